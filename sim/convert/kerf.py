"""Contours that the path of a wire leaves open, and its kerf closes."""

from collections.abc import Sequence

import numpy as np

from parser.findings.facts import telling
from parser.findings.findings import Finding
from parser.geometry.distance import distance_to_curves
from parser.told.compensation import Compensation
from parser.toolpath import Toolpath
from sim.check.closures import OpenContour

_LAST_BLOCKS = 2
"""Blocks before its end beside which a path always runs."""


def closed_by_kerf(
    findings: Sequence[Finding], path: Toolpath, compensation: Compensation
) -> tuple[tuple[Finding, ...], float]:
    """Findings of open contours that a compensated path closes but for a kerf, and the widest of these gaps, µm.

    Where a contour begins and ends at a corner, its first block and its last one are moved aside in two directions. The
    wire, which cuts as far to each side as the path was moved, frees the piece all the same.
    """
    kerf_um = 2.0 * float(np.nanmax(np.abs(compensation.left_um)))
    gaps = [(finding, _gap_um(finding, path)) for finding, _ in telling(findings, OpenContour)]
    narrow = [(finding, gap_um) for finding, gap_um in gaps if gap_um <= kerf_um]
    return tuple(finding for finding, _ in narrow), max((gap_um for _, gap_um in narrow), default=0.0)


def _gap_um(finding: Finding, path: Toolpath) -> float:
    """How far the contour of a finding ends from the rest of itself."""
    first, last = int(finding.values["first"]) - 1, int(finding.values["last"]) - 1
    row = np.arange(first, last + 1 - _LAST_BLOCKS)
    if not len(row):
        return np.inf
    end = np.tile(path.end_um[last], (len(row), 1))
    return float(distance_to_curves(path, row, end[:, 0], end[:, 1])[0].min())
