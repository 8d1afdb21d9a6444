"""Model of ``drycut.accept/1`` (docs/accept.md), and a judgement as such a document."""

import json
from typing import Annotated, Literal, Protocol, TypedDict

from parser import __version__
from parser.documents import Count, Document, Size, Text, Version, one_of
from sim.measure.accept.gap import MeasuredGap
from sim.measure.accept.judge import Judged, Judgement

_DIGITS = 6
VerdictName = Annotated[str, one_of("pass", "to-check", "fail")]


class Say(Protocol):
    """Words for people in one language: the text of a key."""

    def __call__(self, key: str, /) -> str:
        """Text of a key; KeyError where there is none."""


class CharacteristicEntry(TypedDict):
    """A size or a form of a feature at a height, null for all together."""

    feature: Text
    z_mm: float | None
    kind: Annotated[str, one_of("circle", "width")]
    what: Annotated[str, one_of("size", "form")]
    value_um: float
    nominal_um: Size
    deviation_um: float
    uncertainty_um: Size
    lower_um: float
    upper_um: float
    verdict: VerdictName


class CauseEntry(TypedDict):
    """What would explain deviations, with its 95 % interval."""

    name: Annotated[str, one_of("offset", "x-less-y", "barrel")]
    value_um: float
    least_um: float
    most_um: float
    text: Text


class GapEntry(TypedDict):
    """The spark gap that the piece tells, with its 95 % interval, and of how many sizes."""

    value_um: float
    least_um: float
    most_um: float
    sizes: Count


class AcceptDocument(TypedDict):
    """A measured piece by its limits."""

    schema: Literal["drycut.accept/1"]
    drycut: Version
    file: Text
    verdict: Annotated[str, one_of("pass", "to-check", "incomplete", "fail")]
    features: list[CharacteristicEntry]
    missing: list[Text]
    without_limits: list[Text]
    causes: list[CauseEntry]
    gap: GapEntry | None


ACCEPT = Document(AcceptDocument, "docs/accept.md")


def document(file: str, of: Judgement, gap: MeasuredGap | None, say: Say) -> AcceptDocument:
    """A judgement, and the gap if it was asked for, as plain lists, dicts, numbers and None; `say` has texts."""
    return {
        "schema": "drycut.accept/1",
        "drycut": __version__,
        "file": file,
        "verdict": of.verdict,
        "features": [*map(_entry, of.judged)],
        "missing": [*of.missing],
        "without_limits": [*of.without_limits],
        "causes": [
            {
                "name": cause.name,
                "value_um": _rounded(cause.value_um),
                "least_um": _rounded(cause.value_um - cause.by_um),
                "most_um": _rounded(cause.value_um + cause.by_um),
                "text": say(f"accept.cause-{cause.name}"),
            }
            for cause in of.causes
        ],
        "gap": None if gap is None else _gap(gap),
    }


def _gap(gap: MeasuredGap) -> GapEntry:
    return {
        "value_um": _rounded(gap.gap_um),
        "least_um": _rounded(gap.gap_um - gap.by_um),
        "most_um": _rounded(gap.gap_um + gap.by_um),
        "sizes": gap.sizes,
    }


def document_text(file: str, of: Judgement, gap: MeasuredGap | None, say: Say) -> str:
    """The document as JSON."""
    return json.dumps(document(file, of, gap, say), ensure_ascii=False, allow_nan=False, indent=2) + "\n"


def _entry(each: Judged) -> CharacteristicEntry:
    return {
        "feature": each.feature.name,
        "z_mm": None if each.z_mm is None else _rounded(each.z_mm),
        "kind": each.feature.kind,
        "what": each.what,
        "value_um": _rounded(each.value_um),
        "nominal_um": _rounded(each.nominal_um),
        "deviation_um": _rounded(each.deviation_um),
        "uncertainty_um": _rounded(each.uncertainty_um),
        "lower_um": _rounded(each.lower_um),
        "upper_um": _rounded(each.upper_um),
        "verdict": each.verdict,
    }


def _rounded(value: float) -> float:
    return round(value, _DIGITS) + 0.0
