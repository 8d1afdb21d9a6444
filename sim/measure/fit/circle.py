"""A circle as it was measured, to what the machine did: centre, radius, squareness, scales, lag, lost motion.

To the first order in deviation over radius a machine that runs a circle of radius R at speed v, counter-clockwise
(s = 1) or clockwise (−1), stands in the direction θ at the distance

    R_s + cx cos θ + cy sin θ − R β sin θ cos θ + R ½(ex − ey) cos 2θ − s ½v(τy − τx) sin 2θ
        − ½Bx sgn(vx) cos θ − ½By sgn(vy) sin θ,    vx = −s sin θ, vy = s cos θ

from the middle: β out of square, e the scale of an axis, τ the time by which it lags, so that it stands v τ back
against its motion, B what it loses at a reversal, backlash and twice friction over stiffness together (Y. Kakino et
al., Accuracy Inspection of NC Machine Tools by Double Ball Bar Method, 1993; ISO 230-4 for the test). All are fitted
at once by least squares, rows far off left out, and the intervals come from the residuals: quantiles of Student's t
times the standard errors.

What one circle cannot tell is said and gets no number: backlash from friction, the mean scale from the radius, and with
one direction alone squareness from lag. A fit that is not the whole truth is told by two tests of its residuals: an
F-test of harmonics and drift that the model does not have, and the runs of signs (A. Wald, J. Wolfowitz, 1940).
"""

import math
from statistics import NormalDist
from typing import Final, NamedTuple

import numpy as np

from controller.stepping.chunks import chunk_of
from controller.stepping.steps import interpolate_words, stepped_words
from parser.findings.errors import SettingsError
from parser.geometry.curves import Bools, Floats, Ints, curves_between
from sim.measure.fit.parameters import LEVEL, FittedRows, Parameter
from sim.measure.statistics import algebraic_circle, explained, student

LEAST_PLACES: Final = 24
_AT_REVERSAL_RAD: Final = math.radians(2.0)
"""So near to a reversal an axis is still taking up its lost motion."""
_FAR: Final = 4.5  # times the usual residual: a row so far off is left out
_ROUNDS: Final = 4
_ALIKE: Final = 0.95  # share of a column that the other ones explain: so much alike, no circle tells it from them
_LEAST_TURN_RAD: Final = math.radians(300.0)
_FALSE_ALARM: Final = 0.003  # of each of the two tests
_MOST_HARMONIC: Final = 20
_HALF_WINDOW: Final = 3
_MOST_TURNS_BACK: Final = 12
_CELLS: Final = 1440
_STEPPED_UM: Final = 0.5
"""How far lost motion may be off where steps of 1 µm make it: 0.3 µm beside `drycut ballbar` on shipped machines."""


class CircleFit(NamedTuple):
    """All that a circle tells.

    Attributes
    ----------
    parameters
        What it tells, and what it does not.
    residual_um
        Root mean square of what the model leaves.
    lack
        What speaks against the model: name of a text ``fit.lack-…``; empty where nothing does.
    places, left_out
        How many rows were fitted, and how many lie far off.
    senses
        Directions that were run: 1 counter-clockwise, −1 clockwise.
    rows
        What it is of.
    """

    parameters: tuple[Parameter, ...]
    residual_um: float
    lack: str
    places: int
    left_out: int
    senses: tuple[int, ...]
    rows: FittedRows

    def value(self, name: str) -> float | None:
        """The value of a parameter; None where it is not determined."""
        return next(each.value for each in self.parameters if each.name == name)


class _Design(NamedTuple):
    """Columns (n, p) of the model, and the names, units and scales of what they stand for."""

    columns: Floats
    names: tuple[str, ...]
    units: tuple[str, ...]
    scales: Floats


