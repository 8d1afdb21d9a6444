"""The figures and parts of the circular test, against closed forms and circles with known errors."""

import numpy as np
import pytest
from circles import both, measured, moved_out, past, perfect, with_play, with_spikes
from hypothesis import given, settings
from hypothesis import strategies as st
from runs import machine

from parser.controller_words import Axis
from parser.findings.errors import SettingsError
from sim.base.progress import silent
from sim.base.units import parse_speed
from sim.run.ballbar.circle import circle_test, measure, run_test
from sim.run.ballbar.figures import SENSES, MeasuredTurn, circularity, figures_of, least_squares_circle
from sim.setup.machine.machine import load_machine

EXACT_UM = 0.002
"""What the closed forms leave out, (deviation / radius)² and the grid, for deviations of some 10 µm on 50 mm."""

few_um = st.floats(0.0, 12.0)
signed_um = st.floats(-10.0, 10.0)


def test_a_perfect_circle_has_no_deviation() -> None:
    figures, parts, interpolation_um = measured(perfect(1), perfect(-1))
    assert figures.circularity_um == pytest.approx(0.0, abs=1e-4)
    assert figures.hysteresis_um == pytest.approx(0.0, abs=1e-4)
    assert interpolation_um == pytest.approx(0.0, abs=1e-4)
    assert [*parts.radius_um, *parts.step_um, parts.lag_um, parts.diameters_um] == pytest.approx([0.0] * 6, abs=1e-4)
    assert {reversal.spike_um for reversal in parts.reversals} == {0.0}


def test_radial_deviation_sees_the_centre_and_circularity_does_not() -> None:
    moved = [MeasuredTurn(s, perfect(s, 50_003.0).points_um + np.array([4.0, -3.0])) for s in SENSES]
    figures = figures_of(*moved, 50_000.0)
    assert figures.circularity_um == pytest.approx(0.0, abs=EXACT_UM)
    assert figures.center_um == pytest.approx((4.0, -3.0), abs=EXACT_UM)
    assert figures.mean_radial_um == pytest.approx(3.0, abs=EXACT_UM)
    for way in (figures.ccw, figures.cw):
        assert (way.radial_max_um, way.radial_min_um) == pytest.approx((8.0, -2.0), abs=EXACT_UM)
        assert way.mean_radius_um == pytest.approx(3.0, abs=EXACT_UM)


def test_both_directions_are_held_together_by_the_ring_of_both() -> None:
    """Two round circles of different size: each is round, both together are not."""
    figures = figures_of(perfect(1, 50_002.0), perfect(-1, 49_999.0), 50_000.0)
    assert (figures.ccw.circularity_um, figures.cw.circularity_um) == pytest.approx((0.0, 0.0), abs=EXACT_UM)
    assert figures.circularity_um == pytest.approx(3.0, abs=EXACT_UM)
    assert figures.hysteresis_um == pytest.approx(3.0, abs=EXACT_UM)
    assert figures.mean_radial_um == pytest.approx(0.5, abs=EXACT_UM)


def test_hysteresis_is_the_difference_in_one_direction_and_the_zone_is_not() -> None:
    oval = both(lambda turn: moved_out(turn, 3.0 * np.cos(2.0 * np.radians(past(turn, 0.0)))))
    assert oval.figures.circularity_um == pytest.approx(6.0, abs=EXACT_UM)
    assert oval.figures.hysteresis_um == pytest.approx(0.0, abs=EXACT_UM)


@settings(max_examples=15)
@given(st.integers(0, 2**32 - 1))
def test_the_circle_is_that_of_least_squares(seed: int) -> None:
    """Against Gauss and Newton on the distances themselves."""
    rng = np.random.default_rng(seed)
    waves = rng.normal(0.0, 3.0, (6, 2))
    turn = perfect(1)
    angle = np.radians(past(turn, 0.0))
    out = sum(a * np.cos(k * angle) + b * np.sin(k * angle) for k, (a, b) in enumerate(waves))
    turn = moved_out(turn, out)
    center, radius = np.zeros(2), 50_000.0
    for _ in range(4):
        away = turn.points_um[:-1] - center
        length = np.hypot(*away.T)
        slope = np.column_stack([away / length[:, None], np.ones(len(length))])
        change = np.linalg.lstsq(slope, length - radius)[0]
        center, radius = center + change[:2], radius + change[2]
    found, found_radius = least_squares_circle(turn)
    assert found == pytest.approx(center, abs=0.01)
    assert found_radius == pytest.approx(radius, abs=0.01)


