"""Charts: a frame with a scale on each axis and lines in it, and the dial of a polar plot.

Charts: a frame with a scale on each axis, and lines, bands and levels in it; many samples in columns of pixels.

The dial of a polar plot: deviation from the nominal circle, magnified, in the direction where it lies.
"""

import math
from typing import Final, NamedTuple

import numpy as np

from parser.geometry.curves import Floats, Ints
from sim.show.draw import style
from sim.show.draw.canvas import Canvas
from sim.show.draw.flatten import CHORD_PX, simplify
from sim.show.draw.layout import Box, box_around, nice_below, ticks
from sim.show.draw.letters import text_width
from sim.show.draw.style import Paint


class AxisRange(NamedTuple):
    """Lowest and highest value of an axis, in its unit; low < high."""

    low: float
    high: float

    def wider(self, share: float) -> "AxisRange":
        """The range with a share of its width more at both ends."""
        more = share * (self.high - self.low)
        return AxisRange(self.low - more, self.high + more)


class Chart(NamedTuple):
    """A frame on a page, px, with the values that its sides stand for."""

    frame: Box
    x: AxisRange
    y: AxisRange
    unit: float

    def x_px(self, x: Floats | float) -> Floats:
        """Where values of the X axis fall."""
        share = (np.asarray(x) - self.x.low) / (self.x.high - self.x.low)
        return np.asarray(self.frame.left + share * (self.frame.right - self.frame.left), dtype=np.float64)

    def y_px(self, y: Floats | float) -> Floats:
        """Where values of the Y axis fall."""
        share = (np.asarray(y) - self.y.low) / (self.y.high - self.y.low)
        return np.asarray(self.frame.bottom - share * (self.frame.bottom - self.frame.top), dtype=np.float64)

    def to_px(self, points: Floats) -> Floats:
        """Places (n, 2) px of points (n, 2) in the units of the axes."""
        return np.stack([self.x_px(points[:, 0]), self.y_px(points[:, 1])], axis=-1)


def range_of(*values: Floats, least: float = 0.0) -> AxisRange:
    """Range of all finite values, no narrower than `least`; around 0 where there are no values."""
    finite = np.concatenate([[np.nan], *(np.ravel(part) for part in values)])
    finite = finite[np.isfinite(finite)]
    low, high = (float(finite.min()), float(finite.max())) if len(finite) else (0.0, 0.0)
    missing = max(least - (high - low), 0.0)
    return AxisRange(low - missing / 2.0, high + missing / 2.0)


def draw_chart(  # noqa: PLR0913 - all but the first two are named
    canvas: Canvas,
    chart: Chart,
    *,
    x_name: str = "",
    y_name: str = "",
    x_values: bool = True,
    tolerance: AxisRange | None = None,
) -> None:
    """Draw the frame with its grid, the values at its sides, and the names of its axes inside their ends.

    A tolerance band of the Y axis lies under the grid.
    """
    frame, unit, size = chart.frame, chart.unit, style.TICK * chart.unit
    canvas.box(frame, Paint.PAGE, Paint.FRAME, style.GRID_WIDTH * unit)
    if tolerance is not None:
        _draw_tolerance(canvas, chart, tolerance)
    for value, text in tick_texts(chart.x, (frame.right - frame.left) / (1.5 * style.TICK_SPACING * unit)):
        x = float(chart.x_px(value))
        canvas.polyline(np.array([[x, frame.top], [x, frame.bottom]]), Paint.GRID, style.GRID_WIDTH * unit)
        if x_values:
            canvas.text((x, frame.bottom + 0.8 * size), text, size, Paint.GREY, align=0.5)
    for value, text in tick_texts(chart.y, (frame.bottom - frame.top) / (0.28 * style.TICK_SPACING * unit)):
        y = float(chart.y_px(value))
        canvas.polyline(np.array([[frame.left, y], [frame.right, y]]), Paint.GRID, style.GRID_WIDTH * unit)
        canvas.text((frame.left - 0.4 * size, y), text, size, Paint.GREY, align=1.0)
    if x_name:
        canvas.text((frame.right - 0.5 * size, frame.bottom - 0.8 * size), x_name, size, Paint.GREY, align=1.0)
    if y_name:
        canvas.text((frame.left + 0.5 * size, frame.top + 0.8 * size), y_name, size, Paint.GREY)


