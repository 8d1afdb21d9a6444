"""Programs of ISO read with their family named, and what tests ask of them."""

from collections.abc import Mapping

from parser.dialect.reader import Choices
from parser.findings.findings import Finding
from parser.program import Program, parse_program
from parser.toolpath import Toolpath


def read(text: str, dialect: str = "common", registers: Mapping[str, float] | None = None, unit: str = "") -> Program:
    """A program of one family; lines may stand between blanks."""
    lines = "\n".join(line.strip() for line in text.strip().splitlines())
    choices = Choices(dialect=dialect, unit=unit, registers=tuple((registers or {}).items()))
    return parse_program(f"{lines}\n", choices=choices)


def path(text: str, dialect: str = "common", **told: Mapping[str, float]) -> Toolpath:
    """The toolpath of a program."""
    return read(text, dialect, **told).toolpath


def findings(text: str, code: str, dialect: str = "common") -> list[Finding]:
    """Findings of one code."""
    return [finding for finding in read(text, dialect).findings if finding.code == code]


def ends(toolpath: Toolpath) -> list[tuple[float, float]]:
    """Where each row ends, µm."""
    return [(x, y) for x, y in toolpath.end_um.tolist()]
