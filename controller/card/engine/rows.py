"""Rows: entries that move as columns, their path and what limits them."""

import math
from collections.abc import Sequence

import numpy as np

from controller.card.core.settings import AXES, CardSettings
from controller.card.engine.entries import Pace, PathEntry, Place, Segment, Stepped
from controller.card.engine.speeds import Speeds
from controller.motion.path import Path
from controller.motion.planner import RowLimits
from controller.stepping.steps import Steps
from parser.geometry.curves import Floats


def path_of_segments(rows: Sequence[PathEntry]) -> Path:
    """Path of n lines and arcs in four axes."""
    lines = [row for row in rows if isinstance(row, Segment)]
    start, tangent, normal = (
        np.array([row[field] for row in lines], dtype=np.float64).reshape(-1, AXES)
        for field in (Segment._fields.index(name) for name in ("start", "tangent", "normal"))
    )
    curvature = np.array([row.curvature for row in lines], dtype=np.float64)
    return Path(start, tangent, normal, curvature, np.array([row.length_um for row in lines], dtype=np.float64))


def path_of_blocks(rows: Sequence[PathEntry], steps: Steps, place: Place, at_um: tuple[int, int, int, int]) -> Path:
    """Ideal path of n stepped blocks, each from where the steps of the one before it end, the first as far as left."""
    blocks = [row for row in rows if isinstance(row, Stepped)]
    n = len(blocks)
    extent = np.array([(b.x_um, b.y_um) for b in blocks], dtype=np.float64)
    signs = np.array([_SIGNS[b.quadrant] for b in blocks], dtype=np.float64)
    turn = np.array([b.turn for b in blocks], dtype=np.float64)
    outward = extent * signs / np.hypot(*extent.T)[:, None]
    arc = turn != 0.0
    turned = np.stack([-outward[:, 1], outward[:, 0]], axis=1) * turn[:, None]
    start = np.tile(np.array(place), (n, 1))
    start[:, :2] = steps.corner_um[:-1] + np.array(at_um[:2]) - steps.place_after(blocks[0].done)
    still = np.zeros((n, AXES - 2))
    path = Path(
        start_um=start,
        tangent=np.hstack([np.where(arc[:, None], turned, outward), still]),
        normal=np.hstack([np.where(arc[:, None], -outward, 0.0), still]),
        curvature=np.where(arc, 1.0 / np.hypot(*extent.T), 0.0),
        length_um=np.array([b.length_um for b in blocks]),
    )
    return path.rest(blocks[0].offset_um) if blocks[0].offset_um else path


_SIGNS = ((0, 0), (1, 1), (-1, 1), (-1, -1), (1, -1))
"""Signs of X and Y in quadrants 1 to 4."""


def limits_of(
    rows: Sequence[PathEntry], waits_s: Floats, path: Path, speeds: Speeds, settings: CardSettings
) -> RowLimits:
    """What the plan of the n rows has to keep, with waits (n + 1,) s at their borders.

    The path speed is carried through a junction at the lower of both speeds, or each entry ends at the start speed,
    as the settings say; an end speed set for the entry comes first. The path begins and ends with the start speed.
    """
    paces = [row.pace for row in rows]
    speed = np.array([speeds.run_at(pace) for pace in paces], dtype=np.float64)
    speed = np.minimum(speed, settings.pulse_limit_hz / _fastest_axis(path))
    border = np.full(len(rows) + 1, speeds.start_um_s)
    if rows:
        carried = np.minimum(speed[:-1], speed[1:]) if settings.carries_speed else border[1:-1]
        set_for = np.array([_end_speed(pace) for pace in paces[:-1]], dtype=np.float64)
        border[1:-1] = np.maximum(np.where(np.isnan(set_for), carried, set_for), speeds.start_um_s)
        border[waits_s > 0.0] = speeds.start_um_s
    acceleration = np.array([pace.acceleration_um_s2 for pace in paces], dtype=np.float64)
    return RowLimits(path.length_um, speed, acceleration, border, waits_s)


def _end_speed(pace: Pace) -> float:
    return math.nan if pace.end_um_s is None else pace.end_um_s


def _fastest_axis(path: Path) -> Floats:
    """Most of the path speed that one axis can have (n,): on an arc all of it, which is more than a short arc has."""
    along = np.abs(path.tangent).max(axis=1, initial=0.0)
    return np.where((path.curvature > 0.0) | (along == 0.0), 1.0, along)
