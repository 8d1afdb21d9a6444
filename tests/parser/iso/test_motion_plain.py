"""Paths of random programs, block for block, against a plain interpreter that keeps its state in hand."""

import numpy as np
import pytest

from parser.dialect.reader import Choices
from parser.program import parse_program
from parser.toolpath import Toolpath
from tests.tools.plain_iso import PlainIso, PlainRow
from tests.tools.random_iso import random_iso

SEEDS = range(60)
UM = 1e-6


def read(text: str) -> Toolpath:
    return parse_program(text, choices=Choices(dialect="common", unit="um")).toolpath


def done(text: str) -> PlainIso:
    plain = PlainIso(text.splitlines())
    plain.run()
    return plain


def complex_of(pairs: np.ndarray) -> np.ndarray:
    return pairs[:, 0] + 1j * pairs[:, 1]


@pytest.mark.parametrize("seed", SEEDS)
def test_blocks_go_where_a_plain_interpreter_goes(seed: int) -> None:
    text = random_iso(seed)
    toolpath, plain = read(text), done(text)
    assert toolpath.kind.tolist() == [row.kind for row in plain.rows]
    assert toolpath.source.line.tolist() == [row.line for row in plain.rows]
    assert toolpath.source.label == tuple(row.label for row in plain.rows)
    np.testing.assert_allclose(complex_of(toolpath.start_um), [row.start for row in plain.rows], rtol=1e-12, atol=UM)
    np.testing.assert_allclose(complex_of(toolpath.end_um), [row.end for row in plain.rows], rtol=1e-12, atol=UM)
    assert [(stop.kind, stop.after, stop.line) for stop in toolpath.stops] == plain.stops


@pytest.mark.parametrize("seed", SEEDS)
def test_arcs_turn_about_the_centres_of_a_plain_interpreter(seed: int) -> None:
    text = random_iso(seed)
    toolpath = read(text)
    arcs: list[PlainRow] = [row for row in done(text).rows if row.center is not None]
    assert toolpath.is_arc.sum() == len(arcs)
    of = toolpath.picked(toolpath.is_arc)
    np.testing.assert_allclose(complex_of(of.center_um), [row.center for row in arcs], rtol=1e-9, atol=1e-3)
    np.testing.assert_allclose(of.sweep_rad, [row.sweep for row in arcs], rtol=1e-9, atol=1e-9)
    assert (of.radius_um > 0).all()
    angles = np.angle(complex_of(of.start_um) - complex_of(of.center_um))
    np.testing.assert_allclose(of.start_angle_rad, angles, rtol=1e-9, atol=1e-9)
    straight = toolpath.picked(~toolpath.is_arc)
    assert np.isnan([straight.start_angle_rad, straight.radius_um, *straight.center_um.T]).all()
    assert not straight.sweep_rad.any()


@pytest.mark.parametrize("seed", SEEDS)
def test_registers_hold_what_a_plain_interpreter_holds(seed: int) -> None:
    text = random_iso(seed)
    compensation, plain = read(text).compensation, done(text).rows
    sides = [row.side for row in plain]
    if not any(sides):
        assert compensation is None
        return
    assert compensation is not None
    assert compensation.side.tolist() == sides
    assert compensation.register == tuple(row.register for row in plain)
    np.testing.assert_allclose(compensation.by_um, [row.by for row in plain], rtol=1e-12)


def test_the_random_programs_say_all_that_is_compared() -> None:
    plain = [done(random_iso(seed)) for seed in SEEDS]
    rows = [row for one in plain for row in one.rows]
    assert {row.kind for row in rows} == {0, 1, 2}
    assert {row.side for row in rows} == {-1, 0, 1}
    assert any(abs(row.sweep) == np.pi * 2 for row in rows)
    assert any(np.isnan(row.by) for row in rows) or any(row.register == "" for row in rows)
    assert any(one.shift for one in plain)
