"""The drawing surface: strokes, marks and text in px of the page; the only module that draws with pygame.

It draws three times as large and takes the mean of 3 × 3 pixels, which smooths every edge. No display is opened.
"""

import os
from collections.abc import Iterator
from contextlib import contextmanager
from itertools import pairwise
from typing import Final

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from parser.geometry.curves import Floats
from sim.draw import style
from sim.draw.layout import Box
from sim.draw.style import Colour

os.environ.setdefault("PYGAME_HIDE_SUPPORT_PROMPT", "1")  # its greeting would go to stdout, among our data
import pygame
import pygame.font

SUPERSAMPLE: Final = 3
THIN_PX: Final = 4.0  # up to here the slanted ends of pygame's lines do not show
EDGE_FINE: Final = 5.0


class Canvas:
    """A white page of `width_px` × `height_px`; all coordinates and sizes are px of that page, y downwards."""

    def __init__(self, width_px: int, height_px: int) -> None:
        pygame.font.init()
        self._surface = pygame.Surface((width_px * SUPERSAMPLE, height_px * SUPERSAMPLE), depth=24)
        self._surface.fill(style.WHITE)
        self._fonts: dict[int, pygame.font.Font] = {}

    def polyline(self, points: Floats, colour: Colour, width: float) -> None:
        """Stroke a line through `points`, (n, 2) with n ≥ 1, with round corners and ends."""
        fine, half = points * SUPERSAMPLE, width * SUPERSAMPLE / 2
        if width <= THIN_PX:
            self._chords(fine[:-1], fine[1:], colour, 2 * half)
        else:
            self._band(fine, colour, half)
        for center in fine[_sharp(fine, half)]:
            self._circle(center, half, colour)

    def _chords(self, first: Floats, last: Floats, colour: Colour, fine_width: float) -> None:
        """Stroke single chords, (n, 2) each; pygame counts a line's width along the axis it crosses, not across it."""
        chord = np.abs(last - first)
        length, longest = np.hypot(chord[:, 0], chord[:, 1]), chord.max(axis=1)
        stretch = np.divide(length, longest, out=np.ones_like(length), where=longest > 0)
        widths = np.maximum(np.rint(fine_width * stretch), 1).astype(np.int64)
        shift = np.where(widths % 2, 0.0, 0.5)[:, None]  # of two middle pixels pygame wants the lower one
        ends = np.floor(np.stack([first - shift, last - shift], axis=1)).tolist()
        for (start, end), wide in zip(ends, widths.tolist(), strict=True):
            pygame.draw.line(self._surface, colour, start, end, wide)

    def _band(self, fine: Floats, colour: Colour, half: float) -> None:
        """Fill a wide line, then draw its edges: pygame's polygons are up to 2 fine pixels too wide or too narrow."""
        side = _normals(fine) * (half - EDGE_FINE / 2)
        for corners in np.rint(_quads(fine, side)).tolist():
            pygame.draw.polygon(self._surface, colour, corners)
        for edge in (side, -side):
            self._chords(fine[:-1] + edge, fine[1:] + edge, colour, EDGE_FINE)

    def _circle(self, fine: Floats, radius: float, colour: Colour, width: float = 0.0) -> None:
        pygame.draw.circle(self._surface, colour, np.rint(fine).tolist(), round(radius), round(width))

    def dashed(self, points: Floats, colour: Colour, width: float, dash: float, gap: float) -> None:
        """Stroke each chord of `points`, (n, 2), with dashes of length `dash` and gaps of length `gap`."""
        for first, last in pairwise(points):
            length = float(np.hypot(*(last - first)))
            for start in np.arange(0.0, length, dash + gap):
                ends = np.array([[start], [min(start + dash, length)]]) / length
                self.polyline(first + ends * (last - first), colour, width)

    def ring(self, center: Floats, radius: float, colour: Colour, width: float) -> None:
        """Stroke a circle; `radius` is that of its middle line."""
        self._circle(center * SUPERSAMPLE, (radius + width / 2) * SUPERSAMPLE, colour, width * SUPERSAMPLE)

    def arrow(self, tip: Floats, direction: Floats, size: float, colour: Colour) -> None:
        """Fill an arrow head of length `size`; `direction` has length 1."""
        side = np.array([-direction[1], direction[0]])
        back = tip - size * direction
        corners = np.array([tip, back + 0.36 * size * side, tip - 0.75 * size * direction, back - 0.36 * size * side])
        pygame.draw.polygon(self._surface, colour, np.rint(corners * SUPERSAMPLE).tolist())

    def polygon(self, corners: Floats, colour: Colour) -> None:
        """Fill a polygon of `corners`, (n, 2) with n ≥ 3."""
        pygame.draw.polygon(self._surface, colour, np.rint(corners * SUPERSAMPLE).tolist())

    @contextmanager
    def clipped(self, box: Box) -> Iterator[None]:
        """Draw nothing outside a rectangle for as long as the context lasts."""
        left, top, right, bottom = (round(side * SUPERSAMPLE) for side in box)
        self._surface.set_clip((left, top, right - left, bottom - top))
        yield
        self._surface.set_clip(None)

    def box(self, box: Box, fill: Colour, edge: Colour, width: float) -> None:
        """Fill a rectangle and stroke its border inwards."""
        left, top, right, bottom = (round(side * SUPERSAMPLE) for side in box)
        pygame.draw.rect(self._surface, edge, (left, top, right - left, bottom - top))
        inset = round(width * SUPERSAMPLE)
        inner = (left + inset, top + inset, right - left - 2 * inset, bottom - top - 2 * inset)
        pygame.draw.rect(self._surface, fill, inner)

    def text(self, at: tuple[float, float], text: str, size: float, colour: Colour, align: float = 0.0) -> None:
        """Write a line, vertically centred on `at`; `align` of its width lies to the left of `at`."""
        image = self._font(size).render(text, True, colour)
        left = at[0] * SUPERSAMPLE - align * image.get_width()
        self._surface.blit(image, (round(left), round(at[1] * SUPERSAMPLE - image.get_height() / 2)))

    def text_width(self, text: str, size: float) -> float:
        """Width that `text` takes, px."""
        return self._font(size).size(text)[0] / SUPERSAMPLE

    def _font(self, size: float) -> pygame.font.Font:
        fine = round(size * SUPERSAMPLE)
        if fine not in self._fonts:
            self._fonts[fine] = pygame.font.Font(style.FONT, fine)
        return self._fonts[fine]

    def image(self) -> Image.Image:
        """Give the page as an RGB picture."""
        pixels = pygame.image.tobytes(self._surface, "RGB")
        return Image.frombytes("RGB", self._surface.get_size(), pixels).reduce(SUPERSAMPLE)


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
    """Mark the ends, and the corners where a round corner reaches half a pixel beyond the sliver."""
    heading = np.arctan2(*np.diff(points, axis=0).T[::-1])
    turn = np.abs((np.diff(heading) + np.pi) % (2 * np.pi) - np.pi)
    ends = np.ones(1, dtype=np.bool_)
    return np.concatenate([ends, half * (1 - np.cos(turn / 2)) > 0.5, ends[: len(points) - 1]])
