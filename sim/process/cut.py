"""A program cut under sparks, from its steps to what came of it: its times, its figures, what happened."""

import math
from collections.abc import Iterator, Sequence
from itertools import islice
from typing import Final, NamedTuple

import numpy as np

from controller.stepping.counters import Counters
from parser.geometry.curves import Floats
from parser.toolpath import Point
from parser.units import from_mm
from sim.process.events import KINDS, events_of
from sim.process.sparks import CRATERS, Steady
from sim.process.spread import TimeWithin, time_within
from sim.process.ticks import state as ticks
from sim.process.ticks.state import Bounds, Discharge, Job, Records, Servo, Walls
from sim.process.ticks.tick import run_ticks
from sim.process.walls import Mark, Widened, corner_marks, marks_of, usual_feeds_um_s, walls_of, widened
from sim.process.way import CutRows, Work, cut_rows, rest_reversed, slot_of, standing
from sim.setup.spark import Event, Spark

_LAWS: Final = {"voltage": ticks.VOLTAGE, "window": ticks.WINDOW, "duty": ticks.DUTY}
_STOPS: Final = {
    ticks.IN_VAIN: "in-vain",
    ticks.SHORTED: "shorted",
    ticks.STALLED: "stalled",
    ticks.BREAKS_AGAIN: "breaks-again",
    ticks.COLLIDED: "origin",
    ticks.RUNNING: "too-long",
}
_WORDS: Final[dict[int, str]] = {number: kind for kind, number in KINDS.items()} | {ticks.CLEARED: "cleared"}
_STRETCH_UM: Final = 10.0
_MOST_STRETCHES: Final = 1 << 20
_HISTORY_ROWS: Final = 4096
_LOG_ROWS: Final = 500
_COLLISION_UM: Final = 5.0
_MOST_MARKS: Final = 200
_TICKS_AT_ONCE: Final = 1 << 20
_MOST_TICKS: Final = 400 * 3_600_000
"""400 hours: no wire stays in work for longer."""


class Moment(NamedTuple):
    """Something that happened.

    Attributes
    ----------
    kind
        A kind of event, ``cleared`` of a short, or why the control stopped: ``in-vain`` at the end of its way back,
        ``shorted`` for too long, ``stalled`` without progress, ``breaks-again`` in one
        place, ``too-long``, and ``origin``.
    t_s
        When.
    counters
        What the control had in its counters.
    place_um
        Where the wire stood.
    """

    kind: str
    t_s: float
    counters: Counters
    place_um: Point

    @property
    def row(self) -> int:
        """Row of the toolpath."""
        return self.counters.row


class ProcessRun(NamedTuple):
    """What came of a cut under sparks.

    Attributes
    ----------
    spark
        What it was cut with.
    time_s, lost_s
        All of it, jumps left out, and what of it went into shorts, breaks, waits.
    within
        Between which times runs of other seeds lie; None where nothing comes at random.
    sparks
        How many there were.
    mean
        Gap, voltage, rates and feed, as means of the time in which there was something to cut.
    shorts, breaks, retreated_um
        How many of each, and the way gone back in shorts.
    moments, unlisted
        What happened, in order, and how much more than there is room for.
    stopped
        Where the control gave up; None where the path was cut to its end.
    block_s
        (n,) time in each block.
    wider_um
        (n,) by how much the gap at the walls of each block is wider, below 0 narrower, than at the usual feed.
    marks
        Where stops and ways back show.
    displaced_um
        How far the rest of the path lies elsewhere since blocks were skipped; None where none was.
    collided_um
        Way through uncut work on a return to the origin with the wire in; None without one.
    history
        (m, 4): time in s, step of the program, mean voltage and mean current as shares of the highest.
    """

    spark: Spark
    time_s: float
    lost_s: float
    within: TimeWithin | None
    sparks: int
    mean: Steady
    shorts: int
    breaks: int
    retreated_um: float
    moments: tuple[Moment, ...]
    unlisted: int
    stopped: Moment | None
    block_s: Floats
    wider_um: Floats
    marks: tuple[Mark, ...]
    displaced_um: Point | None
    collided_um: float | None
    history: Floats


