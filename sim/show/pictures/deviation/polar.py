"""Deviation around the circles of a program, in the direction where it lies."""

from typing import Final, NamedTuple

import numpy as np

from parser.geometry.curves import Bools, Floats
from parser.toolpath import Toolpath
from parser.units import mm
from sim.show.draw import style
from sim.show.draw.canvas import Canvas
from sim.show.draw.chart import (
    NOMINAL_WIDTH,
    RIM,
    Columns,
    Dial,
    draw_ring_values,
    draw_rings,
    in_cells,
    ring_for,
)
from sim.show.draw.flatten import CHORD_PX, simplify
from sim.show.draw.layout import Box
from sim.show.draw.legend import Entry, draw_at_foot, in_rows, ring, stroke, swatch
from sim.show.draw.sheet import AnyCanvas, Sheet
from sim.show.draw.style import Paint
from sim.show.pictures.deviation.frame import Samples, titled, um, write_caption
from sim.show.texts import Words

MOST: Final = 4
"""Dials in a picture."""
GAP: Final = 18.0
"""Between dials, and around them."""
CAPTION: Final = 76.0
"""Height of the two lines above a dial."""
LARGEST: Final = 1.25
"""The most that a single dial is enlarged."""
CELL: Final = 4.0
"""Width of a cell around a dial, px: of its samples the lowest and the highest show."""
WIRE_WIDTH: Final = 2.2
STEPS_WIDTH: Final = 1.0
LEAST_RADIUS_UM: Final = 20.0
LEAST_SWEEP_RAD: Final = 1.5 * np.pi
SAME_UM: Final = 2.5
"""Two arcs differ by less in centre and radius if they are of one circle and rounded to whole µm."""


class Circle(NamedTuple):
    """Rows of one circle, `first` to `last`, its centre (2,) and radius µm, and 1 counter-clockwise, −1 clockwise."""

    first: int
    last: int
    center_um: Floats
    radius_um: float
    turn: int


class Around(NamedTuple):
    """Deviation around a circle: directions (n,) and deviations (n,) of wire and steps, outward positive."""

    circle: Circle
    wire_rad: Floats
    wire_um: Floats
    steps_rad: Floats
    steps_um: Floats

    @property
    def most_um(self) -> float:
        """The largest deviation of the wire."""
        return float(np.abs(self.wire_um).max())


def draw_polar(sheet: Sheet[AnyCanvas], samples: Samples) -> AnyCanvas | None:
    """Draw the deviation around up to four circles, those where it is largest.

    None where the program has no circle (see `circles_of`), or none was cut. ValueError where the sheet is narrower
    than 600 px.
    """
    say, unit = sheet.say, sheet.unit
    found = [around for circle in circles_of(samples.run.toolpath) if (around := around_of(samples, circle))]
    if not found:
        return None
    arcs = sorted(sorted(found, key=lambda around: -around.most_um)[:MOST], key=lambda around: around.circle.first)
    legend = in_rows(_entries(say), sheet.width_px, unit)
    columns, rows = min(len(arcs), 2), (len(arcs) + 1) // 2
    wide = (sheet.width_px - GAP * unit) / columns
    size = min((wide - GAP * unit) / (2.0 * RIM), LARGEST * unit)
    tall = 2.0 * RIM * size + (CAPTION + GAP) * unit
    some = say("deviation.some_circles", shown=len(arcs), all=len(found)) if len(found) > len(arcs) else ""
    canvas = titled(sheet, samples, say("deviation.polar"), style.HEAD * unit + rows * tall + legend.foot, some)
    for at, around in enumerate(arcs):
        x = (at % columns + 0.5) * wide + GAP * unit / 2.0
        top = style.HEAD * unit + at // columns * tall
        dial = Dial(unit, ring_for(_most(around)), (x, top + CAPTION * unit + RIM * size), size)
        above = Box(x - wide / 2.0, top, x + wide / 2.0, top + CAPTION * unit)
        write_caption(canvas, above, _caption(say, samples, around), unit, align=0.5)
        _draw_dial(canvas, dial, around)
    draw_at_foot(canvas, legend)
    return canvas


def circles_of(toolpath: Toolpath) -> list[Circle]:
    """All circles of a program, more than three quarters of them cut, in its order; empty where there is none."""
    group = np.cumsum(~_goes_on(toolpath))
    first = np.flatnonzero(np.diff(group, prepend=-1))
    last = np.append(first[1:], len(group)) - 1
    swept = np.add.reduceat(np.abs(toolpath.sweep_rad), first)
    round_ = toolpath.is_arc[first] & (swept > LEAST_SWEEP_RAD)
    round_[round_] &= toolpath.radius_um[first[round_]] >= LEAST_RADIUS_UM
    return [_circle(toolpath, *rows) for rows in zip(first[round_].tolist(), last[round_].tolist(), strict=True)]


