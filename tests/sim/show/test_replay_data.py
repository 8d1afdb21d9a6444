"""The replay's data: every step with its time, and what the page's own scripts make of it, against plain loops."""

import base64
import json
import math
import random
import zlib
from collections.abc import Iterator
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
import shapely
from browser import Browsers, Pages
from hypothesis import given
from hypothesis import strategies as st
from page_types import types_of, unlike
from plain import AWAY_X, AWAY_Y, SIGNS, TOWARD_X, TOWARD_Y, PlainBlock, motion_quadrant
from replayed import ASSETS, document_of, empty_page, exports, recording_of, replay_of
from runs import scenario_recording
from strategies import program_text

from controller.offset.shifted import Side
from controller.stepping.chunks import chunk_of
from controller.stepping.pulses import Pulses
from controller.stepping.steps import interpolate
from parser.geometry.curves import Floats
from parser.program import parse_program
from parser.toolpath import Point
from sim.measure.deviation import across, across_um
from sim.run.recording import Recording
from sim.run.report import build_report
from sim.setup.machine.machine import Machine, load_machine
from sim.setup.obstacles import Clamp
from sim.setup.part import Offset, OffsetPass
from sim.setup.quiz import Question
from sim.setup.technology import Cut, Technology
from sim.setup.wire import Wire
from sim.show.html.packed import Packer, varints
from sim.show.replay import tape as tape_module
from sim.show.replay.document import replay_document
from sim.show.replay.tape import GRAIN_UM, TICK_S, tape
from sim.table.trace import Trace

if TYPE_CHECKING:
    from playwright.sync_api import Page

TRIANGLE = "B0B300B300GYL2 B300B200B300GXL4 B300B100B300GXL3 DD"
SERVO, DK = load_machine("servo-400x500"), load_machine("dk7740")


@pytest.fixture(scope="module")
def empty(browsers: Browsers, tmp_path_factory: pytest.TempPathFactory) -> Iterator["Page"]:
    """One page for one document after another, of which nothing stays."""
    pages = Pages(browsers.of, tmp_path_factory.mktemp("replay"))
    yield pages.open(empty_page()).page
    pages.close()


def unpacked(text: str) -> bytes:
    return zlib.decompress(base64.b64decode(text))


