"""Every code there is: how severe its findings are, which check gives them, and whether they name their own place.

The hundreds digit of a code names the layer: ``3B1xx`` grammar, ``3B2xx`` block, ``3B3xx`` contour, ``3B4xx`` machine,
``3B5xx`` wire offset, ``3B6xx`` drawing, ``3B7xx`` taper. ``ISO1xx`` to ``ISO5xx`` are the same layers of ISO, with
the program's own compensation as the fifth; ``PMC1xx`` and ``PMC2xx`` are those of PMAC, ``GEC4xx`` are of programs for
the GE card. A code is stable, and never used twice.
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
    PASSES = "check-passes"
    CORNERS = "check-corners"
    TRAVEL = "check-travel"
    COMPENSATION = "check-compensation"
    TAPER = "check-taper"


class FindingCode(NamedTuple):
    """What holds for all findings of a code.

    Attributes
    ----------
    severity
        An error is certain to spoil a part or a machine; what may be meant so is a warning.
    check
        The check that gives it, one of a shop's own by its name; None where only a dry run does, which moves the table,
        applies an offset, and holds the cut against a scenario and a drawing.
    placed
        Whether the finding says itself where it is, by its values ``x_mm`` and ``y_mm``: places on the part.
    spoils
        Whether a warning of this code tells of a part that is scrap unless it was meant so, as its page says. No sound
        program has one. A person looks at it before the cut.
    """

    severity: Severity
    check: Check | str | None
    placed: bool = False
    spoils: bool = False


_codes = {
    "3B100": FindingCode(Severity.ERROR, Check.GRAMMAR),
    "3B101": FindingCode(Severity.ERROR, Check.GRAMMAR),
    "3B102": FindingCode(Severity.NOTE, Check.ORDER),
    "3B103": FindingCode(Severity.ERROR, Check.ORDER),
    "3B104": FindingCode(Severity.ERROR, Check.GRAMMAR),
    "3B105": FindingCode(Severity.WARNING, Check.ORDER),
    "3B106": FindingCode(Severity.ERROR, Check.GRAMMAR),
    "3B107": FindingCode(Severity.WARNING, Check.ORDER),
    "3B108": FindingCode(Severity.WARNING, Check.HEADER),
    "3B109": FindingCode(Severity.WARNING, Check.ORDER),
    "3B110": FindingCode(Severity.NOTE, Check.ORDER),
    "3B111": FindingCode(Severity.ERROR, Check.HEADER),
    "3B112": FindingCode(Severity.WARNING, Check.HEADER, spoils=True),
    "3B113": FindingCode(Severity.NOTE, Check.GRAMMAR),
    "3B114": FindingCode(Severity.NOTE, Check.GRAMMAR),
    "3B201": FindingCode(Severity.ERROR, Check.BLOCKS),
    "3B202": FindingCode(Severity.ERROR, Check.BLOCKS),
    "3B203": FindingCode(Severity.WARNING, Check.BLOCKS),
    "3B204": FindingCode(Severity.ERROR, Check.STEPS),
    "3B205": FindingCode(Severity.WARNING, Check.BLOCKS),
    "3B206": FindingCode(Severity.ERROR, Check.BLOCKS),
    "3B207": FindingCode(Severity.ERROR, Check.PRINTED_ENDS),
    "3B208": FindingCode(Severity.ERROR, Check.BLOCKS),
    "3B209": FindingCode(Severity.WARNING, Check.BLOCKS),
    "3B210": FindingCode(Severity.WARNING, Check.BLOCKS),
    "3B211": FindingCode(Severity.WARNING, Check.SENSES, spoils=True),
    "3B212": FindingCode(Severity.WARNING, Check.BLOCKS),
    "3B213": FindingCode(Severity.WARNING, Check.PRINTED_ENDS),
    "3B214": FindingCode(Severity.WARNING, Check.SENSES),
    "3B215": FindingCode(Severity.WARNING, Check.SENSES),
    "3B216": FindingCode(Severity.ERROR, Check.CORNERS),
    "3B217": FindingCode(Severity.ERROR, Check.PRINTED_ENDS),
    "3B301": FindingCode(Severity.ERROR, Check.CONTOURS),
    "3B302": FindingCode(Severity.WARNING, Check.CONTOURS),
    "3B303": FindingCode(Severity.ERROR, Check.STEPS),
    "3B304": FindingCode(Severity.NOTE, Check.CONTOURS),
    "3B305": FindingCode(Severity.WARNING, Check.CORNERS),
    "3B306": FindingCode(Severity.WARNING, Check.SENSES, spoils=True),
    "3B307": FindingCode(Severity.WARNING, Check.CROSSINGS, spoils=True),
    "3B308": FindingCode(Severity.WARNING, Check.ORDER),
    "3B309": FindingCode(Severity.ERROR, Check.ORDER),
    "3B310": FindingCode(Severity.WARNING, Check.CONTOURS, spoils=True),
    "3B311": FindingCode(Severity.NOTE, Check.CONTOURS),
    "3B312": FindingCode(Severity.WARNING, Check.PASSES),
    "3B313": FindingCode(Severity.WARNING, Check.PASSES),
    "3B314": FindingCode(Severity.ERROR, Check.PASSES),
    "3B315": FindingCode(Severity.WARNING, Check.PASSES),
    "3B316": FindingCode(Severity.WARNING, Check.PASSES, spoils=True),
    "3B317": FindingCode(Severity.WARNING, Check.CONTOURS, spoils=True),
    "3B318": FindingCode(Severity.WARNING, Check.SENSES, spoils=True),
    "3B319": FindingCode(Severity.WARNING, Check.CONTOURS, spoils=True),
    "3B320": FindingCode(Severity.WARNING, Check.ORDER, spoils=True),
    "3B321": FindingCode(Severity.ERROR, Check.PASSES, placed=True),
    "3B322": FindingCode(Severity.NOTE, Check.CONTOURS),
    "3B401": FindingCode(Severity.ERROR, Check.TRAVEL),
    "3B402": FindingCode(Severity.ERROR, check=None, placed=True),
    "3B403": FindingCode(Severity.ERROR, check=None, placed=True),
    "3B404": FindingCode(Severity.ERROR, check=None, placed=True),
    "3B405": FindingCode(Severity.WARNING, check=None, placed=True),
    "3B406": FindingCode(Severity.WARNING, check=None, placed=True),
    "3B407": FindingCode(Severity.WARNING, check=None),
    "3B408": FindingCode(Severity.ERROR, check=None, placed=True),
    "3B490": FindingCode(Severity.ERROR, check=None),
    "3B501": FindingCode(Severity.ERROR, check=None, placed=True),
    "3B502": FindingCode(Severity.WARNING, check=None, placed=True, spoils=True),
    "3B503": FindingCode(Severity.ERROR, check=None, placed=True),
    "3B504": FindingCode(Severity.ERROR, check=None),
    "3B505": FindingCode(Severity.ERROR, check=None),
    "3B506": FindingCode(Severity.WARNING, check=None, spoils=True),
    "3B601": FindingCode(Severity.ERROR, check=None, placed=True),
    "3B602": FindingCode(Severity.ERROR, check=None),
    "3B603": FindingCode(Severity.NOTE, check=None, placed=True),
    "3B604": FindingCode(Severity.ERROR, check=None),
    "3B605": FindingCode(Severity.ERROR, check=None),
    "3B606": FindingCode(Severity.WARNING, check=None, placed=True, spoils=True),
    "3B607": FindingCode(Severity.WARNING, check=None, spoils=True),
    "3B608": FindingCode(Severity.WARNING, check=None),
    "3B609": FindingCode(Severity.WARNING, check=None, spoils=True),
    "3B701": FindingCode(Severity.ERROR, Check.TAPER),
    "3B702": FindingCode(Severity.ERROR, Check.TAPER),
    "3B703": FindingCode(Severity.ERROR, Check.TAPER),
    "3B704": FindingCode(Severity.ERROR, Check.TAPER),
    "3B705": FindingCode(Severity.ERROR, Check.TAPER),
    "3B706": FindingCode(Severity.WARNING, Check.TAPER, spoils=True),
    "3B708": FindingCode(Severity.WARNING, check=None, spoils=True),
    "3B709": FindingCode(Severity.ERROR, Check.TAPER),
    "3B710": FindingCode(Severity.ERROR, Check.TAPER),
    "3B711": FindingCode(Severity.ERROR, check=None, placed=True),
    "3B712": FindingCode(Severity.WARNING, Check.TAPER),
    "GEC401": FindingCode(Severity.WARNING, None),
    "GEC402": FindingCode(Severity.WARNING, None),
    "GEC403": FindingCode(Severity.WARNING, None),
    "ISO100": FindingCode(Severity.ERROR, Check.GRAMMAR),
    "ISO101": FindingCode(Severity.ERROR, Check.GRAMMAR),
    "ISO102": FindingCode(Severity.ERROR, Check.GRAMMAR),
    "ISO103": FindingCode(Severity.ERROR, Check.GRAMMAR),
    "ISO104": FindingCode(Severity.WARNING, Check.GRAMMAR),
    "ISO105": FindingCode(Severity.ERROR, Check.GRAMMAR),
    "ISO106": FindingCode(Severity.NOTE, Check.GRAMMAR),
    "ISO107": FindingCode(Severity.NOTE, Check.GRAMMAR),
    "ISO108": FindingCode(Severity.WARNING, Check.ORDER),
    "ISO109": FindingCode(Severity.WARNING, Check.ORDER),
    "ISO110": FindingCode(Severity.ERROR, Check.GRAMMAR),
    "ISO111": FindingCode(Severity.NOTE, Check.GRAMMAR),
    "ISO112": FindingCode(Severity.NOTE, Check.GRAMMAR),
    "ISO113": FindingCode(Severity.NOTE, Check.GRAMMAR),
    "ISO120": FindingCode(Severity.WARNING, Check.ORDER),
    "ISO121": FindingCode(Severity.ERROR, Check.ORDER),
    "ISO130": FindingCode(Severity.NOTE, Check.ORDER),
    "ISO200": FindingCode(Severity.ERROR, Check.BLOCKS),
    "ISO201": FindingCode(Severity.ERROR, Check.BLOCKS),
    "ISO202": FindingCode(Severity.ERROR, Check.BLOCKS),
    "ISO203": FindingCode(Severity.ERROR, Check.BLOCKS),
    "ISO204": FindingCode(Severity.WARNING, Check.BLOCKS, spoils=True),
    "ISO205": FindingCode(Severity.ERROR, Check.BLOCKS),
    "ISO206": FindingCode(Severity.ERROR, Check.BLOCKS),
    "ISO207": FindingCode(Severity.WARNING, Check.BLOCKS),
    "ISO208": FindingCode(Severity.ERROR, Check.ORDER),
    "ISO209": FindingCode(Severity.NOTE, Check.BLOCKS),
    "ISO210": FindingCode(Severity.ERROR, Check.BLOCKS),
    "ISO211": FindingCode(Severity.ERROR, Check.BLOCKS),
    "ISO212": FindingCode(Severity.WARNING, Check.BLOCKS),
    "ISO213": FindingCode(Severity.ERROR, Check.BLOCKS),
    "ISO214": FindingCode(Severity.ERROR, Check.BLOCKS),
    "ISO215": FindingCode(Severity.ERROR, Check.BLOCKS),
    "ISO216": FindingCode(Severity.WARNING, Check.BLOCKS, spoils=True),
    "ISO217": FindingCode(Severity.NOTE, Check.BLOCKS),
    "ISO218": FindingCode(Severity.WARNING, Check.BLOCKS),
    "ISO219": FindingCode(Severity.WARNING, Check.SENSES, spoils=True),
    "ISO300": FindingCode(Severity.ERROR, Check.CONTOURS),
    "ISO301": FindingCode(Severity.WARNING, Check.CONTOURS, spoils=True),
    "ISO302": FindingCode(Severity.WARNING, Check.CONTOURS),
    "ISO303": FindingCode(Severity.NOTE, Check.ORDER),
    "ISO304": FindingCode(Severity.ERROR, Check.TRAVEL),
    "ISO305": FindingCode(Severity.WARNING, Check.CROSSINGS, spoils=True),
    "ISO306": FindingCode(Severity.WARNING, Check.PASSES),
    "ISO307": FindingCode(Severity.WARNING, Check.PASSES),
    "ISO308": FindingCode(Severity.WARNING, Check.PASSES, spoils=True),
    "ISO309": FindingCode(Severity.NOTE, Check.PASSES),
    "ISO400": FindingCode(Severity.ERROR, Check.ORDER),
    "ISO401": FindingCode(Severity.NOTE, Check.ORDER),
    "ISO402": FindingCode(Severity.WARNING, Check.ORDER),
    "ISO500": FindingCode(Severity.ERROR, Check.COMPENSATION),
    "ISO501": FindingCode(Severity.WARNING, Check.COMPENSATION, spoils=True),
    "ISO502": FindingCode(Severity.ERROR, Check.COMPENSATION),
    "ISO503": FindingCode(Severity.WARNING, Check.COMPENSATION),
    "ISO504": FindingCode(Severity.ERROR, Check.COMPENSATION, placed=True),
    "ISO505": FindingCode(Severity.ERROR, Check.COMPENSATION, placed=True),
    "ISO506": FindingCode(Severity.ERROR, Check.COMPENSATION, placed=True),
    "ISO507": FindingCode(Severity.ERROR, Check.COMPENSATION),
    "ISO508": FindingCode(Severity.WARNING, Check.COMPENSATION, spoils=True),
    "ISO509": FindingCode(Severity.NOTE, Check.COMPENSATION),
    "ISO510": FindingCode(Severity.WARNING, Check.COMPENSATION),
    "ISO511": FindingCode(Severity.ERROR, Check.COMPENSATION),
    "ISO512": FindingCode(Severity.WARNING, Check.COMPENSATION, spoils=True),
    "ISO513": FindingCode(Severity.NOTE, Check.COMPENSATION),
    "ISO514": FindingCode(Severity.WARNING, Check.COMPENSATION),
    "ISO600": FindingCode(Severity.WARNING, Check.BLOCKS),
    "ISO601": FindingCode(Severity.NOTE, Check.TAPER),
    "PMC100": FindingCode(Severity.ERROR, Check.GRAMMAR),
    "PMC101": FindingCode(Severity.ERROR, Check.GRAMMAR),
    "PMC102": FindingCode(Severity.ERROR, Check.GRAMMAR),
    "PMC103": FindingCode(Severity.WARNING, Check.ORDER),
    "PMC104": FindingCode(Severity.ERROR, Check.GRAMMAR),
    "PMC105": FindingCode(Severity.WARNING, Check.ORDER),
    "PMC106": FindingCode(Severity.NOTE, Check.ORDER),
    "PMC107": FindingCode(Severity.WARNING, Check.GRAMMAR),
    "PMC108": FindingCode(Severity.ERROR, Check.GRAMMAR),
    "PMC201": FindingCode(Severity.ERROR, Check.BLOCKS),
    "PMC202": FindingCode(Severity.ERROR, Check.BLOCKS),
    "PMC203": FindingCode(Severity.ERROR, Check.BLOCKS),
    "PMC204": FindingCode(Severity.WARNING, Check.BLOCKS),
    "PMC205": FindingCode(Severity.NOTE, Check.BLOCKS),
    "PMC206": FindingCode(Severity.WARNING, Check.BLOCKS),
    "PMC207": FindingCode(Severity.WARNING, Check.BLOCKS),
    "PMC208": FindingCode(Severity.NOTE, Check.BLOCKS),
    "PMC209": FindingCode(Severity.ERROR, Check.BLOCKS),
}
CODES: Mapping[str, FindingCode] = MappingProxyType(_codes)
"""All codes by their names, in their order; those of checks of a shop's own stand last, once such checks were found."""


def add_codes(codes: Mapping[str, FindingCode]) -> None:
    """Make codes of a shop's own known."""
    _codes.update(codes)


CODES_OF_ISO: Mapping[str, str] = MappingProxyType(
    {
        "3B211": "ISO219",
        "3B301": "ISO300",
        "3B306": "ISO219",
        "3B307": "ISO305",
        "3B312": "ISO307",
        "3B316": "ISO308",
        "3B401": "ISO304",
        "3B501": "ISO504",
        "3B502": "ISO505",
        "3B503": "ISO506",
        "3B504": "ISO507",
    }
)
"""Codes of ISO for findings of the path and the machine that are made under those of 3B."""
