"""Remarks: what is to be said of a result beside its figures, as data; their words stand in ``pages/remarks.toml``."""

from collections.abc import Mapping
from types import MappingProxyType
from typing import NamedTuple

from parser.findings.catalogue import Language, filled, remark_template
from parser.findings.findings import NO_NAMES, Value


class Remark(NamedTuple):
    """One thing to be said: its name, and what fills its text.

    Lengths among the values are in µm, those that end on ``_mm`` and ``_deg`` in mm and degrees.
    """

    name: str
    values: Mapping[str, Value] = MappingProxyType({})


def remark_text(remark: Remark, language: Language = "en", names: Mapping[int, str] = NO_NAMES) -> str:
    """Text of a remark in one language. KeyError where the catalogue has no such remark.

    `names` has the blocks, by number, that the listing calls by another name.
    """
    return filled(remark_template(remark.name, language), remark.values, language, names)
