"""Which check gives which finding, for formats that show results check by check."""

from collections.abc import Mapping
from types import MappingProxyType

_CODES = {
    "check-grammar": ("3B100", "3B101", "3B104", "3B106"),
    "check-order": ("3B102", "3B103", "3B105", "3B107", "3B109", "3B110", "3B308", "3B309"),
    "check-header": ("3B108",),
    "check-blocks": ("3B201", "3B202", "3B203", "3B205", "3B206", "3B208", "3B209", "3B210", "3B212"),
    "check-printed-ends": ("3B207",),
    "check-steps": ("3B204", "3B303"),
    "check-contours": ("3B301", "3B302", "3B304", "3B310", "3B311"),
    "check-senses": ("3B211", "3B306"),
    "check-crossings": ("3B307",),
    "check-corners": ("3B305",),
    "check-travel": ("3B401",),
}
CHECKS: tuple[str, ...] = tuple(_CODES)
"""Names of all checks, terms of the catalogue."""

CHECK_OF: Mapping[str, str] = MappingProxyType({code: check for check, codes in _CODES.items() for code in codes})
"""Code -> check. 3B402 to 3B406 and all from 3B490 on have none: only a dry run moves the table, applies an offset, and
holds the cut against a scenario and a drawing."""
