"""Model of ``drycut.fit/1`` (docs/fit.md), and a fit as such a document."""

import json
from typing import Annotated, Literal, TypedDict

from parser import __version__
from parser.documents import Count, Document, Size, Text, Version, one_of
from sim.measure.accept.model import Say
from sim.measure.fit.circle import CircleFit
from sim.measure.fit.corner import CornerFit
from sim.measure.fit.parameters import Parameter
from sim.measure.fit.piece import PieceFit

_DIGITS = 6

Fit = CircleFit | CornerFit | PieceFit


class ParameterEntry(TypedDict):
    """A parameter with its 95 % interval; without numbers, and with why, where the data do not tell it."""

    name: Text
    value: float | None
    least: float | None
    most: float | None
    unit: Annotated[str, one_of("µm", "µrad", "ppm", "ms")]
    determined: bool
    why: str


class LackEntry(TypedDict):
    """Whether the residuals say that the model is not the whole truth, and how."""

    found: bool
    why: str


class FitDocument(TypedDict):
    """What a measured circle or piece tells of a machine, or a corner of the wire; the last two have no directions."""

    schema: Literal["drycut.fit/1"]
    drycut: Version
    file: Text
    places: Count
    left_out: Count
    directions: list[Annotated[str, one_of("ccw", "cw")]]
    parameters: list[ParameterEntry]
    lack_of_fit: LackEntry
    residual_um: Size


FIT = Document(FitDocument, "docs/fit.md")


def document(file: str, fit: Fit, say: Say) -> FitDocument:
    """A fit as plain lists, dicts, numbers and None; `say` has the texts of keys."""
    return {
        "schema": "drycut.fit/1",
        "drycut": __version__,
        "file": file,
        "places": fit.places,
        "left_out": _left_out(fit),
        "directions": ["ccw" if sense > 0 else "cw" for sense in fit.senses] if isinstance(fit, CircleFit) else [],
        "parameters": [_entry(each, say) for each in fit.parameters],
        "lack_of_fit": {"found": bool(fit.lack), "why": say(f"fit.lack-{fit.lack}") if fit.lack else ""},
        "residual_um": _rounded(fit.residual_um) or 0.0,
    }


def _left_out(fit: Fit) -> int:
    """Rows far off, or features that were not used."""
    if isinstance(fit, CornerFit):
        return 0
    return fit.left_out if isinstance(fit, CircleFit) else len(fit.left_out) + len(fit.stepped)


def document_text(file: str, fit: Fit, say: Say) -> str:
    """The document as JSON."""
    return json.dumps(document(file, fit, say), ensure_ascii=False, allow_nan=False, indent=2) + "\n"


def _entry(parameter: Parameter, say: Say) -> ParameterEntry:
    return {
        "name": f"{parameter.name}_{_SUFFIXES[parameter.unit]}",
        "value": _rounded(parameter.value),
        "least": _rounded(parameter.least),
        "most": _rounded(parameter.most),
        "unit": parameter.unit,
        "determined": parameter.is_determined,
        "why": say(f"fit.why-{parameter.why}") if parameter.why else "",
    }


_SUFFIXES = {"µm": "um", "µrad": "urad", "ppm": "ppm", "ms": "ms"}


def _rounded(value: float | None) -> float | None:
    return None if value is None else round(value, _DIGITS) + 0.0
