"""A measured test piece, to what the machine and the kerf did: edge, scales, squareness, lost motion; and its corners.

A piece tells apart what a circle does not. A size L across the direction φ, outer (s = 1) or inner (−1), is off by

    2 s δ + L (e + ½ (ex − ey) cos 2φ − β sin φ cos φ) − Bx [φ = 0°] − By [φ = 90°],

with δ by how much each edge stands outside of its contour, e the mean scale and ex − ey the difference of the scales of
both axes, β out of square, and B what an axis loses at a reversal: an axis that comes back from either side stands ½ B
short of both. Sizes of several lengths tell scales from edge and lost motion, inner ones the edge from all else. On a
face at 45° lost motion adds ± (Bx − By) / √2 by the way in which it was cut, which is not known: the interval of the
squareness has it. Faces in other directions are left out. A diameter has 2 s δ + L e (its places are all round).

On a face where a cut begins the axis across it comes from outside, and stands B farther out than where the cut ends:
such faces have a step, and are left out too.

All is fitted at once by weighted least squares; a size is known as its own places tell, and as the instrument is.
"""

import math
from collections.abc import Mapping, Sequence
from statistics import NormalDist
from typing import Final, NamedTuple

import numpy as np

from parser.findings.errors import SettingsError
from parser.geometry.curves import Floats
from parser.units import UM_PER_MM
from sim.measure.accept.features import LEAST_PLACES, Size, circle_size, width_size
from sim.measure.accept.judge import CORNER, Places
from sim.measure.fit.corner import fit_corner
from sim.measure.fit.parameters import LEVEL, FittedRows, Parameter
from sim.measure.statistics import explained, student
from sim.setup.limits import FeatureLimits, Limits

_SAME_RAD: Final = math.radians(0.5)
_ALIKE: Final = 0.98  # share of a column that the other ones explain: so much alike, no piece tells it from them
_FALSE_ALARM: Final = 0.003
_LEAST_UM: Final = 1e-3  # no size is known better
_ALL: Final = 6  # parameters of a piece
_STEP, _STEP_UM = 4.0, 1.0
"""Times the usual form of faces from which they have a step, and µm over what the instrument does."""
_UNITS: Final = {"edge": "µm", "mean_scale": "ppm", "scale_difference": "ppm", "squareness": "µrad"}
_NEEDS: Final = {"squareness": "no-oblique", "reversal_x": "no-faces", "reversal_y": "no-faces"}


class PieceFit(NamedTuple):
    """What a piece tells.

    Attributes
    ----------
    parameters
        What it tells, and what it does not.
    residual_um
        Root mean square of what the model leaves of its sizes.
    lack
        What speaks against the model: name of a text ``fit.lack-…``; empty where nothing does.
    places, sizes
        How many rows were fitted, and how many sizes they came to.
    left_out, stepped
        Names of features that were not used, and of those that were not since their faces have a step.
    names, rows, within_um
        Of each size (n,) the name of its feature, what it is off, and half of its interval.
    """

    parameters: tuple[Parameter, ...]
    residual_um: float
    lack: str
    places: int
    sizes: int
    left_out: tuple[str, ...]
    stepped: tuple[str, ...]
    names: tuple[str, ...]
    rows: FittedRows
    within_um: Floats

    def value(self, name: str) -> float | None:
        """The value of a parameter; None where it is not determined."""
        return next(each.value for each in self.parameters if each.name == name)


class _Measured(NamedTuple):
    """A size that counts: its feature, its direction in eighths of a turn, what it came to, and of how many places."""

    feature: FeatureLimits
    eighth: int
    size: Size
    places: int


class _Solved(NamedTuple):
    """Values (p,) and their standard errors, how far the oblique faces may move each, and what is left (n,), µm."""

    values: Floats
    errors: Floats
    oblique: Floats
    left_um: Floats


