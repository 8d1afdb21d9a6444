"""The legend below a plot, and its scale bar."""

from collections.abc import Callable
from typing import Final, NamedTuple

import numpy as np

from parser.geometry.curves import Floats
from parser.units import mm
from sim.draw import style
from sim.draw.canvas import Canvas
from sim.draw.layout import Box, Page, box_around, mm_text, nice_below
from sim.draw.marks import draw_end, draw_number, draw_start, number_size
from sim.draw.outlines import Shown, draw_clamp, draw_work, swatch

ROWS: Final = 3


class Legend(NamedTuple):
    """What the legend has to say.

    Attributes
    ----------
    kerf_um, kerf_px
        Full width of the kerf, and the width it is drawn with.
    ran
        Whether the kerf lies around the way the wire took, not around the programmed path.
    jumps
        Whether there are jumps.
    numbers
        What the block numbers are.
    shown
        Which bodies show.
    """

    kerf_um: float
    kerf_px: float
    ran: bool
    jumps: bool
    numbers: str
    shown: Shown


class _Entry(NamedTuple):
    """A sample drawn into a box, `width` px wide, and its text."""

    draw: Callable[[Box], None]
    width: float
    text: str


def draw_legend(canvas: Canvas, page: Page, legend: Legend) -> None:
    """Draw the legend in three columns below the plot."""
    unit = page.unit
    top = page.height_px - (ROWS + 0.5) * style.LEGEND_ROW * unit
    columns = (_lines(canvas, page, legend), _marks(canvas, unit), _numbers(canvas, page, legend))
    widths = [max(_width(canvas, entry, unit) for entry in entries) for entries in columns]
    gap = (page.width_px - 2 * style.EDGE * unit - sum(widths)) / len(columns)
    lefts = style.EDGE * unit + np.concatenate([[0.0], np.cumsum(np.array(widths[:-1]) + gap)])
    for left, entries in zip(lefts.tolist(), columns, strict=True):
        for row, entry in enumerate(entries):
            middle = top + (row + 0.5) * style.LEGEND_ROW * unit
            half = style.LEGEND_ROW * unit / 2
            entry.draw(Box(left, middle - half, left + entry.width, middle + half))
            at = (left + entry.width + style.LEGEND_GAP * unit, middle)
            canvas.text(at, entry.text, style.TEXT * unit, style.INK)


def _width(canvas: Canvas, entry: _Entry, unit: float) -> float:
    return entry.width + style.LEGEND_GAP * unit + canvas.text_width(entry.text, style.TEXT * unit)


def _lines(canvas: Canvas, page: Page, legend: Legend) -> list[_Entry]:
    unit = page.unit
    width = style.SAMPLE * unit
    true_px = legend.kerf_um * page.view.px_per_um
    kerf = f"kerf {mm(legend.kerf_um):.3f} mm {'as cut' if legend.ran else 'as programmed'}"
    kerf += ", drawn wider" * (legend.kerf_px > true_px)
    thick = min(legend.kerf_px, style.LEGEND_ROW * unit * 0.6)
    path = _stroke(canvas, style.IDEAL, style.IDEAL_WIDTH * unit)
    entries = [_Entry(_stroke(canvas, style.KERF, thick), width, kerf), _Entry(path, width, "programmed path")]
    return entries + [_Entry(_dashes(canvas, unit), width, "jump, no cutting")] * legend.jumps


def _marks(canvas: Canvas, unit: float) -> list[_Entry]:
    width = style.SAMPLE * unit
    return [
        _Entry(lambda box: draw_start(canvas, _middle(box), unit), width, "start"),
        _Entry(lambda box: draw_end(canvas, _middle(box), unit), width, "end"),
        _Entry(_arrow(canvas, unit), width, "direction of travel"),
    ]


def _numbers(canvas: Canvas, page: Page, legend: Legend) -> list[_Entry]:
    unit = page.unit
    longest_um = style.SCALE_BAR * unit / page.view.px_per_um
    bar_um = nice_below(longest_um)
    size = number_size(canvas, "12", unit)
    return [
        _Entry(
            lambda box: draw_number(canvas, box_around(_middle(box), *size), "12", unit),
            style.SAMPLE * unit,
            legend.numbers,
        ),
        _Entry(_scale_bar(canvas, unit), bar_um * page.view.px_per_um, mm_text(bar_um, bar_um) + " mm"),
        *_bodies(canvas, unit, legend.shown),
    ]


def _bodies(canvas: Canvas, unit: float, shown: Shown) -> list[_Entry]:
    """One entry for work and clamps, each with its half of the sample where there are both."""
    draws = [draw for draw, is_there in ((draw_work, shown.work), (draw_clamp, shown.clamps)) if is_there]
    names = [name for name, is_there in (("workpiece", shown.work), ("clamp", shown.clamps)) if is_there]

    def draw(box: Box) -> None:
        width = (box.right - box.left) / len(draws)
        for at, one in enumerate(draws):
            part = box._replace(left=box.left + at * width, right=box.left + (at + 1) * width)
            one(canvas, swatch(part, 0.6 * style.LEGEND_ROW * unit), unit)

    return [_Entry(draw, style.SAMPLE * unit, ", ".join(names))] if draws else []


def _middle(box: Box) -> Floats:
    return np.array([(box.left + box.right) / 2, (box.top + box.bottom) / 2])


def _across(box: Box) -> Floats:
    y = (box.top + box.bottom) / 2
    return np.array([[box.left, y], [box.right, y]])


def _stroke(canvas: Canvas, colour: style.Colour, width: float) -> Callable[[Box], None]:
    inset = np.array([[width / 2, 0.0], [-width / 2, 0.0]])  # the ends are round
    return lambda box: canvas.polyline(_across(box) + inset, colour, width)


def _dashes(canvas: Canvas, unit: float) -> Callable[[Box], None]:
    dash, gap, width = style.DASH * unit, style.DASH_GAP * unit, style.JUMP_WIDTH * unit
    return lambda box: canvas.dashed(_across(box), style.JUMP, width, dash, gap)


def _arrow(canvas: Canvas, unit: float) -> Callable[[Box], None]:
    def draw(box: Box) -> None:
        line, size = _across(box), style.ARROW * unit
        canvas.polyline(line, style.IDEAL, style.IDEAL_WIDTH * unit)
        ahead = np.array([1.0, 0.0])
        canvas.arrow(_middle(box) + ahead * size / 2, ahead, size, style.IDEAL)

    return draw


def _scale_bar(canvas: Canvas, unit: float) -> Callable[[Box], None]:
    def draw(box: Box) -> None:
        line, tick, width = _across(box), np.array([0.0, 0.25 * style.LEGEND_ROW * unit]), 2 * unit
        canvas.polyline(line, style.INK, width)
        for end in line:
            canvas.polyline(np.stack([end - tick, end + tick]), style.INK, width)

    return draw
