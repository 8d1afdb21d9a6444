"""On which side of each contour the wire runs, and which way round."""

from collections.abc import Sequence
from typing import NamedTuple

from controller.offset.sections import Side
from sim.cam.model import Figure
from sim.setup.making import Making


class Way(NamedTuple):
    """Which way round a first pass runs, and on which side of it the contour's wire is then."""

    is_ccw: bool
    side: Side


def with_sides(figures: Sequence[Figure], making: Making) -> tuple[Figure, ...]:
    """The figures with the sides that are asked for."""
    if making.side == "nesting":
        return tuple(figures)
    return tuple(figure._replace(runs_inside=making.side == "inside") for figure in figures)


def way_of(figure: Figure, making: Making) -> Way:
    """Which way the first pass over a figure runs."""
    is_ccw = figure.runs_inside if making.direction == "one-side" else making.direction == "ccw"
    return Way(is_ccw, Side.LEFT if is_ccw == figure.runs_inside else Side.RIGHT)
