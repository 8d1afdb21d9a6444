"""The picture of a cut: work, kerf and pieces, the path and where the wire was, and what the shop needs to read it.

The travel of the table: its border where it lies in the plot, and the whole table, small, in the head.

The shapes of a cut in a view, worked out once: in pixels and in both languages the same ones are drawn.
"""

from typing import TYPE_CHECKING, Final, NamedTuple

import numpy as np

from parser.geometry.curves import Floats, box_of
from parser.units import mm
from sim.show.draw import style
from sim.show.draw.canvas import Canvas
from sim.show.draw.flatten import simplify
from sim.show.draw.layout import BESIDE_PLOT, IN_PLOT, Box, Ink, Margins, Page, Room, View, page_for
from sim.show.draw.legend import Entry, draw_axes, draw_frame, draw_header
from sim.show.draw.letters import text_width
from sim.show.draw.sheet import AnyCanvas, Sheet
from sim.show.draw.style import Paint
from sim.show.pictures.cut.legend import Drawn, Surroundings, draw_legends, entries, finding_entries, rows_for
from sim.show.pictures.cut.lines import (
    Lines,
    draw_kerf,
    draw_lines,
    draw_off,
    lines_of,
    path_bounds_um,
    shown_bounds_um,
)
from sim.show.pictures.cut.marks import (
    draw_arrows,
    draw_ends,
    draw_flags,
    draw_gaps,
    draw_numbers,
    draw_pauses,
    flag_reach,
    flags_of,
)
from sim.show.pictures.cut.sizes import CutSizes, Extents, draw_extents, draw_rounds, extents_of, sizes_of_cut
from sim.show.pictures.cut.subject import Board, Cut, clamps_on, draw_bodies, works_on
from sim.show.texts import Words

if TYPE_CHECKING:
    from sim.cut.sizes import Sizes
    from sim.measure.compare.result import Comparison, OffSizes, Strips
    from sim.show.pictures.cut.areas import Areas


class Shapes:
    """Lines and areas of one cut, kept for each view that asked for them, and where it is off its drawing."""

    def __init__(self) -> None:
        self._lines: dict[View, Lines] = {}
        self._areas: dict[View, Areas] = {}
        self._strips: tuple[Strips | None] | None = None  # once it was worked out
        self._off_sizes: OffSizes | None = None

    def lines(self, cut: Cut, view: View) -> Lines:
        """The lines of the cut in a view."""
        if view not in self._lines:
            self._lines[view] = lines_of(cut, view)
        return self._lines[view]

    def strips(self, comparison: "Comparison | None") -> "Strips | None":
        """Where the edge of the cut is off its drawing; None where it is nowhere, or there is none."""
        if comparison is None:
            return None
        from sim.measure.compare.result import strips_of  # noqa: PLC0415 - of a path no comparison is known

        if self._strips is None:
            self._strips = (strips_of(comparison),)
        return self._strips[0]

    def off_sizes(self, comparison: "Comparison | None", sizes: "Sizes | None") -> "OffSizes | None":
        """The sizes that are off the drawing; None where the edge is nowhere off it, or there is none."""
        strips = self.strips(comparison)
        if strips is None or sizes is None:
            return None
        from sim.measure.compare.result import off_sizes  # noqa: PLC0415 - of a path no comparison is known

        if self._off_sizes is None:
            self._off_sizes = off_sizes(strips, sizes)
        return self._off_sizes

    def areas(self, cut: Cut, view: View) -> "Areas | None":
        """The areas of the pieces of the cut in a view; None where no pieces are known."""
        if cut.pieces is None:
            return None
        from sim.show.pictures.cut.areas import areas_of  # noqa: PLC0415 - of a path no pieces are known

        if view not in self._areas:
            self._areas[view] = areas_of(cut.pieces, view)
        return self._areas[view]


def draw_border(canvas: Canvas, page: Page, travel_um: Floats) -> None:
    """Draw the border of the travel as far as it lies in the plot."""
    corners = _corners(page.view.to_px(travel_um))
    near = Box(page.plot.left - 99, page.plot.top - 99, page.plot.right + 99, page.plot.bottom + 99)
    limits = np.clip(corners, [near.left, near.top], [near.right, near.bottom])
    with canvas.clipped(page.plot):
        canvas.dashed(limits, Paint.TRAVEL, 1.5 * style.JUMP_WIDTH * page.unit, 30 * page.unit, 12 * page.unit)


def shows_border(page: Page, travel_um: Floats) -> bool:
    """Whether any of the border lies in the plot."""
    low, high = page.view.range_um(page.plot)
    apart = (travel_um[0] >= high).any() or (travel_um[1] <= low).any()
    return not apart and not ((travel_um[0] < low).all() and (travel_um[1] > high).all())