def _draw_tolerance(canvas: Canvas, chart: Chart, tolerance: AxisRange) -> None:
    """Fill a band across the frame, and draw those of its edges that lie inside."""
    ends = np.clip(np.array(tolerance), chart.y.low, chart.y.high)
    draw_band(canvas, chart, np.array(chart.x), np.broadcast_to(ends, (2, 2)), Paint.BAND)
    for edge in tolerance:
        draw_level(canvas, chart, edge, Paint.BAND_EDGE, style.GRID_WIDTH * 1.5)


def tick_texts(values: AxisRange, most: float) -> list[tuple[float, str]]:
    """Round values of a range, no more than `most` and one, with what is written beside them."""
    step = nice_below(2.5 * (values.high - values.low) / max(most, 1.0))
    decimals = max(0, -math.floor(math.log10(step) + 1e-9))
    at = ticks(values.low, values.high, step).tolist()
    return [(value, f"{value + 0.0:,.{decimals}f}".replace("-", "−")) for value in at]


def draw_line(canvas: Canvas, chart: Chart, values: Floats, paint: Paint, width: float) -> None:
    """Draw a line through points (n, 2), cut off at the frame; where a value is NaN it is broken."""
    points = chart.to_px(values)
    known = np.isfinite(points).all(axis=1)
    with canvas.clipped(chart.frame):
        for run in np.split(points, np.flatnonzero(np.diff(known)) + 1):
            if np.isfinite(run[0]).all():
                canvas.polyline(simplify(run, CHORD_PX), paint, width * chart.unit)


def draw_band(canvas: Canvas, chart: Chart, x: Floats, ends: Floats, paint: Paint) -> None:
    """Fill between the two values (n, 2) over each of (n,), n ≥ 2, all finite, cut off at the frame."""
    low, high = (simplify(chart.to_px(np.stack([x, ends[:, side]], axis=1)), CHORD_PX) for side in (0, 1))
    outline = np.concatenate([low, high[::-1]])
    with canvas.clipped(chart.frame):
        canvas.polygon(outline, paint)


def draw_level(canvas: Canvas, chart: Chart, y: float, paint: Paint, width: float) -> None:
    """Draw a dashed level across the frame; nothing where it lies outside."""
    if chart.y.low <= y <= chart.y.high:
        at = float(chart.y_px(y))
        line = np.array([[chart.frame.left, at], [chart.frame.right, at]])
        canvas.dashed(line, paint, width * chart.unit, style.DASH * chart.unit, style.DASH_GAP * chart.unit)


class Columns(NamedTuple):
    """Columns with samples: middle of each in the unit of the X axis (k,), lowest and highest value there (k, 2)."""

    x: Floats
    ends: Floats


def columns_of(chart: Chart, x: Floats, value: Floats) -> Columns:
    """Columns of values (n,) over `x` (n,), n ≥ 1, which never falls; ends of the stretch are kept.

    They are 1 px wide, and wider on a page that is larger than the usual one, where they would be too fine to see.
    """
    return in_cells(np.floor(chart.x_px(x) / max(chart.unit, 1.0)).astype(np.int64), x, value)


def in_cells(cell: Ints, x: Floats, value: Floats) -> Columns:
    """Columns of the cells (n,), never falling, of values (n,) over `x` (n,), n ≥ 1."""
    first = np.flatnonzero(np.diff(cell, prepend=cell[0] - 1))
    ends = np.stack([np.minimum.reduceat(value, first), np.maximum.reduceat(value, first)], axis=1)
    middle = (x[first] + x[np.append(first[1:], len(x)) - 1]) / 2.0
    middle[0], middle[-1] = x[0], x[-1]
    return Columns(middle, ends)


def stretches(chosen: Ints) -> list[slice]:
    """Slices of the stretches of consecutive numbers in `chosen`, rising."""
    if not len(chosen):
        return []
    cuts = np.flatnonzero(np.diff(chosen) > 1) + 1
    first, last = np.concatenate([[0], cuts]), np.append(cuts, len(chosen)) - 1
    return [slice(a, b + 1) for a, b in zip(chosen[first].tolist(), chosen[last].tolist(), strict=True)]


