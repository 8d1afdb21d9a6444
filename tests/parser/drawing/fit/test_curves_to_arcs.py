"""Ellipses and splines to arcs: as few as nodes on the curve allow, never over the tolerance, proved both ways."""

import math
import time
from collections.abc import Callable
from functools import cache

import numpy as np
import pytest

from parser.drawing.dxf.entities import Spline, ellipse_form
from parser.drawing.fit import curves as fit_curves
from parser.drawing.fit.arcs import Drawn
from parser.drawing.fit.curves import arcs_of_ellipses, arcs_of_splines
from parser.drawing.fit.pieces import Fitted, Pieces
from parser.drawing.plane import places_at
from parser.geometry.curves import Curves, Floats
from tests.tools.plain_arc_bounds import at_most_off, ellipse_pieces, spline_pieces

ARC_CONSTANT = 124.7
"""(124.7 t / κ')^⅓ is the length of an arc between nodes on a curve of bend change κ', off by t."""
PROOFS_DIFFER = 1.01
"""Two proofs bound the same distance by coefficients of different polynomials: of the tolerance."""


def _spline(control: Floats, degree: int = 3, weight: Floats | None = None, knot: Floats | None = None) -> Spline:
    number = len(control)
    if knot is None:
        inner = np.linspace(0.0, 1.0, number - degree + 1)
        knot = np.concatenate([np.zeros(degree), inner, np.ones(degree)])
    return Spline(
        np.column_stack([control, np.zeros(number)]), np.ones(number) if weight is None else weight, knot, degree
    )


def _closed_spline(control: Floats) -> Spline:
    """A periodic cubic around control points (n, 2)."""
    round_again = np.concatenate([control, control[:3]])
    return _spline(round_again, knot=np.arange(len(round_again) + 4.0))


def _of_spline(spline: Spline, tolerance_um: float) -> Fitted:
    fitted, refused = arcs_of_splines([spline], tolerance_um)
    assert not len(refused)
    return fitted


def _ellipse(major_um: float, minor_um: float, begin: float = 0.0, end: float = 2.0 * math.pi) -> Floats:
    return ellipse_form(np.zeros(3), np.array([major_um, 0.0, 0.0]), np.array([0.0, minor_um, 0.0]), begin, end)


def _meets(curves: Curves) -> bool:
    return bool((curves.start_um[1:] == curves.end_um[:-1]).all())


def _interpolating(place: Floats, tangent: tuple[Floats, Floats]) -> Spline:
    """The cubic through places (n, 2) with these directions, and unit speed, at the ends."""
    step = np.hypot(*np.diff(place, axis=0).T)
    at = np.concatenate([[0.0], np.cumsum(step)])
    knot = np.concatenate([np.zeros(3), at, np.full(3, at[-1])])
    number = len(place) + 2
    unit = np.eye(number)
    basis = np.stack([places_at(_spline(np.column_stack([row, row]), knot=knot), at)[:, 0] for row in unit], axis=1)
    ends = np.zeros((2, number))
    ends[0, :2] = np.array([-1.0, 1.0]) * 3.0 / knot[4]
    ends[1, -2:] = np.array([-1.0, 1.0]) * 3.0 / (at[-1] - knot[-5])
    control = np.linalg.solve(np.concatenate([basis, ends]), np.concatenate([place, *(one[None] for one in tangent)]))
    return _spline(control, knot=knot)


@cache
def _cam() -> Spline:
    angle = np.linspace(0.0, 2.0 * math.pi, 121)
    radius = 1000.0 * (20.0 + 4.0 * np.cos(angle) + 1.5 * np.cos(2.0 * angle))
    up = np.array([0.0, 1.0])
    return _interpolating(np.column_stack([radius * np.cos(angle), radius * np.sin(angle)]), (up, up))


def _flank() -> Spline:
    """An involute from its base to its tip, module 1 mm, 24 teeth, 20°."""
    base, tip = 12_000.0 * math.cos(math.radians(20.0)), 13_000.0
    roll = np.sqrt(np.linspace(0.0, (tip / base) ** 2 - 1.0, 40))
    place = base * np.column_stack([np.cos(roll) + roll * np.sin(roll), np.sin(roll) - roll * np.cos(roll)])
    last = roll[-1]
    return _interpolating(place, (np.array([1.0, 0.0]), np.array([math.cos(last), math.sin(last)])))


ELLIPSE = _ellipse(20_000.0, 10_000.0)


@cache
def _of_ellipse(tolerance_um: float) -> Fitted:
    fitted, refused = arcs_of_ellipses(ELLIPSE, tolerance_um)
    assert not len(refused)
    return fitted


