"""Which pass went over each pixel of the plot last: worked out once for a view, as the map of the cut is."""

import numpy as np
from numpy.typing import NDArray

from parser.geometry.curves import Ints
from sim.show.draw.layout import Box
from sim.show.draw.silent_pygame import pygame
from sim.show.film.cut_map import NEVER, Discs, Span


class PassMap:
    """The discs of a plot by their tones, from 1; of passes with a later tone the later one lies on top.

    `tone` (k,) int64 is that of each disc.
    """

    def __init__(self, discs: Discs, tone: Ints, plot: Box) -> None:
        self._discs, self._plot = discs, plot
        later = sorted(set(tone.tolist()) - {1})
        self._first = [(one, self._drawn(np.flatnonzero(tone == one))) for one in later]

    def tones(self, front: int, span: Span) -> Ints:
        """Tone (h, w) of each pixel of a span once so many discs are cut."""
        found = np.ones((span.bottom - span.top, span.right - span.left), dtype=np.int64)
        for tone, first in self._first:
            found[first[span.of] < front] = tone
        return found

    def _drawn(self, numbers: Ints) -> NDArray[np.uint32]:
        """Number (h, w) of the first disc over each pixel, those too that a disc only touches."""
        plot = self._plot
        surface = pygame.Surface((round(plot.right - plot.left), round(plot.bottom - plot.top)), depth=32)
        surface.fill(NEVER)
        places = np.rint(self._discs.centers[numbers] - (plot.left, plot.top)).astype(np.int64).tolist()
        radius = round(self._discs.radius) + 1
        for number, place in zip(reversed(numbers.tolist()), reversed(places), strict=True):
            pygame.draw.circle(surface, number, place, radius)
        return np.ascontiguousarray(pygame.surfarray.pixels2d(surface).T)