def test_circularity_is_hardly_wider_than_the_minimum_zone() -> None:
    """The narrowest ring of any centre, found by trying many, for the form that backlash gives."""
    turn = with_play(perfect(1), 6.0, 3.0)
    tried = np.mgrid[-2:2:41j, -2:2:41j].reshape(2, -1).T
    narrowest = min(np.ptp(np.hypot(*(turn.points_um - center).T)) for center in tried)
    assert narrowest - 0.01 <= circularity(turn) <= 1.05 * narrowest


@settings(max_examples=15)
@given(few_um, few_um)
def test_the_step_is_the_backlash(x_um: float, y_um: float) -> None:
    parts = both(lambda turn: with_play(turn, x_um, y_um)).parts
    assert parts.step_um == pytest.approx((x_um, y_um), abs=0.02)
    for reversal in parts.reversals:
        assert reversal.step_um == pytest.approx((x_um, y_um)[reversal.axis], abs=0.03)
        assert reversal.spike_um == 0.0
    assert parts.radius_um == pytest.approx((0.0, 0.0), abs=0.02)
    assert (parts.diameters_um, parts.lag_um) == pytest.approx((0.0, 0.0), abs=0.05)


def test_backlash_steps_outward_by_its_width() -> None:
    """Before a reversal the slide is b/2 inside; at the end of the flat, φ on, b/2 cos φ outside in one axis and b/2
    sin φ inside in the other.
    """
    result = both(lambda turn: with_play(turn, 8.0, 8.0))
    flat = np.arccos(1.0 - 8.0 / 50_000.0)
    assert result.figures.circularity_um == pytest.approx(4.0 * (1.0 + np.cos(flat) - np.sin(flat)), abs=0.01)


def test_the_flat_is_as_wide_as_backlash_makes_it() -> None:
    """The slide stands while the motor goes back by b: R (1 − cos φ) = b."""
    turn = with_play(perfect(1), 10.0, 0.0)
    stands = np.ptp(turn.points_um[:, 1][np.abs(turn.points_um[:, 0] - turn.points_um[:, 0].max()) < 1e-6])
    assert stands == pytest.approx(50_000.0 * np.sin(np.arccos(1.0 - 10.0 / 50_000.0)), abs=110.0)


@pytest.mark.deeper
@settings(max_examples=15)
@given(few_um, few_um, signed_um, signed_um, signed_um)
def test_parts_that_overlap_are_told_apart(
    x_um: float, y_um: float, out_um: float, oval_um: float, lag_um: float
) -> None:
    def change(turn: MeasuredTurn) -> MeasuredTurn:
        angle = np.radians(past(turn, 0.0)) * turn.sense
        form = out_um + oval_um / 4.0 * np.cos(2.0 * angle) + turn.sense * lag_um / 2.0 * np.sin(2.0 * angle)
        return moved_out(with_play(turn, x_um, y_um), form)

    parts = both(change).parts
    assert parts.step_um == pytest.approx((x_um, y_um), abs=0.03)
    assert parts.radius_um == pytest.approx((out_um, out_um), abs=0.03)
    assert (parts.diameters_um, parts.lag_um) == pytest.approx((oval_um, lag_um), abs=0.06)
    assert parts.rest_um < 0.03


