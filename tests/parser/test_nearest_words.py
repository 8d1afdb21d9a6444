"""Paths that are meant as they stand: told in whole µm nearest to them, closed, and on count axes of the rule."""

import numpy as np
import pytest
from plain_ends import plain_ends, random_path

from controller.stepping.steps import interpolate_words
from parser.controller_words import Axis
from parser.geometry.curves import Curves, Floats, curves_between
from parser.step_words.chained import Chained, chained_words
from parser.step_words.looked_at import radii_counted
from parser.step_words.near_blocks import steps_off_um
from parser.step_words.nearest import nearest_words
from parser.step_words.words import moves, words_of_told_arcs

_ASIDE_UM, _AHEAD_UM, _LINE_UM, _CLOSED_UM = 1.0, 2.25, 1.1, 0.5
_ROUNDED_UM = 1.25
"""Rows are told anew until none lies more than 1.2 µm aside; of 400 such contours three lie up to 1.22 µm aside."""
_SHARES = np.linspace(0.0, 1.0, 33)


def told(path: Curves) -> Chained:
    return nearest_words(path, np.zeros(len(path), dtype=np.bool_))


def off_um(path: Curves, words: Chained) -> Floats:
    """(n,) how far what is told of each row lies from its circle or line, at most, along all of it."""
    way = moves(words.words)
    start = np.concatenate([path.start_um[:1], words.end_um[:-1]])
    angle = way.start_angle_rad + _SHARES[:, None] * way.sweep_rad
    arc = start + way.center_um + way.radius_um[:, None] * np.stack([np.cos(angle), np.sin(angle)], axis=2)
    line = start + _SHARES[:, None, None] * (words.end_um - start)
    place = np.where((way.sweep_rad != 0.0)[:, None], arc, line)
    by = path.end_um - path.start_um
    across = np.column_stack([-by[:, 1], by[:, 0]]) / np.hypot(*by.T)[:, None]
    aside = np.abs(((place - path.start_um) * across).sum(axis=2))
    center = np.where(path.is_arc[:, None], path.center_um, 0.0)
    round_ = np.abs(np.hypot(*np.moveaxis(place - center, 2, 0)) - path.radius_um)
    found: Floats = np.where(path.is_arc, round_, aside).max(axis=0)
    return found


def ellipse(rng: np.random.Generator, arcs: int) -> Curves:
    """A closed way of arcs through three places each of an ellipse, led to from a whole place and back."""
    half, turn = rng.uniform(2e3, 3e4, 2), rng.uniform(0.0, 7.0)
    angle = np.linspace(0.0, 2.0 * np.pi, 2 * arcs + 1)[:-1]
    flat = half * np.column_stack([np.cos(angle), np.sin(angle)])
    place = flat @ np.array([[np.cos(turn), np.sin(turn)], [-np.sin(turn), np.cos(turn)]])
    start, middle, end = place[::2], place[1::2], np.roll(place[::2], -1, axis=0)
    one, two = middle - start, end - start
    double = 2.0 * (one[:, 0] * two[:, 1] - one[:, 1] * two[:, 0])
    squares = np.column_stack([(one**2).sum(axis=1), (two**2).sum(axis=1)])
    center = (
        start
        + np.column_stack(
            [
                two[:, 1] * squares[:, 0] - one[:, 1] * squares[:, 1],
                one[:, 0] * squares[:, 1] - two[:, 0] * squares[:, 0],
            ]
        )
        / double[:, None]
    )
    low, high = (np.arctan2(*(at - center).T[::-1]) for at in (start, end))
    return led(start, end, center, (high - low) % (2.0 * np.pi))


