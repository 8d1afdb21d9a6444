"""Where a cut is off its drawing: strips between the edge and the drawing, filled by what is wrong there.

A strip that would be too thin to be seen is drawn so many times as wide, and its legend says how many.
"""

from collections.abc import Iterator
from typing import TYPE_CHECKING, Final, NamedTuple

import numpy as np
import shapely

from parser.geometry.along import places
from parser.geometry.curves import Curves, Floats, Ints
from sim.show.draw import style
from sim.show.draw.canvas import Canvas
from sim.show.draw.layout import Page, View, nice_below
from sim.show.draw.legend import Entry, stroke
from sim.show.draw.paints import Paint
from sim.show.draw.simplify import CHORD_PX, simplify
from sim.show.texts import Words

if TYPE_CHECKING:  # of a path no comparison is known
    from sim.measure.compare.result import Comparison

_SEEN: Final = 7.0  # units that the widest strip is drawn wide, at least
_PARTS: Final = 64  # of an edge's row, at most
_PART_UM: Final = 250.0
_PAINTS: Final = {-1: Paint.OVERCUT, 1: Paint.LEFT_OVER}


class OffDrawing(NamedTuple):
    """Where an edge is off a drawing by more than is allowed, in the program's coordinates.

    Attributes
    ----------
    drawing
        The drawing's curves as they are laid on the part.
    edge_um, foot_um
        (k, 2) places along the edge, and the nearest ones on the drawing.
    strip
        (k,) which strip each place is of, rising.
    side
        (k,) −1 where the part is gouged, +1 where material is left.
    """

    drawing: Curves
    edge_um: Floats
    foot_um: Floats
    strip: Ints
    side: Ints

    @property
    def most_um(self) -> float:
        """The widest that a strip is."""
        return float(np.hypot(*(self.edge_um - self.foot_um).T).max())

    def times_in(self, page: Page) -> int:
        """How many times as wide as they are the strips are drawn, to be seen."""
        wide_px = self.most_um * page.view.px_per_um
        wanted = _SEEN * page.unit / max(wide_px, 1e-9)
        return 1 if wanted <= 1.0 else int(np.ceil(nice_below(2.0 * wanted)))


def off_drawing(comparison: "Comparison") -> OffDrawing | None:
    """Where the edge of a cut is off its drawing; None where it is nowhere, or it is not known to which side."""
    found, edge = comparison.edge_to_drawing, comparison.edge.curves
    is_off = (found.max_um > comparison.request.tolerance_um) & (comparison.edge_side != 0.0)
    rows = np.flatnonzero(is_off)
    if not len(rows):
        return None
    parts = np.clip(np.ceil(edge.length_um[rows] / _PART_UM), 2, _PARTS).astype(np.int64)
    strip = np.repeat(np.arange(len(rows)), parts + 1)
    number = np.arange(len(strip)) - np.searchsorted(strip, strip)
    place = places(edge, rows[strip], number / parts[strip])
    side = comparison.edge_side[rows].astype(np.int64)[strip]
    return OffDrawing(comparison.laid, place, _feet(comparison.laid, place), strip, side)


def _feet(drawing: Curves, place_um: Floats) -> Floats:
    """The places (k, 2) on a drawing that lie nearest to others (k, 2), within a tenth of a µm."""
    sides = np.concatenate([np.stack([run[:-1], run[1:]], axis=1) for run in _runs(drawing, 0.1)])
    lines, of = np.asarray(shapely.linestrings(sides)), shapely.points(place_um)
    _, nearest = shapely.STRtree(list(lines)).query_nearest(of, all_matches=False)
    on = lines[nearest]
    feet: Floats = shapely.get_coordinates(shapely.line_interpolate_point(on, shapely.line_locate_point(on, of)))
    return feet


def _runs(drawing: Curves, tolerance_um: float) -> Iterator[Floats]:
    """Each curve of a drawing as chords that lie so near to it: one need not begin where the last one ends."""
    off = np.minimum(tolerance_um / np.maximum(drawing.radius_um, tolerance_um), 1.0)
    chords = np.where(drawing.is_arc, np.ceil(np.abs(drawing.sweep_rad) / (2.0 * np.arccos(1.0 - off))), 1.0)
    parts = np.maximum(np.nan_to_num(chords), 1.0).astype(np.int64)
    row = np.repeat(np.arange(len(parts)), parts + 1)
    past = np.cumsum(parts + 1)
    number = np.arange(len(row)) - (past - parts - 1)[row]
    yield from np.split(places(drawing, row, number / parts[row]), past[:-1])


def draw_off(canvas: Canvas, page: Page, off: OffDrawing) -> None:
    """Fill the strips, and draw the drawing beside them."""
    times = off.times_in(page)
    for side, ring in _rings_px(off, page.view, times):
        canvas.polygon(ring, _PAINTS[side])
    for run in _runs(off.drawing, CHORD_PX / page.view.px_per_um):
        canvas.polyline(simplify(page.view.to_px(run), CHORD_PX), Paint.DRAWING, style.CONTOUR_WIDTH * page.unit)


def _rings_px(off: OffDrawing, view: View, times: int) -> Iterator[tuple[int, Floats]]:
    """The side of each strip, and its outline on the page."""
    edge = view.to_px(off.foot_um + times * (off.edge_um - off.foot_um))
    foot = view.to_px(off.foot_um)
    first = np.flatnonzero(np.diff(off.strip, prepend=-1))
    for low, past in zip(first.tolist(), [*first[1:].tolist(), len(off.strip)], strict=True):
        yield int(off.side[low]), np.concatenate([edge[low:past], foot[low:past][::-1]])


def off_entries(off: OffDrawing | None, page: Page, say: Words) -> Iterator[Entry]:
    """What a legend says of them."""
    if off is None:
        return
    times = off.times_in(page)
    wider = say("cut.times", times=times) if times > 1 else ""
    for side, key in ((-1, "cut.overcut"), (1, "cut.left-over")):
        if (off.side == side).any():
            yield Entry(stroke(_PAINTS[side], 4.0 * style.CONTOUR_WIDTH), say(key) + wider)
    yield Entry(stroke(Paint.DRAWING, style.CONTOUR_WIDTH), say("cut.drawing"))
