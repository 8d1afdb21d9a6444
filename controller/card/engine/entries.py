"""The list of the card: its entries, in pulses and seconds, their order, and where it ends.

Entries of the list: what the card runs one after another, in pulses and seconds.

A place holds the four axes; lines and arcs keep the columns of one row of a `Path`, so that a path is built of entries
without any arithmetic, and what is left of an entry after a stop is an entry again.

Lines and arcs as path calls give them, made into segments, or refused with the code for what is wrong with them.

What is too large for the card is refused with 3, whatever it is.

The list of the card: what is to be run, in order, and where it ends.
"""

import math
from collections import deque
from collections.abc import Iterable
from enum import Enum
from itertools import islice
from typing import NamedTuple, TypeAlias

import numpy as np

from controller.card.core.call import Code, Refused
from controller.card.core.settings import AXES
from controller.stepping.steps import Steps, interpolate_words
from parser.controller_words import StepWords

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


XY, YZ, ZX = (0, 1), (1, 2), (2, 0)
"""Planes as pairs of axes from 0; a positive turn goes from the first toward the second."""
_LARGEST = float(1 << 31)
"""Pulses; what is beyond fits no counter of the card. Grade C."""
_ROUNDING = 1e-9
"""Part of the diameter by which a chord may be longer, from rounding."""


def checked_line(number: int, pace: Pace, start: Place, end: Place) -> Segment:
    """Refused with 3 where it has no length or is too long."""
    check_size(*end)
    made = line(number, pace, start, end)
    if not made.length_um > 0.0:
        raise Refused(Code.LENGTH)
    return made


def arc_about(  # noqa: PLR0913, PLR0917 - an arc has these
    number: int, pace: Pace, start: Place, plane: tuple[int, int], centre: tuple[float, float], degrees: float
) -> Segment:
    """Refused with 2 where the centre is the start, with 7 where the angle is 0 or beyond a full turn."""
    if not 0.0 < abs(degrees) <= 360.0:
        raise Refused(Code.PARAMETER)
    return _about(number, pace, start, plane, centre, math.radians(degrees))


def arc_by_radius(  # noqa: PLR0913, PLR0917 - an arc has these
    number: int, pace: Pace, start: Place, plane: tuple[int, int], end: tuple[float, float], radius: float, sense: int
) -> Segment:
    """The minor arc for a positive radius, the major one for a negative; sense +1 or −1.

    Refused with 2 where radius or chord is 0, with 5 where the chord is longer than the diameter, with 7 for another
    sense.
    """
    if sense not in (1, -1):
        raise Refused(Code.PARAMETER)
    check_size(*end, radius)
    at = (start[plane[0]], start[plane[1]])
    chord = math.dist(at, end)
    if not chord or not radius:
        raise Refused(Code.RADIUS)
    half = chord / (2.0 * abs(radius))
    if half > 1.0 + _ROUNDING:
        raise Refused(Code.CHORD)
    angle = 2.0 * math.asin(min(half, 1.0))
    sweep = sense * (angle if radius > 0.0 else 2.0 * math.pi - angle)
    # The centre lies on the chord's middle line, to its left for a minor arc to the left.
    aside = math.sqrt(max(radius * radius - chord * chord / 4.0, 0.0)) * math.copysign(1.0, radius * sense) / chord
    u, v = end[0] - at[0], end[1] - at[1]
    centre = (at[0] + u / 2.0 - v * aside, at[1] + v / 2.0 + u * aside)
    return _ending(_about(number, pace, start, plane, centre, sweep), plane, end)


def arc_to(  # noqa: PLR0913, PLR0917 - an arc has these
    number: int,
    pace: Pace,
    start: Place,
    plane: tuple[int, int],
    centre: tuple[float, float],
    end: tuple[float, float],
    sense: int,
) -> Segment:
    """About a centre as far as the direction of an end, a full turn where that is the direction of the start.

    Refused with 2 where start or end is the centre.
    """
    check_size(*end)
    first = math.atan2(start[plane[1]] - centre[1], start[plane[0]] - centre[0])
    last = math.atan2(end[1] - centre[1], end[0] - centre[0])
    turn = math.fmod(sense * (last - first), 2.0 * math.pi)
    sweep = turn if turn > 0.0 else turn + 2.0 * math.pi
    if end == centre:
        raise Refused(Code.RADIUS)
    return _ending(_about(number, pace, start, plane, centre, sense * sweep), plane, end)


