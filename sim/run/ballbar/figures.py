"""The figures of a circular test, as ISO 230-4 has them, and what the form of its paths consists of.

What the form of the two paths consists of: each cause has a form of its own around the circle.

With the sense s of the turn (1 counter-clockwise, −1 clockwise) and the direction θ from the centre, to the first order
of deviation over radius:

==========================  ===================================================================
radius change ΔR            ΔR, one for each direction
centre (a, b)               a cos θ + b sin θ
difference D of diameters   D/4 cos 2θ (X less Y)
lag L of X behind Y         s L/2 sin 2θ: along the path the slower axis comes later
step B at X reversals       s B/2 cos θ sgn(sin θ): the slide stays back against its motion, by B/2 = b/2 + F/k
step B at Y reversals       −s B/2 sin θ sgn(cos θ)
==========================  ===================================================================

The last two are what lost motion does to a circle (Y. Kakino, Y. Ihara, A. Shinohara, "Accuracy Inspection of NC
Machine Tools by Double Ball Bar Method", Hanser 1993): each time an axis turns round, the path steps outward by B.

All are fitted at once, by least squares, to what the table adds to its motors, in both turns, away from the reversals.
The steps have a form of their own: point by point they lie within 1 µm inside of the circle after a reversal and within
1 µm outside of it before one.

The figures of the circular test, as ISO 230-4 (Test code for machine tools, part 4: circular tests) defines them.

Zones are taken about the least-squares circle's centre, which the standard allows beside the minimum zone; they are
never narrower than the minimum zone.

A measured turn: where the table went on one full circle, seen from the circle's centre.
"""

from dataclasses import dataclass
from typing import Final, Literal, NamedTuple

import numpy as np

from parser.controller_words import Axis
from parser.geometry.curves import Bools, Floats

Sense = Literal[1, -1]
SENSES: Final[tuple[Sense, Sense]] = (1, -1)
"""Counter-clockwise and clockwise, the order in which the two directions are run and told."""
NAMES: Final[dict[Sense, str]] = {1: "ccw", -1: "cw"}

_TURN: Final = 2.0 * np.pi
GRID: Final = 14_400
GRID_RAD: Final = np.asarray((np.arange(GRID) + 0.5) * (_TURN / GRID), dtype=np.float64)
"""Directions, 40 to the degree, in which turns are compared and fitted, each weighing alike; none lies on an axis."""
WIDEST_GAP_RAD: Final = np.radians(5.0)
"""A turn with a wider hole in its directions is none."""


@dataclass(frozen=True, slots=True, eq=False)
class MeasuredTurn:
    """One full circle in one direction.

    Attributes
    ----------
    sense
        1 counter-clockwise, −1 clockwise.
    points_um
        (n, 2) float64, places in the order of time, from the nominal centre.
    """

    sense: Sense
    points_um: Floats

    def angles_rad(self) -> Floats:
        """Directions (n,) of the places, 0 to 2π, 0 along +X."""
        return _angles(self.points_um)

    def radii_um(self, center_um: Floats) -> Floats:
        """Distances (n,) from a centre (2,), itself from the nominal one."""
        return _radii(self.points_um - center_um)

    def radii_on_grid(self, center_um: Floats) -> Floats:
        """Distances (`GRID`,) from a centre (2,), each the mean over its cell of the grid around that centre."""
        points = self.points_um - center_um
        return _cell_means(_angles(points), _radii(points))

    @property
    def goes_round(self) -> bool:
        """Whether its places lie all around the centre."""
        if not len(self.points_um):
            return False
        angles = np.sort(self.angles_rad())
        gaps = np.diff(angles, append=angles[0] + _TURN)
        return bool(gaps.max() <= WIDEST_GAP_RAD)


def _angles(points: Floats) -> Floats:
    angles: Floats = np.mod(np.arctan2(points[:, 1], points[:, 0]), _TURN)
    return angles


def _radii(points: Floats) -> Floats:
    radii: Floats = np.hypot(points[:, 0], points[:, 1])
    return radii


def _cell_means(angle: Floats, value: Floats) -> Floats:
    """Means (`GRID`,) over the cells of the grid of what is `value` (n,) at angles (n,) and straight between them."""
    order = np.argsort(angle, kind="stable")
    around = np.concatenate([angle[order[-1:]] - _TURN, angle[order], angle[order[:1]] + _TURN])
    values = value[np.concatenate([order[-1:], order, order[:1]])]
    area = np.cumsum(np.diff(around) * (values[1:] + values[:-1]) / 2.0)
    borders = np.arange(GRID + 1) * (_TURN / GRID)
    means: Floats = np.diff(np.interp(borders, around, np.concatenate([[0.0], area]))) * (GRID / _TURN)
    return means