def filleted(rng: np.random.Generator, corners: int) -> Curves:
    """A closed way of lines with tangent arcs at all corners, led to from a whole place and back."""
    angle = (np.arange(corners) + rng.uniform(-0.3, 0.3, corners)) * 2.0 * np.pi / corners
    size = 10.0 ** rng.uniform(3.0, 5.0) * rng.uniform(0.5, 1.0, corners)
    corner = size[:, None] * np.column_stack([np.cos(angle), np.sin(angle)])
    way = np.roll(corner, -1, axis=0) - corner
    length = np.hypot(*way.T)
    out = way / length[:, None]
    into = np.roll(out, 1, axis=0)
    turn = np.arctan2(into[:, 0] * out[:, 1] - into[:, 1] * out[:, 0], (into * out).sum(axis=1))
    cut = (np.minimum(length, np.roll(length, 1)) * rng.uniform(0.1, 0.4, corners))[:, None]
    start, end = corner - cut * into, corner + cut * out
    radius = cut / np.tan(0.5 * turn)[:, None]
    center = start + radius * np.column_stack([-into[:, 1], into[:, 0]])
    places = np.stack([start, end], axis=1).reshape(-1, 2)
    nothing = np.full_like(center, np.nan)
    centers = np.stack([center, nothing], axis=1).reshape(-1, 2)
    return led(places, np.roll(places, -1, axis=0), centers, np.column_stack([turn, 0.0 * turn]).reshape(-1))


def rounded(rng: np.random.Generator) -> Curves:
    """A rectangle turned by 45° or so, whose corners are quarters of a turn, led to from a whole place and back.

    The arcs end at 45° to both axes: about other centres in whole µm they end in steps of 2 µm.
    """
    turn = 0.25 * np.pi + rng.uniform(-0.05, 0.05)
    x, y = rng.uniform(300.0, 3000.0, 2)
    out = rng.uniform(200.0, 2000.0)
    flat = [(-x, -y - out), (x, -y - out), (x + out, -y), (x + out, y), (x, y + out), (-x, y + out), (-x - out, y)]
    places = np.array([*flat, (-x - out, -y)])
    centers = np.full((8, 2), np.nan)
    centers[1::2] = [(x, -y), (x, y), (-x, y), (-x, -y)]
    turned = np.array([[np.cos(turn), np.sin(turn)], [-np.sin(turn), np.cos(turn)]])
    at = 20e3 + rng.uniform(0.0, 1.0, 2)
    sweep = np.tile([0.0, 0.5 * np.pi], 4)
    return led(places @ turned + at, np.roll(places, -1, axis=0) @ turned + at, centers @ turned + at, sweep)


def led(start: Floats, end: Floats, center: Floats, sweep: Floats) -> Curves:
    thread, nothing = np.rint(1.2 * start[:1]), np.full((1, 2), np.nan)
    return curves_between(
        np.concatenate([thread, start, start[:1]]),
        np.concatenate([start[:1], end, thread]),
        np.concatenate([nothing, center, nothing]),
        np.concatenate([[0.0], sweep, [0.0]]),
    )


@pytest.mark.parametrize("reach_um", [300.0, 5e3, 5e4])
def test_blocks_end_near_their_drawn_ends_by_the_plain_rules(reach_um: float) -> None:
    path = random_path(7, 500, reach_um)
    words = told(path)
    np.testing.assert_allclose(plain_ends(words.words, path.start_um[0]), words.end_um, atol=1e-5)
    off = words.end_um - path.end_um
    assert np.hypot(*off.T).max() <= _AHEAD_UM
    aside = np.concatenate([off * across(path, path.end_um), off[:-1] * across(path, path.start_um)[1:]])
    assert np.abs(aside.sum(axis=1)).max() <= _ASIDE_UM


def across(path: Curves, place: Floats) -> Floats:
    """Unit vectors (n, 2) across lines, and across arcs at places on them."""
    by = path.end_um - path.start_um
    out = np.where(path.is_arc[:, None], place - path.center_um, np.column_stack([-by[:, 1], by[:, 0]]))
    unit: Floats = out / np.hypot(*out.T)[:, None]
    return unit


def stepped_off_um(path: Curves, words: Chained) -> Floats:
    """(n,) how far the steps of the blocks so far end from where their words do."""
    stepped = path.start_um[0] + interpolate_words(words.words, path.length_um).corner_um[1:]
    off: Floats = np.hypot(*(stepped - words.end_um).T)
    return off


