"""Findings: what is wrong with a program, as data with a stable code; their texts are in `parser.findings.catalogue`.

The hundreds digit of a code names the layer: ``3B1xx`` grammar, ``3B2xx`` block, ``3B3xx`` contour, ``3B4xx`` machine,
``3B5xx`` wire offset, ``3B6xx`` drawing.
"""

from collections.abc import Mapping
from enum import StrEnum
from types import MappingProxyType
from typing import NamedTuple


class Severity(StrEnum):
    """How a finding counts: an error fails the program, a warning and a note do not."""

    ERROR = "error"
    WARNING = "warning"
    NOTE = "note"


SEVERITIES: Mapping[str, Severity] = MappingProxyType(
    dict.fromkeys(
        (
            *("3B100", "3B101", "3B103", "3B104", "3B106"),
            *("3B201", "3B202", "3B204", "3B206", "3B207", "3B208"),
            *("3B301", "3B303", "3B309"),
            *("3B401", "3B402", "3B403", "3B404", "3B490"),
            *("3B501", "3B503", "3B504"),
            *("3B601", "3B602"),
        ),
        Severity.ERROR,
    )
    | dict.fromkeys(
        (
            *("3B105", "3B107", "3B108", "3B109"),
            *("3B203", "3B205", "3B209", "3B210", "3B211", "3B212"),
            *("3B302", "3B305", "3B306", "3B307", "3B308", "3B310"),
            *("3B405", "3B406", "3B502"),
        ),
        Severity.WARNING,
    )
    | dict.fromkeys(("3B102", "3B110", "3B304", "3B311"), Severity.NOTE)
)
"""Severity of each code. An error is certain to spoil a part or a machine; what may be meant so is a warning."""

Value = str | int | float


class Edit(NamedTuple):
    """A certain mend: the characters `first` up to but without `past` of the text become `text`."""

    first: int
    past: int
    text: str


class Finding(NamedTuple):
    """One thing that is wrong, and where.

    Attributes
    ----------
    code
        Key of `SEVERITIES`, and name of its page in the catalogue.
    values
        What fills the placeholders of the page's texts; lengths in µm.
    span
        First character and one past the last, in the text of the program; (0, 0) where no place is meant.
    line, column
        Place of the first character, counted from 1; 0 where the whole program is meant.
    block
        Block number counted from 1; 0 where no one block is meant.
    edits
        What certainly mends it, all together; empty where nothing is certain.
    """

    code: str
    values: Mapping[str, Value] = MappingProxyType({})
    span: tuple[int, int] = (0, 0)
    line: int = 0
    column: int = 0
    block: int = 0
    edits: tuple[Edit, ...] = ()

    @property
    def severity(self) -> Severity:
        """Severity that the catalogue gives this code."""
        return SEVERITIES[self.code]


def file_order(finding: Finding) -> tuple[int, int, int, str]:
    """Sort key: by place in the file, then by block and code."""
    return finding.line, finding.column, finding.block, finding.code
