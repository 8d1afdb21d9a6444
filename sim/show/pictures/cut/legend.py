"""The legend below a plot: samples of what shows, the scale bar, and what the codes of findings mean."""

from collections.abc import Callable
from itertools import pairwise
from typing import Final, NamedTuple

import numpy as np

from parser.findings.catalogue import page as page_of
from parser.findings.codes import CODES, Severity
from parser.geometry.curves import Floats
from parser.units import mm
from sim.show.draw import style
from sim.show.draw.canvas import Canvas
from sim.show.draw.furniture import elide
from sim.show.draw.layout import Box, Page, box_around, mm_text, nice_below
from sim.show.draw.paints import Paint
from sim.show.pictures.cut.flags import counted, draw_flag
from sim.show.pictures.cut.marks import draw_end, draw_pause, draw_start, pauses
from sim.show.pictures.cut.numbers import draw_number, number_size
from sim.show.pictures.cut.outlines import draw_clamp, draw_work, swatch
from sim.show.pictures.cut.subject import Cut
from sim.show.words.pictures import Words

COLUMNS: Final = 3
FINDING_COLUMNS: Final = 2
MOST_CODES: Final = 6


class Seen(NamedTuple):
    """What of the surroundings shows in a plot, and how wide the kerf is drawn."""

    work: bool
    clamps: bool
    travel: bool
    kerf_px: float


class Entry(NamedTuple):
    """A sample drawn into a box, its width as a share of the usual one, and its text."""

    draw: Callable[[Canvas, Box, float], None]
    text: str
    width: float = 1.0


def scale_bar_um(page: Page) -> float:
    """Length of the scale bar, a round one."""
    return nice_below(style.SCALE_BAR * page.unit / page.view.px_per_um)


def entries(cut: Cut, page: Page, say: Words, seen: Seen, numbers: str) -> list[Entry]:
    """All that a legend explains, in its order."""
    kerf = say("cut_kerf" if cut.trace else "cut_kerf_programmed", width=f"{mm(cut.kerf_um):.3f}")
    wider = seen.kerf_px > cut.kerf_um * page.view.px_per_um
    bar_um = scale_bar_um(page)
    bar = bar_um * page.view.px_per_um / (style.SAMPLE * page.unit)
    kinds = {piece.kind for piece in cut.pieces.freed} if cut.pieces else set()
    found = (
        (True, Entry(_kerf(seen.kerf_px), say("cut_kerf_wider", kerf=kerf) if wider else kerf)),
        (
            True,
            Entry(_stroke(Paint.IDEAL, style.IDEAL_WIDTH), say("cut_offset_path" if cut.contour else "cut_programmed")),
        ),
        (cut.contour, Entry(_stroke(Paint.CONTOUR, style.CONTOUR_WIDTH), say("cut_contour"))),
        (cut.trace, Entry(_stroke(Paint.ACTUAL, style.ACTUAL_WIDTH), say("cut_actual"))),
        (cut.toolpath.is_jump.any(), Entry(_dashes(Paint.JUMP, style.JUMP_WIDTH), say("cut_jump"))),
        (True, Entry(_arrow, say("cut_direction"))),
        (True, Entry(lambda canvas, box, unit: draw_start(canvas, _middle(box), unit), say("cut_start"))),
        (True, Entry(lambda canvas, box, unit: draw_end(canvas, _middle(box), unit), say("cut_end"))),
        (pauses(cut.toolpath), Entry(_pause, say("cut_pause"))),
        (True, Entry(_number, numbers)),
        ("part" in kinds, Entry(_swatch(Paint.PART, Paint.PART_EDGE), say("cut_part"))),
        ("slug" in kinds, Entry(_swatch(Paint.SLUG, Paint.SLUG_EDGE), say("cut_slug"))),
        (seen.work, Entry(_body(draw_work), say("cut_work"))),
        (seen.clamps, Entry(_body(draw_clamp), say("cut_clamp"))),
        (seen.travel, Entry(_dashes(Paint.TRAVEL, 1.5 * style.JUMP_WIDTH), say("cut_travel_border"))),
        (True, Entry(_scale_bar, mm_text(bar_um, bar_um) + " mm", bar)),
    )
    return [entry for is_there, entry in found if is_there]


def finding_entries(cut: Cut, say: Words) -> list[Entry]:
    """What the codes of the findings mean; where there are many of them, how many there are of each severity."""
    counts = counted(cut.findings)
    if len(counts) > MOST_CODES:
        by = {
            severity: sum(count for code, count in counts if CODES[code].severity is severity) for severity in Severity
        }
        text = say("cut_count", errors=by[Severity.ERROR], warnings=by[Severity.WARNING], notes=by[Severity.NOTE])
        return [Entry(_flag(CODES[counts[0][0]].severity), text)]
    return [
        Entry(
            _flag(CODES[code].severity),
            say(
                "cut_finding",
                code=code if count == 1 else f"{code} ×{count}",
                title=page_of(code, say.language).title,
            ),
        )
        for code, count in counts
    ]