def _goes_on(toolpath: Toolpath) -> Bools:
    """Whether each block (n,) goes on around the circle of the block before it."""
    with np.errstate(invalid="ignore"):  # lines have no centre
        by = np.diff(toolpath.center_um, axis=0)
        same = (np.hypot(by[:, 0], by[:, 1]) < SAME_UM) & (np.abs(np.diff(toolpath.radius_um)) < SAME_UM)
    onward = toolpath.sweep_rad[1:] * toolpath.sweep_rad[:-1] > 0.0
    return np.concatenate([[False], same & onward])


def _circle(toolpath: Toolpath, first: int, last: int) -> Circle:
    turn = 1 if toolpath.sweep_rad[first] > 0.0 else -1
    return Circle(first, last, toolpath.center_um[first], float(toolpath.radius_um[first]), turn)


def around_of(samples: Samples, circle: Circle) -> Around | None:
    """Deviation at the samples of a circle; None where none of it was cut."""
    here = np.flatnonzero((samples.trace.row >= circle.first) & (samples.trace.row <= circle.last))
    if len(here) < 2:
        return None
    wire, steps = (place[here] - circle.center_um for place in (samples.trace.wire_um, samples.trace.commanded_um))
    outward = -circle.turn  # the left of counter-clockwise travel lies inside
    return Around(
        circle,
        np.arctan2(wire[:, 1], wire[:, 0]),
        outward * samples.wire_um[here],
        np.arctan2(steps[:, 1], steps[:, 0]),
        outward * samples.steps_um[here],
    )


def _most(around: Around) -> float:
    return max(around.most_um, float(np.abs(around.steps_um).max()))


def _draw_dial(canvas: Canvas, dial: Dial, around: Around) -> None:
    draw_rings(canvas, dial)
    turn = around.circle.turn
    wire = _cells(dial, turn, around.wire_rad, around.wire_um)
    steps = _cells(dial, turn, around.steps_rad, around.steps_um)
    for columns, paint in ((wire, Paint.ACTUAL_PALE), (steps, Paint.STEPS_PALE)):
        low, high = _edges(dial, columns)
        canvas.polygon(np.concatenate([low, high[::-1]]), paint)
    for columns, paint, width in ((steps, Paint.STEPS, STEPS_WIDTH), (wire, Paint.ACTUAL, WIRE_WIDTH)):
        for edge in _edges(dial, columns):
            canvas.polyline(simplify(edge, CHORD_PX), paint, width * dial.unit)
    draw_ring_values(canvas, dial)
    _mark_start(canvas, dial, around)


def _cells(dial: Dial, turn: int, angle_rad: Floats, off_um: Floats) -> Columns:
    """Lowest and highest deviation in each cell around a dial; directions go on past a whole turn."""
    travelled = turn * np.maximum.accumulate(turn * np.unwrap(angle_rad))
    cell = np.floor(turn * (travelled - travelled[0]) * dial.ring_px(0) / (CELL * dial.unit)).astype(np.int64)
    return in_cells(cell, travelled, off_um)


def _edges(dial: Dial, columns: Columns) -> tuple[Floats, Floats]:
    """The inner and the outer edge of a band, (k, 2) px each."""
    return dial.to_px(columns.x, columns.ends[:, 0]), dial.to_px(columns.x, columns.ends[:, 1])


def _mark_start(canvas: Canvas, dial: Dial, around: Around) -> None:
    """Ring the start of the circle on the ideal one, with an arrow along it."""
    angle, turn, unit = float(around.steps_rad[0]), around.circle.turn, dial.unit
    place = dial.to_px(np.array(angle), np.array(0.0))
    ahead = turn * np.array([-np.sin(angle), -np.cos(angle)])
    canvas.ring(place, style.MARK * unit, Paint.START, style.MARK_WIDTH * unit)
    canvas.arrow(place + ahead * (1.4 * style.MARK + style.ARROW) * unit, ahead, style.ARROW * unit, Paint.START)


def _caption(say: Words, samples: Samples, around: Around) -> tuple[str, str]:
    """Which circle it is, and from what to what the wire is off."""
    circle, radius = around.circle, f"{mm(around.circle.radius_um):.3f}"
    first, last = (samples.run.block_names.of_row(row) for row in (circle.first, circle.last))
    key = "deviation.circle" if first == last else "deviation.circle_blocks"
    low, high = (um(float(end), signed=True) for end in (around.wire_um.min(), around.wire_um.max()))
    name = say(key, block=first, first=first, last=last, radius=radius)
    return name, say("deviation.outward", low=low, high=high)


def _entries(say: Words) -> list[Entry]:
    return [
        Entry(swatch(Paint.ACTUAL_PALE, Paint.ACTUAL, WIRE_WIDTH), say("deviation.wire_band")),
        Entry(swatch(Paint.STEPS_PALE, Paint.STEPS, STEPS_WIDTH), say("deviation.steps_band")),
        Entry(stroke(Paint.INK, NOMINAL_WIDTH), say("deviation.nominal")),
        Entry(ring(Paint.START), say("deviation.circle_start")),
    ]
