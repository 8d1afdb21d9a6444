"""What is said of a drawing as it was read: what is missing of it, what was assumed and what was mended."""

from collections import Counter
from collections.abc import Iterator, Sequence

from parser.drawing.gather import Gathered
from parser.drawing.loops.chain import Chained
from parser.drawing.loops.once import Again
from parser.drawing.model import LeftOut
from parser.findings.catalogue import LANGUAGES, Said
from parser.findings.errors import DrawingError
from parser.findings.messages import Message
from parser.findings.remarks import Remark, remark_text
from parser.text.encoding import printable
from parser.units import mm

_MOST_NAMED = 5  # places and entities named one by one
_UNSEEN = ("off", "frozen", "hidden", "other-layer")
_BY_HABIT = ("broken-line", "never-plotted")  # seen, but drawn as no contour is; read where their layer is asked for


def notes_of(left: Sequence[LeftOut], gathered: Gathered, again: Sequence[Again], chained: Chained) -> Iterator[Remark]:
    """What was left out or mended."""
    counts, why = gathered.counts, Counter(one.why for one in left)
    yield from _not_wanted(left)
    if counts.no_curves:
        yield Remark("no-curves", {"kinds": _listed(counts.no_curves)})
    if counts.unreadable:
        yield Remark("unreadable", {"kinds": _listed(counts.unreadable)})
    yield from [one.detail for one in left if one.detail][:_MOST_NAMED]
    for number, name in (
        (counts.beyond, "beyond"),
        (counts.upright, "upright"),
        (counts.slanted, "slanted"),
        (why["no-width"], "no-width"),
        (why["dot"], "dot"),
        (sum(each.curves for each in again if each.whole), "drawn-twice"),
        (sum(each.curves for each in again if not each.whole), "overlaps"),
    ):
        if number:
            yield Remark(name, {"number": number})
    yield from _of_chain(chained)


def _not_wanted(left: Sequence[LeftOut]) -> Iterator[Remark]:
    """What would be curves, and was not read."""
    why = Counter(one.why for one in left)
    unseen = sum(why[each] for each in _UNSEEN)
    if unseen:
        yield Remark("other-layers", {"number": unseen})
    for name in _BY_HABIT:
        if why[name]:
            yield Remark(name, {"number": why[name]})


def no_contour(left: Sequence[LeftOut], layer: str | None) -> DrawingError:
    """What is wrong with a drawing that gives no curve: what is there instead, as far as that can be told."""
    where = "" if layer is None else Message("on-layer", layer=printable(layer))
    wrong = [one.detail for one in left if one.detail][:1]
    instead = [*([] if layer else _not_wanted(left)), *wrong]
    aside = Said(*("; ".join(remark_text(remark, language) for remark in instead) for language in LANGUAGES))
    return DrawingError("no-curve", where=where, instead=aside)


def _of_chain(chained: Chained) -> Iterator[Remark]:
    bridged = [loop.gap_um for loop in chained.loops if loop.gap_um > 0.0]
    if bridged:
        yield Remark("bridged", {"gap": max(bridged), "loops": len(bridged)})
    places = [f"({mm(x):g}, {mm(y):g})" for x, y in chained.branches_um[:_MOST_NAMED].tolist()]
    more = len(chained.branches_um) - len(places)
    if more:
        yield Remark("many-branches", {"places": ", ".join(places), "more": more})
    elif places:
        yield Remark("branches", {"places": ", ".join(places)})


def _listed(counts: Counter[str]) -> str:
    return ", ".join(f"{number} {kind}" for kind, number in sorted(counts.items()))