class Direction(NamedTuple):
    """Figures of one direction, µm.

    Attributes
    ----------
    circularity_um
        Circular deviation G: width of the ring about the least-squares centre that holds the path.
    radial_max_um, radial_min_um
        Radial deviation F, largest and smallest: path from the nominal circle, about the nominal centre.
    mean_radius_um
        Radius of the least-squares circle less the nominal one.
    """

    circularity_um: float
    radial_max_um: float
    radial_min_um: float
    mean_radius_um: float


class Figures(NamedTuple):
    """Figures of both directions, µm.

    Attributes
    ----------
    circularity_um
        Bi-directional circular deviation G(b): width of the ring about the common least-squares centre that holds
        both paths.
    mean_radial_um
        Mean bi-directional radial deviation D: radius of the least-squares circle of both paths less the nominal one.
    hysteresis_um
        Circular hysteresis H of the standard's first edition (1996): largest radial difference of the two paths in one
        direction from the common centre.
    center_um
        Common least-squares centre (x, y) from the nominal one.
    ccw, cw
        Of each direction.
    """

    circularity_um: float
    mean_radial_um: float
    hysteresis_um: float
    center_um: tuple[float, float]
    ccw: Direction
    cw: Direction


def figures_of(ccw: MeasuredTurn, cw: MeasuredTurn, radius_um: float) -> Figures:
    """Figures of two turns that go round on a nominal radius."""
    center, mean = least_squares_circle(ccw, cw)
    radii = np.concatenate([ccw.radii_um(center), cw.radii_um(center)])
    apart = np.abs(ccw.radii_on_grid(center) - cw.radii_on_grid(center))
    return Figures(
        circularity_um=float(np.ptp(radii)),
        mean_radial_um=mean - radius_um,
        hysteresis_um=float(apart.max()),
        center_um=(float(center[0]), float(center[1])),
        ccw=_direction(ccw, radius_um),
        cw=_direction(cw, radius_um),
    )


def circularity(turn: MeasuredTurn) -> float:
    """Circular deviation G of one turn, µm."""
    return float(np.ptp(turn.radii_um(least_squares_circle(turn)[0])))


def least_squares_circle(*turns: MeasuredTurn) -> tuple[Floats, float]:
    """Centre (2,) µm from the nominal one, and radius µm, of the circle that fits the turns best.

    In closed form, by I. Kåsa, "A circle fitting procedure and its error analysis", IEEE Trans. Instrum. Meas. 25
    (1976): the circle x² + y² = 2ax + 2by + c is linear in a, b and c. It equals the least-squares circle but for
    terms of (deviation / radius)².
    """
    unit = np.stack([np.cos(GRID_RAD), np.sin(GRID_RAD)], axis=1)
    points = np.concatenate([turn.radii_on_grid(np.zeros(2))[:, None] * unit for turn in turns])
    scale = float(np.abs(points).max())
    u = points / scale
    (a, b, c), *_ = np.linalg.lstsq(np.column_stack([2.0 * u, np.ones(len(u))]), (u**2).sum(axis=1))
    return np.array([a, b]) * scale, float(np.sqrt(c + a**2 + b**2)) * scale


def _direction(turn: MeasuredTurn, radius_um: float) -> Direction:
    off = turn.radii_um(np.zeros(2)) - radius_um
    return Direction(
        circularity_um=circularity(turn),
        radial_max_um=float(off.max()),
        radial_min_um=float(off.min()),
        mean_radius_um=least_squares_circle(turn)[1] - radius_um,
    )


BEFORE_RAD: Final = np.radians(5.0)
AFTER_RAD: Final = np.radians(20.0)
"""Around a reversal, in the sense of travel, what is no part of the fit: there the slide stands, and spikes are."""
LEAST_SPIKE_UM: Final = 0.5
"""Half a step: up to here a spike may be a step of 1 µm that the table makes later than its motor."""
BESIDE_RAD: Final = np.radians(10.0)
"""Stretch on either side of that, on which a single reversal's step is measured."""

_UNKNOWNS: Final = 8


class Reversal(NamedTuple):
    """What an axis does where it turns round.

    Attributes
    ----------
    axis, side
        X turns round on the ``+`` and ``-`` side of X, Y on those of Y.
    sense
        Of the turn.
    step_um
        Outward step of the path, in the sense of travel.
    spike_um
        How far the path stands out from the path after the step; 0 where that is no more than the rest
        or than `LEAST_SPIKE_UM`.
    spike_deg
        Direction of the highest place of it from the nominal centre, 0 to 360; None without a spike.
    """

    axis: Axis
    side: Literal["+", "-"]
    sense: Sense
    step_um: float
    spike_um: float
    spike_deg: float | None


