"""Pictures in pixels, drawn with pygame. No display is opened.

It draws larger, three times up to a width of 2400 px and else twice, and takes the mean of those pixels, which smooths
every edge.
"""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from functools import lru_cache
from typing import Final

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from parser.geometry.curves import Floats
from sim.show.draw import style
from sim.show.draw.canvas import arrow_head, dashes
from sim.show.draw.layout import Box
from sim.show.draw.silent_pygame import pygame
from sim.show.draw.style import LIGHT, Paint, Theme

FINEST: Final = 3
COARSER_FROM_PX: Final = 2400  # an A3 page at 300 dpi, drawn three times as large, would take 470 MB
THIN_PX: Final = 4.0  # up to here the slanted ends of pygame's lines do not show
EDGE_FINE: Final = 5.0


class Raster:
    """A page of `width_px` × `height_px` pixels; see `sim.show.draw.canvas.Canvas`."""

    def __init__(self, width_px: int, height_px: int, theme: Theme = LIGHT) -> None:
        self.width_px, self.height_px = width_px, height_px
        self._theme = theme
        self._scale = FINEST if width_px <= COARSER_FROM_PX else FINEST - 1
        # numpy has large pages of memory for so much: a surface's own takes four times as long to be there at all.
        self._pixels = np.empty((height_px * self._scale, width_px * self._scale, 4), dtype=np.uint8)
        self._surface = pygame.image.frombuffer(self._pixels.data, self._pixels.shape[1::-1], "RGBX")
        self._surface.fill(theme[Paint.PAGE])

    def polyline(self, points: Floats, paint: Paint, width: float) -> None:
        """Stroke a line through `points`, (n, 2) with n ≥ 1, with round corners and ends."""
        fine, half = points * self._scale, width * self._scale / 2
        if width <= THIN_PX:
            self._chords(fine[:-1], fine[1:], paint, 2 * half)
        else:
            self._band(fine, paint, half)
        for center in fine[_sharp(fine, half)]:
            self._circle(center, half, paint)

    def _chords(self, first: Floats, last: Floats, paint: Paint, fine_width: float) -> None:
        """Stroke single chords, (n, 2) each; pygame counts a line's width along the axis it crosses, not across it."""
        chord = np.abs(last - first)
        length, longest = np.hypot(chord[:, 0], chord[:, 1]), chord.max(axis=1)
        stretch = np.divide(length, longest, out=np.ones_like(length), where=longest > 0)
        widths = np.maximum(np.rint(fine_width * stretch), 1).astype(np.int64)
        shift = np.where(widths % 2, 0.0, 0.5)[:, None]  # of two middle pixels pygame wants the lower one
        ends = np.floor(np.stack([first - shift, last - shift], axis=1)).tolist()
        colour = self._theme[paint]
        for (start, end), wide in zip(ends, widths.tolist(), strict=True):
            pygame.draw.line(self._surface, colour, start, end, wide)

    def _band(self, fine: Floats, paint: Paint, half: float) -> None:
        """Fill a wide line, then draw its edges: pygame's polygons are up to 2 fine pixels too wide or too narrow."""
        side = _normals(fine) * (half - EDGE_FINE / 2)
        for corners in np.rint(_quads(fine, side)).tolist():
            pygame.draw.polygon(self._surface, self._theme[paint], corners)
        for edge in (side, -side):
            self._chords(fine[:-1] + edge, fine[1:] + edge, paint, EDGE_FINE)

    def _circle(self, fine: Floats, radius: float, paint: Paint, width: float = 0.0) -> None:
        pygame.draw.circle(self._surface, self._theme[paint], np.rint(fine).tolist(), round(radius), round(width))

    def dashed(self, points: Floats, paint: Paint, width: float, dash: float, gap: float) -> None:
        """Stroke each chord of `points`, (n, 2), with dashes of length `dash` and gaps of length `gap`."""
        for line in dashes(points, dash, gap):
            self.polyline(line, paint, width)

    def ring(self, center: Floats, radius: float, paint: Paint, width: float) -> None:
        """Stroke a circle; `radius` is that of its middle line."""
        self._circle(center * self._scale, (radius + width / 2) * self._scale, paint, width * self._scale)

    def disc(self, center: Floats, radius: float, paint: Paint) -> None:
        """Fill a circle."""
        self._circle(center * self._scale, radius * self._scale, paint)

    def arrow(self, tip: Floats, direction: Floats, size: float, paint: Paint) -> None:
        """Fill an arrow head of length `size`; `direction` has length 1."""
        self.polygon(arrow_head(tip, direction, size), paint)

    def polygon(self, corners: Floats, paint: Paint) -> None:
        """Fill a polygon of `corners`, (n, 2) with n ≥ 3."""
        pygame.draw.polygon(self._surface, self._theme[paint], np.rint(corners * self._scale).tolist())

    def region(self, rings: Sequence[Floats], paint: Paint) -> None:
        """Fill what lies inside of an odd number of rings, each (n, 2) with n ≥ 3: outlines with their holes."""
        fine = [np.rint(ring * self._scale) for ring in rings]
        corners = np.concatenate(fine)
        page = np.array(self._surface.get_size(), dtype=np.float64)
        low = np.clip(corners.min(axis=0), 0.0, page)
        wide, tall = (np.clip(corners.max(axis=0) + 1.0, 0.0, page) - low).astype(int).tolist()
        if wide <= 0 or tall <= 0:
            return
        # pygame fills one ring at a time: where they lie one in the other, each turns what the last one filled.
        inside, layer = (pygame.Surface((wide, tall), depth=8) for _ in range(2))
        for surface in (inside, layer):
            surface.set_palette([(0, 0, 0), *[self._theme[paint]] * 255])
        for ring in fine:
            layer.fill(0)
            pygame.draw.polygon(layer, 1, (ring - low).tolist())
            filled = pygame.surfarray.pixels2d(inside)
            filled ^= pygame.surfarray.pixels2d(layer)
            del filled  # it locks its surface
        inside.set_colorkey(0)
        self._surface.blit(inside, low.astype(int).tolist())

    @contextmanager
    def clipped(self, box: Box) -> Iterator[None]:
        """Draw nothing outside a rectangle for as long as the context lasts."""
        left, top, right, bottom = (round(side * self._scale) for side in box)
        self._surface.set_clip((left, top, right - left, bottom - top))
        yield
        self._surface.set_clip(None)

    def box(self, box: Box, fill: Paint, edge: Paint, width: float) -> None:
        """Fill a rectangle and stroke its border inwards."""
        left, top, right, bottom = (round(side * self._scale) for side in box)
        pygame.draw.rect(self._surface, self._theme[edge], (left, top, right - left, bottom - top))
        inset = round(width * self._scale)
        inner = (left + inset, top + inset, right - left - 2 * inset, bottom - top - 2 * inset)
        pygame.draw.rect(self._surface, self._theme[fill], inner)

    def text(self, at: tuple[float, float], text: str, size: float, paint: Paint, align: float = 0.0) -> None:
        """Write a line, vertically centred on `at`; `align` of its width lies to the left of `at`."""
        image = _font_at(max(round(size * self._scale), 1)).render(text, True, self._theme[paint])
        left = at[0] * self._scale - align * image.get_width()
        self._surface.blit(image, (round(left), round(at[1] * self._scale - image.get_height() / 2)))

    def image(self) -> Image.Image:
        """Give the page as an RGB picture."""
        pixels = Image.frombuffer("RGBX", self._surface.get_size(), self._pixels, "raw", "RGBX", 0, 1)
        return pixels.reduce(self._scale).convert("RGB")