class Started(NamedTuple):
    """A cut that begins: what is cut and with which sparks, what the loop goes by, its state, and its walls."""

    work: Work
    rows: CutRows
    spark: Spark
    job: Job
    state: Floats
    walls: Walls

    @property
    def usual_s(self) -> float:
        """About how long it takes at the usual gap, s."""
        return _usual_s(self.rows, self.work, self.spark)


def started(work: Work, spark: Spark, events: Sequence[Event] = ()) -> Started:
    """A cut at its start."""
    rows = cut_rows(work)
    job = job_of(work, rows, spark, events)
    walls = walls_of(work, rows, spark, float(job.records.stretch_um[0]))
    return Started(work, rows, spark, job, start_state(spark), walls)


def run_sparks(work: Work, spark: Spark, events: Sequence[Event] = ()) -> ProcessRun:
    """Cut a path under sparks; the same seed gives the same run."""
    cut = started(work, spark, events)
    came_to = ticks.RUNNING if len(cut.rows.row) else ticks.FINISHED
    came_to = _run_on(cut, came_to)
    run, state = _result(cut, came_to), cut.state
    if came_to == ticks.BROKEN:
        back = cut_from_end(cut)
        run, state = _joined(run, _result(back, _run_on(back, ticks.RUNNING))), back.state
    cut_s = float(state[ticks.TICKS] - state[ticks.STOOD_TICKS]) * ticks.TICK_S
    length_um, drawn_for_s = float(cut.rows.way.along_um[-1]), _drawn_for_s(cut.rows, work, spark)
    within = None if run.stopped else time_within(spark, events, (run.time_s, cut_s), length_um, drawn_for_s)
    return run._replace(within=within)


def _run_on(cut: Started, came_to: int) -> int:
    """Let a cut go on to its end, or to where it stops; what its last tick came to."""
    while came_to == ticks.RUNNING and cut.state[ticks.TICKS] < _MOST_TICKS:
        came_to = run_ticks(cut.job, cut.state, _TICKS_AT_ONCE)
    return came_to


def cut_from_end(cut: Started) -> Started:
    """The rest of a cut whose wire broke, from the end of its path back to where it broke.

    The wire is threaded at the start, which has to be the end of the path too. Events by time go on; those at a
    block have come, or lie on the way and come no more.
    """
    at = float(cut.state[ticks.AT])
    rows = rest_reversed(cut.rows, at)
    spark = cut.spark._replace(threading="start")
    job = job_of(cut.work, rows, spark, ())
    by_step = int(cut.job.events.by_step[0])
    timed = cut.job.events._replace(
        **{name: getattr(cut.job.events, name)[by_step:] for name in ("kind", "for_s", "size", "at")},
        by_step=np.zeros(1),
    )
    state = cut.state.copy()
    passed = [
        *(ticks.SEED_1, ticks.SEED_2, ticks.SET_SHARE, ticks.TICKS),
        *(ticks.NEXT_BY_TIME, ticks.NEXT_BY_CUT, ticks.STOOD_TICKS),
    ]
    state[:] = 0.0
    state[passed], state[ticks.HISTORY_STRIDE] = cut.state[passed], 1.0
    threading_ticks = float(np.rint(spark.thread_s / ticks.TICK_S))
    state[[ticks.TICKS, ticks.STOOD_TICKS]] += threading_ticks
    state[ticks.LOST_TICKS], state[ticks.PROGRESS_TICK] = threading_ticks, state[ticks.TICKS]
    walls = walls_of(cut.work, rows, spark, float(job.records.stretch_um[0]))
    return Started(cut.work, rows, spark, job._replace(events=timed), state, walls)


def _joined(first: ProcessRun, second: ProcessRun) -> ProcessRun:
    """A cut and the rest of it, which came from the other end, as one."""
    cut_s = np.array(
        [each.time_s - each.lost_s for each in (first, second._replace(time_s=second.time_s - first.time_s))]
    )
    share = cut_s / cut_s.sum()
    mean = Steady(*(float(share @ pair) for pair in np.column_stack([first.mean, second.mean])))
    is_both = (first.block_s > 0.0) & (second.block_s > 0.0)
    wider_um = np.where(second.block_s > 0.0, second.wider_um, first.wider_um)
    wider_um[is_both] = (first.wider_um[is_both] + second.wider_um[is_both]) / 2.0
    return second._replace(
        spark=first.spark,
        lost_s=first.lost_s + second.lost_s,
        sparks=first.sparks + second.sparks,
        mean=mean,
        shorts=first.shorts + second.shorts,
        breaks=first.breaks + second.breaks,
        retreated_um=first.retreated_um + second.retreated_um,
        moments=(*first.moments, *second.moments),
        unlisted=first.unlisted + second.unlisted,
        block_s=first.block_s + second.block_s,
        wider_um=wider_um,
        marks=(*first.marks, *second.marks),
        history=np.concatenate([first.history, second.history]),
    )


