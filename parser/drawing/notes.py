"""What a person should know of a drawing beside its curves: what was left out, assumed, joined or doubled."""

from collections import Counter
from collections.abc import Iterator, Sequence

from parser.drawing.blocks import Placed
from parser.drawing.chain import Chained
from parser.drawing.gather import Gathered
from parser.units import mm

_MOST_PLACES = 5  # named one by one


def notes_of(
    placed: Sequence[Placed], wanted: Sequence[Placed], gathered: Gathered, curves: int, chained: Chained
) -> Iterator[str]:
    """Notes, one line each; `curves` is how many are left after what is drawn twice."""
    counts = gathered.counts
    if len(wanted) < len(placed):
        yield f"{len(placed) - len(wanted)} entities on other layers, or on layers that are off or frozen, left out"
    if counts.no_curves:
        yield f"left out, as no curves: {_listed(counts.no_curves)}"
    if counts.unreadable:
        yield f"left out, as their numbers cannot be: {_listed(counts.unreadable)}"
    for number, text in (
        (counts.beyond, "curves left out, as they lie beyond 10 km or nowhere"),
        (counts.upright, "circles or ellipses left out, as they stand upright and are lines from above"),
        (counts.slanted, "curves are not level; taken as they are seen from above"),
        (len(gathered.curves) - curves, "curves left out, as they are drawn twice"),
    ):
        if number:
            yield f"{number} {text}"
    yield from _of_chain(chained)


def _of_chain(chained: Chained) -> Iterator[str]:
    bridged = [loop.gap_um for loop in chained.loops if loop.gap_um > 0.0]
    if bridged:
        yield f"gaps of up to {max(bridged):.3g} µm bridged in {len(bridged)} loops"
    places = [f"({mm(x):g}, {mm(y):g})" for x, y in chained.branches_um[:_MOST_PLACES].tolist()]
    if places:
        more = len(chained.branches_um) - len(places)
        yield f"more than two ends meet at {', '.join(places)} mm{f' and {more} more places' if more else ''}"


def _listed(counts: Counter[str]) -> str:
    return ", ".join(f"{number} {kind}" for kind, number in sorted(counts.items()))
