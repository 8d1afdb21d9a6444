"""What happens in a cut: ways back over blocks and arcs, power losses at every step, random lists of events."""

import math

import numpy as np
import pytest
from depth import DEEP, cases
from spark_cuts import ARCS, OPENING, WIRE_UM, straight, work_of

from controller.stepping.counters import counters_after
from sim.process.cut import cut_from_end, job_of, run_sparks, start_state, started
from sim.process.ticks import servo
from sim.process.ticks import state as ticks
from sim.process.ticks.tick import run_ticks
from sim.process.way import cut_rows, standing
from sim.setup.spark import Event, EventKind, Law, Spark

QUICK = Spark(on_us=3.0, off_us=80.0, thread_s=10.0, restart_s=20.0)


def test_nothing_happens_where_nothing_is_asked_for() -> None:
    run = run_sparks(straight(2_000), QUICK)
    assert (run.shorts, run.breaks, run.retreated_um, run.lost_s) == (0, 0, 0.0, 0.0)
    assert run.moments == ()
    assert run.marks == ()
    assert run.stopped is None
    assert run.time_s == pytest.approx(run.block_s.sum(), abs=1e-9)


@pytest.mark.parametrize("text", [OPENING, ARCS], ids=["lines", "arcs"])
@pytest.mark.parametrize("block", [1, 2, 4])
def test_a_chip_is_cleared_by_going_back_as_far_as_it_takes(text: str, block: int) -> None:
    work = work_of(text)
    run = run_sparks(work, QUICK, [Event("short", block, share=0.5, for_s=1e4, clear_um=60.0)])
    short, cleared = run.moments
    assert (short.kind, cleared.kind) == ("short", "cleared")
    assert run.retreated_um == pytest.approx(60.0, abs=2.0)  # a step of path is up to 1.41 µm
    for moment in run.moments:
        assert moment.counters == counters_after(work.steps, work.words, moment.row, moment.counters.made)
    assert run.stopped is None


def test_a_chip_in_the_first_steps_ends_the_way_back_at_the_start() -> None:
    run = run_sparks(straight(2_000), QUICK, [Event("short", 1, share=0.02, for_s=1e4, clear_um=60.0)])
    assert run.stopped is not None
    assert run.stopped.kind == "in-vain"
    assert run.stopped.counters.made == 0


def test_a_way_back_ends_at_the_ring() -> None:
    spark = QUICK._replace(ring_um=200.0, short_s=60.0)
    run = run_sparks(straight(4_000), spark, [Event("short", 1, share=0.5, for_s=1e4, clear_um=500.0)])
    assert run.stopped is not None
    assert run.stopped.kind == "in-vain"
    assert run.stopped.counters.made == 1_800


def test_a_short_that_lasts_too_long_stops_the_control() -> None:
    run = run_sparks(straight(4_000), QUICK, [Event("short", 1, share=0.5, for_s=1e4, clear_um=2e3)])
    assert run.stopped is not None
    assert run.stopped.kind == "shorted"
    assert run.stopped.t_s - run.moments[0].t_s == pytest.approx(QUICK.short_s, abs=0.02)


@pytest.mark.parametrize(("threading", "ways_um"), [("place", 0.0), ("start", 2 * 2_000.0)])
def test_a_broken_wire_costs_its_threading_and_its_ways(threading: str, ways_um: float) -> None:
    spark = QUICK._replace(threading=threading)
    run = run_sparks(straight(4_000), spark, [Event("break", 1, share=0.5)])
    assert run.breaks == 1
    assert run.lost_s == pytest.approx(10.0 + ways_um / spark.jog_um_s, abs=1e-3)
    (mark,) = run.marks
    assert mark.place_um == (2_000.0, 0.0)


@pytest.mark.parametrize(("kind", "after_s"), [("pump-off", 1.0), ("drum-off", 0.5)])
def test_a_switch_in_the_wrong_place_breaks_the_wire(kind: EventKind, after_s: float) -> None:
    run = run_sparks(straight(4_000), QUICK, [Event(kind, 1, share=0.5, for_s=30.0)])
    switched, broken = run.moments
    assert (switched.kind, broken.kind) == (kind, "break")
    assert broken.t_s - switched.t_s == pytest.approx(after_s, abs=0.01)
    assert run.stopped is None


def test_sparks_switched_off_are_read_as_a_short() -> None:
    run = run_sparks(straight(4_000), QUICK, [Event("sparks-off", 1, share=0.5, for_s=1e3)])
    assert run.stopped is not None
    assert run.stopped.kind == "in-vain"


def test_more_than_the_wire_stands_breaks_it_and_chips_make_that_less() -> None:
    spark = QUICK._replace(most_mm2_min=130.0)
    chips = Event("chips", 1, share=0.5, for_s=5.0, factor=0.5)
    assert run_sparks(straight(2_000), spark).breaks == 0
    assert run_sparks(straight(2_000), spark, [chips]).breaks > 0
    stopped = run_sparks(straight(2_000), spark._replace(most_mm2_min=50.0)).stopped
    assert stopped is not None
    assert stopped.kind == "breaks-again"


