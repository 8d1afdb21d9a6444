"""The circular test itself: the circle as a 3B program, run in both directions on card and table.

A circular test as data, schema ``drycut.ballbar/1`` (docs/ballbar.md).
"""

import json
from dataclasses import dataclass
from typing import Final, NamedTuple

import numpy as np

from controller.motion.limits import Feeds
from controller.stepping.pulses import Pulses
from parser import __version__
from parser.findings.errors import SettingsError
from parser.geometry.curves import Floats
from parser.program import parse_program
from parser.units import from_mm, mm
from sim.base.progress import Progress
from sim.base.units import known, place, rounded
from sim.run.ballbar.figures import (
    NAMES,
    SENSES,
    DeviationParts,
    Direction,
    Figures,
    MeasuredTurn,
    Reversal,
    Sense,
    circularity,
    figures_of,
    parts_of,
)
from sim.run.ballbar.model import BallbarDocument, FiguresEntry, LossEntry, PartsEntry, ReversalEntry, SenseEntry
from sim.setup.machine.machine import Machine
from sim.setup.toml.reader import Bound, number
from sim.table.losses import Loss
from sim.table.motion import Motion, TableRun, driven, motion_of
from sim.table.ticks import Sampling
from sim.table.turning import motors_um

FEED_MM_MIN: Final = Bound(0.1, 100_000.0)
LEAST_RADIUS_MM: Final = 0.1
_SPACING_UM: Final = 5.0  # of samples along the circle
Both = tuple[MeasuredTurn, MeasuredTurn]
"""Turns counter-clockwise and clockwise."""

_WORDS: Final[dict[Sense, str]] = {1: "NR1", -1: "SR4"}


class CircleTest(NamedTuple):
    """What is run: a circle of a whole number of µm about the middle of the travel, at a feed along the path."""

    machine: Machine
    radius_um: int
    feed_um_s: float


class Measured(NamedTuple):
    """What two turns that go round tell.

    Attributes
    ----------
    figures, parts
        Of both directions.
    interpolation_um
        Circular deviation G of the steps as they were commanded, the larger of both directions.
    """

    figures: Figures
    parts: DeviationParts
    interpolation_um: float


@dataclass(frozen=True, slots=True, eq=False)
class Ballbar:
    """A circular test and what came of it.

    Attributes
    ----------
    test
        What was run.
    run_um_s
        Feed as planned: less than asked for where the acceleration of the machine does not bend the path so fast.
    turns
        Measured turns, counter-clockwise and clockwise.
    losses
        What the drives lost in either direction, run-in and run-out included.
    measured
        None where a turn does not go round.
    """

    test: CircleTest
    run_um_s: float
    turns: tuple[MeasuredTurn, MeasuredTurn]
    losses: tuple[tuple[Sense, Loss], ...]
    measured: Measured | None

    def passes(self, tolerance_um: float | None) -> bool:
        """Whether nothing was lost, the turns go round, and the circularity keeps to the tolerance, if there is one."""
        if self.losses or self.measured is None:
            return False
        return tolerance_um is None or self.measured.figures.circularity_um <= tolerance_um


def circle_test(machine: Machine, radius_um: float, feed_um_s: float | None) -> CircleTest:
    """Test of a radius, at the feed of the machine's jumps where none is given.

    Raises SettingsError where the radius is no whole number of µm or does not fit the travel, or the feed is absurd.
    """
    table = machine.table
    most_mm = min(table.travel_x_mm, table.travel_y_mm) / 2.0
    number(mm(radius_um), Bound(LEAST_RADIUS_MM, most_mm), f"--radius in mm (travel of {machine.name})")
    if radius_um != int(radius_um):
        raise SettingsError("radius-not-whole", radius_um=radius_um)
    if feed_um_s is None:
        feed_um_s = from_mm(machine.controller.jump_feed_mm_s)
    number(mm(feed_um_s) * 60.0, FEED_MM_MIN, "--feed in mm/min")
    return CircleTest(machine, int(radius_um), feed_um_s)


