"""The picture of a cut: programmed path, kerf around the way the wire took, and what the shop needs to read it."""

from typing import Final, NamedTuple

import numpy as np
from PIL import Image

from parser.geometry.curves import Floats, Ints
from parser.toolpath import Toolpath
from sim.draw import style
from sim.draw.canvas import Canvas
from sim.draw.flatten import bounds_um, cut_runs, flatten
from sim.draw.furniture import draw_axes, draw_frame, draw_header
from sim.draw.labels import Ink, Room
from sim.draw.layout import View, page_for
from sim.draw.legend import Legend, draw_legend
from sim.draw.marks import draw_marks
from sim.draw.outlines import Bodies, draw_bodies
from sim.draw.simplify import simplify
from sim.trace import Trace

CHORD_PX: Final = 0.15
"""How far a drawn line may leave the true one."""

NOTHING: Final = Bodies()


class _Lines(NamedTuple):
    """What is stroked, px: stretches (k, 2) and jumps, each (2, 2)."""

    kerf: list[Floats]
    ideal: list[Floats]
    jumps: list[Floats]


def draw_cut(  # noqa: PLR0913 - all but the first two are named
    toolpath: Toolpath,
    trace: Trace | None,
    *,
    kerf_um: float,
    title: str,
    note: str = "",
    bodies: Bodies = NOTHING,
    width_px: int = 1600,
) -> Image.Image:
    """Draw the path of a cut.

    Parameters
    ----------
    toolpath
        The program, at least one block.
    trace
        The way the wire took; None draws the kerf around the programmed path.
    kerf_um
        Full width of the kerf, twice the sum of wire radius and spark gap; not negative.
    title, note
        Lines at the top; the middle of a line that is too long is left out.
    bodies
        The workpiece and the clamps; those near the path show.
    width_px
        Width of the picture, 600 or more; its height follows from the part, from half the width to the whole.

    Returns
    -------
    RGB picture; the same input gives the same pixels.

    Raises
    ------
    ValueError
        There is no block, a negative kerf, or a width below 600.
    """
    if not len(toolpath):
        raise ValueError("a picture of a cut needs at least one block, the toolpath has 0")
    if not kerf_um >= 0:
        raise ValueError(f"kerf width is 0 µm or more, not {kerf_um}")
    page = page_for(bodies.around(_bounds_um(toolpath, trace, kerf_um)), width_px)
    lines = _lines(toolpath, trace, page.view)
    kerf_px = max(kerf_um * page.view.px_per_um, style.KERF_WIDTH_MIN * page.unit)
    canvas = Canvas(page.width_px, page.height_px)
    draw_header(canvas, page, title, note)
    draw_frame(canvas, page)
    shown = draw_bodies(canvas, page, bodies)
    names = draw_axes(canvas, page)
    _draw_lines(canvas, page.unit, lines, kerf_px)
    ink = Ink([*lines.ideal, *lines.jumps], page.width_px, page.height_px)
    numbers = draw_marks(canvas, page, toolpath, Room(page.plot, ink, names), kerf_px)
    draw_legend(canvas, page, Legend(kerf_um, kerf_px, trace is not None, bool(lines.jumps), numbers, shown))
    return canvas.image()


def _bounds_um(toolpath: Toolpath, trace: Trace | None, kerf_um: float) -> Floats:
    """Box around all that is drawn, (2, 2), at least three kerfs and 0.1 mm wide."""
    box = bounds_um(toolpath)
    if trace is not None:
        low, high = trace.wire_um.min(axis=0), trace.wire_um.max(axis=0)
        box = np.stack([np.minimum(box[0], low), np.maximum(box[1], high)])
    missing = max(3 * kerf_um, 100.0) - float((box[1] - box[0]).max())
    grow = kerf_um / 2 + max(missing / 2, 0.0)
    margin = np.array([[-grow, -kerf_um / 2], [grow, kerf_um / 2]])
    return np.asarray(box + margin, dtype=np.float64)


def _lines(toolpath: Toolpath, trace: Trace | None, view: View) -> _Lines:
    points_um, row = flatten(toolpath, CHORD_PX / view.px_per_um)
    ideal = _runs_px(points_um, row, toolpath, view)
    kerf = ideal if trace is None else _runs_px(trace.wire_um, trace.row, toolpath, view)
    jumps = np.stack([toolpath.start_um, toolpath.end_um], axis=1)[toolpath.is_jump]
    return _Lines(kerf, ideal, list(view.to_px(jumps)))


def _runs_px(points_um: Floats, row: Ints, toolpath: Toolpath, view: View) -> list[Floats]:
    runs = cut_runs(points_um, row, toolpath.is_jump)
    return [simplify(view.to_px(run), CHORD_PX) for run in runs]


def _draw_lines(canvas: Canvas, unit: float, lines: _Lines, kerf_px: float) -> None:
    for run in lines.kerf:
        canvas.polyline(run, style.KERF, kerf_px)
    for run in lines.ideal:
        canvas.polyline(run, style.IDEAL, style.IDEAL_WIDTH * unit)
    for jump in lines.jumps:
        canvas.dashed(jump, style.JUMP, style.JUMP_WIDTH * unit, style.DASH * unit, style.DASH_GAP * unit)
