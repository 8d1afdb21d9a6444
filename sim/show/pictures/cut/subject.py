"""What the picture of a cut shows, the page that it is drawn on, and what stands beside the path.

The workpiece and what stands beside the path, as filled outlines under the kerf: the work plain, clamps hatched.
"""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Final, NamedTuple

import numpy as np

from parser.findings.findings import Finding
from parser.geometry.curves import Bools, Curves, Floats, box_of
from parser.shape.passes import Passes
from parser.toolpath import Toolpath
from sim.setup.obstacles import Outline
from sim.show.draw import style
from sim.show.draw.canvas import Canvas
from sim.show.draw.layout import Box, Page, Room
from sim.show.draw.style import Paint
from sim.show.texts import Words

if TYPE_CHECKING:  # what only a run has: the picture of a path does without the engine
    from sim.cut.pieces.pieces import Pieces
    from sim.cut.sizes import Sizes
    from sim.measure.compare.result import OffSizes, Strips
    from sim.table.trace import Trace


_BEYOND_PX = 20.0  # outlines go on so far past the frame, which hides the sides that cutting them off there makes


class Bodies(NamedTuple):
    """Outlines of the workpiece, if known, and of the clamps, µm."""

    work_um: Outline | None = None
    clamps_um: Sequence[Outline] = ()

    def around(self, bounds_um: Floats) -> Floats:
        """The box (2, 2) µm of a path, grown to show as much of the bodies as lies near."""
        reach = style.BODIES_NEAR * float((bounds_um[1] - bounds_um[0]).max())
        near = bounds_um + np.array([[-reach], [reach]])
        boxes = [np.stack([np.min(body, axis=0), np.max(body, axis=0)]) for body in self._all()]
        met = [np.clip(box, *near) for box in boxes if (box[0] <= near[1]).all() and (box[1] >= near[0]).all()]
        corners = np.concatenate([bounds_um, *met])
        return box_of(corners)

    def _all(self) -> list[Outline]:
        return [*([] if self.work_um is None else [self.work_um]), *self.clamps_um]


def draw_bodies(canvas: Canvas, page: Page, bodies: Bodies) -> None:
    """Draw what of the bodies lies in the plot."""
    with canvas.clipped(page.inside):
        for corners in works_on(page, bodies):
            draw_work(canvas, corners, page.unit)
        for corners in clamps_on(page, bodies):
            draw_clamp(canvas, corners, page.unit)


def works_on(page: Page, bodies: Bodies) -> list[Floats]:
    """Corners (n, 2) px of the workpiece as far as it lies in or near the plot; none where it does not."""
    return _on_page([] if bodies.work_um is None else [bodies.work_um], page)


def clamps_on(page: Page, bodies: Bodies) -> list[Floats]:
    """Corners (n, 2) px of each clamp that lies in or near the plot."""
    return _on_page(bodies.clamps_um, page)


def draw_work(canvas: Canvas, corners: Floats, unit: float) -> None:
    """Draw a workpiece of corners (n, 2) px."""
    _draw_filled(canvas, corners, Paint.WORK, Paint.WORK_EDGE, unit)


def draw_clamp(canvas: Canvas, corners: Floats, unit: float) -> None:
    """Draw a clamp of corners (n, 2) px."""
    _draw_filled(canvas, corners, Paint.CLAMP, Paint.CLAMP_EDGE, unit)
    for line in _hatching(corners, style.HATCH * unit):
        canvas.polyline(line, Paint.CLAMP_EDGE, style.HATCH_WIDTH * unit)


def _draw_filled(canvas: Canvas, corners: Floats, fill: Paint, edge: Paint, unit: float) -> None:
    canvas.polygon(corners, fill)
    canvas.polyline(np.concatenate([corners, corners[:1]]), edge, style.BODY_EDGE * unit)


