"""The bowed wire against closed forms, and against a plain loop that drags it in tiny steps."""

import math
from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from depth import examples
from hypothesis import given, settings
from hypothesis import strategies as st
from paths import Pen
from runs import machine, plain_scenario, run_text

from parser.findings.errors import SettingsError
from parser.geometry.curves import CurveKind
from parser.toolpath import Toolpath
from sim.cut.wire_lag import bowed
from sim.setup.scenario import load_scenario
from sim.setup.wire import CUT_OFF_OF_90, DEFAULT_WIRE, Wire, WireForces, read_wire
from sim.table.trace import Trace

LINE = Pen(0.0, 0.0).to(1.0, 0.0).path()
LINE_AND_JUMP = Pen(0.0, 0.0).to(1.0, 0.0).jump(2.0, 0.0).to(3.0, 0.0).path()


def trace_of(guides: np.ndarray, row: np.ndarray | None = None) -> Trace:
    n = len(guides)
    rows = np.zeros(n, dtype=np.int64) if row is None else row
    return Trace(np.arange(n, dtype=float), guides, guides, guides, rows)


def wire_of(guides: np.ndarray, lag: float, path: Toolpath = LINE, row: np.ndarray | None = None) -> np.ndarray:
    return bowed(trace_of(np.asarray(guides, dtype=float), row), path, np.full(len(path), lag)).wire_um


def polyline(*corners: tuple[float, float], spacing: float) -> np.ndarray:
    legs = [np.array(corners[0])[None, :]]
    for a, b in pairwise(np.array(corners)):
        n = math.ceil(np.hypot(*(b - a)) / spacing)
        legs.append(a + (b - a) * np.arange(1, n + 1)[:, None] / n)
    return np.concatenate(legs)


def dragged(guides: np.ndarray, cuts: np.ndarray, lag: float, step: float) -> np.ndarray:
    """The wire moved by hand: in each tiny step of the guides pulled straight back to within the lag of them."""
    wire = complex(*guides[0])
    here, places = wire, []
    for (x, y), cut in zip(guides.tolist(), cuts.tolist(), strict=True):
        by = complex(x, y) - here
        parts = max(1, math.ceil(abs(by) / step))
        for part in range(1, parts + 1):
            guide = here + by * part / parts
            gap = guide - wire
            if abs(gap) > lag:
                wire = guide - gap / abs(gap) * lag
        here = complex(x, y)
        wire = wire if cut else here
        places.append((wire.real, wire.imag))
    return np.array(places)


def test_without_lag_nothing_changes() -> None:
    trace = trace_of(np.zeros((3, 2)))
    assert bowed(trace, LINE, np.zeros(len(LINE))) is trace


def test_straight_on_the_wire_waits_for_the_lag_and_then_follows_on_the_line() -> None:
    guides = polyline((0.0, 0.0), (300.0, 400.0), spacing=5.0)
    wire = wire_of(guides, 20.0)
    done, along = np.hypot(*guides.T), wire @ [0.6, 0.8]
    assert np.abs(wire @ [-0.8, 0.6]).max() < 1e-9  # µm
    assert along == pytest.approx(np.maximum(done - 20.0, 0.0), abs=1e-9)


@pytest.mark.alike(1)
@pytest.mark.parametrize(("radius", "lag"), [(1000.0, 20.0), (9900.0, 150.0), (30.0, 29.0)])
def test_a_circle_shrinks_to_the_root_of_the_difference_of_squares(radius: float, lag: float) -> None:
    turns = np.linspace(0.0, 24.0 * math.pi, 40_001)
    wire = wire_of(radius * np.stack([np.cos(turns), np.sin(turns)], axis=1), lag)
    # Chords of 1.9 mrad: their sagitta is 4e-7 of the radius.
    assert np.hypot(*wire[-1000:].T) == pytest.approx(math.sqrt(radius**2 - lag**2), abs=1e-5 * radius)


