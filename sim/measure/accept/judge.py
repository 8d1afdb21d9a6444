"""What a measured piece comes to: each feature within its limits, outside of them, or too near to tell; and why.

The rule is that of ISO 14253-1: with an expanded uncertainty U a size conforms where it lies within the limits less U,
and does not where it lies outside of them by U. Between there nobody can tell: to be checked.
"""

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Final, Literal, NamedTuple

import numpy as np

from parser.findings.errors import SettingsError
from parser.geometry.curves import Floats
from parser.units import UM_PER_MM
from sim.measure.accept.features import LEAST_PLACES, Size, circle_size, width_size
from sim.measure.statistics import student
from sim.setup.limits import FeatureLimits, Limits
from sim.setup.rows import read_rows
from sim.setup.toml.reader import Bound

Verdict = Literal["pass", "to-check", "fail"]
_PLACE_MM: Final = Bound(-1e5, 1e5)
_COLUMNS: Final = ("feature", "x_mm", "y_mm", "z_mm")
_SHARE: Final = 0.975
CORNER: Final = "corner"
"""Beginning of the names of rows that lie along an inside corner: they have no size, and tell of the wire."""


class Judged(NamedTuple):
    """A characteristic of a feature at a height, None for all together.

    Attributes
    ----------
    feature, z_mm
        Which.
    what
        ``size`` or ``form``.
    value_um, nominal_um, deviation_um
        As measured, as it should be, and the difference; of a form all of it.
    uncertainty_um
        Expanded, 95 %: of the measurement, and of the fit through its places.
    lower_um, upper_um
        Limits of the deviation.
    verdict
        By them.
    """

    feature: FeatureLimits
    z_mm: float | None
    what: Literal["size", "form"]
    value_um: float
    nominal_um: float
    deviation_um: float
    uncertainty_um: float
    lower_um: float
    upper_um: float
    verdict: Verdict


class Cause(NamedTuple):
    """What would explain deviations: the name of a text ``accept.cause-…``, µm with its interval."""

    name: str
    value_um: float
    by_um: float


class Judgement(NamedTuple):
    """A piece: what was judged, features that were not measured enough, others that have no limits, and causes."""

    judged: tuple[Judged, ...]
    missing: tuple[str, ...]
    without_limits: tuple[str, ...]
    causes: tuple[Cause, ...]

    @property
    def verdict(self) -> Literal["pass", "to-check", "incomplete", "fail"]:
        """The worst of all; incomplete where a feature is missing and none fails."""
        verdicts = {each.verdict for each in self.judged}
        if "fail" in verdicts:
            return "fail"
        if self.missing:
            return "incomplete"
        return "to-check" if "to-check" in verdicts else "pass"


class Places(NamedTuple):
    """Places (n, 2) µm of a feature, and their heights (n,) mm; NaN where none is given."""

    place_um: Floats
    z_mm: Floats


def read_piece(path: Path) -> dict[str, Places]:
    """Places of each feature. Raises FileUnreadableError, and SettingsError with file, line and column."""
    found: dict[str, list[tuple[float, float, float]]] = {}
    for row in read_rows(path, _COLUMNS, ("feature", "x_mm", "y_mm")):
        if not row.text("feature"):
            raise row.refused("feature", "…")
        x, y, z = (row.number(name, _PLACE_MM) for name in _COLUMNS[1:])
        for name, value in (("x_mm", x), ("y_mm", y)):
            if value is None:
                raise row.refused(name, f"{_PLACE_MM.low:g} … {_PLACE_MM.high:g}")
        found.setdefault(row.text("feature"), []).append((x or 0.0, y or 0.0, math.nan if z is None else z))
    columns = {name: np.array(rows, dtype=np.float64) for name, rows in found.items()}
    return {name: Places(UM_PER_MM * rows[:, :2], rows[:, 2]) for name, rows in columns.items()}


def judged(piece: dict[str, Places], limits: Limits) -> Judgement:
    """A piece by its limits, each feature at each height that has places enough, else at all of them together."""
    found, missing = list[Judged](), list[str]()
    for feature in limits.features:
        sizes = [*_sizes(feature, piece[feature.name])] if feature.name in piece else []
        if not sizes:
            missing.append(feature.name)
        for z_mm, size in sizes:
            found += _judge(feature, z_mm, size, limits.uncertainty_um)
    known = {feature.name for feature in limits.features}
    others = tuple(name for name in piece if name not in known and not name.startswith(CORNER))
    if len(missing) == len(limits.features):
        raise SettingsError("piece-without-feature", names=", ".join(known))
    return Judgement(tuple(found), tuple(missing), others, tuple(_causes(found)))


