"""Legends: samples of what a picture shows, each with its text to the right of it, in rows or in columns.

What stands around a plot: title, axes and grid.
"""

from collections.abc import Callable, Sequence
from itertools import pairwise
from typing import Final, NamedTuple

import numpy as np

from parser.geometry.curves import Floats
from sim.show.draw import style
from sim.show.draw.canvas import Canvas
from sim.show.draw.layout import Box, Page, mm_text, nice_below, ticks
from sim.show.draw.letters import text_width
from sim.show.draw.style import Paint


def elide(text: str, size: float, width: float) -> str:
    """Make `text` fit into `width` px by leaving out its middle; characters that do not print become spaces."""
    text = "".join(c if c.isprintable() else " " for c in text)
    if text_width(text, size) <= width:
        return text
    short, long = 0, len(text)
    while long - short > 1:
        middle = (short + long) // 2
        fits = text_width(_without_middle(text, middle), size) <= width
        short, long = (middle, long) if fits else (short, middle)
    return _without_middle(text, short)


def _without_middle(text: str, keep: int) -> str:
    tail = keep // 3  # the end of a file name tells less than its beginning, but more than its middle
    return text[: keep - tail].rstrip() + "…" + text[len(text) - tail :].lstrip()


def draw_header(canvas: Canvas, unit: float, title: str, note: str, *, beside_px: float = 0.0) -> None:
    """Write the title and the note below it over the page, with so much of its right side left free."""
    left, width = style.EDGE * unit, canvas.width_px - 2 * style.EDGE * unit - beside_px
    rows = ((title, style.TITLE, 0.34, Paint.INK), (note, style.NOTE, 0.72, Paint.GREY))
    for text, size, share, paint in rows:
        line = elide(text, size * unit, width)
        canvas.text((left, share * style.HEAD * unit), line, size * unit, paint)


def draw_frame(canvas: Canvas, page: Page) -> None:
    """Draw the empty plot with its frame."""
    canvas.box(page.plot, Paint.PAGE, Paint.FRAME, style.GRID_WIDTH * page.unit)


def draw_axes(canvas: Canvas, page: Page) -> list[Box]:
    """Draw grid and labels in mm; give the boxes that the names of the axes take inside the frame."""
    plot, unit = page.plot, page.unit
    step = nice_below(style.TICK_SPACING * unit / page.view.px_per_um * 1.5)
    low, high = page.view.range_um(plot)
    for axis in (0, 1):
        for tick in ticks(float(low[axis]), float(high[axis]), step):
            _draw_tick(canvas, page, axis, float(tick), step)
    size = style.TICK * unit
    wide, high_px = text_width("X mm", size) + size, 1.6 * size
    names = [
        Box(plot.right - wide, plot.bottom - high_px, plot.right, plot.bottom),
        Box(plot.left, plot.top, plot.left + wide, plot.top + high_px),
    ]
    for name, box in zip(("X mm", "Y mm"), names, strict=True):
        canvas.text(((box.left + box.right) / 2, (box.top + box.bottom) / 2), name, size, Paint.GREY, align=0.5)
    return names


def _draw_tick(canvas: Canvas, page: Page, axis: int, tick_um: float, step_um: float) -> None:
    plot, size = page.plot, style.TICK * page.unit
    x, y = page.view.to_px(np.full(2, tick_um)).tolist()
    text = mm_text(tick_um, step_um)
    if axis == 0:
        line = np.array([[x, plot.top], [x, plot.bottom]])
        canvas.text((x, plot.bottom + 0.8 * size), text, size, Paint.GREY, align=0.5)
    else:
        line = np.array([[plot.left, y], [plot.right, y]])
        canvas.text((plot.left - 0.4 * size, y), text, size, Paint.GREY, align=1.0)
    canvas.polyline(line, Paint.GRID, style.GRID_WIDTH * page.unit)


DrawSample = Callable[[Canvas, Box, float], None]
"""Draws a sample into a box, px; the last value is the factor on the sizes of `sim.show.draw.style`."""

FREE_ROWS: Final = 0.4
"""Free room below a legend at the foot of a page, in rows."""


class Entry(NamedTuple):
    """A line of a legend: what draws its sample, its text, and how wide the sample is, of the usual width."""

    draw: DrawSample
    text: str
    width: float = 1.0


class LegendSizes(NamedTuple):
    """Height of a row, width of a sample, height of the text, and room from entry to entry of a row.

    They are factors of `Legend.unit`, as the sizes of `sim.show.draw.style` are.
    """

    row: float = style.LEGEND_ROW
    sample: float = style.SAMPLE
    text: float = style.TEXT
    apart: float = 44.0


class _Placed(NamedTuple):
    """An entry, its row from 0, and from where to where it may reach, px from where the legend begins."""

    entry: Entry
    row: int
    left: float
    right: float


