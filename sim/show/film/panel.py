"""The read-outs as pixels: a line is drawn anew only when its text has changed."""

from collections.abc import Sequence
from typing import Final

from sim.show.draw import style
from sim.show.draw.canvas import Canvas
from sim.show.draw.furniture import elide
from sim.show.draw.layout import Box
from sim.show.draw.paints import Paint, Theme
from sim.show.film.layout import Layout
from sim.show.film.plate import Pixels, Plate
from sim.show.film.readout import Line

ROW: Final = 41.0
FIRST_CJK: Final = 0x2E80
LEADING: Final = 1.3
GAP: Final = 40.0
"""Between the two columns of read-outs below a plot."""


class ReadoutPanel:
    """The lines of a frame, in one column beside the plot or in two below it."""

    def __init__(self, layout: Layout, theme: Theme, lines: int) -> None:
        self._unit = layout.unit
        self._boxes = _boxes(layout, lines)
        self._shown: list[Line | None] = [None] * lines
        self._plates = [Plate(round(box.right - box.left), round(box.bottom - box.top), theme) for box in self._boxes]

    def show(self, lines: Sequence[Line], frame: Pixels) -> None:
        """Draw lines into a frame that holds those of the last time."""
        for at, line in enumerate(lines):
            if line != self._shown[at]:
                left, top, right, bottom = (round(side) for side in self._boxes[at])
                plate = self._plates[at]
                plate.clear()
                _draw_line(plate, line, self._unit)
                frame[top:bottom, left:right] = plate.pixels()
                self._shown[at] = line

    @property
    def foot(self) -> float:
        """Where the lowest line ends, px."""
        return max(box.bottom for box in self._boxes)


def _boxes(layout: Layout, lines: int) -> list[Box]:
    """Boxes of the lines; below a plot the first two and the last take the whole width."""
    panel, row = layout.panel, ROW * layout.unit
    if layout.beside:
        boxes = [_row(panel, number, row) for number in range(lines)]
        return [*boxes[:-1], boxes[-1]._replace(bottom=boxes[-1].bottom + round(row))]
    row = (panel.bottom - panel.top) / ((lines - 2) // 2 + 3)
    middle, gap = (panel.left + panel.right) / 2, GAP * layout.unit / 2
    left, right = panel._replace(right=middle - gap), panel._replace(left=middle + gap)
    pairs = [_row((left, right)[number % 2], 2 + number // 2, row) for number in range(lines - 3)]
    last = 2 + (lines - 2) // 2
    return [_row(panel, 0, row), _row(panel, 1, row), *pairs, _row(panel, last, row)]


def _row(column: Box, number: int, row: float) -> Box:
    return Box(column.left, column.top + round(number * row), column.right, column.top + round((number + 1) * row))


def _draw_line(canvas: Canvas, line: Line, unit: float) -> None:
    row = min(ROW * unit, float(canvas.height_px))
    middle, size = row / 2, min(style.TEXT * unit, 0.72 * row)
    if not line.name:
        texts = _wrapped(canvas, line.value, size) if canvas.height_px > 1.5 * row else (line.value,)
        for number, text in enumerate(texts):
            place = (0.0, middle + number * size * LEADING)
            canvas.text(place, elide(canvas, text, size, canvas.width_px), size, line.paint)
        return
    canvas.text((0.0, middle), line.name, size, Paint.GREY)
    canvas.text((canvas.width_px, middle), line.value, size, line.paint, align=1.0)


def _wrapped(canvas: Canvas, text: str, size: float) -> tuple[str, ...]:
    """The text as one line where it fits, else as two, broken at a space or between Chinese characters."""
    if canvas.text_width(text, size) <= canvas.width_px:
        return (text,)
    breaks = [at for at in range(1, len(text)) if text[at - 1] == " " or ord(text[at - 1]) >= FIRST_CJK]
    fitting = [at for at in breaks if canvas.text_width(text[:at], size) <= canvas.width_px]
    return (text[: fitting[-1]].rstrip(), text[fitting[-1] :]) if fitting else (text,)