def job_of(work: Work, rows: CutRows, spark: Spark, events: Sequence[Event]) -> Job:
    """All that the loop goes by, and room for what it records."""
    length_um = float(rows.way.along_um[-1])
    stretch_um = max(_STRETCH_UM, length_um / _MOST_STRETCHES)
    law, crater = spark.filled, CRATERS[spark.mode]
    least_um_s = law.least_um_s if spark.law == "duty" else -spark.back_um_s
    return Job(
        way=rows.way,
        discharge=Discharge(spark.on_us, spark.off_us, crater.mean_um3, crater.spread_um3, work.height_um),
        servo=Servo(
            law=float(_LAWS[spark.law]),
            gain_um_s=law.gain_um_s,
            reset_s=law.reset_s,
            least_um_s=least_um_s,
            most_um_s=max(law.most_um_s, least_um_s),
            ring_um=spark.ring_um,
        ),
        bounds=Bounds(
            short_s=spark.short_s,
            area_rate_mm2_min=math.inf if spark.most_mm2_min is None else spark.most_mm2_min,
            thread_s=spark.thread_s,
            restart_s=spark.restart_s,
            jog_um_s=spark.jog_um_s,
            is_from_start=float(spark.threading == "start"),
            is_reversed=float(spark.threading == "reverse"),
            is_manned=0.0,
        ),
        events=events_of(rows, spark, events, _drawn_for_s(rows, work, spark)),
        records=Records(
            lit_s=np.zeros(int(length_um / stretch_um) + 1),
            stretch_um=np.array([stretch_um]),
            block_s=np.zeros(len(rows.row)),
            log=np.zeros(4 * _LOG_ROWS),
            history=np.zeros(4 * _HISTORY_ROWS),
        ),
    )


def start_state(spark: Spark) -> Floats:
    """A cut that begins. Its generator has two seeds within its bounds; neighbouring seeds lead far apart."""
    state = np.zeros(ticks.STATE_SIZE)
    first, second = np.random.SeedSequence(spark.seed).generate_state(2).tolist()
    state[ticks.SEED_1], state[ticks.SEED_2] = first % 2_147_483_562 + 1, second % 2_147_483_398 + 1
    state[ticks.SET_SHARE] = spark.filled.set_value
    state[ticks.HISTORY_STRIDE] = 1.0
    return state


def _drawn_for_s(rows: CutRows, work: Work, spark: Spark) -> float:
    """Time for which random events are drawn: twice as long as the cut takes."""
    return 2.0 * _usual_s(rows, work, spark) + 60.0


def _usual_s(rows: CutRows, work: Work, spark: Spark) -> float:
    """Time that the cut takes at the usual gap, s; where nothing is cut, the control goes as fast as it can."""
    feed_um_s = usual_feeds_um_s(spark, rows.way.width_um, work.height_um)
    feed_um_s[feed_um_s == 0.0] = spark.filled.most_um_s
    return float((np.diff(rows.way.along_um) / feed_um_s).sum())