def fit_piece(piece: Mapping[str, Places], limits: Limits) -> PieceFit:
    """What places of features tell, whose nominal sizes and whose uncertainty stand in limits.

    Rows whose names begin with ``corner`` lie along an inside corner, and tell of the wire. SettingsError where there
    are too few sizes.
    """
    every = [each for feature in limits.features if (each := _measured(feature, piece)) is not None]
    measured = _without_steps(every, limits.uncertainty_um)
    columns = {name: column for name, column in _columns(measured).items() if column.any()} if measured else {}
    if len(measured) <= len(columns):
        raise SettingsError("piece-too-few-sizes", found=len(measured), needed=(len(columns) or _ALL) + 1)
    off_um = np.array([each.size.size_um - UM_PER_MM * each.feature.nominal_mm for each in measured])
    error_um = np.maximum(np.hypot(_errors_um(measured), 0.5 * limits.uncertainty_um), _LEAST_UM)
    matrix = np.column_stack([*columns.values()])
    solved = _solved(matrix, off_um, error_um, _oblique(measured))
    shared, free = explained(matrix / error_um[:, None]), sum(each.size.free for each in measured)
    parameters = _parameters([*columns], solved, shared, free, limits.uncertainty_um)
    corner = [place.place_um for name, place in piece.items() if name.startswith(CORNER)]
    known = {each.feature.name for each in every}
    return PieceFit(
        parameters=(*parameters, *_of_wire(corner)),
        residual_um=float(np.sqrt(np.mean(solved.left_um**2))),
        lack="sizes" if _is_lacking(solved.left_um / error_um, len(measured) - len(columns)) else "",
        places=sum(each.places for each in measured) + sum(map(len, corner)),
        sizes=len(measured),
        left_out=tuple(name for name in piece if name not in known and not name.startswith(CORNER)),
        stepped=tuple(each.feature.name for each in every if each not in measured),
        names=tuple(each.feature.name for each in measured),
        rows=_rows(off_um, off_um - solved.left_um),
        within_um=student(0.5 * (1.0 + LEVEL), free) * error_um,
    )


def _rows(off_um: Floats, model_um: Floats) -> FittedRows:
    none = np.zeros(len(off_um), dtype=np.bool_)
    return FittedRows(np.arange(len(off_um), dtype=np.float64), off_um, model_um, none, ~none)


def _measured(feature: FeatureLimits, piece: Mapping[str, Places]) -> _Measured | None:
    """A feature that was measured enough, and whose direction is a multiple of 45°; None else."""
    if feature.name not in piece or len(piece[feature.name].place_um) < LEAST_PLACES[feature.kind]:
        return None
    place_um, across = piece[feature.name].place_um, math.radians(feature.across_deg)
    eighth = round(across / (0.25 * math.pi))
    if feature.kind == "circle":
        return _Measured(feature, 0, circle_size(place_um), len(place_um))
    size = width_size(place_um, across)
    if size is None or abs(across - 0.25 * math.pi * eighth) > _SAME_RAD:
        return None
    return _Measured(feature, eighth % 4, size, len(place_um))


def _without_steps(measured: Sequence[_Measured], uncertainty_um: float) -> list[_Measured]:
    """Those whose faces have no step: their form is about the usual one."""
    forms = [each.size.form_um for each in measured if each.feature.kind == "width"]
    most_um = max(_STEP * float(np.median(forms)), _STEP_UM + uncertainty_um) if forms else math.inf
    return [each for each in measured if each.feature.kind != "width" or each.size.form_um <= most_um]


def _errors_um(measured: Sequence[_Measured]) -> Floats:
    """Standard errors (n,) of sizes: all places have the noise that those on faces have, on a circle at least that.

    What reversals leave on a circle is no noise, and is more.
    """
    faces = [each.size for each in measured if each.feature.kind == "width"] or [each.size for each in measured]
    square = sum(size.free * size.noise_um**2 for size in faces) / sum(size.free for size in faces)
    return np.array([each.size.error_um * _times(each, math.sqrt(square)) for each in measured])


def _times(each: _Measured, noise_um: float) -> float:
    """By how much the standard error of a size is larger with the noise of all places than with its own."""
    own_um = each.size.noise_um
    if own_um == 0.0:
        return 1.0
    return max(noise_um / own_um, 1.0) if each.feature.kind == "circle" else noise_um / own_um