def fit_circle(place_um: Floats, feed_um_s: float | None = None, *, by_points: bool = False) -> CircleFit:
    """What places (n, 2) of one or more turns, in the order of time, tell of a machine that ran them at a feed.

    `by_points` tells that its controller steps point by point: what its steps alone add to a circle is taken off.
    SettingsError where they are too few, no circle, or in no order.
    """
    if len(place_um) < LEAST_PLACES:
        raise SettingsError("circle-too-few", found=len(place_um), least=LEAST_PLACES)
    center, radius = algebraic_circle(place_um)
    for _ in range(2):
        out = place_um - center
        angle, off = np.arctan2(out[:, 1], out[:, 0]), np.hypot(out[:, 0], out[:, 1]) - radius
        sense = _senses(angle)
        _refuse_no_circle(angle, off, radius)
        if by_points:
            off = off - steps_um(angle, sense, radius)
        design = _design(angle, sense, radius)
        is_used = _without_far(design.columns, off, _off_reversals(angle))
        solved = np.linalg.lstsq(design.columns[is_used], off[is_used], rcond=None)[0]
        center = center + solved[[design.names.index(name) for name in ("center_x", "center_y")]]
    parameters = _parameters(design, off, is_used, (center, radius), feed_um_s)
    if by_points:
        parameters = tuple(map(_widened, parameters))
    used = (off - design.columns @ solved)[is_used]
    return CircleFit(
        parameters=parameters,
        residual_um=float(np.sqrt(np.mean(used**2))),
        lack=_lack(design.columns, angle, off, is_used),
        places=int(is_used.sum()),
        left_out=int((_off_reversals(angle) & ~is_used).sum()),
        senses=tuple(each for each in (1, -1) if (sense == each).any()),
        rows=FittedRows(np.degrees(np.mod(angle, 2.0 * np.pi)), off, design.columns @ solved, sense < 0.0, is_used),
    )


def _widened(parameter: Parameter) -> Parameter:
    """A reversal with what a stepped path leaves unknown of it."""
    value, least, most = parameter[2:5]
    if not parameter.name.startswith("reversal") or value is None or least is None or most is None:
        return parameter
    by = math.hypot(most - value, _STEPPED_UM)
    return parameter._replace(least=value - by, most=value + by)


def steps_um(angle: Floats, sense: Floats, radius_um: float) -> Floats:
    """(n,) how far the steps of a point-by-point controller lie off a circle, by direction: means of a quarter degree.

    They lie within 1 µm inside of it behind each reversal and outside before it, which looks like −1.3 µm of lost
    motion.
    """
    radius, off = float(max(round(radius_um), 1)), np.zeros(len(angle))
    cell = _cells(angle)
    for of in (1.0, -1.0):
        start = np.array([[radius, 0.0]])
        circle = curves_between(start, start.copy(), np.zeros((1, 2)), np.array([2.0 * np.pi * of]))
        steps = interpolate_words(stepped_words(circle), circle.length_um)
        made = chunk_of(steps, 0, len(steps))
        x, y = made.x_um + radius, made.y_um.astype(np.float64)
        at = _cells(np.arctan2(y, x))
        mean = np.bincount(at, np.hypot(x, y) - radius, _CELLS) / np.maximum(np.bincount(at, minlength=_CELLS), 1)
        off[sense == of] = mean[cell[sense == of]]
    return off


def _cells(angle: Floats) -> Ints:
    """(n,) which quarter of a degree directions lie in."""
    cell: Ints = np.floor(np.mod(angle, 2.0 * np.pi) / (2.0 * np.pi) * _CELLS).astype(np.int64) % _CELLS
    return cell


def _senses(angle: Floats) -> Floats:
    """(n,) which way round the places are run. SettingsError where they lie in no order."""
    run = np.unwrap(angle)
    at = np.arange(len(run))
    by = run[np.minimum(at + _HALF_WINDOW, len(run) - 1)] - run[np.maximum(at - _HALF_WINDOW, 0)]
    sense = np.where(by >= 0.0, 1.0, -1.0)
    if int((np.diff(sense) != 0).sum()) > _MOST_TURNS_BACK:
        raise SettingsError("circle-no-order")
    return sense