@pytest.mark.alike(1)
@pytest.mark.parametrize(("tolerance_um", "arcs"), [(1.0, 32), (2.0, 24), (5.0, 18)])
def test_an_ellipse_takes_as_many_arcs_as_nodes_on_it_allow(tolerance_um: float, arcs: int) -> None:
    fitted = _of_ellipse(tolerance_um)
    assert len(fitted.curves) == arcs
    assert fitted.curves.is_arc.all()
    assert fitted.max_um <= tolerance_um
    assert at_most_off(ellipse_pieces(ELLIPSE[0]), fitted.curves) <= PROOFS_DIFFER * fitted.max_um


@pytest.mark.alike(1)
@pytest.mark.parametrize(("tolerance_um", "arcs"), [(1.0, 21), (2.0, 17), (5.0, 12)])
def test_a_cam_drawn_as_a_spline_takes_no_more_arcs_than_the_cam(tolerance_um: float, arcs: int) -> None:
    fitted = _of_spline(_cam(), tolerance_um)
    assert arcs - 1 <= len(fitted.curves) <= arcs
    assert fitted.max_um <= tolerance_um
    assert at_most_off(spline_pieces(_cam()), fitted.curves) <= PROOFS_DIFFER * fitted.max_um


@pytest.mark.parametrize(("tolerance_um", "arcs"), [(1.0, 3), (2.0, 2), (5.0, 2)])
def test_a_flank_of_a_gear_takes_two_or_three_arcs(tolerance_um: float, arcs: int) -> None:
    assert len(_of_spline(_flank(), tolerance_um).curves) == arcs


def _integral(spline: Spline) -> float:
    """∫ |κ'|^⅓ ds, by differences over 20,000 places."""
    at = np.linspace(spline.knot[spline.degree], spline.knot[len(spline.control)], 20_001)
    place = places_at(spline, at)
    by = np.diff(place, axis=0)
    step = np.hypot(*by.T)
    turn = np.arctan2(by[:-1, 0] * by[1:, 1] - by[:-1, 1] * by[1:, 0], (by[:-1] * by[1:]).sum(axis=1))
    bend = turn / (0.5 * (step[1:] + step[:-1]))
    return float((np.cbrt(np.abs(np.diff(bend)) / step[1:-1]) * step[1:-1]).sum())


@pytest.mark.alike(1)
@pytest.mark.parametrize("tolerance_um", [1.0, 1.5, 4.5])
def test_the_last_arc_of_an_ellipse_is_not_short(tolerance_um: float) -> None:
    """About vertices the others cannot all share what it lacks, but those before it can."""
    length = _of_ellipse(tolerance_um).curves.length_um
    angle = np.linspace(0.0, 2.0 * math.pi, 10_000)
    speed = np.hypot(20_000.0 * np.sin(angle), 10_000.0 * np.cos(angle))
    change = np.abs(np.gradient(2e8 / speed**3, angle)) / speed
    assert length.min() > 0.65 * np.cbrt(ARC_CONSTANT * tolerance_um / change.max())


@pytest.mark.alike(1)
@pytest.mark.parametrize("tolerance_um", [0.05, 0.2, 1.0])
def test_the_number_of_arcs_is_that_of_the_closed_form(tolerance_um: float) -> None:
    control = 1000.0 * np.array([(0, 0), (8, 9), (18, -6), (28, 8), (38, -4), (48, 9), (56, 2), (64, 10)])
    spline = _spline(control, weight=np.array([1.0, 0.6, 1.5, 2.0, 0.8, 1.2, 0.7, 1.0]))
    expected = _integral(spline) / np.cbrt(ARC_CONSTANT * tolerance_um)
    assert len(_of_spline(spline, tolerance_um).curves) == pytest.approx(expected, rel=0.03, abs=1.5)


def _random_closed(random: np.random.Generator) -> Spline:
    number = int(random.integers(6, 12))
    angle = 2.0 * math.pi * np.arange(number) / number
    radius = 5000.0 * random.uniform(0.6, 1.6, number)
    return _closed_spline(np.column_stack([radius * np.cos(angle), radius * np.sin(angle)]))


def _random_open(random: np.random.Generator) -> Spline:
    number = int(random.integers(5, 12))
    along = np.cumsum(random.uniform(500.0, 5000.0, number))
    control = np.column_stack([along, random.uniform(-4000.0, 4000.0, number)])
    return _spline(control, int(random.integers(2, 5)), random.uniform(0.5, 2.0, number))


@pytest.mark.alike(1)
@pytest.mark.parametrize("drawn", [_random_closed, _random_open])
def test_arcs_of_any_spline_are_within_the_tolerance_both_ways(drawn: Callable[[np.random.Generator], Spline]) -> None:
    random = np.random.default_rng(4)
    splines = [drawn(random) for _ in range(14)]
    fitted, refused = arcs_of_splines(splines, 2.0)
    assert not len(refused)
    assert fitted.max_um <= 2.0
    for row, spline in enumerate(splines):
        own = fitted.curves.picked(fitted.of == row)
        assert _meets(own)
        assert at_most_off(spline_pieces(spline), own) <= PROOFS_DIFFER * 2.0


