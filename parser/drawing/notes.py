"""What is said of a drawing as it was read: what is missing of it, what was assumed and what was mended."""

from collections import Counter
from collections.abc import Iterator, Sequence

from parser.drawing.gather import Gathered
from parser.drawing.loops.chain import Chained
from parser.drawing.loops.once import Again
from parser.drawing.model import LeftOut
from parser.findings.remarks import Remark, remark_text
from parser.text.encoding import printable
from parser.units import mm

_MOST_NAMED = 5  # places and entities named one by one
_UNSEEN = ("off", "frozen", "hidden", "other-layer")
_BY_HABIT = ("broken-line", "never-plotted")  # seen, but drawn as no contour is; read where their layer is asked for


def notes_of(left: Sequence[LeftOut], gathered: Gathered, again: Sequence[Again], chained: Chained) -> Iterator[Remark]:
    """What was left out or mended."""
    counts, why = gathered.counts, Counter(one.why for one in left)
    unseen = sum(why[each] for each in _UNSEEN)
    if unseen:
        yield Remark("other-layers", {"number": unseen})
    for name in _BY_HABIT:
        if why[name]:
            yield Remark(name, {"number": why[name]})
    if counts.no_curves:
        yield Remark("no-curves", {"kinds": _listed(counts.no_curves)})
    if counts.unreadable:
        yield Remark("unreadable", {"kinds": _listed(counts.unreadable)})
    yield from [one.detail for one in left if one.detail][:_MOST_NAMED]
    for number, name in (
        (counts.beyond, "beyond"),
        (counts.upright, "upright"),
        (counts.slanted, "slanted"),
        (sum(each.curves for each in again if each.whole), "drawn-twice"),
        (sum(each.curves for each in again if not each.whole), "overlaps"),
    ):
        if number:
            yield Remark(name, {"number": number})
    yield from _of_chain(chained)


def nothing_text(left: Sequence[LeftOut], layer: str | None) -> str:
    """What is wrong with a drawing that gives no curve: what is there instead, as far as that can be told."""
    where = "" if layer is None else f" on layer {printable(layer)}"
    count = Counter(one.why for one in left)
    unseen = sum(count[why] for why in _UNSEEN) if layer is None else 0
    habit = sum(count[why] for why in _BY_HABIT)
    found = [
        *([f"{unseen} entities on layers that are off or frozen"] if unseen else []),
        *([f"{habit} in broken linetypes or on Defpoints, read where their layer is asked for"] if habit else []),
        *[remark_text(one.detail) for one in left if one.detail][:1],
    ]
    told = f" ({'; '.join(found)})" if found else ""
    return f"holds no line, arc or curve{where}{told}; expected the contour of a part"


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