def _hatching(corners: Floats, spacing: float) -> Floats:
    """Lines (k, 2, 2) at 45° inside a polygon (n, 2), `spacing` px apart across."""
    start = corners @ np.array([1.0, 1.0])  # a line of the hatching has one x + y
    end = np.roll(start, -1)
    step = spacing * np.sqrt(2.0)
    level = np.arange(np.ceil(start.min() / step), np.ceil(start.max() / step)) * step
    crossed = (start <= level[:, None]) != (end <= level[:, None])
    line, side = np.nonzero(crossed)
    share = ((level[line] - start[side]) / (end[side] - start[side]))[:, None]
    places = corners[side] * (1.0 - share) + np.roll(corners, -1, axis=0)[side] * share
    order = np.lexsort((places[:, 0], line))  # a line enters and leaves by turns
    lines: Floats = places[order].reshape(-1, 2, 2)
    return lines


def _on_page(outlines: Sequence[Outline], page: Page) -> list[Floats]:
    """Corners (n, 2) px of outlines as far as they lie in or near the plot; those that do not are left out."""
    cut = [_within(page.view.to_px(np.array(outline)), page.plot) for outline in outlines]
    return [corners for corners in cut if len(corners) > 2]


def _within(corners: Floats, plot: Box) -> Floats:
    """The part of a polygon (n, 2) that lies in or near the plot."""
    limits = ((0, -1.0, plot.left), (0, 1.0, plot.right), (1, -1.0, plot.top), (1, 1.0, plot.bottom))
    for axis, sign, limit in limits:
        corners = _cut_off(corners, sign * corners[:, axis] - (sign * limit + _BEYOND_PX))
    return corners


def _cut_off(corners: Floats, beyond: Floats) -> Floats:
    """The part of a polygon (n, 2) on which `beyond` (n,), linear in the place, is not above 0.

    After I. E. Sutherland and G. W. Hodgman, "Reentrant polygon clipping", 1974: parts stay joined along the border.
    """
    after, beyond_after = np.roll(corners, -1, axis=0), np.roll(beyond, -1)
    crossing = (beyond > 0.0) != (beyond_after > 0.0)
    share = np.divide(beyond, beyond - beyond_after, out=np.zeros_like(beyond), where=crossing)[:, None]
    places = np.stack([corners, corners * (1.0 - share) + after * share], axis=1)
    cut: Floats = places[np.stack([beyond <= 0.0, crossing], axis=1)]
    return cut


NOTHING: Final = Bodies()


class Cut(NamedTuple):
    """A cut, known as far as it is; all in program coordinates.

    Attributes
    ----------
    toolpath
        The path of the wire's centre, at least one block.
    kerf_um
        Full width of the kerf, twice the sum of wire radius and spark gap; 0 where none is to be drawn.
    title, note
        Lines at the top; the middle of a line that is too long is left out.
    trace
        The way the wire took; where None the kerf lies around the path.
    passes
        Which blocks make each pass over an edge; None where every edge is cut once.
    leads
        (n,) which rows lead into edges and out of them; None where the picture does not tell them apart.
    contour
        What the program draws where a controller adds the offset; None where it runs as written.
    bodies
        The workpiece and the clamps; those near the path show.
    pieces, sizes
        What the cut leaves, and the sizes of what is kept, where they were worked out.
    findings
        What is wrong.
    travel_um
        The box that the table can reach, (2, 2): lowest and highest (x, y).
    off
        Strips between the edge and the drawing that it was held against; None where it is nowhere off, or there is
        none.
    off_sizes
        The sizes that are off it; None as above.
    faces
        The way of a wire that leans at the bottom of the work, and at its top; None of an upright one.
    """

    toolpath: Toolpath
    kerf_um: float
    title: str
    note: str = ""
    trace: "Trace | None" = None
    passes: Passes | None = None
    leads: Bools | None = None
    contour: Toolpath | None = None
    bodies: Bodies = NOTHING
    pieces: "Pieces | None" = None
    sizes: "Sizes | None" = None
    findings: Sequence[Finding] = ()
    travel_um: Floats | None = None
    off: "Strips | None" = None
    off_sizes: "OffSizes | None" = None
    faces: tuple[Curves, Curves] | None = None


class Board(NamedTuple):
    """A page that is being drawn; what finds its place takes it out of `room`."""

    canvas: Canvas
    page: Page
    room: Room
    say: Words