def test_a_slower_axis_comes_later_along_the_path() -> None:
    """X late by 1/1000 rad: that is 5 µm of way on a radius of 5 mm, in both directions."""
    turns = []
    for sense in SENSES:
        angle = sense * np.linspace(np.pi, 3.0 * np.pi, 6001)
        turns.append(MeasuredTurn(sense, 5_000.0 * np.stack([np.cos(angle - sense * 1e-3), np.sin(angle)], axis=1)))
    parts = measured(turns[0], turns[1], 5_000.0).parts
    assert parts.lag_um == pytest.approx(5.0, abs=0.01)
    assert parts.step_um == pytest.approx((0.0, 0.0), abs=0.01)


def test_each_direction_has_its_own_radius() -> None:
    parts = measured(perfect(1, 50_001.0), perfect(-1, 49_998.0)).parts
    assert parts.radius_um == pytest.approx((1.0, -2.0), abs=EXACT_UM)


@pytest.mark.deeper
@settings(max_examples=15)
@given(st.floats(0.6, 8.0), few_um, st.floats(0.5, 6.0))
def test_a_spike_is_as_high_as_it_stands_out(height_um: float, play_um: float, at_deg: float) -> None:
    past_flat_deg = at_deg + np.degrees(np.arccos(1.0 - play_um / 50_000.0)) + 2.0
    change = lambda turn: with_spikes(with_play(turn, play_um, play_um), height_um, past_flat_deg)  # noqa: E731
    parts = both(change).parts
    assert parts.step_um == pytest.approx((play_um, play_um), abs=0.03)
    for reversal in parts.reversals:
        assert reversal.spike_um == pytest.approx(height_um, abs=0.05)
        at = 90.0 * reversal.axis + (180.0 if reversal.side == "-" else 0.0)
        assert np.mod(reversal.sense * (reversal.spike_deg - at), 360.0) == pytest.approx(past_flat_deg, abs=0.2)
    assert parts.spike_um(Axis.X) == pytest.approx(height_um, abs=0.05)


def test_one_reversal_is_told_from_the_others() -> None:
    """A slide that loses its play on one side alone, in one direction: its step shows there."""
    turn = perfect(1)
    after = (past(turn, 90.0) > 0.0) & (past(turn, 90.0) < 45.0)
    odd = moved_out(turn, np.where(after, 2.0, 0.0))
    reversals = measured(odd, perfect(-1)).parts.reversals
    steps = {(r.sense, r.side + r.axis.name): r.step_um for r in reversals}
    largest = max(steps, key=lambda key: steps[key])
    assert largest == (1, "+Y")
    assert steps[largest] == pytest.approx(2.0, abs=0.4)


def test_noise_makes_no_spike_and_hardly_moves_a_part() -> None:
    rng = np.random.default_rng(5)
    noisy = lambda turn: moved_out(with_play(turn, 5.0, 3.0), rng.normal(0.0, 0.3, len(turn.points_um)))  # noqa: E731
    parts = both(noisy).parts
    assert parts.step_um == pytest.approx((5.0, 3.0), abs=0.1)
    assert parts.spike_um(Axis.X) < 1.3
    assert 0.3 < parts.rest_um < 1.5


@pytest.mark.parametrize("sense", SENSES)
def test_the_sense_of_a_mirrored_path_is_the_other(sense: int) -> None:
    """Mirrored at the X axis counter-clockwise becomes clockwise: same figures, the directions changed over."""
    ccw, cw = (with_spikes(with_play(perfect(s), 4.0, 7.0), 1.0 + s) for s in SENSES)
    mirrored = [MeasuredTurn(-turn.sense, turn.points_um * (1.0, -1.0)) for turn in (cw, ccw)]
    first, second = measured(ccw, cw), measured(mirrored[0], mirrored[1])
    assert second.figures.circularity_um == pytest.approx(first.figures.circularity_um, abs=1e-6)
    assert second.figures.ccw == pytest.approx(first.figures.cw, abs=1e-6)
    assert second.parts.step_um == pytest.approx(first.parts.step_um, abs=1e-6)


