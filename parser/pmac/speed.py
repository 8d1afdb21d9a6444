"""What the card makes of speeds: blocks shorter than the acceleration time, corners that it rounds, F and its unit.

Sources: PMAC User's Manual on TA, TS and blending (docs/pmac.md §5).
"""

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from parser.findings.findings import Value
from parser.geometry.curves import Bools, CurveKind, Floats, Ints
from parser.pmac.state import Move
from parser.toolpath import Toolpath
from parser.units import from_mm

DEFAULT_UNIT_MS = 1000.0
"""Time unit of F where nothing sets it (Isx90)."""
ROUNDING_UM = 10.0
"""Corners that are rounded by less are not told: the wire's own lag rounds as much."""
_SAME = 0.99  # a block of just the acceleration time runs at its speed


class Slow(NamedTuple):
    """Something about speeds at a row: the code of its finding and its values."""

    code: str
    row: int
    values: dict[str, Value]


def speed_findings(toolpath: Toolpath, moves: Sequence[Move], unit_ms: float | None) -> Iterator[Slow]:
    """PMC204 to PMC206 and PMC208, each once for the whole program."""
    cut = toolpath.kind != CurveKind.JUMP
    if not cut.any():
        return
    feed = np.array([np.nan if move.feed is None else move.feed for move in moves])
    ramp = np.array([move.ramp_ms for move in moves])
    known = cut & ~np.isnan(feed) & ~np.isnan(ramp)
    told_rows = np.flatnonzero(known)
    silent = np.flatnonzero(cut & np.array([move.feed is None for move in moves]))
    if len(silent):
        yield _at("PMC208", int(silent[0]), {})
    if not len(told_rows):
        return
    if unit_ms is None:
        yield _at("PMC206", int(told_rows[0]), {"feed": float(feed[told_rows[0]])})
    speed = from_mm(feed) / (unit_ms or DEFAULT_UNIT_MS)
    yield from _too_short(toolpath, told_rows, speed, ramp, feed)
    yield from _rounded(toolpath, moves, known, _reached(toolpath, speed, ramp), ramp)


def _too_short(toolpath: Toolpath, told_rows: Ints, speed: Floats, ramp: Floats, feed: Floats) -> Iterator[Slow]:
    """PMC204 at the block that runs slowest of its F."""
    share = toolpath.length_um[told_rows] / (speed[told_rows] * np.where(ramp[told_rows] > 0.0, ramp[told_rows], 1e-9))
    short = np.flatnonzero((share < _SAME) & (share > 0.0))
    if not len(short):
        return
    worst = short[int(np.argmin(share[short]))]
    row = int(told_rows[worst])
    values: dict[str, Value] = {
        "time": float(toolpath.length_um[row] / speed[row]),
        "ramp": float(ramp[row]),
        "feed": float(feed[row]),
        "runs": float(feed[row] * share[worst]),
        "more": len(short) - 1,
    }
    yield _at("PMC204", row, values)


def _reached(toolpath: Toolpath, speed: Floats, ramp: Floats) -> Floats:
    """(n,) speeds that the blocks reach, µm/ms: a block takes the acceleration time at least."""
    return np.where(ramp > 0.0, np.minimum(speed, toolpath.length_um / np.where(ramp > 0.0, ramp, 1.0)), speed)


def _rounded(toolpath: Toolpath, moves: Sequence[Move], known: Bools, speed: Floats, ramp: Floats) -> Iterator[Slow]:
    """PMC205 at the corner that is rounded most.

    The velocity changes evenly from one block to the next: its change times TA, by 8, is how far the path passes the
    corner. At a right angle this is v · TA · √2 / 8.
    """
    blends = np.array([move.blends for move in moves])
    corner = np.flatnonzero(known[1:] & known[:-1] & blends[1:]) + 1
    if not len(corner):
        return
    before = speed[corner - 1, None] * _heading(toolpath, corner - 1, at_end=True)
    behind = speed[corner, None] * _heading(toolpath, corner, at_end=False)
    passed = np.hypot(*(behind - before).T) * ramp[corner] / 8.0
    worst = int(np.argmax(passed))
    if passed[worst] > ROUNDING_UM:
        more = int((passed > ROUNDING_UM).sum()) - 1
        values: dict[str, Value] = {"off": float(passed[worst]), "ramp": float(ramp[corner[worst]]), "more": more}
        yield _at("PMC205", int(corner[worst]), values)


def _at(code: str, row: int, values: dict[str, Value]) -> Slow:
    return Slow(code, row, values)


def _heading(toolpath: Toolpath, row: Ints, *, at_end: bool) -> Floats:
    """(k, 2) unit vectors along the curves at their start or end."""
    by = toolpath.end_um[row] - toolpath.start_um[row]
    angle = toolpath.start_angle_rad[row] + (toolpath.sweep_rad[row] if at_end else 0.0)
    angle = np.where(toolpath.is_arc[row], angle + np.sign(toolpath.sweep_rad[row]) * np.pi / 2.0, 0.0)
    straight = np.arctan2(by[:, 1], by[:, 0])
    turned = np.where(toolpath.is_arc[row], angle, straight)
    return np.column_stack([np.cos(turned), np.sin(turned)])