def test_arcs_of_any_ellipse_are_within_the_tolerance_both_ways() -> None:
    random = np.random.default_rng(5)
    forms = np.concatenate(
        [
            ellipse_form(
                np.array([*random.uniform(-1e5, 1e5, 2), 0.0]),
                np.array([*random.uniform(-2e4, 2e4, 2), 0.0]),
                np.array([*random.uniform(-2e4, 2e4, 2), 0.0]),
                *random.uniform(0.0, 6.0, 2),
            )
            for _ in range(20)
        ]
    )
    fitted, refused = arcs_of_ellipses(forms, 2.0)
    assert not len(refused)
    for row, form in enumerate(forms):
        own = fitted.curves.picked(fitted.of == row)
        assert (own.start_um[0] == form[:2]).all()
        assert (own.end_um[-1] == form[3:5]).all()
        assert at_most_off(ellipse_pieces(form), own) <= PROOFS_DIFFER * 2.0


def test_curves_that_are_one_but_for_their_places_are_fitted_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """An array of 10,000 stretched circles took 140 s. Each still begins and ends where it is drawn, within 1e-5 µm."""
    looked_at: list[int] = []
    real = fit_curves.arcs_of_pieces

    def counted(pieces: Pieces, drawn: Drawn, tolerance_um: float) -> Fitted:
        looked_at.append(len(drawn.origin_um))
        return real(pieces, drawn, tolerance_um)

    monkeypatch.setattr(fit_curves, "arcs_of_pieces", counted)
    random = np.random.default_rng(6)
    places = np.column_stack([random.uniform(-1e6, 1e6, (2000, 2)), np.zeros(2000)])
    half = np.array([[7000.0, 1000.0, 0.0], [-500.0, 3000.0, 0.0]])
    forms = np.concatenate(
        [ellipse_form(at, *half, 0.0, 4.0 + at_odd) for at, at_odd in zip(places, [0, 1] * 1000, strict=True)]
    )
    fitted, refused = arcs_of_ellipses(forms, 2.0)
    assert (sum(looked_at), len(refused)) == (2, 0)
    spline = _random_open(random)
    splines = [spline._replace(control=spline.control + at) for at in places]
    of_splines, refused = arcs_of_splines(splines, 2.0)
    assert (sum(looked_at), len(refused)) == (3, 0)
    alone_ellipse, _ = arcs_of_ellipses(forms[[77]], 2.0)
    alone_spline, _ = arcs_of_splines([splines[77]], 2.0)
    for made, alone in ((fitted, alone_ellipse), (of_splines, alone_spline)):
        own = made.curves.picked(made.of == 77)
        assert np.abs(own.start_um - alone.curves.start_um).max() <= 1e-5
        assert np.abs(own.end_um - alone.curves.end_um).max() <= 1e-5
        assert np.nanmax(np.abs(own.center_um - alone.curves.center_um), initial=0.0) <= 1e-3
    assert (np.diff(fitted.of) >= 0).all()
    assert len(np.unique(fitted.of)) == 2000


def test_the_bound_is_one_that_is_reached() -> None:
    fitted = _of_ellipse(2.0)
    assert at_most_off(ellipse_pieces(ELLIPSE[0]), fitted.curves) >= 0.99 * fitted.max_um


def test_arcs_of_one_curve_are_equally_full() -> None:
    """No short last arc: on a spiral of even change of bend, all arcs are of one length, within a seventh."""
    turn = np.linspace(0.0, 6.0, 200)
    place = np.cumsum(50.0 * np.column_stack([np.cos(0.1 * turn**2), np.sin(0.1 * turn**2)]), axis=0)
    last = 0.1 * turn[-1] ** 2
    spline = _interpolating(place, (np.array([1.0, 0.0]), np.array([math.cos(last), math.sin(last)])))
    length = _of_spline(spline, 2.0).curves.length_um
    assert len(length) >= 3
    assert length.min() > 0.85 * length.max()


def test_corners_stay_corners() -> None:
    """A cubic whose middle knot is there three times: its corner, of 90°, is a place where curves meet."""
    control = 1000.0 * np.array([(0, 0), (0, 5), (5, 10), (10, 10), (10, 5), (15, 0), (20, 0)])
    spline = _spline(control, knot=np.array([0.0, 0, 0, 0, 1, 1, 1, 2, 2, 2, 2]))
    curves = _of_spline(spline, 2.0).curves
    assert (curves.end_um[:-1] == (10_000.0, 10_000.0)).all(axis=1).any()