def _refuse_no_circle(angle: Floats, off: Floats, radius_um: float) -> None:
    order = np.sort(angle)
    gap = float(np.diff(order, append=order[0] + 2.0 * np.pi).max())
    if 2.0 * np.pi - gap < _LEAST_TURN_RAD or float(np.median(np.abs(off))) > 0.01 * radius_um:
        raise SettingsError("circle-not-round", degrees=math.degrees(2.0 * np.pi - gap))


def _off_reversals(angle: Floats) -> Bools:
    """(n,) which directions lie off the axes, where one of them turns round."""
    quarter = np.mod(angle, 0.5 * np.pi)
    off: Bools = np.minimum(quarter, 0.5 * np.pi - quarter) > _AT_REVERSAL_RAD
    return off


def _design(angle: Floats, sense: Floats, radius_um: float) -> _Design:
    cos, sin = np.cos(angle), np.sin(angle)
    both = (sense > 0.0).any() and (sense < 0.0).any()
    columns = {
        **{name: (sense == of).astype(np.float64) for name, of in (("radius_ccw", 1), ("radius_cw", -1))},
        "center_x": cos,
        "center_y": sin,
        "squareness": -radius_um * sin * cos,
        "scale_difference": 0.5 * radius_um * np.cos(2.0 * angle),
        "lag_difference": -0.5 * sense * np.sin(2.0 * angle),
        "reversal_x": -0.5 * np.sign(-sense * sin) * cos,
        "reversal_y": -0.5 * np.sign(sense * cos) * sin,
    }
    units = {"squareness": "µrad", "scale_difference": "ppm"}
    if not both:
        del columns["lag_difference"]
    columns = {name: column for name, column in columns.items() if column.any()}
    names = tuple(columns)
    scales = np.array([1e6 if name in units else 1.0 for name in names])
    return _Design(np.column_stack([*columns.values()]), names, tuple(units.get(name, "µm") for name in names), scales)


def _without_far(columns: Floats, off: Floats, is_used: Bools) -> Bools:
    """Which of the rows (n,) stay once those far off the fit of the others are left out."""
    stays = is_used
    for _ in range(_ROUNDS):
        solved = np.linalg.lstsq(columns[stays], off[stays], rcond=None)[0]
        away = np.abs(off - columns @ solved)
        usual = 1.4826 * float(np.median(away[stays]))
        stays = is_used & (away <= max(_FAR * usual, 1e-6))
    return stays


def _parameters(
    design: _Design, off: Floats, is_used: Bools, circle: tuple[Floats, float], feed_um_s: float | None
) -> tuple[Parameter, ...]:
    """Values with their intervals, and what is not told."""
    columns, free = design.columns[is_used], int(is_used.sum()) - design.columns.shape[1]
    solved = np.linalg.lstsq(columns, off[is_used], rcond=None)[0]
    variance = float(((off[is_used] - columns @ solved) ** 2).sum()) / free
    errors = np.sqrt(variance * np.diag(np.linalg.pinv(columns.T @ columns)))
    reach = student(0.5 * (1.0 + LEVEL), free) * errors
    shared = explained(columns)
    (x, y), radius = circle[0].tolist(), circle[1]
    base = {"radius_ccw": radius, "radius_cw": radius, "center_x": x, "center_y": y}
    alone = "squareness" if "lag_difference" not in design.names else ""
    found: list[Parameter] = []
    for at, (name, unit, scale) in enumerate(zip(design.names, design.units, design.scales.tolist(), strict=True)):
        if name == alone:
            found.append(Parameter(name, unit, why="one-direction"))
        elif shared[at] > _ALIKE:
            found.append(Parameter(name, unit, why="missing-arcs"))
        else:
            # The centre was moved by what the fit gave: nothing of it is left in the solution but rounding.
            middle = scale * float(solved[at]) + (base[name] if name.startswith("radius") else 0.0)
            middle = base[name] if name.startswith("center") else middle
            by = scale * float(reach[at])
            found.append(Parameter(name, unit, middle, middle - by, middle + by))
    return (*found, *_not_told(found, bool(alone), feed_um_s))


