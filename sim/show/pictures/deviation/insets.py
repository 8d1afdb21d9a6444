"""Insets: a few µm of the path on a grid of single steps, with the staircase and the deviation.

What an inset shows: a stretch of the ideal path, of the single steps and of the wire, around one place.
"""

from typing import Final, NamedTuple

import numpy as np

from controller.stepping.pulses import Pulses
from parser.geometry.along import places_at
from parser.geometry.curves import Bools, Floats
from sim.show.draw import style
from sim.show.draw.canvas import Canvas
from sim.show.draw.chart import stretches
from sim.show.draw.flatten import CHORD_PX, simplify
from sim.show.draw.layout import Box, View, box_around, centred, nice_below, ticks
from sim.show.draw.legend import Entry, stroke
from sim.show.draw.letters import text_width
from sim.show.draw.style import Paint
from sim.show.pictures.deviation.frame import Samples, um
from sim.show.texts import Words
from sim.table.trace import origin_um

LEAST_SIDE_UM: Final = 24.0
SIDES: Final = 3.2
"""How many times the deviation fits into the side of its view."""
STEPS: Final = 20_000
"""So many steps before and after a place are searched for those in its view."""
POINTS: Final = 2000
"""The ideal path of a view is drawn through so many: no chord leaves an arc by a thousandth of the view."""
SHOWN: Final = 1.5
"""A view shows no more of the path before its place, and after it, in sides of the view.

A straight path leaves the view after 0.7.
"""


class Inset(NamedTuple):
    """A place close up, all lengths µm.

    Attributes
    ----------
    at
        Sample of the place.
    center_um, side_um
        Middle (2,) and side of the square view.
    foot_um, place_um
        Ends (2,) of the deviation: on the ideal path, and the wire.
    ideal_um
        (k, 2) the ideal path through the view.
    steps_um
        Stretches (k, 2) of single steps in the view.
    wire_um, table_um
        (k, 2) samples of wire and table around the place: the same array, unless the wire bows back.
    """

    at: int
    center_um: Floats
    side_um: float
    foot_um: Floats
    place_um: Floats
    ideal_um: Floats
    steps_um: list[Floats]
    wire_um: Floats
    table_um: Floats


def inset_of(samples: Samples, steps: Pulses, at: int) -> Inset:
    """The place of a sample close up; of the steps of the run only some around it are read."""
    trace = samples.trace
    place, foot = trace.wire_um[at], samples.foot_um[at]
    side = max(LEAST_SIDE_UM, SIDES * float(np.hypot(*(place - foot))))
    center = (place + foot) / 2.0
    low, high = _reach_um(samples, foot, at, side)
    near = slice(*np.searchsorted(samples.along_um, [low, np.nextafter(high, np.inf)]).tolist())
    wire = trace.wire_um[near]
    return Inset(
        at=at,
        center_um=center,
        side_um=side,
        foot_um=foot,
        place_um=place,
        ideal_um=_ideal(samples, low, high),
        steps_um=_steps_in_view(samples, steps, at, center, side),
        wire_um=wire,
        table_um=trace.table_um[near] if trace.table_um is not trace.wire_um else wire,
    )


def _reach_um(samples: Samples, foot: Floats, at: int, side_um: float) -> tuple[float, float]:
    """Path lengths between which the path may lie in a view; the wire trails behind the length planned by then."""
    trails = float(np.hypot(*(samples.trace.commanded_um[at] - foot)))
    middle, reach = float(samples.along_um[at]), SHOWN * side_um + trails
    return max(middle - reach, 0.0), middle + reach


def _ideal(samples: Samples, low: float, high: float) -> Floats:
    """The ideal path from a length to another one, its corners included."""
    toolpath = samples.run.toolpath
    border = toolpath.before_um
    high = min(high, float(border[-1]))
    inner = border[(border > low) & (border < high)]
    along = np.union1d(np.linspace(low, high, POINTS), inner)
    row = np.clip(np.searchsorted(border, along, side="right") - 1, 0, len(toolpath) - 1)
    return places_at(toolpath, row, along - border[row])


def _steps_in_view(samples: Samples, steps: Pulses, at: int, center: Floats, side_um: float) -> list[Floats]:
    """Stretches of places of steps, those in the view and one more at each end."""
    middle = int(np.searchsorted(steps.t_s, samples.trace.t_s[at]))
    since, until = max(middle - STEPS, 0), min(middle + STEPS, len(steps.t_s))
    near = steps.part(since, until)
    if since:
        before = np.array([[steps.x_um[since - 1], steps.y_um[since - 1]]])
    else:
        before = np.array([origin_um(samples.run.toolpath)])
    places = np.concatenate([before, np.stack([near.x_um, near.y_um], axis=1)]).astype(np.float64)
    inside: Bools = np.all(np.abs(places - center) <= side_um / 2.0, axis=1)
    seen = inside.copy()
    seen[1:] |= inside[:-1]
    seen[:-1] |= inside[1:]
    return [places[stretch] for stretch in stretches(np.flatnonzero(seen))]


GRID_APART: Final = 7.0
"""Lines of the grid are single µm unless they would come closer together than this."""
TENTH: Final = 10
"""Every how manyth line of the grid is darker."""
IDEAL_WIDTH: Final = 2.4
STEPS_WIDTH: Final = 1.8
WIRE_WIDTH: Final = 3.0
TABLE_WIDTH: Final = 1.6
STEP_DOT: Final = 3.6
WIRE_DOT: Final = 5.5
APART: Final = 2.7
"""Dots show where their middles are at least so many radii apart."""
SIZE_WIDTH: Final = 2.0
SIZE_ARROW: Final = 14.0


