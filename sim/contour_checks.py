"""Findings about contours, and about blocks whose steps end elsewhere than their geometry."""

import numpy as np

from controller.steps import Steps
from parser.findings import Finding
from parser.toolpath import Axis, Ints, Toolpath
from parser.units import UM_PER_MM, mm
from sim.contours import Contour

STEPPED_END_UM = 12.0
"""40,000 random arcs of 10 µm to 1 m radius, on the right count axis, ended at most 9.5 µm from their exact end when
stepped, half of them within 1.0 µm and 95 % within 3.7 µm; the worst found, on purpose, was 9.94 µm off."""


def contour_findings(toolpath: Toolpath, contours: tuple[Contour, ...], *, may_stay_open: bool) -> list[Finding]:
    """Open contours (3B301) unless they may stay open, and poor stepped closure (3B302)."""
    found = []
    for contour in contours:
        at = {"line": int(toolpath.source.line[contour.last - 1]), "block": contour.last}
        blocks = f"the contour of blocks {contour.first} to {contour.last}"
        if contour.is_open and not may_stay_open:
            found.append(
                Finding(
                    "3B301",
                    f"{blocks} ends {_um(contour.closure_exact_um)} from its start, and does not close on its path",
                    "a contour that closes, or a scenario that says open = true",
                    "the part is not cut free, or the cut runs into it",
                    **at,
                )
            )
        elif contour.closes_badly_stepped:
            found.append(
                Finding(
                    "3B302",
                    f"{blocks} closes to {_um(contour.closure_stepped_um)} when stepped",
                    f"no more than {contour.tolerance_um:g} µm",
                    "the cut ends beside its start and leaves a mark",
                    **at,
                )
            )
    return found


def missed_ends(toolpath: Toolpath, steps: Steps) -> list[Finding]:
    """Blocks whose steps, begun at the exact start, miss the exact end by more than a sound block does (3B303)."""
    miss = np.diff(steps.corner_um, axis=0) - (toolpath.end_um - toolpath.start_um)
    off = np.hypot(miss[:, 0], miss[:, 1])
    turns = np.maximum(np.abs(toolpath.sweep_rad) / (2.0 * np.pi), 1.0)
    ruled = ruled_count_axis(toolpath)
    return [
        Finding(
            "3B303",
            f"the steps end {_um(float(off[row]))} from the exact end",
            _expected(int(toolpath.words.count_axis[row]), int(ruled[row])),
            "the table stops there, and all later blocks are shifted by as much",
            int(toolpath.source.line[row]),
            block=row + 1,
        )
        for row in np.flatnonzero(off > STEPPED_END_UM * turns).tolist()
    ]


def ruled_count_axis(toolpath: Toolpath) -> Ints:
    """Axis (n,) that the trade's rule counts on (docs/3b.md §1): arcs by their end, lines by their longer side.

    Near an extreme of the counted axis one count is a long way along the path; the rule keeps the end away from it.
    """
    end = np.abs(toolpath.end_um - np.where(toolpath.is_arc[:, None], toolpath.center_um, 0.0))
    side = np.abs(toolpath.end_um - toolpath.start_um)
    on_y = np.where(toolpath.is_arc, end[:, 0] > end[:, 1], side[:, 1] > side[:, 0])
    return np.where(on_y, np.int64(Axis.Y), np.int64(Axis.X))


def _expected(axis: int, ruled: int) -> str:
    if axis == ruled:
        return f"an end within {STEPPED_END_UM:g} µm"
    return f"G{Axis(ruled).name}, the axis that does not stand still there"


def _um(length: float) -> str:
    return f"{length:.2f} µm" if length < UM_PER_MM else f"{mm(length):.3f} mm"
