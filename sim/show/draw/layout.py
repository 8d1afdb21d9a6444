"""Where things stand on a page: the plot's frame, its scale and its ticks."""

import math
from typing import Final, NamedTuple

import numpy as np

from parser.geometry.curves import Floats
from parser.units import mm
from sim.show.draw import style


class Box(NamedTuple):
    """An upright rectangle in px; y grows downwards."""

    left: float
    top: float
    right: float
    bottom: float

    def meets(self, other: "Box") -> bool:
        """Whether the two share more than an edge."""
        return (
            self.left < other.right and other.left < self.right and self.top < other.bottom and other.top < self.bottom
        )

    def holds(self, other: "Box") -> bool:
        """Whether `other` lies wholly inside."""
        return (
            self.left <= other.left
            and other.right <= self.right
            and self.top <= other.top
            and other.bottom <= self.bottom
        )


def box_around(center: Floats, width: float, height: float) -> Box:
    """Box of a size in px around the point `center`, (2,) px."""
    x, y = float(center[0]), float(center[1])
    return Box(x - width / 2, y - height / 2, x + width / 2, y + height / 2)


class View(NamedTuple):
    """Scale of a plot, equal on both axes.

    Attributes
    ----------
    px_per_um
        Scale.
    x_px, y_px
        Where the point (0, 0) µm falls on the page.
    """

    px_per_um: float
    x_px: float
    y_px: float

    def to_px(self, points_um: Floats) -> Floats:
        """Points of a part, (…, 2) µm with y upwards, on the page, (…, 2) px with y downwards."""
        return np.asarray(points_um * (self.px_per_um, -self.px_per_um) + (self.x_px, self.y_px), dtype=np.float64)

    def to_um(self, points_px: Floats) -> Floats:
        """Points of the page, (…, 2) px, on the part, (…, 2) µm."""
        return np.asarray((points_px - (self.x_px, self.y_px)) / (self.px_per_um, -self.px_per_um), dtype=np.float64)

    def range_um(self, plot: Box) -> Floats:
        """Give the part of the plane that `plot` shows: (2, 2) µm, lowest and highest (x, y)."""
        return self.to_um(np.array([[plot.left, plot.bottom], [plot.right, plot.top]]))


def fitted(bounds_um: Floats, plot: Box, pad: float = 0.0) -> View:
    """The view that shows a box (2, 2) µm in the middle of a plot, with `pad` px free at its sides."""
    wide_um, tall_um = np.maximum(bounds_um[1] - bounds_um[0], 1e-9).tolist()
    wide, tall = plot.right - plot.left - 2.0 * pad, plot.bottom - plot.top - 2.0 * pad
    return centred(bounds_um.mean(axis=0), min(wide / wide_um, tall / tall_um), plot)


def centred(place_um: Floats, px_per_um: float, plot: Box) -> View:
    """The view of a scale with a place (2,) µm in the middle of a plot."""
    x, y = (place_um * px_per_um).tolist()
    return View(px_per_um, (plot.left + plot.right) / 2 - x, (plot.top + plot.bottom) / 2 + y)


class Page(NamedTuple):
    """A page with one plot.

    Attributes
    ----------
    width_px, height_px
        Size of the page.
    unit
        Factor on the sizes of `sim.show.draw.style`.
    plot
        Frame of the plot.
    view
        Scale of the plot.
    """

    width_px: int
    height_px: int
    unit: float
    plot: Box
    view: View

    @property
    def inside(self) -> Box:
        """The plot without the line of its frame."""
        line = style.GRID_WIDTH * self.unit
        return Box(self.plot.left + line, self.plot.top + line, self.plot.right - line, self.plot.bottom - line)


class Margins(NamedTuple):
    """What is kept free at the four sides of something, in the sizes of `sim.show.draw.style`."""

    left: float
    top: float
    right: float
    bottom: float

    def within(self, box: Box, unit: float) -> Box:
        """What is left of a box."""
        return Box(
            box.left + self.left * unit,
            box.top + self.top * unit,
            box.right - self.right * unit,
            box.bottom - self.bottom * unit,
        )


BESIDE_PLOT: Final = Margins(style.LEFT, style.HEAD, style.EDGE, style.FOOT)
IN_PLOT: Final = Margins(style.PAD, style.PAD, style.PAD, style.PAD)


def unit_of(width_px: int) -> float:
    """Factor on the sizes of `sim.show.draw.style` for a page of this width."""
    return max(width_px / style.BASE_WIDTH, style.LEAST_UNIT)


def page_for(bounds_um: Floats, width_px: int, margins: Margins = BESIDE_PLOT, inside: Margins = IN_PLOT) -> Page:
    """Lay out a page so that a part fills its plot.

    Parameters
    ----------
    bounds_um
        (2, 2) µm, lowest and highest (x, y), neither of both sides 0.
    width_px
        Width of the page; its height follows from the part within `style.HEIGHT_RANGE`.
    beside, inside
        What is kept free between page and frame, and between frame and part.

    Raises
    ------
    ValueError
        The page is narrower than `style.LEAST_THUMBNAIL`.
    """
    if width_px < style.LEAST_THUMBNAIL:
        raise ValueError(f"a picture is at least {style.LEAST_THUMBNAIL} px wide, not {width_px}")
    unit = unit_of(width_px)
    wide_um, tall_um = np.maximum(bounds_um[1] - bounds_um[0], 1e-9).tolist()
    room = _room(width_px, width_px, margins, inside)
    other_px = width_px - (room.bottom - room.top)
    height_px = _height_px(width_px, other_px + (room.right - room.left) * tall_um / wide_um)
    room = _room(width_px, height_px, margins, inside)
    plot = margins.within(Box(0.0, 0.0, width_px, height_px), unit)
    return Page(width_px, height_px, unit, plot, fitted(bounds_um, room))


def _room(width_px: int, height_px: int, margins: Margins, inside: Margins) -> Box:
    """Where the part may lie on a page."""
    unit = unit_of(width_px)
    return inside.within(margins.within(Box(0.0, 0.0, width_px, height_px), unit), unit)


def _height_px(width_px: int, wanted_px: float) -> int:
    low, high = style.HEIGHT_RANGE
    return round(min(max(wanted_px, low * width_px), high * width_px))


def nice_below(value: float) -> float:
    """Largest of … 1, 2, 5, 10, 20 … that is not above `value`, which is above 0."""
    power = 10.0 ** math.floor(math.log10(value))
    return next(digit * power for digit in (5.0, 2.0, 1.0) if digit * power <= value or digit == 1.0)


def ticks(low: float, high: float, step: float) -> Floats:
    """Multiples of `step` from `low` to `high`, in their unit."""
    return np.asarray(np.arange(math.ceil(low / step), math.floor(high / step) + 1) * step, dtype=np.float64)


def mm_text(length_um: float, step_um: float) -> str:
    """Write a length in mm with the decimals that steps of `step_um` need, such as ``−12.5``."""
    decimals = max(0, -math.floor(math.log10(mm(step_um)) + 1e-9))
    return f"{mm(length_um) + 0.0:.{decimals}f}".replace("-", "−")