def test_a_pause_under_sparks_marks_the_wall_and_a_longer_one_more() -> None:
    depths = []
    for seconds in (20.0, 60.0):
        run = run_sparks(straight(4_000), QUICK, [Event("pause", 1, share=0.5, for_s=seconds)])
        (mark,) = run.marks
        assert mark.place_um.x == pytest.approx(2_000.0, abs=1.0)
        assert mark.within_um == pytest.approx(mark.depth_um / 2.0)
        depths.append(mark.depth_um)
    assert 2.0 < depths[0] < depths[1] < 20.0  # what is said of such marks: 5 to 20 µm


def test_a_wait_at_corners_washes_them_out() -> None:
    """The time of five waits, and a mark at each corner, deeper for longer ones."""
    plain = run_sparks(work_of(OPENING), QUICK)
    depths = []
    for wait_s in (4.0, 12.0):
        run = run_sparks(work_of(OPENING, wait_s=wait_s), QUICK)
        # The front recedes by up to 50 µm in a wait, 38 µm more than at the usual gap: so much is made up behind it.
        assert plain.time_s + 5 * (wait_s - 38.0 / 30.0) < run.time_s < plain.time_s + 5 * wait_s
        assert run.lost_s == 0.0
        corners = {(0.0, -1900.0), (2900.0, -1900.0), (2900.0, 1900.0), (-2900.0, 1900.0), (-2900.0, -1900.0)}
        assert {tuple(mark.place_um) for mark in run.marks} == corners
        depths.append(np.mean([mark.depth_um for mark in run.marks]))
    assert 0.5 < depths[0] < depths[1] < 15.0


def test_the_knob_turned_settles_elsewhere() -> None:
    low = run_sparks(straight(8_000), QUICK, [Event("set", 1, share=0.01, set_value=0.2)])
    assert low.mean.voltage_share == pytest.approx(0.2, abs=0.01)


def test_a_slower_cut_leaves_a_wider_gap() -> None:
    fast, slow = (run_sparks(straight(6_000), QUICK._replace(set_value=value)) for value in (0.25, 0.6))
    usual = run_sparks(straight(6_000), QUICK)
    assert fast.wider_um[0] < usual.wider_um[0] < slow.wider_um[0]
    assert usual.wider_um[0] == pytest.approx(0.0, abs=0.05)  # of a gap of 10 µm
    by_time = 10.0 * ((slow.time_s / usual.time_s) ** (1 / 3) - 1.0)
    assert slow.wider_um[0] == pytest.approx(by_time, abs=0.05)


CLOSED = OPENING.removesuffix("DD") + "B0B1900B1900GYL2 DD"


def test_a_reverse_cut_meets_the_break_point_to_the_step() -> None:
    """The rest is cut from the end of the path: its blocks take the same time, its last step is that of the break."""
    work = work_of(CLOSED)
    plain = run_sparks(work, QUICK)
    run = run_sparks(work, QUICK._replace(threading="reverse"), [Event("break", 4, share=0.3)])
    assert run.stopped is None
    assert run.breaks == 1
    assert run.lost_s == pytest.approx(QUICK.thread_s, abs=1e-6)
    assert run.block_s == pytest.approx(plain.block_s, rel=0.03)
    assert run.time_s == pytest.approx(plain.time_s + QUICK.thread_s, rel=0.01)
    broken = started(work, QUICK._replace(threading="reverse"), [Event("break", 4, share=0.3)])
    assert run_ticks(broken.job, broken.state, 10**9) == ticks.BROKEN
    back = cut_from_end(broken)
    assert run_ticks(back.job, back.state, 10**9) == ticks.FINISHED
    met = standing(work, back.rows, float(back.state[ticks.AT]))
    at = standing(work, broken.rows, float(broken.state[ticks.AT]))
    assert met == at
    first = standing(work, back.rows, 0.0)
    assert first.place_um == (0.0, 0.0)


def test_single_block_stops_at_the_end_of_each_block() -> None:
    plain, run = (run_sparks(work_of(OPENING), QUICK, events) for events in ([], [Event("single", 3, for_s=7.0)]))
    assert run.lost_s == 3 * 7.0  # behind blocks 3, 4, 5; the last one ends the program
    assert run.time_s == pytest.approx(plain.time_s + 21.0, abs=1.0)


def test_a_skipped_block_displaces_all_that_follows() -> None:
    run = run_sparks(work_of(OPENING), QUICK, [Event("skip", 4, share=0.25)])
    assert run.displaced_um == (5800.0 * 0.75, 0.0)
    assert run.block_s[3] < run.block_s[4]
    assert run.stopped is None
    assert run_sparks(work_of(OPENING), QUICK, [Event("skip", 6)]).stopped is None


