"""The spark gap that a measured piece tells, by the offset that it was cut with; and the technology file that holds it.

An offset that is larger by δ than half of the wire and the gap leaves all outer sizes 2δ larger and all inner ones 2δ
smaller; a scale e of the axes, or of the instrument, makes all of them larger by e times themselves. Both are fitted
at once by least squares. With outer or inner sizes alone of much the same length nobody can tell one from the other.
"""

import math
from typing import Final, NamedTuple

import numpy as np

from parser.findings.errors import SettingsError
from parser.units import mm
from sim.measure.accept.judge import Judgement
from sim.measure.statistics import student
from sim.setup.technology import GAP_WITHIN_UM, Choice, Cut, Technology

_SHARE: Final = 0.975
_ALIKE: Final = 0.95
"""Of the sum of squares of one column the other one explains: more, and no piece tells offset from scale."""


class MeasuredGap(NamedTuple):
    """A gap µm and half of its 95 % interval, and of how many sizes it is."""

    gap_um: float
    by_um: float
    sizes: int


class Cutting(NamedTuple):
    """How a piece was cut: the offset of its last pass and the wire, µm."""

    offset_um: float
    wire_um: float


def measured_gap(of: Judgement, cutting: Cutting, uncertainty_um: float) -> MeasuredGap:
    """The gap of the pass that made the edges of a piece.

    `uncertainty_um` is that of the measurement, 95 %: sizes of one instrument may all be off by it. SettingsError where
    the piece does not tell it.
    """
    sizes = [each for each in of.judged if each.what == "size"]
    sign = np.array([-2.0 if each.feature.inside else 2.0 for each in sizes])
    columns = np.column_stack([sign, np.array([each.nominal_um for each in sizes])])
    off = np.array([each.deviation_um for each in sizes])
    free = len(sizes) - 2
    if free < 1 or _explained(columns) > _ALIKE:
        raise SettingsError("piece-tells-no-gap", sizes=len(sizes))
    solved = np.linalg.lstsq(columns, off, rcond=None)[0]
    variance = float(((off - columns @ solved) ** 2).sum()) / free
    error = math.sqrt(variance * float(np.linalg.inv(columns.T @ columns)[0, 0]))
    by_um = math.hypot(student(_SHARE, free) * error, 0.5 * uncertainty_um)
    return MeasuredGap(cutting.offset_um - 0.5 * cutting.wire_um - float(solved[0]), by_um, len(sizes))


def _explained(columns: np.ndarray[tuple[int, int], np.dtype[np.float64]]) -> float:
    """Share of the first column's sum of squares that the second one explains."""
    first, second = columns.T
    return float((first @ second) ** 2 / ((first @ first) * (second @ second)))


def technology_of(gap: MeasuredGap, choice: Choice, number: int, source: str) -> Technology:
    """A technology of one cut: the gap of a pass as measured.

    How the gaps of cuts scatter one piece does not say: for that the usual interval of a measured gap is added.
    """
    within_um = math.hypot(gap.by_um, GAP_WITHIN_UM["measured"])
    cut = Cut(
        material=choice.material,
        wire_um=choice.wire_um,
        height_mm=choice.height_mm,
        number=number,
        gap_um=round(gap.gap_um, 2),
        gap_within_um=round(within_um, 2),
        feed_mm_min=None,
        area_rate_mm2_min=None,
        rate_within=None,
        lag_um=None,
        lag_within_um=None,
        offset_um=None,
        roughness_um=None,
        grade="measured",
        source=source,
    )
    name = f"{choice.material}, {mm(choice.wire_um):g} mm"
    return Technology(name, "measured", source, (cut,))