def draw_table(canvas: Canvas, page: Page, say: Words, travel_um: Floats, runs_px: list[Floats]) -> float:
    """Draw the table with the path on it into the right of the head, with its size; the width of both, px.

    `runs_px` are stretches of the path, (k, 2) px of the plot.
    """
    unit, size = page.unit, style.NOTE * page.unit
    points = np.concatenate([travel_um, *(page.view.to_um(run) for run in runs_px)])
    low, high = box_of(points)
    scale = style.TABLE * unit / float((high - low).max())
    right, top = page.width_px - style.EDGE * unit, (style.HEAD - style.TABLE) / 2 * unit
    view = View(scale, right - float(high[0]) * scale, top + float(high[1]) * scale)
    corners = _corners(view.to_px(travel_um))
    canvas.polyline(corners, Paint.TRAVEL, style.SIZE_WIDTH * unit)
    for run in runs_px:
        canvas.polyline(simplify(view.to_px(page.view.to_um(run)), 0.2), Paint.IDEAL, unit)
    start = view.to_px(page.view.to_um(runs_px[0][0])) if runs_px else corners[0]
    canvas.disc(start, 0.2 * style.MARK * unit, Paint.START)
    x_mm, y_mm = mm(travel_um[1] - travel_um[0]).tolist()
    text = say("cut.travel", x=f"{x_mm:g}", y=f"{y_mm:g}")
    left = right - float((high - low)[0]) * scale - style.LEGEND_GAP * unit
    canvas.text((left, 0.72 * style.HEAD * unit), text, size, Paint.GREY, align=1.0)
    return page.width_px - style.EDGE * unit - left + text_width(text, size) + style.LEGEND_GAP * unit


def _corners(box_px: Floats) -> Floats:
    """Border (5, 2) of a box that two corners (2, 2) span."""
    (left, bottom), (right, top) = box_px
    return np.array([[left, bottom], [right, bottom], [right, top], [left, top], [left, bottom]])


_BARE: Final = Margins(0.0, 0.0, 0.0, 0.0)
_THUMBNAIL: Final = Margins(*(style.THUMBNAIL_PAD,) * 4)
_FOOT_ROWS: Final = 3  # rows of the legend in `style.FOOT`


class CutLayout(NamedTuple):
    """The page; what of the surroundings shows on it; the sizes and the lines of the largest; what the codes mean."""

    page: Page
    seen: Surroundings
    sizes: CutSizes
    extents: Extents | None
    codes: list[Entry]


def draw_cut(sheet: Sheet[AnyCanvas], cut: Cut, shapes: Shapes | None = None) -> AnyCanvas:
    """Draw a cut; with the `shapes` of its earlier pictures, if there were any.

    Its height follows from the part, from half the width of the sheet to the whole. Narrower than `style.LEAST_WIDTH`
    it is a thumbnail: the path and what lies about it, without sizes, numbers, axes and legend.

    Returns
    -------
    The picture; the same input gives the same one.

    Raises
    ------
    ValueError
        There is no block, a negative kerf, or a width below `style.LEAST_THUMBNAIL`.
    """
    if not len(cut.toolpath):
        raise ValueError("a picture of a cut needs at least one block, the toolpath has 0")
    if not cut.kerf_um >= 0:
        raise ValueError(f"kerf width is 0 µm or more, not {cut.kerf_um}")
    draw = _thumbnail if sheet.width_px < style.LEAST_WIDTH else _full
    return draw(sheet, cut, shapes or Shapes())


def _thumbnail(sheet: Sheet[AnyCanvas], cut: Cut, shapes: Shapes) -> AnyCanvas:
    page = page_for(shown_bounds_um(cut), sheet.width_px, _BARE, _THUMBNAIL)
    canvas, lines = sheet.page(page.height_px), shapes.lines(cut, page.view)
    _draw_below(canvas, page, cut, shapes.areas(cut, page.view))
    _draw_cut_lines(canvas, page, cut, lines, kerf_px(cut, page))
    _draw_marks(Board(canvas, page, _room(page, lines, [], []), sheet.say), cut, texts=False)
    return canvas


def _full(sheet: Sheet[AnyCanvas], cut: Cut, shapes: Shapes) -> AnyCanvas:
    say, layout = sheet.say, layout_of(sheet, cut)
    page, seen = layout.page, layout.seen
    canvas, lines = sheet.page(page.height_px), shapes.lines(cut, page.view)
    _draw_head(canvas, page, say, cut, lines)
    draw_frame(canvas, page)
    _draw_below(canvas, page, cut, shapes.areas(cut, page.view))
    names = draw_axes(canvas, page)
    if seen.travel and cut.travel_um is not None:
        draw_border(canvas, page, cut.travel_um)
    _draw_cut_lines(canvas, page, cut, lines, seen.kerf_px)
    sized = [*layout.extents.lines(page)] if layout.extents else []
    drawn = _draw_above(Board(canvas, page, _room(page, lines, sized, names), say), cut, layout)
    draw_legends(canvas, page, entries(cut, page, say, seen, drawn), layout.codes)
    return canvas