def test_a_return_to_the_origin_with_the_wire_in_runs_into_what_is_uncut() -> None:
    """Straight from (1.45, 1.9) to (0, 0) mm, less the reach of the wire at either end, for it leads away from both."""
    run = run_sparks(work_of(OPENING), QUICK, [Event("origin", 4, share=0.25)])
    assert run.stopped is not None
    assert run.stopped.kind == "origin"
    assert run.collided_um == pytest.approx(math.hypot(1450.0, 1900.0) - 2.0 * (WIRE_UM / 2.0 + 10.0), abs=6.0)


SMALL = "B40B30B40GXL1 B30B0B60GYNR1 B0B25B25GYL4 B25B10B25GXL2 DD"


@pytest.mark.parametrize("remembers", [True, False])
def test_after_a_power_loss_at_any_step_the_same_steps_remain(remembers: bool) -> None:
    """Of each step of a program: the way ends where it would have, and each step of it is one of the program's."""
    work = work_of(SMALL)
    rows = cut_rows(work)
    spark = QUICK._replace(restart_s=0.0)
    total = len(work.steps)
    for step in range(total):
        row = int(np.searchsorted(work.steps.before, step, side="right")) - 1
        share = (step - int(work.steps.before[row])) / int(work.steps.count[row])
        share = np.nextafter(share, 1.0)  # no rounding down to the step before
        run = run_sparks(work, spark, [Event("power", row + 1, share=float(share), remembers=remembers)])
        (lost,) = run.moments
        assert work.steps.before[lost.row] + lost.counters.made == step
        assert run.stopped is None
        assert run.history[-1, 1] <= total
        assert run.block_s[rows.row].min() > 0.0


def test_ways_forth_and_back_stay_on_the_path_and_lose_nothing() -> None:
    """10^5 ways forth and back when deep: after each the wire is where it was, across blocks, arcs, the start."""
    random = np.random.default_rng(3)
    for text in (OPENING, ARCS, SMALL):
        work = work_of(text)
        rows = cut_rows(work)
        job, state = job_of(work, rows, QUICK, ()), start_state(QUICK)
        total, at = int(rows.way.before[-1]), 0
        for drawn in random.integers(-40, 44, 34_000 if DEEP else 8_000).tolist():
            wanted = max(min(drawn, total - 1 - at), -at)
            for _ in range(abs(wanted)):
                (servo.step_forward if wanted > 0 else servo.step_back).function(job, state)
            at += wanted
            row = int(state[ticks.ROW])
            assert state[ticks.AT] == at
            assert rows.way.before[row] <= at < rows.way.before[row + 1]
        assert state[ticks.FARTHEST] >= at


KINDS: list[EventKind] = [
    *(
        "short",
        "chips",
        "break",
        "power",
        "pause",
        "sparks-off",
        "pump-off",
        "drum-off",
        "set",
        "single",
        "skip",
        "origin",
    )
]
LAWS: list[Law] = ["voltage", "window", "duty"]


def random_event(random: np.random.Generator) -> Event:
    kind = KINDS[int(random.integers(len(KINDS)))]
    place = int(random.integers(3))
    return Event(
        kind,
        block=int(random.integers(1, 5)) if place == 0 else None,
        share=float(random.random()),
        at_s=float(random.random() * 20.0) if place == 1 else None,
        per_h=float(10.0 ** random.uniform(-2, 3)) if place == 2 else None,
        for_s=float(10.0 ** random.uniform(-3, 4)),
        clear_um=float(10.0 ** random.uniform(0, 4)),
        factor=float(random.random()),
        remembers=bool(random.integers(2)),
        set_value=float(random.uniform(0.01, 0.99)) if kind == "set" else None,
    )


@pytest.mark.parametrize("part", range(4))
def test_random_lists_of_events_end_and_never_leave_the_path(part: int) -> None:
    """10^5 lists in all when deep: each ends, every moment is on the path, and all that is recorded is bounded."""
    work = work_of(SMALL, height_um=2e3)
    total = len(work.steps)
    for number in cases(100, 25_000):
        random = np.random.default_rng([part, number])
        spark = Spark(
            law=LAWS[int(random.integers(3))],
            set_value=float(random.uniform(0.01, 0.99)),
            most_mm2_min=None if random.integers(2) else float(random.uniform(1.0, 200.0)),
            ring_um=float(10.0 ** random.uniform(1, 4)),
            seed=number,
        )
        events = [random_event(random) for _ in range(int(random.integers(0, 8)))]
        run = run_sparks(work, spark, events)
        assert math.isfinite(run.time_s)
        assert run.time_s >= run.lost_s - 1e-6 or run.lost_s < 1e5
        assert len(run.moments) <= 500
        assert len(run.history) <= 4096
        assert len(run.marks) <= 200
        assert (run.history[:, 1] >= 0).all()
        assert (run.history[:, 1] <= total).all()
        for moment in run.moments:
            counters = moment.counters
            assert 0 <= counters.made <= work.steps.count[moment.row]
            assert moment.place_um == (counters.x_um, counters.y_um)
