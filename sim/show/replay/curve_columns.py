"""Columns of curves alone, exact: pages draw by them what was run, and what never was."""

from collections.abc import Iterator
from itertools import pairwise
from typing import Any

import numpy as np

from parser.drawing.model import Drawing
from parser.geometry.curves import CurveKind, Curves, Floats, joined, jump_between
from sim.base.rounded import column
from sim.measure.compare.starts import Placement, laid_loops

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


def drawing_columns(drawing: Drawing, placement: Placement) -> dict[str, list[Any]]:
    """Columns that pages draw a drawing by as it is laid: its loops one behind the other, with jumps between them."""
    return exact_columns(joined(list(_with_jumps(laid_loops(drawing, placement)))))


def _with_jumps(loops: list[Curves]) -> Iterator[Curves]:
    """Each loop, and before it the jump from the end of the last."""
    yield from loops[:1]
    for before, behind in pairwise(loops):
        yield jump_between(before.end_um[-1], behind.start_um[0])
        yield behind


def _pairs(name: str, place_um: Floats) -> dict[str, list[float | None]]:
    return {f"{name}_{axis}_um": column(place_um[:, at]) for at, axis in enumerate("xy")}