def layout_of(sheet: Sheet[AnyCanvas], cut: Cut) -> CutLayout:
    """Lay out a page with room for its legend."""
    sizes, codes = sizes_of_cut(cut), finding_entries(cut, sheet.say)
    extents = extents_of(sizes, path_bounds_um(cut))
    bounds_um, inside = shown_bounds_um(cut), extents.margins() if extents else IN_PLOT
    page = page_for(bounds_um, sheet.width_px, inside=inside)
    seen = _surroundings(cut, page)
    rows = rows_for(len(entries(cut, page, sheet.say, seen, Drawn())), len(codes))
    foot = style.FOOT + (rows - _FOOT_ROWS) * style.LEGEND_ROW
    page = page_for(bounds_um, sheet.width_px, BESIDE_PLOT._replace(bottom=foot), inside)
    return CutLayout(page, seen._replace(kerf_px=kerf_px(cut, page)), sizes, extents, codes)


def _surroundings(cut: Cut, page: Page) -> Surroundings:
    return Surroundings(
        work=bool(works_on(page, cut.bodies)),
        clamps=bool(clamps_on(page, cut.bodies)),
        travel=cut.travel_um is not None and shows_border(page, cut.travel_um),
        kerf_px=kerf_px(cut, page),
    )


def kerf_px(cut: Cut, page: Page) -> float:
    """The width that the kerf is drawn with."""
    return max(cut.kerf_um * page.view.px_per_um, style.KERF_WIDTH_MIN * page.unit)


def _draw_head(canvas: Canvas, page: Page, say: Words, cut: Cut, lines: Lines) -> None:
    ways = [line.way for line in lines.ideal]
    width = 0.0 if cut.travel_um is None else draw_table(canvas, page, say, cut.travel_um, ways)
    draw_header(canvas, page.unit, cut.title, cut.note, beside_px=width)


def _draw_cut_lines(canvas: Canvas, page: Page, cut: Cut, lines: Lines, kerf_width_px: float) -> None:
    """Draw the kerf, over it where the edge is off the drawing, and over that the path and the way of the wire."""
    draw_kerf(canvas, lines, kerf_width_px)
    if cut.off is not None:
        draw_off(canvas, page, cut.off)
    draw_lines(canvas, page.unit, lines)


def _draw_below(canvas: Canvas, page: Page, cut: Cut, areas: "Areas | None") -> None:
    draw_bodies(canvas, page, cut.bodies)
    if areas is not None:
        from sim.show.pictures.cut.areas import draw_areas  # noqa: PLC0415 - of a path no pieces are known

        draw_areas(canvas, page.unit, areas)


def _room(page: Page, lines: Lines, sized: list[Floats], taken: list[Box]) -> Room:
    ways = [line.way for line in lines.ideal]
    ink = Ink([*ways, *lines.contour, *lines.jumps, *sized], page.width_px, page.height_px)
    return Room(page.plot, ink, taken)


def _draw_above(board: Board, cut: Cut, layout: CutLayout) -> Drawn:
    """Draw marks, numbers and sizes over the path, those first that must have their place."""
    if layout.extents:
        draw_extents(board, layout.sizes, layout.extents)
    paused = _draw_marks(board, cut, texts=True)
    draw_arrows(board, cut.toolpath)
    numbers = draw_numbers(board, cut.toolpath, layout.seen.kerf_px)
    if cut.pieces is not None:
        from sim.show.pictures.cut.areas import draw_labels  # noqa: PLC0415 - of a path no pieces are known

        draw_labels(board, cut.toolpath, cut.pieces)
    draw_rounds(board, layout.sizes)
    return Drawn(numbers.text(board.say), paused)


def _draw_marks(board: Board, cut: Cut, *, texts: bool) -> int:
    """Draw ends, gaps, findings and pauses; how many of the pauses found a place."""
    apart_um = flag_reach(board.page.unit) / board.page.view.px_per_um
    draw_ends(board, cut.toolpath)
    if texts:
        draw_gaps(board, cut.toolpath, cut.findings)
    draw_flags(board, flags_of(cut.toolpath, cut.findings, apart_um), codes=texts)
    return draw_pauses(board, cut.toolpath, numbers=texts)
