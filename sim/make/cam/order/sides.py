"""On which side of each contour the wire runs, and which way round."""

from collections.abc import Sequence
from typing import NamedTuple

from controller.offset.shifted import Side
from sim.make.cam.model import CannotCutError, Figure, Refusal
from sim.setup.making import Making, SideWish

_MOST_NAMED = 10


class Way(NamedTuple):
    """Which way round a first pass runs, and on which side of it the contour's wire is then."""

    is_ccw: bool
    side: Side


def with_sides(figures: Sequence[Figure], making: Making) -> tuple[Figure, ...]:
    """The figures with the sides that are asked for, for their layers or for all.

    CannotCutError, ``no-such-layer``, where a layer for which something is asked has no figure: its name may be wrong.
    """
    _refuse_strange(figures, making)
    of_layer = {wish.layer.casefold(): wish.side for wish in making.layers if wish.side is not None}
    return tuple(_with_side(figure, of_layer.get(figure.layer.casefold(), making.side)) for figure in figures)


def _refuse_strange(figures: Sequence[Figure], making: Making) -> None:
    layers = {figure.layer.casefold(): figure.layer for figure in figures}
    strange = [wish.layer for wish in making.layers if wish.layer.casefold() not in layers]
    if strange:
        values = (("layer", strange[0]), ("layers", ", ".join(sorted(layers.values())[:_MOST_NAMED])))
        raise CannotCutError(Refusal("no-such-layer", (), values))


def _with_side(figure: Figure, side: SideWish) -> Figure:
    inside = figure.kind == "hole" if side == "nesting" else side == "inside"
    return figure._replace(runs_inside=inside)


def way_of(figure: Figure, making: Making) -> Way:
    """Which way the first pass over a figure runs.

    ``one-side`` has the wire on its left: counter-clockwise within a contour, clockwise around one.
    """
    is_ccw = figure.runs_inside if making.direction == "one-side" else making.direction == "ccw"
    return Way(is_ccw, Side.LEFT if is_ccw == figure.runs_inside else Side.RIGHT)
