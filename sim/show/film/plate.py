"""A drawing surface whose pixels are had quickly, and that may begin with a part of a frame."""

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from sim.show.draw.layout import Box
from sim.show.draw.paints import Paint, Theme
from sim.show.draw.raster import Raster
from sim.show.draw.silent_pygame import pygame

_RED_LAST = 0xFF0000

Pixels = NDArray[np.uint8]
"""(h, w, 3) red, green and blue."""


class Plate(Raster):
    """A page that is drawn on again and again."""

    def clear(self) -> None:
        """Make the page empty again."""
        self.box(Box(0.0, 0.0, self.width_px, self.height_px), Paint.PAGE, Paint.PAGE, 0.0)

    def lay(self, pixels: Pixels) -> None:
        """Cover the page with pixels (h, w, 3) of its size."""
        below = pygame.image.frombuffer(np.ascontiguousarray(pixels).data, (self.width_px, self.height_px), "RGB")
        self._surface.blit(pygame.transform.scale_by(below, self._scale), (0, 0))

    def pixels(self) -> Pixels:
        """The page as pixels, in an array of their own."""
        # The surface's own bytes: pygame would turn each pixel round to hand them over as RGB.
        order = "BGR" if self._surface.get_masks()[0] == _RED_LAST else "RGB"
        data, size, pitch = self._surface.get_buffer().raw, self._surface.get_size(), self._surface.get_pitch()
        return np.array(Image.frombuffer("RGB", size, data, "raw", order, pitch, 1).reduce(self._scale))


def plate_over(pixels: Pixels, theme: Theme) -> Plate:
    """A page that begins with pixels (h, w, 3)."""
    tall, wide = pixels.shape[:2]
    plate = Plate(wide, tall, theme)
    plate.lay(pixels)
    return plate