class DeviationParts(NamedTuple):
    """Parts of the deviation, µm.

    Attributes
    ----------
    radius_um
        Radius change (counter-clockwise, clockwise): the following of the drives.
    step_um
        Steps at reversals of (X, Y): backlash and the wind-up of the drive by friction, b + 2F/k; positive outward.
    diameters_um
        Diameter along X less that along Y.
    lag_um
        Way by which X lags behind Y at the feed of the test.
    rest_um
        Largest deviation that these leave, away from the reversals.
    reversals
        The eight reversals: counter-clockwise at +X, +Y, −X, −Y, then clockwise.
    """

    radius_um: tuple[float, float]
    step_um: tuple[float, float]
    diameters_um: float
    lag_um: float
    rest_um: float
    reversals: tuple[Reversal, ...]

    def spike_um(self, axis: Axis) -> float:
        """Highest spike of an axis."""
        return max(reversal.spike_um for reversal in self.reversals if reversal.axis == axis)


def parts_of(turns: tuple[MeasuredTurn, MeasuredTurn], motors: tuple[MeasuredTurn, MeasuredTurn]) -> DeviationParts:
    """Parts of two turns that go round, counter-clockwise and clockwise, driven by these turns of the motors."""
    center = np.zeros(2)
    pairs = zip(turns, motors, strict=True)
    added: Floats = np.stack([turn.radii_on_grid(center) - motor.radii_on_grid(center) for turn, motor in pairs])
    forms: Floats = np.stack([_forms(GRID_RAD, GRID_RAD, sense) for sense in SENSES])
    fair = np.stack([~_near_reversal(sense) for sense in SENSES])
    found = np.asarray(np.linalg.lstsq(forms[fair], added[fair])[0], dtype=np.float64)
    left = added - forms @ found
    rest_um = float(np.abs(left[fair]).max())
    of = found.tolist()
    return DeviationParts(
        radius_um=(of[0], of[1]),
        diameters_um=of[4],
        lag_um=of[5],
        step_um=(of[6], of[7]),
        rest_um=rest_um,
        reversals=tuple(
            _Fit(sense, added[row], left[row], found, rest_um).reversal(quarter)
            for row, sense in enumerate(SENSES)
            for quarter in range(4)
        ),
    )


def _forms(angle: Floats, within: Floats, sense: Sense) -> Floats:
    """Forms (n, 8) at directions (n,), each for a part of 1 µm; signs of motion are those at directions `within`."""
    cos, sin = np.cos(angle), np.sin(angle)
    forms = np.zeros((len(angle), _UNKNOWNS))
    forms[:, 0 if sense == 1 else 1] = 1.0
    forms[:, 2], forms[:, 3] = cos, sin
    forms[:, 4] = np.cos(2.0 * angle) / 4.0
    forms[:, 5] = sense * np.sin(2.0 * angle) / 2.0
    forms[:, 6] = sense * cos * np.sign(np.sin(within)) / 2.0
    forms[:, 7] = -sense * sin * np.sign(np.cos(within)) / 2.0
    return forms


def _past(angle: Floats, at_rad: float, sense: Sense) -> Floats:
    """Angles (n,) travelled past a direction, −π to π."""
    past: Floats = np.mod(sense * (angle - at_rad) + np.pi, 2.0 * np.pi) - np.pi
    return past


def _near_reversal(sense: Sense) -> Bools:
    """Which directions of the grid lie about a reversal."""
    past = np.stack([_past(GRID_RAD, quarter * np.pi / 2.0, sense) for quarter in range(4)])
    near: Bools = ((past > -BEFORE_RAD) & (past < AFTER_RAD)).any(axis=0)
    return near


class _Fit(NamedTuple):
    """One direction: what the table adds and what the parts leave of it on the grid, the parts (8,), and the rest."""

    sense: Sense
    added: Floats
    left: Floats
    found: Floats
    rest_um: float

    def reversal(self, quarter: int) -> Reversal:
        """What happens on passing an axis: 0 for +X, 1 for +Y, 2 for −X, 3 for −Y."""
        at_rad = quarter * np.pi / 2.0
        past = _past(GRID_RAD, at_rad, self.sense)
        after = self.left[(past >= AFTER_RAD) & (past < AFTER_RAD + BESIDE_RAD)].mean()
        before = self.left[(past <= -BEFORE_RAD) & (past > -BEFORE_RAD - BESIDE_RAD)].mean()
        spike_um, spike_rad = self._spike(at_rad, (past > -BEFORE_RAD) & (past < AFTER_RAD))
        stands_out = spike_um > max(self.rest_um, LEAST_SPIKE_UM)
        return Reversal(
            axis=Axis(quarter % 2),
            side="+" if quarter < 2 else "-",
            sense=self.sense,
            step_um=float(self.found[6 + quarter % 2] + after - before),
            spike_um=spike_um if stands_out else 0.0,
            spike_deg=float(np.degrees(spike_rad)) if stands_out else None,
        )

    def _spike(self, at_rad: float, near: Bools) -> tuple[float, float]:
        """Highest place of some near a reversal above the path after it, µm, and its direction."""
        angle = GRID_RAD[near]
        after = np.full_like(angle, at_rad + self.sense * np.pi / 4.0)
        above = self.added[near] - _forms(angle, after, self.sense) @ self.found
        top = int(above.argmax())
        return float(above[top]), float(angle[top])