def run_test(test: CircleTest, progress: Progress) -> Ballbar:
    """Run the circle in both directions and measure it."""
    ccw, cw = (_run(test, sense, progress) for sense in SENSES)
    return Ballbar(
        test=test,
        run_um_s=ccw.feed_um_s,
        turns=(ccw.table, cw.table),
        losses=tuple((sense, loss) for sense, run in zip(SENSES, (ccw, cw), strict=True) for loss in run.losses),
        measured=measure((ccw.table, cw.table), (ccw.motors, cw.motors), (ccw.steps, cw.steps), test.radius_um),
    )


def measure(turns: Both, motors: Both, steps: Both, radius_um: float) -> Measured | None:
    """What two turns tell that were driven by these turns of the motors, and those by these steps, on a radius."""
    if not all(turn.goes_round for turn in turns):
        return None
    return Measured(figures_of(*turns, radius_um), parts_of(turns, motors), max(map(circularity, steps)))


class _Run(NamedTuple):
    """One direction: the measured turn of the table, of its motors, and the steps of it; planned feed, and losses."""

    table: MeasuredTurn
    motors: MeasuredTurn
    steps: MeasuredTurn
    feed_um_s: float
    losses: tuple[Loss, ...]


def _run(test: CircleTest, sense: Sense, progress: Progress) -> _Run:
    """Run two turns and keep the middle one, so that both its ends are run through."""
    motion = _motion(test, sense)
    plan = motion.drive.plan
    start_s, middle_s, end_s = plan.time_at(np.array([1.0, 2.0, 3.0]) * np.pi * test.radius_um).tolist()
    step_time_s = motion.table.model.motor.step_time_s
    window = _Window(start_s - step_time_s, end_s, motion.drive.origin_um)  # steps that begin before are still made

    def progress_of_sense(stage: str, done: int, total: int) -> None:
        progress(f"{stage}-{NAMES[sense]}", done, total)

    table = TableRun(motion, progress_of_sense)
    for pulses in table.followed(driven(motion)):
        window.take(pulses)
    trace, _, losses, *_ = table.moved
    measured = (trace.t_s >= start_s) & (trace.t_s <= end_s)
    center_um = trace.commanded_um[0] - (test.radius_um, 0.0)
    turned = window.pulses()
    if motion.table.model.motor.loop is None:
        motors = motors_um(turned, window.before_um, step_time_s, trace.t_s[measured])
    else:
        motors = trace.commanded_um[measured]  # what the loop does counts to the drive
    return _Run(
        table=MeasuredTurn(sense, trace.table_um[measured] - center_um),
        motors=MeasuredTurn(sense, motors - center_um),
        steps=MeasuredTurn(sense, _stepped_um(turned, start_s) - center_um),
        feed_um_s=float(plan.at(middle_s).speed_um_s),
        losses=losses,
    )


class _Window:
    """Pulses from `since_s` to `until_s`, gathered as they stream in; `before_um` (2,) is the place before them."""

    def __init__(self, since_s: float, until_s: float, origin_um: tuple[int, int]) -> None:
        self._since_s = since_s
        self._until_s = until_s
        self._parts: list[Pulses] = []
        self.before_um = np.array(origin_um, dtype=np.float64)

    def take(self, pulses: Pulses) -> None:
        """Keep those pulses that fall into the time."""
        first = int(np.searchsorted(pulses.t_s, self._since_s))
        past = int(np.searchsorted(pulses.t_s, self._until_s, side="right"))
        if first:
            self.before_um[:] = pulses.x_um[first - 1], pulses.y_um[first - 1]
        self._parts.append(pulses.part(first, past))

    def pulses(self) -> Pulses:
        """All of them, one after the other."""
        return Pulses(*(np.concatenate(columns) for columns in zip(*self._parts, strict=True)))


def _stepped_um(pulses: Pulses, since_s: float) -> Floats:
    """Places (n, 2) from a time on after which some time passes: of two axes that step at once, after both steps."""
    is_kept = (pulses.t_s >= since_s) & (np.diff(pulses.t_s, append=np.inf) > 0.0)
    return np.stack([pulses.x_um[is_kept], pulses.y_um[is_kept]], axis=1).astype(np.float64)