class Legend(NamedTuple):
    """A legend that is laid out; `unit` is the factor on its sizes."""

    placed: Sequence[_Placed]
    rows: int
    unit: float
    sizes: LegendSizes

    @property
    def height(self) -> float:
        """Height of its rows, px."""
        return self.rows * self.sizes.row * self.unit

    @property
    def foot(self) -> float:
        """What it takes of the foot of a page, px: its rows and some free room below them."""
        return (self.rows + FREE_ROWS) * self.sizes.row * self.unit


USUAL: Final = LegendSizes()


def in_rows(entries: Sequence[Entry], width_px: float, unit: float, sizes: LegendSizes = USUAL) -> Legend:
    """Lay out entries in rows from the left of a page, each as full as its width allows, with both edges free."""
    edge = style.EDGE * unit
    placed: list[_Placed] = []
    row, left = 0, edge
    for entry in entries:
        wide = _width(entry, unit, sizes)
        if left > edge and left + wide > width_px - edge:
            row, left = row + 1, edge
        placed.append(_Placed(entry, row, left, np.inf))
        left += wide + sizes.apart * unit
    return Legend(placed, row + 1, unit, sizes)


def in_columns(
    entries: Sequence[Entry], number: int, width_px: float, unit: float, sizes: LegendSizes = USUAL
) -> Legend:
    """Lay out entries in up to `number` columns that fill a width; texts that have no room there lose their middle."""
    rows = rows_in_columns(len(entries), number)
    columns = [entries[first : first + rows] for first in range(0, len(entries), max(rows, 1))]
    widths = [max(_width(entry, unit, sizes) + 1.0 for entry in column) for column in columns]
    apart = (width_px - sum(widths)) / max(len(columns), 1)
    if apart < style.LEGEND_GAP * unit:
        apart = style.LEGEND_GAP * unit
        widths = [width_px / len(columns) - apart] * len(columns)
    lefts = pairwise(np.cumsum([0.0, *(wide + apart for wide in widths)]).tolist())
    placed = [
        _Placed(entry, row, left, left + wide)
        for (left, _), wide, column in zip(lefts, widths, columns, strict=True)
        for row, entry in enumerate(column)
    ]
    return Legend(placed, rows, unit, sizes)


def rows_in_columns(entries: int, number: int) -> int:
    """Rows that so many entries take in a number of columns."""
    return -(-entries // number)


def _width(entry: Entry, unit: float, sizes: LegendSizes) -> float:
    """Width of an entry, px: its sample, its text, and what lies between."""
    sample = (entry.width * sizes.sample + style.LEGEND_GAP) * unit
    return sample + text_width(entry.text, sizes.text * unit)


def draw_legend(canvas: Canvas, legend: Legend, left: float, top: float) -> None:
    """Draw a legend that begins at a place of the page, px: at its upper left corner."""
    unit, sizes = legend.unit, legend.sizes
    row_px, size = sizes.row * unit, sizes.text * unit
    for entry, row, begin, end in legend.placed:
        above = top + row * row_px
        sample = Box(left + begin, above, left + begin + entry.width * sizes.sample * unit, above + row_px)
        entry.draw(canvas, sample, unit)
        x = sample.left + (entry.width * sizes.sample + style.LEGEND_GAP) * unit
        text = elide(entry.text, size, left + end - x)
        canvas.text((x, above + row_px / 2.0), text, size, Paint.INK)


def draw_at_foot(canvas: Canvas, legend: Legend) -> None:
    """Draw a legend at the foot of the page."""
    draw_legend(canvas, legend, 0.0, canvas.height_px - legend.foot)


def stroke(paint: Paint, width: float) -> DrawSample:
    """A sample that is a line."""
    return lambda canvas, box, unit: canvas.polyline(across(box), paint, width * unit)


def dashes(paint: Paint, width: float, dash: float = style.DASH, gap: float = style.DASH_GAP) -> DrawSample:
    """A sample that is a dashed line."""
    return lambda canvas, box, unit: canvas.dashed(across(box), paint, width * unit, dash * unit, gap * unit)


def ring(paint: Paint) -> DrawSample:
    """A sample that is the ring around a place."""
    return lambda canvas, box, unit: canvas.ring(middle(box), style.MARK * unit, paint, style.MARK_WIDTH * unit)


def swatch(fill: Paint, edge: Paint, width: float) -> DrawSample:
    """A sample that is a filled rectangle with an edge."""

    def draw(canvas: Canvas, box: Box, unit: float) -> None:
        inset = 0.22 * (box.bottom - box.top)
        canvas.box(box._replace(top=box.top + inset, bottom=box.bottom - inset), fill, edge, width * unit)

    return draw


def across(box: Box) -> Floats:
    """The line (2, 2) px across the middle of a sample."""
    y = (box.top + box.bottom) / 2.0
    return np.array([[box.left, y], [box.right, y]])


def middle(box: Box) -> Floats:
    """The middle (2,) px of a sample."""
    return np.array([(box.left + box.right) / 2.0, (box.top + box.bottom) / 2.0])
