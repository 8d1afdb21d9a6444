"""Words told one block from the end of the other: near the drawn ends, however many blocks and whichever arcs."""

import random

import numpy as np
import pytest
from plain_ends import plain_ends, random_path

from parser.geometry.curves import curves_between
from parser.step_words.chained import arc_of, chained_words, line_of, told_arc_of
from parser.step_words.words import moves, words_of_arcs, words_of_lines, words_of_told_arcs

_MOST_UM = 2.3


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("reach_um", [300.0, 5e4])
def test_every_block_ends_near_its_drawn_end(seed: int, reach_um: float) -> None:
    path = random_path(seed, 250, reach_um)
    told = chained_words(path, np.full((len(path), 2), np.nan), np.zeros(len(path), dtype=np.bool_))
    np.testing.assert_allclose(plain_ends(told.words, path.start_um[0]), told.end_um, atol=1e-5)
    assert np.hypot(*(told.end_um - path.end_um).T).max() <= _MOST_UM


def test_arcs_keep_the_centres_that_they_name() -> None:
    rng = random.Random(5)
    start = np.array([[0.0, 0.0]])
    for _ in range(50):
        out = np.array([[float(rng.randint(50, 9000)), float(rng.randint(50, 9000))]])
        sweep = np.array([rng.uniform(0.3, 6.0)])
        angle = np.arctan2(out[:, 1], out[:, 0]) + sweep
        end = np.rint(start - out + np.hypot(*out.T) * np.column_stack([np.cos(angle), np.sin(angle)]))
        arc = curves_between(start, end, start - out, sweep)
        words = chained_words(arc, -out, np.zeros(1, dtype=np.bool_)).words
        assert (words.x_um[0], words.y_um[0]) == (out[0, 0], out[0, 1])


def test_a_block_begins_where_a_place_is_named() -> None:
    start = np.array([[0.0, 0.0], [10.2, 0.0], [500.75, 3.0]])
    end = np.array([[10.2, 0.0], [500.75, 3.0], [600.0, 3.0]])
    lines = curves_between(start, end, np.full((3, 2), np.nan), np.zeros(3))
    told = chained_words(lines, np.full((3, 2), np.nan), np.array([False, True, False]))
    assert told.end_um.tolist() == [[10.0, 0.0], [500.75, 3.0], [599.75, 3.0]]


def test_no_blocks_have_no_words() -> None:
    nothing = curves_between(*[np.zeros((0, 2))] * 3, np.zeros(0))
    assert len(chained_words(nothing, np.zeros((0, 2)), np.zeros(0, dtype=np.bool_)).words.x_um) == 0


@pytest.mark.parametrize("most_um", [3.0, 400.0, 1e6])
def test_one_arc_is_told_as_arrays_tell_it(most_um: float) -> None:
    """To the last bit: `one_arc` says the same as `telling` and `moves`, also on axes, diagonals and whole turns."""
    rng = np.random.default_rng(int(most_um))
    n = 500
    start = np.where(
        rng.random((n, 1)) < 0.3, rng.integers(-3, 4, (n, 2)) * 500.0, rng.uniform(-1, 1, (n, 2)) * most_um
    )
    by = np.where(rng.random((n, 1)) < 0.1, -2.0 * start, rng.normal(size=(n, 2)) * most_um)
    by = np.where(rng.random((n, 1)) < 0.1, rng.normal(size=(n, 2)), by)
    sweep = rng.uniform(0.001, 2.0 * np.pi, n) * rng.choice([-1.0, 1.0], n)
    end = start + by
    for one, words in (
        (lambda row: line_of(tuple(by[row].tolist())), words_of_lines(by)),
        (lambda row: arc_of(start[row].tolist(), end[row].tolist(), sweep[row]), words_of_arcs(start, end, sweep)),
        (
            lambda row: told_arc_of(start[row].tolist(), by[row].tolist(), sweep[row]),
            words_of_told_arcs(np.rint(start), by, sweep),
        ),
    ):
        ways = moves(words).by_um
        columns = [words.x_um, words.y_um, words.count_um, words.count_axis, words.quadrant, words.turn]
        assert [one(row) for row in range(n)] == [
            (*numbers, tuple(way))
            for numbers, way in zip(np.column_stack(columns).tolist(), ways.tolist(), strict=True)
        ]