@pytest.mark.deeper
@pytest.mark.parametrize(("radius", "lag"), [(30.0, 50.0), (30.0, 40.0)])
def test_a_circle_smaller_than_the_lag_is_not_cut(radius: float, lag: float) -> None:
    turns = np.linspace(0.0, 100.0 * math.pi, 20_001)
    wire = wire_of(radius * np.stack([np.cos(turns), np.sin(turns)], axis=1), lag)
    away = np.hypot(*wire.T)
    assert away[-400:].max() <= lag - radius + 0.05  # µm: no place of the circle is beyond the lag
    assert np.hypot(*np.diff(wire[-400:], axis=0).T).max() < 1e-3  # µm: it stays


@given(
    turn=st.floats(1.0, 179.0), lag=st.floats(1.0, 200.0), spacing=st.floats(0.5, 60.0), left=st.sampled_from([1, -1])
)
@settings(max_examples=examples(60), deadline=None)
def test_a_corner_is_the_tractrix_of_its_closed_form(turn: float, lag: float, spacing: float, left: int) -> None:
    angle = math.radians(turn)
    toward = np.array([math.cos(angle), left * math.sin(angle)])
    corner = np.array([3000.0, 0.0])
    first = polyline((0.0, 0.0), (3000.0, 0.0), spacing=spacing)
    second = corner + toward * np.arange(1, 200)[:, None] * (spacing / 3.0)
    wire = wire_of(np.concatenate([first, second]), lag)[len(first) :]
    s = np.arange(1, 200) * (spacing / 3.0)
    waits = max(-2.0 * lag * math.cos(angle), 0.0)
    sharp = min(angle, math.pi - angle)
    half = math.tan(sharp / 2.0) * np.exp(-np.maximum(s - waits, 0.0) / lag)
    cos, sin = (1.0 - half**2) / (1.0 + half**2), 2.0 * half / (1.0 + half**2)
    # Of the guides behind the wire: along the new leg, and across it toward the outside of the turn.
    aside = np.array([toward[1], -toward[0]]) * left
    taut = corner + toward * (s - lag * cos)[:, None] - aside * (lag * sin)[:, None]
    expected = np.where((s < waits)[:, None], corner - [lag, 0.0], taut)
    assert wire == pytest.approx(expected, abs=1e-6)  # µm


def test_a_right_angle_is_cut_off_by_about_half_the_lag() -> None:
    wire = wire_of(polyline((-2000.0, 0.0), (0.0, 0.0), (0.0, 2000.0), spacing=1.0), 100.0)
    off = np.minimum(np.abs(wire[:, 0]), np.abs(wire[:, 1]))
    # On the tractrix x = −lag sech u, y = lag (u − tanh u) both are equal at u = 1.3586.
    assert off.max() == pytest.approx(48.25, abs=0.5)  # µm
    assert (wire[:, 0] <= 1e-9).all()
    assert (wire[:, 1] >= -1e-9).all()  # inside the corner


def test_on_the_way_back_the_wire_lies_in_its_own_slot() -> None:
    wire = wire_of(polyline((0.0, 0.0), (1000.0, 0.0), (0.0, 0.0), spacing=5.0), 50.0)
    assert np.abs(wire[:, 1]).max() == 0.0
    assert wire[:, 0].max() == pytest.approx(950.0)
    assert wire[-1, 0] == pytest.approx(50.0)


@st.composite
def walks(draw: st.DrawFn) -> tuple[np.ndarray, np.ndarray]:
    rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    n = draw(st.integers(2, 80))
    heading = np.cumsum(rng.normal(0.0, draw(st.floats(0.0, 2.0)), n))
    length = rng.uniform(0.0, draw(st.floats(0.1, 30.0)), n) * (rng.random(n) > 0.1)
    guides = np.cumsum(np.stack([np.cos(heading), np.sin(heading)], axis=1) * length[:, None], axis=0)
    row = np.cumsum(rng.random(n) < 0.02).clip(max=2)
    return guides, row


@given(walk=walks(), lag=st.floats(2.0, 60.0))
@settings(max_examples=examples(80), deadline=None)
def test_any_way_is_that_of_a_plain_loop(walk: tuple[np.ndarray, np.ndarray], lag: float) -> None:
    guides, row = walk
    cuts = LINE_AND_JUMP.kind[row] != CurveKind.JUMP
    step = 2e-3 * lag
    wire = wire_of(guides, lag, LINE_AND_JUMP, row)
    assert np.abs(wire - dragged(guides, cuts, lag, step)).max() < 4.0 * step  # µm


