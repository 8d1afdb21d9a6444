"""A canvas that draws nothing and remembers what it was asked to draw."""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import Any, NamedTuple

from parser.geometry.curves import Floats
from sim.show.draw.layout import Box
from sim.show.draw.letters import text_width
from sim.show.draw.sheet import Sheet
from sim.show.draw.style import LIGHT, Paint, Theme


class Drawn(NamedTuple):
    """One call: what was drawn, in which paint, where (points, box or place), with what else."""

    what: str
    paint: Paint
    at: Any
    more: tuple[Any, ...] = ()


class Recorder:
    """See `sim.show.draw.canvas.Canvas`."""

    def __init__(self, width_px: int, height_px: int, theme: Theme = LIGHT) -> None:
        self.width_px, self.height_px = width_px, height_px
        self.drawn: list[Drawn] = []

    def polyline(self, points: Floats, paint: Paint, width: float) -> None:
        self.drawn.append(Drawn("polyline", paint, points, (width,)))

    def dashed(self, points: Floats, paint: Paint, width: float, dash: float, gap: float) -> None:
        self.drawn.append(Drawn("dashed", paint, points, (width, dash, gap)))

    def ring(self, center: Floats, radius: float, paint: Paint, width: float) -> None:
        self.drawn.append(Drawn("ring", paint, center, (radius, width)))

    def disc(self, center: Floats, radius: float, paint: Paint) -> None:
        self.drawn.append(Drawn("disc", paint, center, (radius,)))

    def arrow(self, tip: Floats, direction: Floats, size: float, paint: Paint) -> None:
        self.drawn.append(Drawn("arrow", paint, tip, (direction, size)))

    def polygon(self, corners: Floats, paint: Paint) -> None:
        self.drawn.append(Drawn("region", paint, [corners]))

    def region(self, rings: Sequence[Floats], paint: Paint) -> None:
        self.drawn.append(Drawn("region", paint, list(rings)))

    def box(self, box: Box, fill: Paint, edge: Paint, width: float) -> None:
        self.drawn.append(Drawn("box", fill, box, (edge, width)))

    @contextmanager
    def clipped(self, box: Box) -> Iterator[None]:
        yield

    def text(self, at: tuple[float, float], text: str, size: float, paint: Paint, align: float = 0.0) -> None:
        self.drawn.append(Drawn("text", paint, at, (text, size, align)))

    def of(self, what: str, paint: Paint | None = None) -> list[Drawn]:
        """Calls of a kind, and of a paint where one is given."""
        return [one for one in self.drawn if one.what == what and paint in (None, one.paint)]

    @property
    def texts(self) -> list[str]:
        """All that was written."""
        return [one.more[0] for one in self.of("text")]

    def text_boxes(self) -> list[Box]:
        """Boxes that the texts take."""
        boxes = []
        for one in self.of("text"):
            (x, y), (text, size, align) = one.at, one.more
            width = text_width(text, size)
            boxes.append(Box(x - align * width, y - size / 2, x + (1 - align) * width, y + size / 2))
        return boxes


def recording_sheet(width_px: int = 1600, language: str = "en") -> Sheet[Recorder]:
    return Sheet(Recorder, width_px, LIGHT, language)