def _not_told(found: list[Parameter], one_direction: bool, feed_um_s: float | None) -> tuple[Parameter, ...]:
    """What follows from the others, and what one circle cannot tell."""
    lag = next((each for each in found if each.name == "lag_difference"), None)
    if lag is None or lag.value is None or feed_um_s is None or lag.least is None or lag.most is None:
        why = "one-direction" if one_direction else "no-feed"
        delay = Parameter("delay_difference", "ms", why=why)
    else:
        middle, least, most = (1e3 * each / feed_um_s for each in (lag.value, lag.least, lag.most))
        delay = Parameter("delay_difference", "ms", middle, least, most)
    return (
        *([Parameter("lag_difference", "µm", why="one-direction")] if one_direction else []),
        delay,
        Parameter("backlash_x", "µm", why="with-friction"),
        Parameter("backlash_y", "µm", why="with-friction"),
        Parameter("mean_scale", "ppm", why="with-radius"),
    )


def _lack(columns: Floats, angle: Floats, off: Floats, is_used: Bools) -> str:
    """What speaks against the model; empty where nothing does."""
    rows = np.flatnonzero(is_used)
    most = min(_MOST_HARMONIC, len(rows) // 12)
    of_angle = [np.cos(number * angle) for number in range(3, most + 1)] + [
        np.sin(number * angle) for number in range(3, most + 1)
    ]
    time = np.linspace(-1.0, 1.0, len(angle))
    of_time = [time, time * np.cos(angle), time * np.sin(angle)]
    for name, more in (("harmonics", of_angle), ("drift", of_time)):
        if more and _is_better(columns[rows], np.column_stack(more)[rows], off[rows]):
            return name
    residual = off[rows] - columns[rows] @ np.linalg.lstsq(columns[rows], off[rows], rcond=None)[0]
    return "runs" if has_few_runs(residual) else ""


def _is_better(columns: Floats, more: Floats, off: Floats) -> bool:
    """Whether further columns (n, q) explain more than chance does: F by its χ² of q degrees, n being large."""
    whole = np.column_stack([columns, more])
    left = [float(((off - each @ np.linalg.lstsq(each, off, rcond=None)[0]) ** 2).sum()) for each in (columns, whole)]
    added = more.shape[1]
    free = len(off) - whole.shape[1]
    if free < added or left[1] <= 0.0:
        return left[0] > 0.0 and left[1] <= 0.0
    ratio = (left[0] - left[1]) / added / (left[1] / free)
    # Cube roots of F are nearly normal (E. Paulson, 1942).
    a, b = 2.0 / (9.0 * added), 2.0 / (9.0 * free)
    root = max(ratio, 0.0) ** (1.0 / 3.0)
    deviate = (root * (1.0 - b) - (1.0 - a)) / math.sqrt(b * root**2 + a)
    return bool(deviate > NormalDist().inv_cdf(1.0 - _FALSE_ALARM))


def has_few_runs(residual: Floats) -> bool:
    """Whether the signs of neighbouring residuals are alike more often than by chance."""
    above = residual > 0.0
    more, fewer = int(above.sum()), int((~above).sum())
    if min(more, fewer) < 10:
        return False
    number = 1 + int((np.diff(above.astype(np.int64)) != 0).sum())
    expected = 1.0 + 2.0 * more * fewer / (more + fewer)
    variance = (expected - 1.0) * (expected - 2.0) / (more + fewer - 1.0)
    return bool((number - expected) / math.sqrt(variance) < NormalDist().inv_cdf(_FALSE_ALARM))