def _about(  # noqa: PLR0913, PLR0917 - an arc has these
    number: int, pace: Pace, start: Place, plane: tuple[int, int], centre: tuple[float, float], sweep_rad: float
) -> Segment:
    if (start[plane[0]], start[plane[1]]) == centre:
        raise Refused(Code.RADIUS)
    check_size(*centre)
    made = arc(number, pace, start, plane, centre, sweep_rad)
    check_size(*made.end)
    return made


def check_size(*values: float) -> None:
    """Refused with 3 where a number is too large, or has become none on its way to pulses."""
    if not all(abs(value) < _LARGEST for value in values):
        raise Refused(Code.LENGTH)


def _ending(segment: Segment, plane: tuple[int, int], end: tuple[float, float]) -> Segment:
    """The segment with the end that was asked for, without the rounding of its angle."""
    place = list(segment.end)
    place[plane[0]], place[plane[1]] = end
    x, y, z, a = place
    return segment._replace(end=(x, y, z, a))


_KEPT = 4096
"""Blocks are kept to count their steps at once; never more than these."""


class MotionList:
    """Entries that are not finished, and where the next one starts.

    Attributes
    ----------
    entries
        In order. Those of the stretch that runs stay until the stretch is cut or ends.
    is_open
        Whether path calls are stored.
    number
        Number of the next path entry: 0 for the positioning move that opens a list; every other has 1 or more.
    executed
        Number of the path entry executed last, as far as a cut or the end of its stretch told.
    begun
        How often the list was emptied to begin anew.
    start
        Where the first entry starts.
    """

    def __init__(self) -> None:
        self.entries: deque[Entry] = deque()
        self.is_open = False
        self.number = self.executed = 0
        self.begun = 0
        self.start = self._end = ORIGIN
        self._uncounted: list[Stepped] = []

    def clear(self, *, is_open: bool) -> None:
        """Forget all entries; numbers begin anew."""
        self.entries.clear()
        self.begun += 1
        self.is_open, self.number, self.executed = is_open, 0, 0

    def begin(self, place: Place) -> None:
        """Let the entries begin at a place; for an empty list."""
        self.start, self._end = place, place
        self._uncounted.clear()

    def push(self, entry: Entry) -> None:
        """Append an entry; a line or an arc starts at the `end` asked for before."""
        self.entries.append(entry)
        if isinstance(entry, Segment):
            self.number, self._end = entry.number + 1, entry.end
        elif isinstance(entry, Stepped):
            self.number = entry.number + 1
            self._uncounted.append(entry)
            if len(self._uncounted) >= _KEPT:
                self.end()

    def end(self) -> Place:
        """Where the next entry starts."""
        if self._uncounted:
            x, y = steps_of(self._uncounted).corner_um[-1].tolist()
            place = self._end
            self._end = (float(np.rint(place[0]) + x), float(np.rint(place[1]) + y), place[2], place[3])
            self._uncounted.clear()
        return self._end

    def first_run(self) -> list[Entry]:
        """The entries from the front that one interpolator runs."""
        kind: Stepping | None = None
        for n, entry in enumerate(self.entries):
            own = entry.kind
            if own is not None and kind is not None and own is not kind:
                return list(islice(self.entries, n))
            kind = own or kind
        return list(self.entries)

    def start_from(self, place: Place) -> None:
        """Let the list begin at a place. Refused with 1 unless its first path entry, if it has one, is a line."""
        paths = ((n, entry) for n, entry in enumerate(self.entries) if isinstance(entry, PathEntry))
        first, entry = next(paths, (0, None))
        if entry is None:
            self.begin(place)
            return
        if not isinstance(entry, Segment) or entry.curvature:
            raise Refused(Code.COMMAND)
        self.entries[first] = line(entry.number, entry.pace, place, entry.end)._replace(call=entry.call)

    def replace(self, n: int, left: list[Entry]) -> None:
        """Put what is left of the first n entries in their place."""
        for _ in range(n):
            self.entries.popleft()
        self.entries.extendleft(reversed(left))


def steps_of(blocks: list[Stepped]) -> Steps:
    """Steps of whole blocks, whatever part of them is made."""
    columns = np.array([block[2:8] for block in blocks], dtype=np.int64).reshape(-1, 6).T
    x, y, count, axis, quadrant, turn = np.ascontiguousarray(columns)
    words = StepWords(x, y, count, axis, quadrant, turn, radius_um=np.full_like(x, -1), curve=np.zeros_like(x))
    return interpolate_words(words, np.array([block.length_um for block in blocks], dtype=np.float64))