def _motion(test: CircleTest, sense: Sense) -> Motion:
    """Two turns from +X about the middle of the travel; 3B counts 4R in a turn."""
    radius, table = test.radius_um, test.machine.table
    toolpath = parse_program(f"B{radius}B0B{8 * radius}GY{_WORDS[sense]}DD").toolpath
    start_um = from_mm(table.travel_x_mm / 2.0) + radius, from_mm(table.travel_y_mm / 2.0)
    return motion_of(toolpath, Feeds(test.feed_um_s, test.feed_um_s), test.machine, start_um, Sampling(_SPACING_UM))


_DEG_DIGITS: Final = 3


def document(ballbar: Ballbar, tolerance_um: float | None) -> BallbarDocument:
    """The test as plain lists, dicts, numbers and None; the order of keys is fixed."""
    test, measured = ballbar.test, ballbar.measured
    return {
        "schema": "drycut.ballbar/1",
        "drycut": __version__,
        "verdict": "pass" if ballbar.passes(tolerance_um) else "fail",
        "machine": test.machine.name,
        "interpolator": test.machine.controller.interpolation,
        "radius_um": test.radius_um,
        "feed_um_s": rounded(test.feed_um_s),
        "planned_feed_um_s": rounded(ballbar.run_um_s),
        "tolerance_um": known(tolerance_um),
        "circularity_um": None if measured is None else rounded(measured.figures.circularity_um),
        "figures": None if measured is None else _figures(measured.figures),
        "parts": None if measured is None else _parts(measured.parts, measured.interpolation_um),
        "losses": [_loss(sense, loss) for sense, loss in ballbar.losses],
    }


def document_text(ballbar: Ballbar, tolerance_um: float | None) -> str:
    """The document as JSON; the same test gives the same bytes."""
    return json.dumps(document(ballbar, tolerance_um), ensure_ascii=False, allow_nan=False, indent=2) + "\n"


def trace_text(ballbar: Ballbar) -> str:
    """Both turns as CSV: ``turn`` (ccw, cw), and the table's place in µm from the nominal centre, in order of time.

    G(b) is the width of the ring about `figures.center_um` that holds the places of both turns (docs/ballbar.md).
    """
    rows = (f"{NAMES[turn.sense]},{x:.4f},{y:.4f}\n" for turn in ballbar.turns for x, y in turn.points_um.tolist())
    return "turn,x_um,y_um\n" + "".join(rows)


def _figures(figures: Figures) -> FiguresEntry:
    return {
        "mean_radial_um": rounded(figures.mean_radial_um),
        "hysteresis_um": rounded(figures.hysteresis_um),
        "center_um": place(figures.center_um),
        "ccw": _direction(figures.ccw),
        "cw": _direction(figures.cw),
    }


def _direction(direction: Direction) -> SenseEntry:
    return {
        "circularity_um": rounded(direction.circularity_um),
        "radial_max_um": rounded(direction.radial_max_um),
        "radial_min_um": rounded(direction.radial_min_um),
        "mean_radius_um": rounded(direction.mean_radius_um),
    }


def _parts(parts: DeviationParts, interpolation_um: float) -> PartsEntry:
    return {
        "radius_ccw_um": rounded(parts.radius_um[0]),
        "radius_cw_um": rounded(parts.radius_um[1]),
        "step_x_um": rounded(parts.step_um[0]),
        "step_y_um": rounded(parts.step_um[1]),
        "diameters_um": rounded(parts.diameters_um),
        "lag_um": rounded(parts.lag_um),
        "interpolation_um": rounded(interpolation_um),
        "rest_um": rounded(parts.rest_um),
        "reversals": [_reversal(reversal) for reversal in parts.reversals],
    }


def _reversal(reversal: Reversal) -> ReversalEntry:
    return {
        "direction": NAMES[reversal.sense],
        "axis": reversal.axis.name,
        "side": reversal.side,
        "step_um": rounded(reversal.step_um),
        "spike_um": rounded(reversal.spike_um),
        "spike_deg": None if reversal.spike_deg is None else round(reversal.spike_deg, _DEG_DIGITS),
    }


def _loss(sense: Sense, loss: Loss) -> LossEntry:
    return {
        "direction": NAMES[sense],
        "kind": loss.kind,
        "axis": loss.axis.name,
        "t_s": rounded(loss.t_s),
        "amount_um": rounded(loss.amount_um),
        "x_um": rounded(loss.x_um),
        "y_um": rounded(loss.y_um),
    }