def test_a_long_way_in_stretches_is_one_way() -> None:
    # With circles above and below the lag, so that some stretches forget how they began and some never do.
    rng = np.random.default_rng(3)
    bend = np.repeat(rng.choice([0.0, 1.0 / 400.0, 1.0 / 30.0, -1.0 / 70.0], 40), 100)
    heading = np.cumsum(bend * 5.0)
    guides = np.cumsum(5.0 * np.stack([np.cos(heading), np.sin(heading)], axis=1), axis=0)
    wire, one = wire_of(guides, 50.0), []
    behind = 0.0 + 0.0j
    before = complex(*guides[0])
    for x, y in guides.tolist():
        length, angle = abs(complex(x, y) - before), math.atan2(y - before.imag, x - before.real)
        before = complex(x, y)
        seen = behind * complex(math.cos(angle), -math.sin(angle))
        slack = math.sqrt(50.0**2 - min(abs(seen.imag), 50.0) ** 2) - seen.real
        if length <= slack:
            seen += length
        else:
            turn = 2.0 * math.atan(math.tan(math.asin(seen.imag / 50.0) / 2.0) * math.exp((slack - length) / 50.0))
            seen = 50.0 * complex(math.cos(turn), math.sin(turn))
        behind = seen * complex(math.cos(angle), math.sin(angle))
        one.append((x - behind.real, y - behind.imag))
    assert np.abs(wire - np.array(one)).max() < 1e-6  # µm


@given(lag=st.floats(1.0, 100.0), parts=st.integers(2, 9))
@settings(max_examples=examples(30), deadline=None)
def test_samples_between_change_nothing(lag: float, parts: int) -> None:
    coarse = np.random.default_rng(parts).uniform(-50.0, 50.0, (40, 2))
    share = np.arange(parts)[:, None] / parts
    fine = np.concatenate([*(a + (b - a) * share for a, b in pairwise(coarse)), coarse[-1:]])
    assert wire_of(fine, lag)[::parts] == pytest.approx(wire_of(coarse, lag), abs=1e-6)  # µm


def test_on_jumps_the_wire_is_straight_and_the_lag_builds_up_again() -> None:
    guides = polyline((0.0, 0.0), (300.0, 0.0), spacing=5.0)
    row = np.repeat([0, 1, 2], [21, 20, 20])
    wire = wire_of(guides, 20.0, LINE_AND_JUMP, row)
    assert wire[20, 0] == pytest.approx(80.0)
    assert np.array_equal(wire[row == 1], guides[row == 1])
    assert wire[row == 2][:, 0] == pytest.approx(np.maximum(guides[row == 2][:, 0] - 20.0, 200.0))


def test_steps_of_the_table_are_smoothed_by_a_lag_that_is_long_beside_them() -> None:
    slope = np.array([5.0, 2.0]) / 29**0.5
    guides = np.rint(slope * np.arange(0.0, 5000.0, 4.7)[:, None])
    table, wire = (np.ptp((places @ [-slope[1], slope[0]])[100:]) for places in (guides, wire_of(guides, 30.0)))
    assert table > 0.9  # µm
    assert wire < table / 3.0


