"""The broad phase of crossings: which blocks come near each other."""

import numpy as np
import pytest

from parser.geometry.curves import Curves, Floats, curves_between
from parser.geometry.near import NearPairs, near_pairs

_ALL = 1 << 40


@pytest.mark.parametrize("long_um", [100.0, 3000.0], ids=["of like lengths", "some of many pieces"])
def test_all_blocks_that_meet_are_a_pair_each_once(long_um: float) -> None:
    curves = _scattered(400, long_um)
    contour = np.arange(len(curves)) % 3
    pairs = near_pairs(curves, contour, 10.0, _ALL)
    found = _as_set(pairs)
    assert len(found) == len(pairs.early)
    assert (pairs.early < pairs.late).all()
    assert (contour[pairs.early] == contour[pairs.late]).all()
    missing = {(a, b) for a, b in _meeting(curves) if contour[a] == contour[b]} - found
    assert not missing


def test_a_limit_leaves_pairs_out_and_says_so() -> None:
    curves = _scattered(200, 100.0)
    contour = np.zeros(len(curves), dtype=np.int64)
    every = near_pairs(curves, contour, 10.0, _ALL)
    sizes = []
    for most in (0, 10, 100, 1000, _ALL):
        some = near_pairs(curves, contour, 10.0, most)
        assert _as_set(some) <= _as_set(every)
        assert some.incomplete.tolist() == ([] if most == _ALL else [0])
        sizes.append(len(some.early))
    assert sizes == sorted(sizes)
    assert sizes[0] == 0
    assert sizes[-1] == len(every.early)


def test_blocks_that_all_lie_on_one_another_are_held_against_each_other_up_to_the_limit() -> None:
    start = np.zeros((20_000, 2))
    curves = curves_between(start, np.add(start, [100.0, 7.0]), start, np.zeros(len(start)))
    pairs = near_pairs(curves, np.zeros(len(start), dtype=np.int64), 10.0, 50_000)
    assert 0 < len(pairs.early) <= 50_000
    assert pairs.incomplete.tolist() == [0]


def _as_set(pairs: NearPairs) -> set[tuple[int, int]]:
    return set(zip(pairs.early.tolist(), pairs.late.tolist(), strict=True))


def _scattered(number: int, long_um: float) -> Curves:
    """Lines of about 100 µm in a field of 1 mm, every tenth one `long_um` long."""
    rng = np.random.default_rng(7)
    start, angle = rng.uniform(-500.0, 500.0, (number, 2)), rng.uniform(0.0, 2.0 * np.pi, number)
    length = np.where(np.arange(number) % 10 == 0, long_um, rng.uniform(60.0, 140.0, number))
    end = start + length[:, None] * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    return curves_between(start, end, start, np.zeros(number))


def _meeting(curves: Curves) -> list[tuple[int, int]]:
    """Each two lines of which the ends of each lie on both sides of the other."""
    a, b = curves.start_um, curves.end_um
    way = b - a

    def side(place: Floats) -> Floats:
        off = place[None, :, :] - a[:, None, :]
        sign: Floats = np.sign(way[:, None, 0] * off[:, :, 1] - way[:, None, 1] * off[:, :, 0])
        return sign

    parts = side(a) * side(b) < 0.0
    return [(i, j) for i, j in np.argwhere(parts & parts.T).tolist() if i < j]