def plain_numbers(data: bytes) -> list[int]:
    """Numbers of a packed column, byte by byte."""
    found, value, shift = [], 0, 0
    for byte in data:
        value |= (byte & 127) << shift
        shift += 7
        if byte < 128:
            found.append(value // 2 if value % 2 == 0 else -(value + 1) // 2)
            value, shift = 0, 0
    return found


def plain_steps_of(made: dict[str, Any]) -> list[tuple[int, int, int]]:
    """Ticks and places of the steps of a tape, one by one."""
    (x, y), ticks, took = made["origin_um"], 0, [0] * 9
    steps = []
    for way, more in zip(unpacked(made["moves"]), plain_numbers(unpacked(made["step_ticks"])), strict=True):
        x, y = x + way // 3 - 1, y + way % 3 - 1
        took[way] += more
        ticks += took[way]
        steps.append((ticks, x, y))
    return steps


@given(st.lists(st.one_of(st.integers(-200, 200), st.integers(-(2**61), 2**61))))
def test_numbers_come_back_from_their_bytes(values: list[int]) -> None:
    assert plain_numbers(varints(np.array(values, dtype=np.int64)).tobytes()) == values


def test_packed_bytes_are_a_raw_deflate_stream() -> None:
    packer = Packer()
    packer.bytes(np.arange(5, dtype=np.uint8))
    packer.numbers(np.array([-1, 64]))
    assert unpacked(packer.text()) == bytes([0, 1, 2, 3, 4, 1, 128, 1])


MOVES = st.tuples(st.integers(-1, 1), st.integers(-1, 1), st.floats(0.0, 1.0) | st.floats(0.0, 4e3))


def pulses_of(moves: list[tuple[int, int, float]], origin: tuple[int, int]) -> Pulses:
    by = np.array(moves, dtype=np.float64).reshape(-1, 3)
    place = np.cumsum(by[:, :2], axis=0).astype(np.int32) + np.array(origin, dtype=np.int32)
    return Pulses(np.cumsum(by[:, 2]), place[:, 0], place[:, 1], np.zeros(len(by), dtype=np.int32))


def still(t_s: Floats) -> Trace:
    place = np.zeros((len(t_s), 2))
    return Trace(t_s, place, place, place, np.zeros(len(t_s), dtype=np.int64))


def taped(steps: Pulses, origin: tuple[int, int], trace: Trace) -> dict[str, Any]:
    """The tape of steps and samples; each is measured from the row that is running."""
    return tape(steps, origin, trace, trace.row)


@given(st.lists(MOVES, max_size=60), st.integers(1, 7))
def test_any_steps_come_back_whole_and_to_half_a_tick(moves: list[tuple[int, int, float]], at_once: int) -> None:
    steps = pulses_of(moves, (-7, 12))
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(tape_module, "_AT_ONCE", at_once)
        made = plain_steps_of(taped(steps, (-7, 12), still(np.zeros(1))))
    assert [step[1:] for step in made] == list(zip(steps.x_um.tolist(), steps.y_um.tolist(), strict=True))
    assert all(abs(step[0] * TICK_S - t) <= 0.5001 * TICK_S for step, t in zip(made, steps.t_s, strict=True))


@given(
    st.lists(MOVES, min_size=1, max_size=40), st.lists(st.floats(0.0, 5.0), min_size=1, max_size=20), st.integers(1, 7)
)
def test_places_of_samples_come_back_to_half_a_grain(
    moves: list[tuple[int, int, float]], times: list[float], at_once: int
) -> None:
    steps, t_s = pulses_of(moves, (3, 4)), np.sort(np.array(times))
    chance = np.random.default_rng(1)
    table, wire = chance.normal(0.0, 300.0, (2, len(t_s), 2))
    trace = Trace(t_s, table, table, wire, np.zeros(len(t_s), dtype=np.int64))
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(tape_module, "_AT_ONCE", at_once)
        made = taped(steps, (3, 4), trace)
    ticks = np.cumsum(np.cumsum(plain_numbers(unpacked(made["sample_ticks"]))))
    assert np.abs(ticks * TICK_S - t_s).max() <= 0.5001 * TICK_S
    plain = plain_steps_of(made)
    commanded = np.array([next((s[1:] for s in reversed(plain) if s[0] <= tick), (3, 4)) for tick in ticks.tolist()])
    lag = np.stack([np.cumsum(plain_numbers(unpacked(made[f"table_{axis}"]))) for axis in "xy"], axis=1)
    bow = np.stack([np.cumsum(plain_numbers(unpacked(made[f"wire_{axis}"]))) for axis in "xy"], axis=1)
    placed = commanded + lag * GRAIN_UM
    assert np.abs(placed - table).max() <= 0.5001 * GRAIN_UM
    assert np.abs(placed + bow * GRAIN_UM - wire).max() <= 0.5001 * GRAIN_UM


def test_a_step_of_two_pulses_on_an_axis_is_refused() -> None:
    steps = Pulses(np.zeros(2), np.array([0, 2], np.int32), np.zeros(2, np.int32), np.zeros(2, np.int32))
    with pytest.raises(ValueError, match="not by 2"):
        taped(steps, (0, 0), still(np.zeros(1)))


def assert_replayed(page: Any, recording: Recording) -> None:
    """The page has every step of the recording and its time, and the samples."""
    run, steps = recording.run, recording.steps
    made = page.evaluate("""() => Object.fromEntries(["x", "y", "t"].map((name) =>
        [name, Array.from({length: replay.steps + 1}, (_, step) => replay.way[name](step))]))""")
    assert made["x"][1:] == steps.x_um.tolist()
    assert made["y"][1:] == steps.y_um.tolist()
    assert made["t"][0] == 0.0
    assert np.abs(np.array(made["t"][1:]) - steps.t_s).max() <= 0.51 * TICK_S
    samples = page.evaluate("""() => Object.fromEntries(
        Object.entries(replay.samples).map(([name, column]) => [name, Array.from(column)]))""")
    assert np.abs(np.array(samples["t"]) - run.trace.t_s).max() <= 0.51 * TICK_S
    for name, place_um in (("table", run.trace.table_um), ("wire", run.trace.wire_um)):
        column = np.stack([samples[f"{name}X"], samples[f"{name}Y"]], axis=1)
        assert np.abs(column - place_um).max() <= 1.01 * GRAIN_UM, name
    commanded = np.array(
        page.evaluate("""() => Array.from(replay.samples.t, (t) => replay.way.doneBy(t))
        .map((step) => [replay.way.x(step), replay.way.y(step)])""")
    )
    # A sample may fall in the tick of a step: then the step counts as done.
    apart = np.abs(commanded - run.trace.commanded_um).max(axis=1)
    near = np.abs(run.trace.t_s[:, None] - steps.t_s[None, :]).min(axis=1) < 1.01 * TICK_S
    assert apart[~near].max() == 0.0
    assert apart.max() <= 1.0


@pytest.mark.alike(1)
@pytest.mark.parametrize(
    "changes",
    [
        pytest.param({}, id="point by point"),
        pytest.param({"machine": SERVO}, id="card"),
        pytest.param({"wire": Wire(180.0, 10.0, 20.0)}, id="wire that lags"),
    ],
)
def test_a_run_is_replayed_as_it_ran(empty: "Page", changes: dict[str, object]) -> None:
    recording = recording_of(TRIANGLE, **changes)
    assert_replayed(replay_of(empty, replay_document(recording)), recording)


def test_a_program_without_a_step_has_a_replay(empty: "Page") -> None:
    page = replay_of(empty, document_of("B0 B5000 B0 GY L2 DD"))
    state = page.evaluate("model.stateAt(1)")
    assert (state["step"], state["block"], state["x"], state["y"], state["count_left"]) == (0, 0, 0, 0, 0)
    assert page.evaluate("[model.timeOf(5), model.deviation(0).um]") == [0, 0]


def test_the_same_run_gives_the_same_document() -> None:
    one, other = (json.dumps(document_of(TRIANGLE), allow_nan=False) for _ in range(2))
    assert one == other


def plain_decisions(block: PlainBlock) -> list[tuple[int, str, int, str]]:
    """F before each step, its axis and sign, and the quadrant of motion: four beats, F kept up by additions alone."""
    sx, sy = SIGNS[block.quadrant]
    left, f, made = block.count, 0, []
    x, y = sx * block.x, sy * block.y
    while left > 0:
        if block.sense == "L":
            first_is_x, motion = block.quadrant % 2 == 1, f"L{block.quadrant}"
            axis, sign = ("X", sx) if (f >= 0) == first_is_x else ("Y", sy)
            more = (block.x if axis == "Y" else block.y) * (-1 if f >= 0 else 1)
        else:
            motion = f"{block.sense}{motion_quadrant(x, y, block.sense)}"
            if f >= 0:
                axis, sign = ("X", TOWARD_X[motion]) if motion in TOWARD_X else ("Y", TOWARD_Y[motion])
            else:
                axis, sign = ("Y", AWAY_Y[motion]) if motion in AWAY_Y else ("X", AWAY_X[motion])
            more = 2 * sign * (x if axis == "X" else y) + 1
        made.append((f, axis, sign, motion))
        f += more
        x, y = (x + sign, y) if axis == "X" else (x, y + sign)
        left -= axis == block.axis
    return made


def all_ways() -> list[PlainBlock]:
    """Lines in all quadrants, on axes, with a neighbour's label, at 45°; arcs of both senses through quadrants."""
    of_lines = [(30, 11, "X"), (11, 30, "Y"), (30, 30, "X"), (30, 30, "Y"), (30, 0, "X"), (0, 30, "Y"), (3, 1, "Y")]
    of_arcs = [(20, 15, 10, "X"), (20, 15, 85, "Y"), (25, 0, 100, "X"), (0, 25, 60, "Y"), (1, 35, 150, "X")]
    quadrants = range(1, 5)
    lines = [PlainBlock(x, y, 30, axis, "L", quadrant) for quadrant in quadrants for x, y, axis in of_lines]
    arcs = [
        PlainBlock(x, y, count, axis, sense, quadrant)
        for sense in ("NR", "SR")
        for quadrant in quadrants
        for x, y, count, axis in of_arcs
    ]
    program = [*lines, *arcs]
    random.Random(7).shuffle(program)
    return program


DECISIONS = """() => Array.from({length: replay.steps}, (_, at) => model.decision(at + 1)).map((d) =>
    [Number(d.f), d.axis, d.sign, d.motion, d.rule, Number(d.fAfter), d.counted, d.row])"""


@pytest.mark.deeper
def test_every_decision_is_the_step_that_the_tape_makes(empty: "Page") -> None:
    program = all_ways()
    recording = recording_of(program_text(program))
    page = replay_of(empty, replay_document(recording))
    decided = page.evaluate(DECISIONS)
    expected = [(*step, at) for at, block in enumerate(program) for step in plain_decisions(block)]
    assert [(f, axis, sign, motion, row) for f, axis, sign, motion, _, _, _, row in decided] == expected
    x, y = (np.diff(column, prepend=np.int32(0)) for column in (recording.steps.x_um, recording.steps.y_um))
    assert [sign if axis == "X" else 0 for _, axis, sign, *_ in decided] == x.tolist()
    assert [sign if axis == "Y" else 0 for _, axis, sign, *_ in decided] == y.tolist()
    assert all(rule == (">=0" if f >= 0 else "<0") for f, _, _, _, rule, _, _, _ in decided)
    assert all(now[5] == then[0] for now, then in pairwise(decided) if now[7] == then[7])
    assert all(counted == (axis == program[row].axis) for _, axis, _, _, _, _, counted, row in decided)


def stepped_page(empty: "Page", program: list[PlainBlock]) -> Any:
    """A page with all steps of a program, one a second, and of its blocks what decisions need."""
    steps = interpolate(parse_program(program_text(program)).toolpath)
    chunk = chunk_of(steps, 0, len(steps))
    pulses = Pulses(np.arange(len(steps), dtype=np.float64), chunk.x_um, chunk.y_um, chunk.row)
    blocks = {
        "first_step": steps.before.tolist(),
        "word_x_um": [block.x for block in program],
        "word_y_um": [block.y for block in program],
        "quadrant": [block.quadrant for block in program],
        "turn": [{"L": 0, "NR": 1, "SR": -1}[block.sense] for block in program],
        "count_axis": [block.axis for block in program],
        "kind": ["arc"] * len(program),
        "length_um": [1.0] * len(program),
    }
    stepping = {"interpolator": "point-by-point", "blocks": blocks, "tape": taped(pulses, (0, 0), still(np.zeros(1)))}
    return replay_of(empty, stepping)


def test_decisions_on_figures_beyond_doubles_are_exact(empty: "Page") -> None:
    """R² and X·Y past 2⁵³, where a double no longer knows F = 1 from F = 0."""
    program = [
        PlainBlock(799_999_999, 1, 40, "Y", "NR", 1),
        PlainBlock(400_000_001, 399_999_999, 300, "X", "L", 3),
        PlainBlock(500_000_003, 600_000_001, 200, "X", "SR", 2),
    ]
    page = stepped_page(empty, program)
    decided = page.evaluate("""() => Array.from({length: replay.steps}, (_, at) => model.decision(at + 1)).map((d) =>
        [String(d.f), d.axis, d.sign, d.motion])""")
    expected = [(str(f), *rest) for block in program for f, *rest in plain_decisions(block)]
    assert [tuple(step) for step in decided] == expected
    assert max(abs(int(f)) for f, *_ in expected) > 10**8


KEYHOLE = [
    PlainBlock(0, 24900, 24900, "Y", "L", 2),
    PlainBlock(0, 24900, 49800, "X", "NR", 2),
    PlainBlock(56757, 0, 56757, "X", "L", 1),
    PlainBlock(43243, 24900, 149800, "Y", "NR", 3),
    PlainBlock(56756, 2, 56756, "X", "L", 2),
    PlainBlock(0, 24900, 24900, "Y", "L", 4),
]


def test_every_decision_of_the_keyhole_is_its_step(empty: "Page") -> None:
    page = stepped_page(empty, KEYHOLE)
    astray, checked = page.evaluate("""() => {
        const checked = [];
        let astray = 0;
        for (let step = 1; step <= replay.steps; step++) {
            const {f, axis, sign} = model.decision(step);
            const {x, y} = replay.way;
            const [dx, dy] = [x(step) - x(step - 1), y(step) - y(step - 1)];
            if (dx !== (axis === "X" ? sign : 0) || dy !== (axis === "Y" ? sign : 0)) astray++;
            if (step % 101 === 0) checked.push([Number(f), axis, sign]);
        }
        return [astray, checked];
    }""")
    expected = [list(step[:3]) for block in KEYHOLE for step in plain_decisions(block)]
    assert (astray, len(expected)) == (0, 599_001)
    assert checked == expected[100::101]


@pytest.mark.deeper
def test_steps_are_the_same_in_whatever_order_one_asks_for_them(empty: "Page") -> None:
    page = stepped_page(empty, KEYHOLE)
    astray = page.evaluate("""() => {
        const { steps, way } = replay;
        const all = (name) => Float64Array.from({length: steps + 1}, (_, step) => way[name](step));
        const [x, y, t] = ["x", "y", "t"].map(all);
        let astray = 0;
        for (let at = 0, step = 0; at < 20_000; at++, step = (step + 224_737) % (steps + 1)) {
            if (way.x(step) !== x[step] || way.y(step) !== y[step] || way.t(step) !== t[step]) astray++;
            const done = way.doneBy(t[step]);
            if (t[done] > t[step] || (done < steps && t[done + 1] <= t[step])) astray++;
        }
        return astray;
    }""")
    assert astray == 0


@pytest.mark.parametrize("off", [-1, 0, 1])
@pytest.mark.parametrize("quadrant", [1, 2])
def test_a_decision_far_along_a_long_line_is_exact(empty: "Page", quadrant: int, off: int) -> None:
    """Products past 2⁵³, beside the line by a step across."""
    word_x, word_y, times = 600_000_007, 500_000_003, 3
    done_x, done_y = word_x * times // 4, word_y * times // 4 + off
    f = (word_x * done_y - word_y * done_x) * (1 if quadrant == 1 else -1)
    page = replay_of(empty, document_of(TRIANGLE))
    blocks = {"first_step": [0, 2], "word_x_um": [word_x], "word_y_um": [word_y], "quadrant": [quadrant], "turn": [0]}
    made = page.evaluate(
        f"([blocks, x, y]) => {{ const {{ decisionAt }} = {exports('decisions')};"
        """
            const doc = {interpolator: "point-by-point", blocks: {...blocks, count_axis: ["X"]}};
            const made = decisionAt({doc, steps: 2, way: {x: (step) => [0, x][step], y: (step) => [0, y][step]}}, 2, 0);
            return [String(made.f), made.axis];
        }""",
        [blocks, done_x if quadrant == 1 else -done_x, done_y],
    )
    assert made == [str(f), "X" if (f >= 0) == (quadrant == 1) else "Y"]
    assert off or abs(word_x * done_y) > 2**53


def test_the_card_decides_nothing(empty: "Page") -> None:
    page = replay_of(empty, document_of(TRIANGLE, machine=SERVO))
    assert page.evaluate("[model.decision(1), model.stateAt(0).count_left]") == [None, None]


@pytest.mark.deeper
def test_j_counts_down_on_its_axis_alone(empty: "Page") -> None:
    program = all_ways()[:20]
    page = replay_of(empty, document_of(program_text(program)))
    left = page.evaluate("""() => Array.from({length: replay.steps}, (_, at) => {
        const row = model.blockOfStep(at + 1); return [row, model.countLeft(row, at + 1)]; })""")
    expected = []
    for row, block in enumerate(program):
        count = block.count
        for _, axis, _, _ in plain_decisions(block):
            count -= axis == block.axis
            expected.append([row, count])
        assert count == 0
    assert left == expected


@pytest.mark.parametrize("jerk_um_s3", [math.inf, 30.0])
def test_a_state_is_that_of_its_time(empty: "Page", jerk_um_s3: float) -> None:
    limits = DK.controller.limits._replace(acceleration_um_s2=30.0, jerk_um_s3=jerk_um_s3)
    slow = DK._replace(controller=DK.controller._replace(limits=limits))
    text = "B0B300B300GYL2 B300B0B600GYNR1 B50B20B50GXL4 DD"
    recording = recording_of(text, wire=Wire(180.0, 10.0, 30.0), machine=slow)
    run, steps = recording.run, recording.steps
    page = replay_of(empty, replay_document(recording))
    times = np.linspace(0.0, run.plan.duration_s, 401)
    times = times[np.abs(times[:, None] - steps.t_s[None, :]).min(axis=1) > TICK_S]
    states = page.evaluate("(times) => times.map((t) => model.stateAt(t))", times.tolist())
    borders, duration_s = np.cumsum(run.block_time_s), page.evaluate("model.duration")
    for t, state in zip(times.tolist(), states, strict=True):
        done = int(np.searchsorted(steps.t_s, t, side="right"))
        assert state["step"] == done
        assert (state["x"], state["y"]) == ((int(steps.x_um[done - 1]), int(steps.y_um[done - 1])) if done else (0, 0))
        assert state["block"] == min(int(np.searchsorted(borders, t, side="right")), 2)
        instant = run.plan.at(t)
        assert state["feed_um_s"] == pytest.approx(float(instant.speed_um_s), abs=1e-4)
        assert t + state["remaining_s"] == pytest.approx(duration_s, abs=1e-9)
        for at, place in enumerate(state["wire"]):
            between = float(np.interp(t, run.trace.t_s, run.trace.wire_um[:, at]))
            assert place == pytest.approx(between, abs=2 * GRAIN_UM)


@pytest.mark.parametrize("machine", [DK, SERVO], ids=["point by point", "card"])
def test_steps_belong_to_the_blocks_that_make_them(empty: "Page", machine: Machine) -> None:
    text = "B100B0B100GXL1 B0B100B0GYL2 B100B100B100GYL1 B0B9B9GYL2 DD"
    recording = recording_of(text, machine=machine)
    page = replay_of(empty, replay_document(recording))
    rows = page.evaluate("() => Array.from({length: replay.steps}, (_, at) => model.blockOfStep(at + 1))")
    assert rows == recording.steps.row.tolist()
    assert page.evaluate("[model.blockOfStep(0), model.timeOf(0), model.stepAt(-1), model.stepAt(1e9)]") == [
        0,
        0,
        0,
        len(rows),
    ]


def assert_as_the_report_says(page: Any, recording: Recording) -> None:
    """The page's deviation at every sample is that of the measure, between samples no more than the report's largest.

    On the page the wire lies within half a grain of its place in X and in Y.
    """
    run, off_by = recording.run, 0.75 * GRAIN_UM
    expected = np.abs(across_um(run.toolpath, run.cut, run.cut.wire_um, run.plan.at(run.cut.t_s).along_um))
    most_um = build_report(run)["deviation"]["wire"]["max_um"]
    assert expected.max() == pytest.approx(most_um, abs=1e-6)
    found = page.evaluate("() => Array.from(replay.samples.t, (t) => model.deviation(t))")
    assert np.abs(np.array([deviation["um"] for deviation in found]) - expected).max() <= off_by
    for deviation, place in zip(found, run.cut.wire_um, strict=True):
        assert math.dist(deviation["foot"], place) == pytest.approx(deviation["um"], abs=off_by)
    times = np.linspace(0.0, 1.001 * page.evaluate("model.duration"), 20_011)
    between = page.evaluate("(times) => times.map((t) => model.deviation(t).um)", times.tolist())
    assert max(between) <= most_um + off_by


@pytest.mark.alike(1)
@pytest.mark.parametrize("lag_um", [0.0, 40.0])
def test_the_deviation_of_the_wire_is_that_of_the_report(empty: "Page", lag_um: float) -> None:
    text = "B0B300B300GYL2 B300B0B600GYNR1 B40B5B40GXL1 B30B60B60GYL3 B30B40B90GXSR4 DD"
    recording = recording_of(text, wire=Wire(180.0, 10.0, lag_um))
    assert_as_the_report_says(replay_of(empty, replay_document(recording)), recording)
    assert recording.run.deviations.wire.max_um > 1.0


@pytest.mark.alike(1)
@pytest.mark.parametrize("name", ["wire-lag-corner", "wire-lag-arc", "backlash", "friction", "servo-trip"])
def test_no_moment_of_a_replay_deviates_more_than_the_report(empty: "Page", name: str) -> None:
    recording = scenario_recording(name)
    assert_as_the_report_says(replay_of(empty, replay_document(recording)), recording)


def test_a_wire_ahead_of_its_block_is_measured_from_the_next_one(empty: "Page") -> None:
    """Past a line's end and past an arc's end, where the block that is reached soon is nearer."""
    recording = recording_of("B300B0B300GXL1 B0B300B600GYNR4 B300B0B300GXL3 DD")
    run, steps = recording.run, recording.steps
    borders = np.cumsum(run.block_time_s)
    t_s = np.array([0.0, borders[0] - 1.0, borders[1] - 1.0])
    wire = np.array([[0.0, 0.0], [345.0, 4.0], [260.0, 606.0]])
    trace = Trace(t_s, wire, wire, wire, np.array([0, 0, 1]))
    row = across(run.toolpath, trace, wire, run.plan.at(t_s).along_um).row
    assert row.tolist() == [0, 1, 2]
    page = replay_of(empty, {**replay_document(recording), "tape": tape(steps, (0, 0), trace, row)})
    found = page.evaluate("() => Array.from(replay.samples.t, (t) => model.deviation(t).um)")
    assert found == pytest.approx([0.0, abs(300.0 - math.hypot(45.0, 296.0)), 6.0], abs=2 * GRAIN_UM)


def test_blocks_are_told_exactly() -> None:
    recording = recording_of("N1: B0B300B300GYL2 B300B0B600GYNR1\nN2:B50B20B50GXL4\nDD")
    toolpath, blocks = recording.run.toolpath, replay_document(recording)["blocks"]
    place = np.stack([blocks["place_x_um"], blocks["place_y_um"]], axis=1)
    assert np.abs(place[:-1] - toolpath.start_um).max() < 1e-6
    assert np.abs(place[1:] - toolpath.end_um).max() < 1e-6
    assert blocks["kind"] == ["line", "arc", "line"]
    assert (blocks["center_x_um"][0], blocks["radius_um"]) == (None, [None, 300.0, None])
    assert blocks["center_x_um"][1] + 300.0 * math.cos(blocks["start_angle_rad"][1]) == pytest.approx(0.0, abs=1e-6)
    assert blocks["sweep_rad"][1] == pytest.approx(math.pi, abs=1e-9)
    assert blocks["length_um"][1] == pytest.approx(300.0 * math.pi, abs=1e-5)
    assert (blocks["count_um"], blocks["count_axis"], blocks["quadrant"]) == (
        [300, 600, 50],
        ["Y", "Y", "X"],
        [2, 1, 4],
    )
    assert blocks["turn"] == [0, 1, 0]
    assert (blocks["number"], blocks["line"], blocks["name"]) == ([1, 2, 3], [1, 1, 2], ["N1", "2", "N2"])
    assert blocks["first_step"] == [0, *np.cumsum(recording.run.stepped.count).tolist()]
    assert blocks["border_s"][-1] == pytest.approx(recording.run.plan.duration_s, abs=1e-6)
    assert blocks["border_s"][1] == pytest.approx(float(recording.run.block_time_s[0]), abs=1e-6)


def test_every_block_is_found_in_the_lines_of_the_program() -> None:
    text = "header\r\nN1: B0 B300 B300 GYL2 B300B0B600GYNR1\t//é\x07<script>\rB50B20B50GXL4\n\nDD\n"
    recording = recording_of(text)
    document = replay_document(recording)
    lines, blocks = document["program"]["lines"], document["blocks"]
    assert lines == ["header", "N1: B0 B300 B300 GYL2 B300B0B600GYNR1 //é�<script>", "B50B20B50GXL4", "", "DD"]
    shown = [
        lines[line - 1][first : first + length]
        for line, first, length in zip(blocks["line"], blocks["character"], blocks["characters"], strict=True)
    ]
    assert shown == [block.text for block in recording.run.toolpath]


def test_findings_tell_their_block_time_and_both_languages() -> None:
    recording = recording_of("B300B0B300GXL1 B0B300B300GYL2 B300B0B300GXL4 DD")
    (finding,) = (f for f in replay_document(recording)["findings"] if f["code"] == "3B203")
    assert (finding["severity"], finding["row"], finding["block"], finding["line"]) == ("warning", 2, 3, 1)
    assert finding["t_s"] == pytest.approx(float(recording.run.block_time_s[:2].sum()), abs=1e-6)
    assert finding["texts"]["en"]["title"] != finding["texts"]["zh"]["title"]


def test_pieces_are_told_within_their_step() -> None:
    recording = recording_of("B0B300B300GYL2 B0B600B2400GXNR2 DD")
    (piece,), (entry,) = recording.pieces.freed, replay_document(recording)["pieces"]
    ring = shapely.Polygon(entry["outline_um"], entry["holes_um"])
    assert ring.symmetric_difference(piece.outline_um).area <= 2.0 * piece.outline_um.length
    assert all(isinstance(along, int) for corner in entry["outline_um"] for along in corner)
    assert entry["outline_um"][0] != entry["outline_um"][-1]
    assert (entry["kind"], entry["row"]) == (piece.kind, piece.freed.block - 1)
    assert entry["t_s"] == pytest.approx(piece.freed.t_s, abs=1e-6)
    assert entry["area_mm2"] == pytest.approx(piece.area_mm2, abs=1e-6)


def tripping() -> Recording:
    table = SERVO.table._replace(motor=SERVO.table.motor._replace(following_error_limit_um=3.0))
    text = "B100B0B100GXL1 D B3000B0B3000GXL1 D B0B100B100GYL2 B100B0B100GXL1 DD"
    return recording_of(text, machine=SERVO._replace(table=table))


def test_the_replay_ends_where_a_servo_trips(empty: "Page") -> None:
    recording = tripping()
    trip = recording.run.ended
    assert trip is not None
    document = replay_document(recording)
    assert document["duration_s"] == trip.t_s
    assert document["ended"]["row"] == trip.row < len(recording.run.toolpath) - 1
    page = replay_of(empty, document)
    made, latest, sampled = page.evaluate("[replay.steps, replay.way.t(replay.steps), replay.samples.t.at(-1)]")
    assert 0 < made == len(recording.steps.t_s) < recording.run.toolpath.length_um.sum()  # µm, one step each
    assert max(latest, sampled) <= trip.t_s + TICK_S
    assert document["blocks"]["first_step"][-1] == made
    state = page.evaluate("model.stateAt(1e6)")
    assert (state["t"], state["remaining_s"], state["step"]) == (trip.t_s, 0, made)


def test_the_page_names_every_key_of_the_document() -> None:
    """Over runs that have between them clamps, findings, pieces, questions, a trip and losses."""
    quiz = (Question(1, "quadrant", "test"), Question(2, "end", "test"))
    clamps = (Clamp("left", (Point(0.0, 0.0), Point(9.0, 0.0), Point(0.0, 9.0))),)
    part = document_of("B0B300B300GYL2 B0B600B2400GXNR2 DD", quiz=quiz, clamps=clamps)
    documents = [part, document_of(TRIANGLE.replace("B300GXL4", "B250GXL4")), replay_document(tripping())]
    for entries in ("clamps", "findings", "pieces", "quiz", "losses", "stops", "contours"):
        assert any(document[entries] for document in documents), entries
    types = types_of(ASSETS / "document.js", ASSETS.parents[1] / "html" / "assets" / "language.js")
    assert [complaint for document in documents for complaint in unlike(types, "ReplayDocument", document)] == []
    assert list(unlike(types, "ReplayDocument", {**part, "stops": [{"kind": "end", "after": None}]})) != []


def test_an_offset_path_is_replayed_with_the_blocks_it_comes_from() -> None:
    text = "B0B2000B2000GYL2 B2000B0B2000GXL1 B0B2000B2000GYL4 B2000B0B2000GXL3 DD"
    from controller.offset.shifted import Side
    from sim.setup.part import Offset, OffsetPass

    recording = recording_of(text, offset=Offset((OffsetPass(100.0),), Side.LEFT))
    document = replay_document(recording)
    blocks = document["blocks"]
    assert len(blocks["kind"]) == len(recording.run.toolpath) > 4
    assert set(blocks["number"]) == {1, 2, 3, 4}
    assert blocks["first_step"][-1] == document["tape"]["steps"] == len(recording.steps.t_s)


LONG_STEPS = 1_000_000


def long_document() -> dict[str, Any]:
    """A spiral of lines and arcs of a million steps, and a table and wire that jitter, sampled every 5 steps."""
    turns = [PlainBlock(900 + k, 700, 6 * (900 + k), "X", "NR", 1 + k % 4) for k in range(55)]
    slanted = [PlainBlock(4000 + 13 * k, 900 + 7 * k, 4000 + 13 * k, "X", "L", 1 + k % 4) for k in range(45)]
    program = [block for pair in zip(turns, slanted, strict=False) for block in pair]
    toolpath = parse_program(program_text(program)).toolpath
    steps = interpolate(toolpath)
    chunk = chunk_of(steps, 0, len(steps))
    times = LONG_STEPS // len(steps) + 1
    x, y = (np.diff(column, prepend=np.int32(0)) for column in (chunk.x_um, chunk.y_um))
    along = np.diff(chunk.along_um, prepend=0.0)
    x, y, along = (np.tile(column, times)[:LONG_STEPS] for column in (x, y, along))
    pulses = Pulses(
        np.cumsum(along / 43.75), *(np.cumsum(c).astype(np.int32) for c in (x, y)), np.zeros(LONG_STEPS, np.int32)
    )
    every = slice(4, None, 5)
    chance = np.random.default_rng(3)
    commanded = np.stack([pulses.x_um[every], pulses.y_um[every]], axis=1)
    table = commanded + chance.normal(0.0, 0.3, commanded.shape)
    wire = table + chance.normal(0.0, 0.1, commanded.shape)
    trace = Trace(pulses.t_s[every], commanded, table, wire, np.zeros(len(table), dtype=np.int64))
    return {
        "tape": taped(pulses, (0, 0), trace),
        "end": [int(pulses.x_um[-1]), int(pulses.y_um[-1]), float(pulses.t_s[-1])],
    }


def test_the_kerf_is_as_wide_as_the_technology_has_the_pass(empty: "Page") -> None:
    """Half of 180 µm and 20 in the first pass, and 5 in the second, from sample to sample; else of the wire."""
    row = Cut("steel", 180.0, 40.0, 1, 20.0, None, 2.0, None, None, None, None, None, None, None, None)
    both = Technology("test", "measured", "here", (row, row._replace(number=2, gap_um=5.0)))
    passes = (OffsetPass(150.0), OffsetPass(95.0, "back"))
    half, whole = "B0B300B300GY", "B0B600B600GY"
    square = f"{half}L2 B300B0B300GXL1 {whole}L2 B600B0B600GXL3 {whole}L4 B300B0B300GXL1 {half}L4 DD"
    for changes, wanted in (({"technology": both}, {190.0, 220.0}), ({}, {200.0})):
        replay_of(empty, document_of(square, offset=Offset(passes, Side.RIGHT), **changes))
        found = empty.evaluate(
            f"() => {{ const {{ widthSamples }} = {exports('stage')}; const widthUm = widthSamples(replay);"
            " return Array.from(replay.samples.t, (_, at) => widthUm(at)); }"
        )
        assert set(found) == wanted
        assert (found[0], found[-1]) == (max(wanted), min(wanted))


@pytest.mark.deeper
def test_a_million_steps_are_small_and_soon_decoded(empty: "Page") -> None:
    """A table that jitters at random is the worst case; the bound on the time is ten times what it takes here."""
    document = {**document_of(TRIANGLE), **long_document()}
    assert len(json.dumps(document["tape"])) < 3_500_000
    page = replay_of(empty, document)
    found = page.evaluate(
        """async (doc) => {
        const began = performance.now();
        const one = await decode(doc);
        const {steps, way: {x, y, t}} = one;
        return [performance.now() - began, x(steps), y(steps), t(steps), one.samples.t.length];
    }""",
        document,
    )
    took_ms, *end, t_s, samples = found
    assert (end, samples) == (document["end"][:2], LONG_STEPS // 5)
    assert t_s == pytest.approx(document["end"][2], abs=TICK_S)
    assert took_ms < 5_000.0


def test_a_finding_lies_where_it_says_and_else_at_its_block() -> None:
    of = scenario_recording("out-of-travel")
    findings = {one.code: one for one in of.run.findings}
    entries = {entry["code"]: entry for entry in replay_document(of)["findings"]}
    assert entries["3B401"]["place_um"] is None  # its x_mm and y_mm are the travel of the table
    assert entries["3B401"]["row"] == findings["3B401"].block - 1
    assert entries["3B402"]["place_um"] == pytest.approx(
        [1000.0 * at for at in findings["3B402"].place_mm or ()], abs=1e-6
    )
