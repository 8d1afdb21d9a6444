"""The picture of a cut: work, kerf and pieces, the path and where the wire was, and what the shop needs to read it."""

from typing import Final

from parser.geometry.curves import Floats
from sim.show.draw import style
from sim.show.draw.canvas import Canvas
from sim.show.draw.furniture import draw_axes, draw_frame, draw_header
from sim.show.draw.labels import Ink, Room
from sim.show.draw.layout import Box, Margins, Page, page_for
from sim.show.draw.sheet import AnyCanvas, Sheet
from sim.show.pictures.cut.areas import draw_labels, draw_pieces
from sim.show.pictures.cut.board import Board
from sim.show.pictures.cut.flags import draw_flags, flag_reach, flags_of
from sim.show.pictures.cut.legend import draw_legend, entries
from sim.show.pictures.cut.lines import Lines, draw_lines, lines_of, shown_bounds_um
from sim.show.pictures.cut.marks import draw_arrows, draw_ends, draw_pauses
from sim.show.pictures.cut.numbers import draw_numbers
from sim.show.pictures.cut.outlines import draw_bodies
from sim.show.pictures.cut.plan import Plan, kerf_px, plan_of
from sim.show.pictures.cut.size_lines import draw_extents, draw_rounds
from sim.show.pictures.cut.subject import Cut
from sim.show.pictures.cut.table import draw_border, draw_table
from sim.show.words import Words

_BARE: Final = Margins(0.0, 0.0, 0.0, 0.0)
_THUMBNAIL: Final = Margins(*(style.THUMBNAIL_PAD,) * 4)


def draw_cut(sheet: Sheet[AnyCanvas], cut: Cut) -> AnyCanvas:
    """Draw a cut.

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
    return _thumbnail(sheet, cut) if sheet.width_px < style.LEAST_WIDTH else _full(sheet, cut)


def _thumbnail(sheet: Sheet[AnyCanvas], cut: Cut) -> AnyCanvas:
    page = page_for(shown_bounds_um(cut), sheet.width_px, _BARE, _THUMBNAIL)
    canvas, lines = sheet.page(page.height_px), lines_of(cut, page.view)
    _draw_below(canvas, page, cut)
    draw_lines(canvas, page.unit, lines, kerf_px(cut, page))
    _draw_marks(Board(canvas, page, _room(page, lines, [], []), sheet.say), cut, texts=False)
    return canvas


def _full(sheet: Sheet[AnyCanvas], cut: Cut) -> AnyCanvas:
    say, plan = sheet.say, plan_of(sheet, cut)
    page, seen = plan.page, plan.seen
    canvas, lines = sheet.page(page.height_px), lines_of(cut, page.view)
    _draw_head(canvas, page, say, cut, lines)
    draw_frame(canvas, page)
    _draw_below(canvas, page, cut)
    names = draw_axes(canvas, page)
    if seen.travel and cut.travel_um is not None:
        draw_border(canvas, page, cut.travel_um)
    draw_lines(canvas, page.unit, lines, seen.kerf_px)
    sized = [*plan.extents.lines(page)] if plan.extents else []
    numbers = _draw_above(Board(canvas, page, _room(page, lines, sized, names), say), cut, plan)
    draw_legend(canvas, page, entries(cut, page, say, seen, numbers), plan.codes)
    return canvas


def _draw_head(canvas: Canvas, page: Page, say: Words, cut: Cut, lines: Lines) -> None:
    beside = 0.0 if cut.travel_um is None else draw_table(canvas, page, say, cut.travel_um, lines.ideal)
    draw_header(canvas, page, cut.title, cut.note, beside_px=beside)


def _draw_below(canvas: Canvas, page: Page, cut: Cut) -> None:
    draw_bodies(canvas, page, cut.bodies)
    if cut.pieces is not None:
        draw_pieces(canvas, page, cut.pieces)


def _room(page: Page, lines: Lines, sized: list[Floats], taken: list[Box]) -> Room:
    ink = Ink([*lines.ideal, *lines.contour, *lines.jumps, *sized], page.width_px, page.height_px)
    return Room(page.plot, ink, taken)


def _draw_above(board: Board, cut: Cut, plan: Plan) -> str:
    """Draw marks, numbers and sizes over the path, those first that must have their place; what the numbers are."""
    if plan.extents:
        draw_extents(board, plan.sizes, plan.extents)
    _draw_marks(board, cut, texts=True)
    draw_arrows(board, cut.toolpath)
    numbers = draw_numbers(board, cut.toolpath, plan.seen.kerf_px)
    if cut.pieces is not None:
        draw_labels(board, cut.toolpath, cut.pieces)
    draw_rounds(board, plan.sizes)
    return numbers.text(board.say)


def _draw_marks(board: Board, cut: Cut, *, texts: bool) -> None:
    apart_um = flag_reach(board.page.unit) / board.page.view.px_per_um
    draw_ends(board, cut.toolpath)
    draw_flags(board, flags_of(cut.toolpath, cut.findings, apart_um), codes=texts)
    draw_pauses(board, cut.toolpath, numbers=texts)