@pytest.mark.alike(1)
@pytest.mark.parametrize(("arcs", "most_um"), [(50, 2.5), (200, 4.5), (1000, 6.0)])
def test_what_steps_are_off_does_not_add_up_over_arcs(arcs: int, most_um: float) -> None:
    """Told without a look at the steps, they end up to 6, 19 and 81 µm beside their words."""
    for seed in range(5):
        path = ellipse(np.random.default_rng(seed), arcs)
        words = told(path)
        assert stepped_off_um(path, words).max() <= most_um
        assert off_um(path, words).max() <= 1.0


@pytest.mark.parametrize("seed", range(20))
def test_a_short_arc_is_run_back_about_the_centre_that_it_had_ahead(seed: int) -> None:
    """1 µm at an end moves the centre of an arc of 41 mm that is 220 µm long by 200 µm."""
    rng = np.random.default_rng(seed)
    low, sweep, radius = rng.uniform(0.0, 7.0), 220.0 / 41e3, 41e3
    ahead = radius * np.array([[np.cos(low), np.sin(low)], [np.cos(low + sweep), np.sin(low + sweep)]])
    there, here = ahead[1:], ahead[:1]
    path = curves_between(
        np.concatenate([here, there]), np.concatenate([there, here]), np.zeros((2, 2)), np.array([sweep, -sweep])
    )
    words = told(path)
    start = np.concatenate([here, words.end_um[:1]])
    one, other = start + moves(words.words).center_um
    assert np.hypot(*(one - other)) <= 8.0
    assert np.hypot(*(words.end_um[1] - here[0])) <= _CLOSED_UM


@pytest.mark.parametrize("reach_um", [30.0, 3e3, 3e5])
def test_steps_of_an_arc_end_where_the_controller_makes_them(reach_um: float) -> None:
    rng = np.random.default_rng(5)
    start = np.rint(rng.uniform(-reach_um, reach_um, (300, 2)))
    start = start[np.hypot(*start.T) > 3.0]
    sweep = rng.uniform(0.1, 6.2, len(start)) * rng.choice([-1.0, 1.0], len(start))
    cosine, sine = np.cos(sweep), np.sin(sweep)
    end = np.column_stack([start[:, 0] * cosine - start[:, 1] * sine, start[:, 0] * sine + start[:, 1] * cosine])
    arcs = curves_between(start, end, np.zeros_like(start), sweep)
    words = words_of_told_arcs(start, end - start, sweep)
    rows = np.flatnonzero(words.turn)
    assert len(rows) > 200
    goes, radii = moves(words).by_um, radii_counted(arcs, words.count_axis)
    made = np.diff(interpolate_words(words, np.ones(len(start))).corner_um, axis=0)
    for row in rows.tolist():
        at, ends, turn = start[row : row + 1], (start + goes)[row : row + 1], float(np.sign(sweep[row]))
        off = steps_off_um(at, ends, int(radii[row]), turn, int(words.count_axis[row]))
        np.testing.assert_allclose(goes[row] + off[0], made[row], atol=1e-6)


def test_paths_lie_nearer_than_those_of_a_cam() -> None:
    path = random_path(8, 3000, 5e3)
    cam = chained_words(path, np.full((len(path), 2), np.nan), np.zeros(len(path), dtype=np.bool_))
    ours, theirs = off_um(path, told(path)), off_um(path, cam)
    assert ours.max() < 0.85 * theirs.max()
    assert np.median(ours) < 0.85 * np.median(theirs)
    assert ours[~path.is_arc].max() <= _LINE_UM


@pytest.mark.parametrize("seed", range(40))
def test_a_way_of_arcs_closes_and_lies_within_a_um(seed: int) -> None:
    rng = np.random.default_rng(seed)
    path = ellipse(rng, int(rng.integers(12, 60)))
    words = told(path)
    assert np.hypot(*(words.end_um[-2] - words.end_um[0])) <= _CLOSED_UM
    assert np.hypot(*(words.end_um[-1] - path.start_um[0])) <= _CLOSED_UM
    assert off_um(path, words).max() <= 1.0


