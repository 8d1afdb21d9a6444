"""A conversion on the terminal: what was written, how far it is off and what it lost; or why there is none."""

from collections.abc import Iterator
from pathlib import Path

import numpy as np

from parser.findings.catalogue import Bilingual, Language
from parser.findings.codes import Severity
from parser.geometry.curves import CurveKind
from parser.program import Program
from parser.text.encoding import printable
from parser.toolpath import Toolpath
from parser.units import mm
from parser.write.losses import Loss
from sim.make.convert import Converted, Refused
from sim.make.wanted import Wanted, upper_file
from sim.show.terminal.finding import finding_lines
from sim.show.terminal.printer import painted, styled
from sim.show.terminal.wrap import wrapped
from sim.show.texts import Words
from sim.show.texts.phrases import as_read, listed, numbered, same
from sim.show.texts.texts import bilingual

_INDENT = "    "


def read_as_lines(program: Program, name: str, language: Language, width: int) -> Iterator[str]:
    """What was assumed to read a program, in lines of `width` cells; none where its text leaves nothing open."""
    if not program.reading.assumptions:
        return
    text = Words(language)("findings.read-as", parts=as_read(program.reading.assumptions))
    yield from wrapped(f"{printable(name)}: {text}", width, "", _INDENT)


def converted_lines(done: Converted, out: Path, wanted: Wanted, language: Language, width: int) -> Iterator[str]:
    """What was written, in lines of `width` cells."""
    words = Words(language)
    warnings = sum(finding.severity is Severity.WARNING for finding in done.checked.findings)
    above = printable(str(upper_file(out)))
    texts = [
        "" if done.upper_data is None else words("convert.upper", out=above),
        words("convert.off", off=f"{done.off_um:.3f}", bound=f"{done.bound_um:g}"),
        words("convert.finds", counts=numbered({"warning": warnings})) if warnings else "",
        words("convert.open", gap=f"{done.open_um:.0f}") if done.open_um else "",
        words("convert.stays-open") if done.stays_open else "",
        words("convert.registers", options=_registers(done)) if done.registers else "",
        words("convert.ramp", ramp=done.ramp_ms) if done.ramp_ms else "",
        words("convert.lost", parts=listed(map(_lost, done.lost))) if done.lost else "",
        "" if done.told_by_itself else words("convert.say-dialect", options=_options(wanted)),
    ]
    head = words("convert.written", out=printable(str(out)), rows=_rows(done.program.toolpath))
    yield from wrapped(head, width, "", _INDENT)
    for text in filter(None, texts):
        yield from wrapped(text, width, _INDENT, _INDENT * 2)


def refused_lines(refused: Refused, name: str, language: Language, width: int) -> Iterator[str]:
    """Why nothing was written: the findings that speak against it, and what is to be done."""
    for finding in refused.findings:
        excerpt = refused.program.excerpt(finding.line) if finding.line else None
        for line in finding_lines(printable(refused.program.name), finding, excerpt, language, width):
            yield painted(line, finding.severity)
    values = {key: bilingual(value) if value.startswith("convert.") else same(value) for key, value in refused.values}
    why = bilingual(f"convert.refused-{refused.why}", **values)
    text = Words(language)("convert.not-written", name=printable(name), why=why)
    yield from (styled(line, "red") for line in wrapped(text, width, "", _INDENT))


def _lost(loss: Loss) -> Bilingual:
    return bilingual(f"convert.lost-{loss.what}", of=printable(loss.of), number=f"{loss.number:,}")


def _rows(toolpath: Toolpath) -> Bilingual:
    names = {"line": CurveKind.LINE, "arc": CurveKind.ARC, "jump": CurveKind.JUMP}
    return numbered({name: int(np.count_nonzero(toolpath.kind == kind)) for name, kind in names.items()})


def _registers(done: Converted) -> str:
    return " ".join(f"--offset {name}={mm(by_um):g}mm" for name, by_um in done.registers)


def _options(wanted: Wanted) -> str:
    if wanted.iso is None:
        return ""
    unit = wanted.iso.reading_unit
    return f"--dialect {wanted.iso.profile.name}" + (f" --unit {unit}" if unit else "")
