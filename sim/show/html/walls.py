"""The walls that a leaning wire cuts, as the page turns them about: places of both faces, row by row."""

from typing import Final, TypedDict

import numpy as np

from parser.geometry.along import places
from parser.geometry.curves import CurveKind
from parser.units import mm
from sim.cut.solids import TiltedCut

_TURN_RAD: Final = np.radians(6.0)
"""Of an arc between two places: a circle of 50 mm is drawn within 0.07 mm, less than a line is wide."""
_DIGITS: Final = 4


class WallsEntry(TypedDict):
    """Ways of the wire at the bottom and at the top, places mm, one beside the other; and heights, mm.

    `cuts` says of each place but the first whether the wire cut on the way to it. `block` is the block that it is in,
    from 1.
    """

    bottom: list[list[float]]
    top: list[list[float]]
    cuts: list[bool]
    block: list[int]
    work_mm: float
    program_mm: float
    lower_guide_mm: float
    upper_guide_mm: float


def walls_entry(cut: TiltedCut | None) -> WallsEntry | None:
    """The walls of a cut; None of an upright wire."""
    if cut is None:
        return None
    ruled, heights = cut.path.ruled, cut.path.heights
    turn = np.maximum(np.abs(ruled.lower.sweep_rad), np.abs(ruled.upper.sweep_rad))
    moves = np.maximum(ruled.lower.length_um, ruled.upper.length_um) > 0.0
    count = np.where(moves, np.maximum(np.ceil(turn / _TURN_RAD), 1.0), 0.0).astype(np.int64)
    row = np.repeat(np.arange(len(ruled)), count)
    share = (np.arange(len(row)) - np.repeat(np.cumsum(count) - count, count) + 1) / count[row]
    row, share = np.concatenate([row[:1], row]), np.concatenate([[0.0], share])
    bottom, top = (np.round(mm(places(of, row, share)), _DIGITS).tolist() for of in (ruled.lower, ruled.upper))
    return {
        "bottom": bottom,
        "top": top,
        "cuts": (ruled.lower.kind != CurveKind.JUMP)[row].tolist(),
        "block": (cut.path.source_row[row] + 1).tolist(),
        "work_mm": mm(heights.work_um),
        "program_mm": mm(heights.program_um),
        "lower_guide_mm": mm(heights.lower_guide_um),
        "upper_guide_mm": mm(heights.upper_guide_um),
    }
