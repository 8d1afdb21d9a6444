"""Every code there is: how severe its findings are, which check gives them, and whether they name their own place.

The hundreds digit of a code names the layer: ``3B1xx`` grammar, ``3B2xx`` block, ``3B3xx`` contour, ``3B4xx`` machine,
``3B5xx`` wire offset, ``3B6xx`` drawing. A code is stable, and never used twice.
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


class Check(StrEnum):
    """The checks of a program, by their names, which are terms of the catalogue."""

    GRAMMAR = "check-grammar"
    ORDER = "check-order"
    HEADER = "check-header"
    BLOCKS = "check-blocks"
    PRINTED_ENDS = "check-printed-ends"
    STEPS = "check-steps"
    CONTOURS = "check-contours"
    SENSES = "check-senses"
    CROSSINGS = "check-crossings"
    CORNERS = "check-corners"
    TRAVEL = "check-travel"


class Code(NamedTuple):
    """What holds for all findings of a code.

    Attributes
    ----------
    severity
        An error is certain to spoil a part or a machine; what may be meant so is a warning.
    check
        The check that gives it; None where only a dry run does, which moves the table, applies an offset, and holds
        the cut against a scenario and a drawing.
    placed
        Whether the finding says itself where it is, by its values ``x_mm`` and ``y_mm``: places on the part.
    """

    severity: Severity
    check: Check | None
    placed: bool = False


CODES: Mapping[str, Code] = MappingProxyType(
    {
        "3B100": Code(Severity.ERROR, Check.GRAMMAR),
        "3B101": Code(Severity.ERROR, Check.GRAMMAR),
        "3B102": Code(Severity.NOTE, Check.ORDER),
        "3B103": Code(Severity.ERROR, Check.ORDER),
        "3B104": Code(Severity.ERROR, Check.GRAMMAR),
        "3B105": Code(Severity.WARNING, Check.ORDER),
        "3B106": Code(Severity.ERROR, Check.GRAMMAR),
        "3B107": Code(Severity.WARNING, Check.ORDER),
        "3B108": Code(Severity.WARNING, Check.HEADER),
        "3B109": Code(Severity.WARNING, Check.ORDER),
        "3B110": Code(Severity.NOTE, Check.ORDER),
        "3B201": Code(Severity.ERROR, Check.BLOCKS),
        "3B202": Code(Severity.ERROR, Check.BLOCKS),
        "3B203": Code(Severity.WARNING, Check.BLOCKS),
        "3B204": Code(Severity.ERROR, Check.STEPS),
        "3B205": Code(Severity.WARNING, Check.BLOCKS),
        "3B206": Code(Severity.ERROR, Check.BLOCKS),
        "3B207": Code(Severity.ERROR, Check.PRINTED_ENDS),
        "3B208": Code(Severity.ERROR, Check.BLOCKS),
        "3B209": Code(Severity.WARNING, Check.BLOCKS),
        "3B210": Code(Severity.WARNING, Check.BLOCKS),
        "3B211": Code(Severity.WARNING, Check.SENSES),
        "3B212": Code(Severity.WARNING, Check.BLOCKS),
        "3B301": Code(Severity.ERROR, Check.CONTOURS),
        "3B302": Code(Severity.WARNING, Check.CONTOURS),
        "3B303": Code(Severity.ERROR, Check.STEPS),
        "3B304": Code(Severity.NOTE, Check.CONTOURS),
        "3B305": Code(Severity.WARNING, Check.CORNERS),
        "3B306": Code(Severity.WARNING, Check.SENSES),
        "3B307": Code(Severity.WARNING, Check.CROSSINGS),
        "3B308": Code(Severity.WARNING, Check.ORDER),
        "3B309": Code(Severity.ERROR, Check.ORDER),
        "3B310": Code(Severity.WARNING, Check.CONTOURS),
        "3B311": Code(Severity.NOTE, Check.CONTOURS),
        "3B401": Code(Severity.ERROR, Check.TRAVEL),
        "3B402": Code(Severity.ERROR, check=None, placed=True),
        "3B403": Code(Severity.ERROR, check=None, placed=True),
        "3B404": Code(Severity.ERROR, check=None, placed=True),
        "3B405": Code(Severity.WARNING, check=None, placed=True),
        "3B406": Code(Severity.WARNING, check=None, placed=True),
        "3B490": Code(Severity.ERROR, check=None),
        "3B501": Code(Severity.ERROR, check=None, placed=True),
        "3B502": Code(Severity.WARNING, check=None, placed=True),
        "3B503": Code(Severity.ERROR, check=None, placed=True),
        "3B504": Code(Severity.ERROR, check=None),
        "3B601": Code(Severity.ERROR, check=None, placed=True),
        "3B602": Code(Severity.ERROR, check=None),
    }
)
"""All codes, in their order."""
