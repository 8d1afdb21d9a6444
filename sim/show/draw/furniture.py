"""What stands around a plot: title, axes and grid."""

import numpy as np

from sim.show.draw import style
from sim.show.draw.canvas import Canvas
from sim.show.draw.layout import Box, Page, mm_text, nice_below, ticks
from sim.show.draw.paints import Paint


def elide(canvas: Canvas, text: str, size: float, width: float) -> str:
    """Make `text` fit into `width` px by leaving out its middle; characters that do not print become spaces."""
    text = "".join(c if c.isprintable() else " " for c in text)
    if canvas.text_width(text, size) <= width:
        return text
    short, long = 0, len(text)
    while long - short > 1:
        middle = (short + long) // 2
        fits = canvas.text_width(_without_middle(text, middle), size) <= width
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
        line = elide(canvas, text, size * unit, width)
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
    wide, high_px = canvas.text_width("X mm", size) + size, 1.6 * size
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