@pytest.mark.parametrize("seed", range(60))
def test_a_way_of_lines_and_fillets_closes(seed: int) -> None:
    rng = np.random.default_rng(seed)
    path = filleted(rng, int(rng.integers(4, 12)))
    words = told(path)
    assert np.hypot(*(words.end_um[-2] - words.end_um[0])) <= _CLOSED_UM
    assert np.hypot(*(words.end_um[-1] - path.start_um[0])) <= _CLOSED_UM
    assert off_um(path, words).max() <= 1.6


def test_count_axes_are_those_of_the_rule() -> None:
    path = random_path(9, 3000, 5e3)
    words = told(path)
    way = moves(words.words)
    out = np.abs(way.by_um - way.center_um)
    ruled = np.where(out[:, 0] > out[:, 1], Axis.Y, Axis.X)
    clear = (way.sweep_rad != 0.0) & (np.abs(out[:, 0] - out[:, 1]) > 5.0)  # nearer to 45° both axes do
    assert (words.words.count_axis == ruled)[clear].all()


def test_whole_um_stay_as_they_are() -> None:
    start = np.array([[0.0, 0.0], [5000.0, 0.0], [0.0, 5000.0], [0.0, 0.0]])
    end = np.roll(start, -1, axis=0)
    sweep = np.array([0.0, 0.5 * np.pi, 0.0, 2.0 * np.pi])
    center = np.array([[np.nan, np.nan], [0.0, 0.0], [np.nan, np.nan], [-701.0, 0.0]])
    words = told(curves_between(start, end[[0, 1, 2, 3]] * [[1.0], [1.0], [1.0], [0.0]], center, sweep)).words
    assert words.x_um.tolist() == [5000, 5000, 0, 701]
    assert words.y_um.tolist() == [0, 0, 5000, 0]
    assert words.count_um.tolist() == [5000, 5000, 5000, 2804]


def test_a_path_that_comes_to_a_place_again_ends_where_it_was() -> None:
    """Back over the same curves: each end within half a µm of where the way there had it."""
    there = ellipse(np.random.default_rng(3), 24).picked(slice(1, 20))
    back = curves_between(
        there.end_um[::-1], there.start_um[::-1], there.center_um[::-1], np.array(-there.sweep_rad[::-1])
    )
    path = curves_between(
        *(
            np.concatenate([getattr(way, name) for way in (there, back)])
            for name in ("start_um", "end_um", "center_um")
        ),
        np.concatenate([there.sweep_rad, back.sweep_rad]),
    )
    ends = np.concatenate([path.start_um[:1], told(path).end_um])
    n = len(there)
    assert np.hypot(*(ends[n + 1 :] - ends[n - 1 :: -1]).T).max() <= 0.6


@pytest.mark.alike(1)
@pytest.mark.parametrize("seed", range(40))
def test_a_contour_closes_whose_arcs_can_end_only_two_um_from_each_other(seed: int) -> None:
    """Where lines took no other whole µm than the nearest, one in six missed by 0.9 µm or lay up to 2.1 µm aside."""
    path = rounded(np.random.default_rng(seed))
    words = told(path)
    assert np.hypot(*(words.end_um[-2] - words.end_um[0])) <= _CLOSED_UM
    assert off_um(path, words)[1:-1].max() <= _ROUNDED_UM


def test_a_row_that_is_placed_ends_at_the_very_place() -> None:
    start = np.array([[0.0, 0.0], [10.2, 0.0], [500.75, 3.0]])
    end = np.array([[10.2, 0.0], [500.75, 3.0], [600.0, 3.0]])
    lines = curves_between(start, end, np.full((3, 2), np.nan), np.zeros(3))
    assert nearest_words(lines, np.array([False, True, False])).end_um[1].tolist() == [500.75, 3.0]


def test_no_curves_have_no_words() -> None:
    nothing = curves_between(*[np.zeros((0, 2))] * 3, np.zeros(0))
    assert len(told(nothing).words.x_um) == 0
