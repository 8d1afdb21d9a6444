"""The least distance of curves from a contour in closed form, held against many places along them."""

import numpy as np
import pytest
from cam_contours import circle, contour

from parser.geometry.curves import Curves, Floats
from parser.geometry.distance import distance_to_curves
from sim.make.cam.convex import clearance_um

SHAPES = {
    "lines": contour([(0.0, 0.0), (3000.0, -700.0), (4000.0, 2500.0), (-500.0, 2000.0)]),
    "arcs": contour([(0.0, 0.0), (3000.0, -700.0), (4000.0, 2500.0), (-500.0, 2000.0)], [0.5, -0.3, 1.5, -0.2]),
    "circle": circle(2000.0),
}


def sampled(closed: Curves, curves: Curves) -> Floats:
    share = np.linspace(0.0, 1.0, 4001)
    found = []
    for row in range(len(curves)):
        angle = curves.start_angle_rad[row] + share * curves.sweep_rad[row]
        on_arc = curves.center_um[row] + curves.radius_um[row] * np.stack([np.cos(angle), np.sin(angle)], axis=1)
        on_line = curves.start_um[row] + share[:, None] * (curves.end_um[row] - curves.start_um[row])
        place = on_arc if curves.is_arc[row] else on_line
        away = [
            distance_to_curves(closed, np.full(len(share), of), place[:, 0], place[:, 1])[0]
            for of in range(len(closed))
        ]
        found.append(float(np.min(away)))
    return np.array(found)


@pytest.mark.parametrize("name", SHAPES)
@pytest.mark.parametrize("seed", range(6))
def test_no_place_along_a_curve_is_nearer_than_told_and_one_is_as_near(name: str, seed: int) -> None:
    rng = np.random.default_rng(seed)
    corners = rng.uniform(-4000.0, 6000.0, (12, 2))
    curves = contour([tuple(corner) for corner in corners.tolist()], rng.choice([0.0, 0.1, -0.4, 1.2], 12).tolist())
    told, places = clearance_um(SHAPES[name], curves, 1e5), sampled(SHAPES[name], curves)
    apart = np.flatnonzero(places > 10.0)  # curves that cross are told nothing of
    assert len(apart) >= 3
    assert (told[apart] <= places[apart] + 1e-6).all()
    assert told[apart] == pytest.approx(places[apart], abs=2.0)


def test_a_large_contour_gives_the_same_as_its_curves_one_by_one() -> None:
    angle = np.linspace(0.0, 2.0 * np.pi, 600, endpoint=False)
    radius = 20_000.0 + 500.0 * np.cos(30.0 * angle)
    large = contour([tuple(at) for at in np.stack([radius * np.cos(angle), radius * np.sin(angle)], axis=1).tolist()])
    corners = [(19_000.0, 0.0), (18_900.0, 900.0), (0.0, 19_300.0), (-900.0, 18_000.0), (-18_900.0, 0.0)]
    curves = contour([*corners, (-15_000.0, -9000.0), (0.0, -18_000.0), (9000.0, -15_000.0)])
    pieces = [clearance_um(large.picked(slice(at, at + 100)), curves, 3000.0) for at in range(0, 600, 100)]
    assert clearance_um(large, curves, 3000.0) == pytest.approx(np.minimum.reduce(pieces))