def draw_inset(canvas: Canvas, box: Box, inset: Inset, unit: float) -> None:
    """Draw an inset into a square box."""
    view = view_of(box, inset)
    canvas.box(box, Paint.PAGE, Paint.FRAME, style.GRID_WIDTH * unit)
    inner = Box(box.left + unit, box.top + unit, box.right - unit, box.bottom - unit)
    with canvas.clipped(inner):
        _draw_grid(canvas, box, view, unit)
        canvas.polyline(_drawn(view, inset.ideal_um), Paint.IDEAL, IDEAL_WIDTH * unit)
        _draw_steps(canvas, view, inset, unit)
        if inset.table_um is not inset.wire_um:
            canvas.polyline(_drawn(view, inset.table_um), Paint.GREY, TABLE_WIDTH * unit)
        _draw_wire(canvas, view, inset, unit)
        _draw_size(canvas, box, view, inset, unit)


def view_of(box: Box, inset: Inset) -> View:
    """Scale of an inset in a square box."""
    return centred(inset.center_um, (box.right - box.left) / inset.side_um, box)


def _drawn(view: View, points_um: Floats) -> Floats:
    return simplify(view.to_px(points_um), CHORD_PX)


def grid_um(view: View, unit: float) -> float:
    """From line to line of the grid: 1 µm, or more where lines would come too close."""
    least_um = GRID_APART * unit / view.px_per_um
    return 1.0 if least_um <= 1.0 else nice_below(least_um * 2.5)


def _draw_grid(canvas: Canvas, box: Box, view: View, unit: float) -> None:
    """Draw the lines of the grid, some of them darker."""
    step = grid_um(view, unit)
    low, high = view.range_um(box)
    for axis in (0, 1):
        for tick in ticks(float(low[axis]), float(high[axis]), step).tolist():
            x, y = view.to_px(np.array([tick, tick])).tolist()
            line = [[x, box.top], [x, box.bottom]] if axis == 0 else [[box.left, y], [box.right, y]]
            paint = Paint.FRAME if round(tick / step) % TENTH == 0 else Paint.GRID
            canvas.polyline(np.array(line), paint, style.GRID_WIDTH * unit)


def _draw_steps(canvas: Canvas, view: View, inset: Inset, unit: float) -> None:
    """Draw the staircase, and a dot at each place where a step ends while they stand apart."""
    dots = view.px_per_um >= APART * STEP_DOT * unit
    for run in inset.steps_um:
        canvas.polyline(_drawn(view, run), Paint.STEPS, STEPS_WIDTH * unit)
        for place in view.to_px(run) if dots else ():
            canvas.disc(place, STEP_DOT * unit, Paint.STEPS)


def _draw_wire(canvas: Canvas, view: View, inset: Inset, unit: float) -> None:
    """Draw the wire's way, and a dot at each sample while they stand apart: between them it is drawn straight."""
    places = view.to_px(inset.wire_um)
    canvas.polyline(simplify(places, CHORD_PX), Paint.ACTUAL, WIRE_WIDTH * unit)
    apart = np.hypot(*np.diff(places, axis=0).T)
    if not len(apart) or np.median(apart) >= APART * WIRE_DOT * unit:
        for place in places[(np.abs(inset.wire_um - inset.center_um) <= inset.side_um / 2.0).all(axis=1)]:
            canvas.disc(place, WIRE_DOT * unit, Paint.ACTUAL)


def _draw_size(canvas: Canvas, box: Box, view: View, inset: Inset, unit: float) -> None:
    """Draw the deviation as a dimension from the ideal path to the wire, its value beyond the wire."""
    foot, place = view.to_px(np.stack([inset.foot_um, inset.place_um]))
    length = float(np.hypot(*(place - foot)))
    ahead = (place - foot) / length if length > 0.0 else np.array([0.0, -1.0])
    arrow = SIZE_ARROW * unit
    inside = length > 3.0 * arrow
    tail = 0.0 if inside else 2.0 * arrow
    canvas.polyline(np.stack([foot - tail * ahead, place + tail * ahead]), Paint.ERROR, SIZE_WIDTH * unit)
    for tip, way in ((place, ahead), (foot, -ahead)):
        canvas.arrow(tip, way if inside else -way, arrow, Paint.ERROR)
    text = um(float(np.hypot(*(inset.place_um - inset.foot_um))))
    size = style.NOTE * unit
    half = np.array([text_width(text, size) / 2.0 + 0.3 * size, 0.7 * size])
    reach = tail + 0.6 * size + float(np.abs(ahead) @ half)
    low = np.array([box.left, box.top]) + half
    high = np.array([box.right, box.bottom]) - half
    at = np.clip(place + reach * ahead, low, high)
    canvas.box(box_around(at, *(2.0 * half).tolist()), Paint.PAGE, Paint.ERROR, unit)
    canvas.text((float(at[0]), float(at[1])), text, size, Paint.INK, align=0.5)


def inset_entries(say: Words, *, bows: bool) -> list[Entry]:
    """What the lines of insets are, for a legend; `bows` where the wire is drawn beside the table."""
    looks = [
        (Paint.IDEAL, IDEAL_WIDTH, "deviation.ideal"),
        (Paint.STEPS, STEPS_WIDTH, "deviation.staircase"),
        (Paint.ACTUAL, WIRE_WIDTH, "deviation.wire_samples"),
        *[(Paint.GREY, TABLE_WIDTH, "deviation.table")] * bows,
    ]
    return [Entry(stroke(paint, width), say(key)) for paint, width, key in looks]