def _sizes(feature: FeatureLimits, places: Places) -> list[tuple[float | None, Size]]:
    """Sizes by height; of a feature with too few places at some height, of all together."""
    heights = np.unique(np.round(places.z_mm[~np.isnan(places.z_mm)], 3)).tolist()
    groups = [(z, places.place_um[np.abs(places.z_mm - z) < 5e-4]) for z in heights] if len(heights) > 1 else []
    if not groups or any(len(place) < LEAST_PLACES[feature.kind] for _, place in groups) or np.isnan(places.z_mm).any():
        groups = [(heights[0] if len(heights) == 1 else None, places.place_um)]
    found = list[tuple[float | None, Size]]()
    for z, place in groups:
        size = None
        if len(place) >= LEAST_PLACES[feature.kind]:
            of_width = math.radians(feature.across_deg)
            size = circle_size(place) if feature.kind == "circle" else width_size(place, of_width)
        if size is not None:
            found.append((z, size))
    return found


def _judge(feature: FeatureLimits, z_mm: float | None, size: Size, uncertainty_um: float) -> list[Judged]:
    by_um = math.hypot(uncertainty_um, student(_SHARE, size.free) * size.error_um)
    nominal = UM_PER_MM * feature.nominal_mm
    off = size.size_um - nominal
    verdict = verdict_of(off, by_um, feature.lower_um, feature.upper_um)
    rows = [
        Judged(feature, z_mm, "size", size.size_um, nominal, off, by_um, feature.lower_um, feature.upper_um, verdict)
    ]
    if feature.form_um is not None:
        form_um, most_um = size.form_um, feature.form_um
        verdict = verdict_of(form_um, uncertainty_um, -math.inf, most_um)
        rows.append(Judged(feature, z_mm, "form", form_um, 0.0, form_um, uncertainty_um, 0.0, most_um, verdict))
    return rows


def verdict_of(deviation_um: float, by_um: float, lower_um: float, upper_um: float) -> Verdict:
    """Whether a deviation that is known to `by_um` lies within its limits (ISO 14253-1)."""
    if lower_um + by_um <= deviation_um <= upper_um - by_um:
        return "pass"
    return "fail" if deviation_um < lower_um - by_um or deviation_um > upper_um + by_um else "to-check"


def _causes(found: Sequence[Judged]) -> list[Cause]:
    """What would explain the deviations of sizes, where it is more than its interval.

    Sizes of one instrument may all be off by its uncertainty: no mean of them is known better.

    An offset that is too large by d leaves all outer sizes 2d too large and all inner ones 2d too small. What then
    differs between outer sizes across X and across Y is the scale of an axis or its lost motion; what differs from the
    middle of the height to its ends is the bow of the wire.
    """
    sizes = [each for each in found if each.what == "size"]
    sign = np.array([-1.0 if each.feature.inside else 1.0 for each in sizes])
    off, by = (np.array([getattr(each, name) for each in sizes]) for name in ("deviation_um", "uncertainty_um"))
    causes = list[Cause]()
    if len(sizes) > 1:
        weight = 1.0 / np.maximum(by, 1e-3) ** 2
        mean = float((weight * sign * off).sum() / weight.sum())
        causes.append(Cause("offset", 0.5 * mean, 0.5 * float(by.mean())))
    is_outer = np.array([each.feature.kind == "width" and not each.feature.inside for each in sizes])
    across = np.array([each.feature.across_deg % 180.0 for each in sizes])
    ends = [np.flatnonzero(is_outer & (np.abs(across - angle) < 1.0)) for angle in (0.0, 90.0)]
    if all(len(each) for each in ends):
        means = [float(off[each].mean()) for each in ends]
        causes.append(Cause("x-less-y", means[0] - means[1], math.hypot(*(float(by[each].mean()) for each in ends))))
    barrel = [*_barrels(sizes)]
    if barrel:
        mean, of = (float(np.mean(column)) for column in zip(*barrel, strict=True))
        causes.append(Cause("barrel", mean, of))
    return [cause for cause in causes if abs(cause.value_um) > cause.by_um]


def _barrels(sizes: list[Judged]) -> list[tuple[float, float]]:
    """How much larger each feature is in the middle of its heights than at both ends, and how sure that is."""
    found = list[tuple[float, float]]()
    for name in dict.fromkeys(each.feature.name for each in sizes):
        at_heights = [each for each in sizes if each.feature.name == name and each.z_mm is not None]
        rows = sorted(at_heights, key=lambda each: each.z_mm or 0.0)
        if len(rows) > 2:
            low, middle, high = rows[0], rows[len(rows) // 2], rows[-1]
            sign = -1.0 if low.feature.inside else 1.0
            bow = middle.deviation_um - 0.5 * (low.deviation_um + high.deviation_um)
            by = math.sqrt(middle.uncertainty_um**2 + 0.25 * (low.uncertainty_um**2 + high.uncertainty_um**2))
            found.append((sign * bow, by))
    return found