@lru_cache(maxsize=32)  # each has its file open
def _font_at(size_px: int) -> pygame.font.Font:
    """The shipped font at a size, px."""
    pygame.font.init()
    return pygame.font.Font(style.FONT, size_px)


def _normals(points: Floats) -> Floats:
    """Unit normals of the n − 1 chords of a line, 0 where a chord has no length."""
    chord = np.diff(points, axis=0)
    length = np.hypot(chord[:, 0], chord[:, 1])[:, None]
    return np.stack([-chord[:, 1], chord[:, 0]], axis=1) / np.where(length > 0, length, 1.0)


def _quads(points: Floats, side: Floats) -> Floats:
    """Rectangles around the chords of a line, then slivers that close the notches between them, (m, 4, 2)."""
    first, last, inner = points[:-1], points[1:], points[1:-1]
    quads = np.stack([first + side, last + side, last - side, first - side], axis=1)
    slivers = np.stack([inner + side[:-1], inner + side[1:], inner - side[:-1], inner - side[1:]], axis=1)
    return np.concatenate([quads, slivers])


def _sharp(points: Floats, half: float) -> NDArray[np.bool_]:
    """Mark the points (n,) that need a disc: both ends, and corners that it rounds by more than half a pixel."""
    heading = np.arctan2(*np.diff(points, axis=0).T[::-1])
    turn = np.abs((np.diff(heading) + np.pi) % (2 * np.pi) - np.pi)
    ends = np.ones(1, dtype=np.bool_)
    return np.concatenate([ends, half * (1 - np.cos(turn / 2)) > 0.5, ends[: len(points) - 1]])
