"""Columns of curves alone, exact: pages draw by them what was run, and what never was."""

from typing import Any

import numpy as np

from parser.geometry.curves import CurveKind, Curves, Floats
from sim.base.rounded import column

_ANGLE_DIGITS = 12
"""On a radius of a metre they tell a place to 10⁻⁶ µm, as its own digits do."""


def exact_columns(path: Curves) -> dict[str, list[Any]]:
    """Columns of n curves, each from the end of the last one, that pages draw a path by; `place_*` have n + 1."""
    place = np.concatenate([path.start_um[:1], path.end_um])
    return {
        "kind": [CurveKind(kind).name.lower() for kind in path.kind.tolist()],
        **_pairs("place", place),
        **_pairs("center", path.center_um),
        "radius_um": column(path.radius_um),
        "start_angle_rad": column(path.start_angle_rad, _ANGLE_DIGITS),
        "sweep_rad": column(path.sweep_rad, _ANGLE_DIGITS),
        "length_um": column(path.length_um),
    }


def _pairs(name: str, place_um: Floats) -> dict[str, list[float | None]]:
    return {f"{name}_{axis}_um": column(place_um[:, at]) for at, axis in enumerate("xy")}
