"""Ways all round a contour at the offset of each pass, begun where the wire comes to it."""

from itertools import pairwise

import numpy as np

from parser.geometry.curves import Curves
from parser.toolpath import Point
from sim.make.cam.model import CannotCutError, Figure, Refusal, Thread
from sim.make.cam.passes.beside.beside import beside
from sim.make.cam.passes.beside.short import SHORT_UM
from sim.make.cam.passes.turned import begun_at
from sim.setup.making import Making

_FARTHEST = 1.5  # times the offset: how far from a corner of the contour the way turns round it; √2 at 90°


def offsets_of(figure: Figure, passes_um: tuple[float, ...], making: Making) -> tuple[float, ...]:
    """Offset of each pass over a figure: as its layer asks for, else as for all. CannotCutError where one rises."""
    layer = figure.layer.lower()
    asked = next(
        (wish.passes_um for wish in making.layers if wish.layer.lower() == layer and wish.passes_um), passes_um
    )
    for number, (by_um, next_um) in enumerate(pairwise(asked), start=2):
        if next_um > by_um:
            values = (("number", str(number)), ("offset_mm", f"{next_um / 1000:g}"), ("before_mm", f"{by_um / 1000:g}"))
            raise CannotCutError(Refusal("offset-rises", (), values))
    return asked


def around(figure: Figure, thread: Thread, by_um: float, making: Making) -> Curves:
    """The closed way counter-clockwise at an offset, begun across from the entry; CannotCutError where it has none."""
    way = beside(figure, by_um, making.corners)
    return begun_at(way, _begin(figure, thread, by_um, way))


def _begin(figure: Figure, thread: Thread, by_um: float, way: Curves) -> Point:
    """Where a way begins: across from the entry, or where the way turns round the corner that the entry lies at.

    From there on the wire does not touch the part: a mark of it stays off the corner.
    """
    entry = thread.entry
    across = Point(entry.place_um.x + by_um * entry.out.x, entry.place_um.y + by_um * entry.out.y)
    length = float(figure.contour.length_um[entry.row])
    if SHORT_UM < entry.along_um < length - SHORT_UM:
        return across
    off = np.hypot(*(way.start_um - np.array(entry.place_um)).T)
    beside_um = np.hypot(*(way.start_um - np.array(across)).T)
    near = (off >= by_um - SHORT_UM) & (off <= _FARTHEST * by_um)
    if not near.any():
        return across
    return Point(*way.start_um[int(np.argmin(np.where(near, beside_um, np.inf)))].tolist())