def _columns(measured: Sequence[_Measured]) -> dict[str, Floats]:
    """Columns (n,) of the model, µm for 1 µm, 1 ppm or 1 µrad, by the names of the parameters."""
    is_width = np.array([each.feature.kind == "width" for each in measured])
    eighth = np.array([each.eighth for each in measured])
    length = 1e-6 * UM_PER_MM * np.array([each.feature.nominal_mm for each in measured])
    angle = 0.25 * np.pi * eighth
    return {
        "edge": np.array([-2.0 if each.feature.inside else 2.0 for each in measured]),
        "mean_scale": length,
        "scale_difference": np.where(is_width & (eighth % 2 == 0), 0.5 * length * np.cos(2.0 * angle), 0.0),
        "squareness": np.where(is_width & (eighth % 2 == 1), -0.5 * length * np.sin(2.0 * angle), 0.0),
        "reversal_x": -1.0 * (is_width & (eighth == 0)),
        "reversal_y": -1.0 * (is_width & (eighth == 2)),
    }


def _oblique(measured: Sequence[_Measured]) -> Floats:
    """What 1 µm of Bx − By adds to each size (n,), one way or the other."""
    of_eighth = {1: math.sqrt(0.5), 3: -math.sqrt(0.5)}
    return np.array([of_eighth.get(each.eighth, 0.0) for each in measured])


def _solved(matrix: Floats, off_um: Floats, error_um: Floats, oblique: Floats) -> _Solved:
    weighted = matrix / error_um[:, None]
    inverse = np.linalg.pinv(weighted)
    values = inverse @ (off_um / error_um)
    errors = np.sqrt((inverse**2).sum(axis=1))
    return _Solved(values, errors, inverse @ (oblique / error_um), off_um - matrix @ values)


def _parameters(
    names: Sequence[str], solved: _Solved, shared: Floats, free: int, uncertainty_um: float
) -> list[Parameter]:
    """Values with their intervals, and what is not told.

    A probe that is larger than it is known to be moves all edges alike: the edge is known no better than one size.
    """
    reach = student(0.5 * (1.0 + LEVEL), free) * solved.errors
    lost = {name: (float(solved.values[at]), float(reach[at])) for at, name in enumerate(names)}
    (x_um, by_x), (y_um, by_y) = (lost.get(name, (0.0, 0.0)) for name in ("reversal_x", "reversal_y"))
    unlike_um = abs(x_um - y_um) + math.hypot(by_x, by_y)
    found = []
    for name in (*_UNITS, "reversal_x", "reversal_y"):
        unit = _UNITS.get(name, "µm")
        if name not in names:
            found.append(Parameter(name, unit, why=_NEEDS[name]))
            continue
        at = names.index(name)
        if shared[at] > _ALIKE:
            found.append(Parameter(name, unit, why="piece-alike"))
            continue
        probe_um = 0.5 * uncertainty_um if name == "edge" else 0.0
        value, by = float(solved.values[at]), math.hypot(reach[at], unlike_um * solved.oblique[at], probe_um)
        found.append(Parameter(name, unit, value, value - by, value + by))
    return [*found, *(Parameter(f"backlash_{axis}", "µm", why="with-friction") for axis in "xy")]


def _of_wire(corners: Sequence[Floats]) -> tuple[Parameter, ...]:
    """Lag and reach of the wire, from the first corner that was measured."""
    if not corners:
        return (Parameter("lag", "µm", why="no-corner"), Parameter("reach", "µm", why="no-corner"))
    of_corner = fit_corner(corners[0]).parameters
    return tuple(each for each in of_corner if each.name in {"lag", "reach"})


def _is_lacking(left: Floats, free: int) -> bool:
    """Whether residuals in standard errors are larger than by chance: χ² by its cube root (E. Wilson, M. Hilferty)."""
    root, spread = (float((left**2).sum()) / free) ** (1.0 / 3.0), 2.0 / (9.0 * free)
    return bool((root - (1.0 - spread)) / math.sqrt(spread) > NormalDist().inv_cdf(1.0 - _FALSE_ALARM))
