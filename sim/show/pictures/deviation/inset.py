"""What an inset shows: a stretch of the ideal path, of the single steps and of the wire, around one place."""

from typing import Final, NamedTuple

import numpy as np

from controller.stepping.pulses import Pulses
from parser.geometry.along import places_at
from parser.geometry.curves import Bools, Floats
from sim.show.draw.chart import stretches
from sim.show.pictures.deviation.samples import Samples
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