@pytest.mark.parametrize(
    "points",
    [
        pytest.param(perfect(1).points_um[:3000], id="half a turn"),
        pytest.param(np.zeros((0, 2)), id="no place"),
        pytest.param(np.full((500, 2), 30_000.0), id="a table that stands"),
    ],
)
def test_what_does_not_go_round_is_not_measured(points: np.ndarray) -> None:
    steps = perfect(1), perfect(-1)
    assert measure((MeasuredTurn(1, points), perfect(-1)), steps, steps, 50_000.0) is None
    assert measure((perfect(1), MeasuredTurn(-1, points)), steps, steps, 50_000.0) is None


def test_the_measured_turn_is_one_from_minus_x_and_settled() -> None:
    ballbar = run_test(circle_test(load_machine("dk7740"), 1000.0, None), silent)
    for turn in ballbar.turns:
        assert turn.points_um[0] == pytest.approx((-1000.0, 0.0), abs=8.0)
        assert turn.points_um[-1] == pytest.approx((-1000.0, 0.0), abs=8.0)
        swept = np.unwrap(np.arctan2(turn.points_um[:, 1], turn.points_um[:, 0]))
        assert swept[-1] - swept[0] == pytest.approx(turn.sense * 2.0 * np.pi, abs=0.02)


@pytest.mark.parametrize(("interpolator", "most_um"), [("point-by-point", 1.0), ("card", 0.71)])
def test_interpolation_is_what_the_steps_allow(interpolator: str, most_um: float) -> None:
    """Point by point no step is more than 1 µm off, the card's own rounding 0.71 µm: G is at most twice that."""
    rigid = machine(drive_stiffness_n_um=5000.0, friction_n=(0.0, 0.0), backlash_um=(0.0, 0.0))
    ballbar = run_test(circle_test(rigid.stepping_by(interpolator), 2000.0, 500.0), silent)
    assert most_um < ballbar.measured.interpolation_um <= 2.0 * most_um + 0.05
    # The step that is in the steps themselves is none of the table.
    assert ballbar.measured.parts.step_um == pytest.approx((0.0, 0.0), abs=0.1)


def test_a_feed_that_the_machine_does_not_bend_is_told() -> None:
    """R 1 mm at 0.87 × 100 mm/s² allows 9.3 mm/s."""
    ballbar = run_test(circle_test(load_machine("dk7740"), 1000.0, 20_000.0), silent)
    assert ballbar.run_um_s == pytest.approx((0.75**0.5 * 1e5 * 1000.0) ** 0.5, rel=1e-3)
    assert ballbar.test.feed_um_s == 20_000.0


@pytest.mark.parametrize(
    ("radius_um", "feed_um_s", "message"),
    [
        (200_001.0, 500.0, "--radius in mm"),
        (99.0, 500.0, "--radius in mm"),
        (1000.5, 500.0, "whole number of µm"),
        (1000.0, 0.0, "--feed in mm/min"),
        (1000.0, 1e9, "--feed in mm/min"),
    ],
)
def test_a_test_that_cannot_be_run_is_refused(radius_um: float, feed_um_s: float, message: str) -> None:
    with pytest.raises(SettingsError, match=message):
        circle_test(load_machine("dk7740"), radius_um, feed_um_s)


def test_the_feed_left_out_is_that_of_jumps() -> None:
    assert circle_test(load_machine("dk7740"), 200_000.0, None).feed_um_s == 500.0


@pytest.mark.parametrize(
    ("text", "um_s"),
    [("500mm/min", 500_000 / 60), ("2 mm/s", 2000.0), ("180um/s", 180.0), ("180 µm/s", 180.0), ("1.2m/min", 20_000.0)],
)
def test_speeds_are_read_with_their_unit(text: str, um_s: float) -> None:
    assert parse_speed(text) == pytest.approx(um_s, rel=1e-15)


@pytest.mark.parametrize("text", ["500", "500mm", "mm/min", "500 mm / min", "1e3mm/s", "5mm/h", "", "nanmm/s"])
def test_what_is_no_speed_is_refused(text: str) -> None:
    with pytest.raises(SettingsError, match="is no speed"):
        parse_speed(text)
