"""Entries of the list: what the card runs one after another, in pulses and seconds.

A place holds the four axes; lines and arcs keep the columns of one row of a `Path`, so that a path is built of entries
without any arithmetic, and what is left of an entry after a stop is an entry again.
"""

import math
from collections.abc import Iterable
from enum import Enum
from typing import NamedTuple, TypeAlias

from controller.card.core.settings import AXES

Place: TypeAlias = tuple[float, float, float, float]

ORIGIN: Place = (0.0, 0.0, 0.0, 0.0)

NO_LENGTH = 1e-9
"""A path no longer than this, in pulses, has no length; grade C."""


NO_NUMBER = -1
"""Of an entry that runs at once, outside the list."""


class Stepping(Enum):
    """Who moves the axes: the card's own interpolator, or point-by-point comparison."""

    EQUAL_TIME = "equal time"
    STEPPED = "stepped"


class Pace(NamedTuple):
    """How an entry is run: speed µm/s, acceleration µm/s², rapid or not, and its end speed where one was set."""

    speed_um_s: float
    acceleration_um_s2: float
    rapid: bool = False
    end_um_s: float | None = None


class Segment(NamedTuple):
    """A line or an arc; see `Path` for the columns. Without length it only counts as executed.

    `call` is the number of the card's call that made it, from 1; 0 before it is known.
    """

    number: int
    pace: Pace
    start: Place
    tangent: Place
    normal: Place
    curvature: float
    length_um: float
    end: Place
    call: int = 0

    @property
    def kind(self) -> Stepping | None:
        """`EQUAL_TIME`; None without length, which fits any motion."""
        return Stepping.EQUAL_TIME if self.length_um > 0.0 else None

    def rest(self, s_um: float) -> "Segment":
        """What is left of it from `s_um` on."""
        s = min(s_um, self.length_um)
        turn = self.curvature * s
        sin, cos = math.sin(turn), math.cos(turn)
        axes = range(AXES)
        tangent = tuple(self.tangent[i] * cos + self.normal[i] * sin for i in axes)
        normal = tuple(self.normal[i] * cos - self.tangent[i] * sin for i in axes)
        radius = 1.0 / self.curvature if self.curvature else 0.0
        forward = sin * radius if self.curvature else s
        aside = 2.0 * math.sin(turn / 2.0) ** 2 * radius
        start = tuple(self.start[i] + self.tangent[i] * forward + self.normal[i] * aside for i in axes)
        return self._replace(
            start=four(start), tangent=four(tangent), normal=four(normal), length_um=self.length_um - s
        )


class Stepped(NamedTuple):
    """One 3B block in X and Y, stepped point by point; its words as in `StepWords`, `axis` the counted one.

    `length_um` is that of its ideal path, of which `offset_um` are run, and `done` of its steps are made.
    """

    number: int
    pace: Pace
    x_um: int
    y_um: int
    count_um: int
    axis: int
    quadrant: int
    turn: int
    length_um: float
    offset_um: float = 0.0
    done: int = 0

    @property
    def kind(self) -> Stepping:
        """`STEPPED`."""
        return Stepping.STEPPED


class Wait(NamedTuple):
    """Standing still for a time."""

    seconds: float

    @property
    def kind(self) -> None:
        """None: it fits any motion."""


class Output(NamedTuple):
    """Outputs under the mask take the levels of `value`."""

    mask: int
    value: int

    @property
    def kind(self) -> None:
        """None: it fits any motion."""


PathEntry: TypeAlias = Segment | Stepped
"""An entry along a path; without length it only counts as executed."""

Entry: TypeAlias = PathEntry | Wait | Output


def steps_made(entry: PathEntry) -> int:
    """Steps of an entry that are made."""
    return entry.done if isinstance(entry, Stepped) else 0


def four(values: Iterable[float]) -> Place:
    """A place of four axes."""
    x, y, z, a = values
    return (x, y, z, a)


def line(number: int, pace: Pace, start: Place, end: Place) -> Segment:
    """Straight from place to place; every axis counts for its length (grade C for X, Y with Z and A)."""
    by = [b - a for a, b in zip(start, end, strict=True)]
    length = math.hypot(*by)
    if length <= NO_LENGTH:
        return Segment(number, pace, start, ORIGIN, ORIGIN, 0.0, 0.0, end)
    tangent = four(d / length for d in by)
    return Segment(number, pace, start, tangent, ORIGIN, 0.0, length, end)


def arc(  # noqa: PLR0913, PLR0917 - an arc has these
    number: int, pace: Pace, start: Place, plane: tuple[int, int], centre: tuple[float, float], sweep_rad: float
) -> Segment:
    """About a centre in the plane of two axes (from 0), positive from the first axis toward the second.

    The start is not the centre.
    """
    i, j = plane
    u, v = start[i] - centre[0], start[j] - centre[1]
    radius, sense = math.hypot(u, v), math.copysign(1.0, sweep_rad)
    tangent, normal, end = list(ORIGIN), list(ORIGIN), list(start)
    tangent[i], tangent[j] = -v / radius * sense, u / radius * sense
    normal[i], normal[j] = -u / radius, -v / radius
    if abs(sweep_rad) < 2.0 * math.pi:
        cos, sin = math.cos(sweep_rad), math.sin(sweep_rad)
        end[i], end[j] = centre[0] + u * cos - v * sin, centre[1] + u * sin + v * cos
    length = radius * abs(sweep_rad)
    return Segment(number, pace, start, four(tangent), four(normal), 1.0 / radius, length, four(end))