def _result(cut: Started, came_to: int) -> ProcessRun:
    work, rows, state, records = cut.work, cut.rows, cut.state, cut.job.records
    wider = widened(cut.walls, rows.way, records)
    block_s, wider_um = np.zeros(len(work.toolpath)), np.zeros(len(work.toolpath))
    block_s[rows.row], wider_um[rows.row] = records.block_s, wider.by_row_um
    logged = min(int(state[ticks.LOGGED]), _LOG_ROWS)
    log = [row for row in records.log.reshape(-1, 4)[:logged].tolist() if int(row[2]) != ticks.STOPPED]
    moments = tuple(_moment(work, rows, t_s, at, _WORDS[int(kind)]) for t_s, at, kind, _ in log)
    time_s = float(state[ticks.TICKS]) * ticks.TICK_S
    is_through = came_to in {ticks.FINISHED, ticks.BROKEN}  # of a broken wire the rest comes from the other end
    return ProcessRun(
        spark=cut.spark,
        time_s=time_s,
        lost_s=float(state[ticks.LOST_TICKS]) * ticks.TICK_S,
        within=None,
        sparks=int(state[ticks.ALL_SPARKS]),
        mean=_mean(state, work.height_um),
        shorts=int(state[ticks.SHORTS]),
        breaks=int(state[ticks.BREAKS]),
        retreated_um=float(state[ticks.RETREATED_UM]),
        moments=moments,
        unlisted=int(state[ticks.LOGGED]) - logged,
        stopped=None if is_through else _moment(work, rows, time_s, float(state[ticks.AT]), _STOPS[came_to]),
        block_s=block_s,
        wider_um=wider_um,
        marks=tuple(islice(_marks(cut, log, wider), _MOST_MARKS)),
        displaced_um=displaced_um(work, moments),
        collided_um=collided_um(work, rows, state) if came_to == ticks.COLLIDED else None,
        history=_history(cut),
    )


def _history(cut: Started) -> Floats:
    """What the loop recorded, its steps as the program counts them, from before its first one."""
    rows, found = cut.rows, cut.job.records.history.reshape(-1, 4)[: int(cut.state[ticks.HISTORY_ROWS])].copy()
    if len(found):
        index = np.clip(np.searchsorted(rows.way.before, found[:, 1], side="right") - 1, 0, len(rows.row) - 1)
        row, made = rows.row[index], found[:, 1] - rows.way.before[index]
        steps = cut.work.steps
        found[:, 1] = steps.before[row] + (steps.count[row] - made if rows.is_back else made)
    return found


def _marks(cut: Started, log: Sequence[Sequence[float]], wider: Widened) -> Iterator[Mark]:
    yield from marks_of(cut.work, cut.rows, log, cut.walls, wider)
    yield from corner_marks(cut.work, cut.rows, cut.walls, wider)


def displaced_um(work: Work, moments: Sequence[Moment]) -> Point | None:
    """How far what follows skipped blocks lies elsewhere, µm: a controller counts from where it stands."""
    skipped = [each for each in moments if each.kind == "skip"]
    if not skipped:
        return None
    left_out = [work.steps.corner_um[each.row + 1] - (each.counters.x_um, each.counters.y_um) for each in skipped]
    x, y = -np.sum(left_out, axis=0)
    return Point(float(x), float(y))


def collided_um(work: Work, rows: CutRows, state: Floats) -> float:
    """Length of the straight way back to the start that leads through uncut work, µm."""
    here, start = standing(work, rows, float(state[ticks.AT])).place_um, work.toolpath.start_um[0]
    way = start - here
    count = max(int(np.hypot(*way) / _COLLISION_UM), 1)
    share = (np.arange(count) + 0.5) / count
    slot = slot_of(work, rows, float(state[ticks.FARTHEST]))
    is_free = slot.covers_um(here + share[:, None] * way)
    return float(np.hypot(*way) * (~is_free).mean())


def _mean(state: Floats, height_um: float) -> Steady:
    """Means of the time with something to cut; zeros where there was none."""
    live_s = float(state[ticks.LIVE_TICKS]) * ticks.TICK_S
    if live_s == 0.0:
        return Steady(0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    area_rate = float(state[ticks.AREA_UM2]) * 1e-6 / live_s * 60.0
    open_us = float(state[ticks.ALL_OPEN_US] + ticks.ARC_SHARE * state[ticks.ALL_ON_US])
    return Steady(
        gap_um=float(state[ticks.ALL_GAP_UM] / state[ticks.LIVE_TICKS]),
        rate_hz=float(state[ticks.ALL_SPARKS]) / live_s,
        voltage_share=open_us / (live_s * 1e6),
        volume_mm3_min=float(state[ticks.REMOVED_UM3]) * 1e-9 / live_s * 60.0,
        area_rate_mm2_min=area_rate,
        feed_um_s=from_mm(from_mm(area_rate)) / 60.0 / height_um,
    )


def _moment(work: Work, rows: CutRows, t_s: float, at: float, kind: str) -> Moment:
    return Moment(kind, t_s, *standing(work, rows, at))
