"""Two contours of a wire that leans, each offset in its own plane: held to distances, and partners to their blocks."""

import numpy as np
import pytest
import shapely
from depth import cases
from tilted_paths import contour, random_pair

from controller.offset.compensate import compensate
from controller.offset.shifted import OffsetSection, Side
from controller.taper.two_contours import Matched, matched_offsets
from parser.geometry.along import places
from parser.geometry.curves import Curves, Floats

BY_UM = 100.0
_PLACES = 400


def offset(lower: Curves, upper: Curves, side: Side) -> Matched:
    section = OffsetSection(0, len(lower) - 1, closed=True)
    return matched_offsets(*(compensate(of, [section], BY_UM, side) for of in (lower, upper)))


def along(curves: Curves, row: int) -> Floats:
    """Places (k, 2) of a row, near each other."""
    return places(curves, np.full(_PLACES, row), np.linspace(0.0, 1.0, _PLACES))


def beside(curves: Curves, drawn: Curves) -> tuple[Floats, list[int]]:
    """How near each row comes to a drawn contour, and the drawn row that it runs beside; −1 round a corner of two."""
    blocks = np.array([shapely.LineString(along(drawn, row)) for row in range(len(drawn))])
    least, nearest = [], []
    for row in range(len(curves)):
        near = np.stack([shapely.distance(shapely.points(along(curves, row)), block) for block in blocks])
        least.append(near.min())
        first, second = np.argsort(near[:, _PLACES // 2])[:2]
        is_corner = near[second, _PLACES // 2] - near[first, _PLACES // 2] < 0.1
        nearest.append(-1 if is_corner else int(first))
    return np.array(least), nearest


@pytest.mark.deep
@pytest.mark.parametrize("side", [Side.LEFT, Side.RIGHT])
@pytest.mark.parametrize("seed", cases(6, 200))
def test_each_plane_has_the_offset_of_its_own_contour(seed: int, side: Side) -> None:
    toolpath, upper, _ = random_pair(seed)
    drawn = toolpath.picked(slice(None)), upper
    made = offset(*drawn, side)
    runs = (made.lower.length_um > 1.0) & (made.upper.length_um > 1.0)
    runs[[0, -1]] = False  # what leads in and out
    partners = []
    for of, found in zip(drawn, (made.lower, made.upper), strict=True):
        assert np.abs(found.end_um[:-1] - found.start_um[1:]).max() < 1e-6
        least, nearest = beside(found, of)
        assert least[runs] == pytest.approx(BY_UM, abs=0.05)
        partners.append(np.array(nearest)[runs])
    straight = (partners[0] >= 0) & (partners[1] >= 0)
    assert partners[0][straight].tolist() == partners[1][straight].tolist() == list(range(len(upper)))


def test_where_one_plane_goes_round_a_corner_the_other_end_stands() -> None:
    # Both turn by more than a right angle at the same corner: the lower one by 135°, the upper one by 60°.
    lower, upper = (contour([(0, 0), (20, 0), far, (0, 15), (0, 0)]) for far in ((8, 12), (25.77, 10)))
    made = offset(lower, upper, Side.RIGHT)
    stands = np.flatnonzero((made.upper.length_um == 0.0) & (made.lower.length_um > 0.0))
    assert made.lower.is_arc[stands].any()
    before = made.upper.end_um[stands - 1]
    assert made.upper.start_um[stands] == pytest.approx(before)