def test_a_closed_curve_closes_exactly_and_an_open_one_keeps_its_ends() -> None:
    random = np.random.default_rng(6)
    closed, opened = _of_spline(_random_closed(random), 2.0).curves, _random_open(random)
    assert (closed.start_um[0] == closed.end_um[-1]).all()
    curves = _of_spline(opened, 2.0).curves
    assert curves.start_um[0] == pytest.approx(opened.control[0, :2], abs=1e-9)
    assert curves.end_um[-1] == pytest.approx(opened.control[-1, :2], abs=1e-9)


def test_what_is_straight_becomes_one_line() -> None:
    control = np.column_stack([np.array([0.0, 1000.0, 5000.0, 5100.0, 20_000.0]), np.zeros(5)]) @ [
        [0.6, 0.8],
        [-0.8, 0.6],
    ]
    curves = _of_spline(_spline(control), 2.0).curves
    assert len(curves) == 1
    assert not curves.is_arc.any()


def test_a_point_of_inflection_is_passed() -> None:
    control = 1000.0 * np.array([(0, 0), (5, 8), (10, -8), (15, 0)])
    curves = _of_spline(_spline(control), 2.0).curves
    assert set(np.sign(curves.sweep_rad[curves.is_arc])) == {-1.0, 1.0}
    assert at_most_off(spline_pieces(_spline(control)), curves) <= PROOFS_DIFFER * 2.0


def test_a_cusp_is_passed_within_the_tolerance() -> None:
    """Control points crossed so that the curve stops and turns back in the middle."""
    control = 1000.0 * np.array([(0.0, 0.0), (10.0, 10.0), (0.0, 10.0), (10.0, 0.0)])
    fitted = _of_spline(_spline(control), 2.0)
    assert _meets(fitted.curves)
    assert fitted.max_um <= 2.0
    assert len(fitted.curves) < 60


HOSTILE: dict[str, Spline] = {
    "all places the same": _spline(np.full((6, 2), 7.0)),
    "weights far apart": _spline(
        1000.0 * np.array([(0, 0), (4, 9), (8, -9), (12, 3)]), weight=np.array([1.0, 1e-9, 1e9, 1.0])
    ),
    "back and forth": _spline(1000.0 * np.array([(0, 0), (10, 0), (-10, 0), (10, 0), (0, 0)])),
    "100 m": _spline(1e7 * np.array([(0, 0), (4, 9), (8, -9), (10, 3)])),
    "doubled places": _spline(1000.0 * np.array([(0, 0), (5, 5), (5, 5), (5, 5), (10, 0)])),
}


@pytest.mark.deeper
def test_hostile_splines_end_in_curves_within_the_tolerance_or_are_refused() -> None:
    fitted, refused = arcs_of_splines(list(HOSTILE.values()), 2.0)
    assert fitted.max_um <= 2.0
    assert np.isfinite(fitted.curves.length_um).all()
    for row, name in enumerate(HOSTILE):
        own = fitted.curves.picked(fitted.of == row)
        assert row not in refused or not len(own), name
        assert _meets(own), name


@pytest.mark.parametrize("weight", [-1.0, 0.0, math.nan, math.inf])
def test_a_spline_without_a_place_everywhere_is_refused_alone(weight: float) -> None:
    control = 1000.0 * np.array([(0, 0), (4, 9), (8, -9), (10, 3)])
    bad = _spline(control, weight=np.array([1.0, weight, 1.0, 1.0]))
    fitted, refused = arcs_of_splines([_spline(control), bad, _spline(control + 1.0)], 2.0)
    assert refused.tolist() == [1]
    assert set(fitted.of.tolist()) == {0, 2}


def test_ellipses_of_any_form_are_fitted_within_the_tolerance() -> None:
    forms = [_ellipse(*axes) for axes in ((1e4, 0.01), (1e7, 10.0), (1e8, 1e4), (1.0, 0.5))]
    fitted, refused = arcs_of_ellipses(np.concatenate(forms), 2.0)
    assert not len(refused)
    assert fitted.max_um <= 2.0
    assert set(fitted.of.tolist()) == set(range(len(forms)))
    assert all(_meets(fitted.curves.picked(fitted.of == row)) for row in range(len(forms)))


def _wave(number: int) -> Spline:
    along = np.arange(number)
    return _spline(np.column_stack([1000.0 * along, 3000.0 * np.sin(1.7 * along)]))


def _seconds(number: int) -> float:
    before = time.process_time()
    arcs_of_splines([_wave(number)], 2.0)
    return time.process_time() - before


@pytest.mark.deeper
def test_time_grows_with_the_curve_and_no_faster() -> None:
    """Eight times the spans in less than eight times the time."""
    assert _seconds(400) < 8.0 * max(_seconds(50), 0.02)