def rows_for(plain: int, findings: int) -> int:
    """Rows that a legend of so many entries takes."""
    return -(-plain // COLUMNS) + -(-findings // FINDING_COLUMNS)


def draw_legend(canvas: Canvas, page: Page, plain: list[Entry], findings: list[Entry]) -> None:
    """Draw the legend below the plot, column by column, and below it what the codes mean."""
    top = page.height_px - (rows_for(len(plain), len(findings)) + 0.5) * style.LEGEND_ROW * page.unit
    _draw_columns(canvas, page, _columns(plain, COLUMNS), top)
    below = rows_for(len(plain), 0) * style.LEGEND_ROW * page.unit
    _draw_columns(canvas, page, _columns(findings, FINDING_COLUMNS), top + below)


def _columns(made: list[Entry], number: int) -> list[list[Entry]]:
    rows = max(-(-len(made) // number), 1)
    return [made[first : first + rows] for first in range(0, len(made), rows)]


def _draw_columns(canvas: Canvas, page: Page, columns: list[list[Entry]], top: float) -> None:
    unit, width = page.unit, page.width_px - 2 * style.EDGE * page.unit
    widths = [max(_width(canvas, entry, unit) for entry in column) for column in columns]
    gap = (width - sum(widths)) / max(len(columns), 1)
    if gap < style.LEGEND_GAP * unit:
        gap = style.LEGEND_GAP * unit
        widths = [width / len(columns) - gap] * len(columns)
    lefts = style.EDGE * unit + np.cumsum([0.0, *(wide + gap for wide in widths)])
    for (left, _), wide, column in zip(pairwise(lefts.tolist()), widths, columns, strict=True):
        for row, entry in enumerate(column):
            _draw_entry(canvas, entry, Box(left, top + row * style.LEGEND_ROW * unit, left + wide, 0.0), unit)


def _draw_entry(canvas: Canvas, entry: Entry, room: Box, unit: float) -> None:
    sample = Box(room.left, room.top, room.left + entry.width * style.SAMPLE * unit, room.top + style.LEGEND_ROW * unit)
    entry.draw(canvas, sample, unit)
    left = sample.right + style.LEGEND_GAP * unit
    text = elide(canvas, entry.text, style.TEXT * unit, room.right - left)
    canvas.text((left, (sample.top + sample.bottom) / 2), text, style.TEXT * unit, Paint.INK)


def _width(canvas: Canvas, entry: Entry, unit: float) -> float:
    sample = (entry.width * style.SAMPLE + style.LEGEND_GAP) * unit
    return sample + canvas.text_width(entry.text, style.TEXT * unit) + 1.0


def _middle(box: Box) -> Floats:
    return np.array([(box.left + box.right) / 2, (box.top + box.bottom) / 2])


def _across(box: Box) -> Floats:
    y = (box.top + box.bottom) / 2
    return np.array([[box.left, y], [box.right, y]])


def _kerf(kerf_px: float) -> Callable[[Canvas, Box, float], None]:
    def draw(canvas: Canvas, box: Box, unit: float) -> None:
        width = min(kerf_px, 0.6 * style.LEGEND_ROW * unit)
        canvas.polyline(_across(box) + np.array([[width / 2, 0.0], [-width / 2, 0.0]]), Paint.KERF, width)

    return draw


def _stroke(paint: Paint, width: float) -> Callable[[Canvas, Box, float], None]:
    return lambda canvas, box, unit: canvas.polyline(_across(box), paint, width * unit)


def _dashes(paint: Paint, width: float) -> Callable[[Canvas, Box, float], None]:
    def draw(canvas: Canvas, box: Box, unit: float) -> None:
        canvas.dashed(_across(box), paint, width * unit, style.DASH * unit, style.DASH_GAP * unit)

    return draw


def _arrow(canvas: Canvas, box: Box, unit: float) -> None:
    line, size, ahead = _across(box), style.ARROW * unit, np.array([1.0, 0.0])
    canvas.polyline(line, Paint.IDEAL, style.IDEAL_WIDTH * unit)
    canvas.arrow(_middle(box) + ahead * size / 2, ahead, size, Paint.IDEAL)


def _pause(canvas: Canvas, box: Box, unit: float) -> None:
    side = style.PAUSE * unit
    draw_pause(canvas, box_around(_middle(box), side, side), "", unit)


def _number(canvas: Canvas, box: Box, unit: float) -> None:
    draw_number(canvas, box_around(_middle(box), *number_size(canvas, "12", unit)), "12", unit)


def _swatch(fill: Paint, edge: Paint) -> Callable[[Canvas, Box, float], None]:
    def draw(canvas: Canvas, box: Box, unit: float) -> None:
        corners = swatch(box, 0.6 * style.LEGEND_ROW * unit)
        canvas.polygon(corners, fill)
        canvas.polyline(np.concatenate([corners, corners[:1]]), edge, style.EDGE_WIDTH * unit)

    return draw


def _body(draw_body: Callable[[Canvas, Floats, float], None]) -> Callable[[Canvas, Box, float], None]:
    return lambda canvas, box, unit: draw_body(canvas, swatch(box, 0.6 * style.LEGEND_ROW * unit), unit)


def _flag(severity: Severity) -> Callable[[Canvas, Box, float], None]:
    return lambda canvas, box, unit: draw_flag(canvas, _middle(box), severity, 0.9 * unit)


def _scale_bar(canvas: Canvas, box: Box, unit: float) -> None:
    line, tick, width = _across(box), np.array([0.0, 0.25 * style.LEGEND_ROW * unit]), 2 * unit
    canvas.polyline(line, Paint.INK, width)
    for end in line:
        canvas.polyline(np.stack([end - tick, end + tick]), Paint.INK, width)