NOMINAL: Final = 240.0
RING: Final = 54.0
RINGS: Final = 2
"""Rings inside and outside of the nominal circle."""
RIM: Final = NOMINAL + (RINGS + 0.3) * RING
LEAST_RING_UM: Final = 0.1
RING_SIZES: Final = (1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0)
VALUES_RAD: Final = (np.radians(67.5), np.radians(247.5))
AXIS_WIDTH: Final = 1.2
NOMINAL_WIDTH: Final = 2.0


class Dial(NamedTuple):
    """Scale of the dial.

    Attributes
    ----------
    unit
        Factor on the sizes of texts and lines.
    ring_um
        Deviation from one ring to the next.
    middle
        Place of its centre, px.
    size
        Factor on the sizes of this module, px.
    """

    unit: float
    ring_um: float
    middle: tuple[float, float]
    size: float

    @property
    def px_per_um(self) -> float:
        """Scale of deviations."""
        return RING * self.size / self.ring_um

    def magnification(self, radius_um: float) -> float:
        """How many times larger deviations are drawn than the circle."""
        return self.px_per_um / (NOMINAL * self.size / radius_um)

    def to_px(self, angle_rad: Floats, off_um: Floats) -> Floats:
        """Places (n, 2) px of deviations (n,) in directions (n,)."""
        return self.at(angle_rad, NOMINAL * self.size + off_um * self.px_per_um)

    def at(self, angle_rad: Floats, radius_px: Floats | float) -> Floats:
        """Places (n, 2) px at distances from the dial's centre."""
        unit = np.stack([np.cos(angle_rad), -np.sin(angle_rad)], axis=-1)
        return np.asarray(self.center + unit * np.asarray(radius_px)[..., None], dtype=np.float64)

    def ring_px(self, ring: int) -> float:
        """Radius of a ring, counted outward from the nominal circle."""
        return (NOMINAL + ring * RING) * self.size

    @property
    def center(self) -> Floats:
        """Centre (2,) px."""
        return np.array(self.middle)


def ring_for(most_um: float) -> float:
    """Deviation from ring to ring, µm, a round one, where deviations up to `most_um` have room."""
    wanted = max(most_um / RINGS, LEAST_RING_UM)
    power = 10.0 ** math.floor(math.log10(wanted))
    return next(size * power for size in RING_SIZES if size * power >= wanted * (1.0 - 1e-9))


def draw_rings(canvas: Canvas, dial: Dial) -> None:
    """Draw the nominal circle, rings, the two axes, and their halves."""
    unit = dial.unit
    for eighth in range(8):
        line = dial.at(np.full(2, eighth * np.pi / 4.0), np.array([NOMINAL - RINGS * RING, RIM]) * dial.size)
        canvas.polyline(line, Paint.GRID if eighth % 2 else Paint.FRAME, AXIS_WIDTH * unit)
    for ring in range(-RINGS, RINGS + 1):
        canvas.ring(dial.center, dial.ring_px(ring), Paint.FRAME, AXIS_WIDTH * unit)
    canvas.ring(dial.center, dial.ring_px(0), Paint.INK, NOMINAL_WIDTH * unit)


def draw_ring_values(canvas: Canvas, dial: Dial) -> None:
    """Write the deviation beside each ring, µm."""
    size = style.NUMBER * dial.unit
    for angle in VALUES_RAD:
        for ring in range(-RINGS, RINGS + 1):
            x, y = dial.at(np.array(angle), dial.ring_px(ring)).tolist()
            text = _value_text(ring, dial.ring_um)
            plate = box_around(np.array([x, y]), text_width(text, size) + 0.4 * size, 1.1 * size)
            canvas.box(plate, Paint.PAGE, Paint.PAGE, 0.0)
            canvas.text((x, y), text, size, Paint.GREY, align=0.5)


def _value_text(ring: int, ring_um: float) -> str:
    value = f"{ring * ring_um:+.6g}".replace("-", "−") if ring else "0"
    return f"{value} µm" if ring == RINGS else value