@pytest.mark.parametrize("span", [None, 40.0, 65.0, 200.0])
def test_forces_bow_the_wire_as_a_string_in_small_parts(span: float | None) -> None:
    forces = WireForces(tension_n=9.0, pressure_n_mm=0.002, guide_span_mm=span)
    length, n = span or 40.0, 4000
    # T w'' = −q on parts of the span, w = 0 at the guides: solved as a chain of nodes.
    dx = length / n
    middle = (np.arange(1, n) * dx) - length / 2.0
    load = np.where(np.abs(middle) < 20.0, 0.002, np.where(np.abs(middle) > 20.0, 0.0, 0.001))
    shear = np.cumsum(load) * dx
    slope = (shear.mean() * (n - 1) / n - np.concatenate([[0.0], shear])) / 9.0
    sag_um = np.cumsum(slope)[n // 2 - 1] * dx * 1e3
    assert forces.lag_um(40.0) == pytest.approx(sag_um, rel=1e-3)


def test_a_wire_section_sets_the_lag_or_its_forces() -> None:
    assert read_wire({}, "w") == DEFAULT_WIRE
    assert read_wire({"lag_um": 15}, "w").lag_um(40.0) == 15.0
    forces = read_wire({"tension_n": 12.0, "pressure_n_mm": 0.0012}, "w")
    assert forces.lag_um(40.0) == pytest.approx(20.0)
    assert forces.lag_um(80.0) == pytest.approx(80.0)


@pytest.mark.parametrize(
    ("section", "complaint"),
    [
        ({"lag_um": 10.0, "tension_n": 12.0}, r"w: lag_um is given, or tension_n that tell it; found both"),
        ({"tension_n": 12.0}, "w: tension_n needs pressure_n_mm, which is missing"),
        ({"guide_span_mm": 90.0}, "w: guide_span_mm needs tension_n, which is missing"),
        ({"lag_um": -1.0}, "w: lag_um is -1; it must lie between 0 and 1000"),
        ({"lag_mm": 1.0}, "w: unknown key 'lag_mm'; did you mean lag_um"),
        ({"tension_n": 0.0, "pressure_n_mm": 0.1}, "w: tension_n is 0; it must lie between 0.1 and 100"),
        ({"diameter_mm": "thin"}, "w: diameter_mm is a number; found 'thin'"),
    ],
)
def test_bad_wire_sections_are_refused(section: dict[str, object], complaint: str) -> None:
    with pytest.raises(SettingsError, match=complaint):
        read_wire(section, "w")


def test_a_wire_that_cannot_be_bowed_so_is_refused_with_its_work() -> None:
    short = replace(DEFAULT_WIRE, lag=WireForces(12.0, 0.001, guide_span_mm=50.0))
    assert plain_scenario(wire=short).wire_lag_um == pytest.approx(0.001 * 40.0 * 60.0 / 96.0 * 1e3)
    with pytest.raises(SettingsError, match="the work is 60 mm thick and the guides are 50 mm apart"):
        plain_scenario(wire=short, thickness_mm=60.0)
    with pytest.raises(SettingsError, match=r"bow it by 2\.66\d+e\+06 µm; it must be no more than 1000"):
        plain_scenario(wire=Wire(180.0, 10.0, WireForces(0.3, 4.0)))


def test_a_scenario_with_a_wire_lag_cuts_its_corners_off(tmp_path: Path) -> None:
    (tmp_path / "program.3b").write_text("B2000B0B2000GXL1 B0B2000B2000GYL2 DD", "utf-8")
    (tmp_path / "scenario.toml").write_text("[wire]\nlag_um = 40.0\n", "utf-8")
    case = load_scenario(tmp_path)
    assert case.wire_lag_um == 40.0
    # Without play: the table's own lag at the corner would count to the table, not to the wire.
    free = machine(friction_n=(0.0, 0.0), viscous_n_s_mm=(0.0, 0.0), backlash_um=(0.0, 0.0))
    run = run_text("B2000B0B2000GXL1 B0B2000B2000GYL2 DD", wire=case.wire, machine=free)
    assert run.deviations.wire.max_um == pytest.approx(CUT_OFF_OF_90 * 40.0, abs=1.0)  # µm, and a step
    assert run.deviations.by_cause.wire.max_um == pytest.approx(CUT_OFF_OF_90 * 40.0, abs=1.0)


def test_what_a_run_without_lag_says_of_a_right_angle_is_what_the_law_has() -> None:
    """The most that the wire is off both ways, the guides s lags past the corner: s − cos φ along, sin φ aside."""
    past = np.linspace(0.0, 3.0, 30_001)
    angle = 2.0 * np.arctan(np.exp(-past))
    off = np.minimum(past - np.cos(angle), np.sin(angle))
    assert off.max() == pytest.approx(CUT_OFF_OF_90, abs=5e-4)
