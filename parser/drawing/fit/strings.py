"""Strings: runs of curve without a corner, and the longest arcs along them.

Pieces joined to strings: runs of curve without a corner, and a length along all of them that tells places.

The longest arcs along strings, one behind the other, over all strings at once.

Arcs through two places that lie near what runs between them: all those that do are one range of bends.
"""

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from parser.drawing.fit.pieces import FLATTEST_UM, Pieces, legs_of
from parser.geometry.curves import Bools, Floats, Ints, total_before

_CORNER_RAD = math.radians(1.0)
"""Directions that jump more are corners: arcs with nodes on a curve join at up to 2°, so less is no one's intent."""
_SAME_UM = 1e-6  # what rounding leaves between the ends of pieces that follow each other
_STEPS = 8  # of each piece in the table of lengths
_SEEN = 1e-6  # a leg of a control polygon that is shorter beside the whole has no direction to speak of


class Strings(NamedTuple):
    """Runs of curve, and where along all of them each place is.

    Attributes
    ----------
    power
        (degree + 1, n, 3) coefficients of the powers 0 … of each piece's parameter in [0, 1], as x·w, y·w, w.
    control
        (n, degree + 1, 3) the same as control points.
    along, at
        (m,) lengths along all pieces, close to those of arc, and the piece and the share of it there, as one number.
    first, last
        (k,) the pieces of a string: from `first` to before `last`.
    of
        (k,) the curve that it is of.
    is_closed
        (k,) whether it runs into itself smoothly; its pieces then stand there twice, for runs that start anywhere.
    """

    power: Floats
    control: Floats
    along: Floats
    at: Floats
    first: Ints
    last: Ints
    of: Ints
    is_closed: Bools


def strings_of(pieces: Pieces) -> Strings:
    """The strings of pieces. ValueError where pieces of one curve do not meet."""
    follows = np.diff(pieces.of) == 0
    place = pieces.control[:, [0, -1], :2] / pieces.control[:, [0, -1], 2:]
    gap = np.hypot(*(place[1:, 0] - place[:-1, 1]).T)
    scale = np.abs(place).max(initial=1.0)
    same = max(_SAME_UM, 1e-13 * scale)
    if (gap[follows] > same).any():
        raise ValueError("a curve that is torn")
    into, out = _directions(pieces.control)
    smooth = follows & (_between(out[:-1], into[1:]) <= _CORNER_RAD)
    first = np.flatnonzero(np.concatenate([[True], ~smooth]))
    last = np.append(first[1:], len(pieces.of))
    whole = np.bincount(pieces.of, minlength=pieces.of[-1] + 1)[pieces.of[first]] == last - first
    shut = np.hypot(*(place[first, 0] - place[last - 1, 1]).T) <= same
    closed = whole & shut & (_between(out[last - 1], into[first]) <= _CORNER_RAD)
    return _with_table(pieces, first, last, closed)


def _with_table(pieces: Pieces, first: Ints, last: Ints, closed: Bools) -> Strings:
    number = (last - first) * np.where(closed, 2, 1)
    end = np.cumsum(number)
    string = np.repeat(np.arange(len(first)), number)
    row = first[string] + (np.arange(len(string)) - (end - number)[string]) % (last - first)[string]
    control = pieces.control[row]
    power = _powers(control)
    at = np.arange(len(row) * _STEPS + 1) / _STEPS
    share = np.broadcast_to(np.linspace(0.0, 1.0, _STEPS + 1), (len(row), _STEPS + 1))
    place = _placed(power, np.arange(len(row))[:, None], share)
    step = np.diff(place, axis=1)
    along = total_before(np.hypot(step[:, :, 0], step[:, :, 1]).ravel())
    return Strings(power, control, along, at, end - number, end, pieces.of[first], closed)


def places_on(strings: Strings, along: Floats, first: Ints, last: Ints) -> Floats:
    """Places (r, m, 2) in µm at lengths (r, m), each row on pieces from `first` to before `last` (r,)."""
    piece, share = where_at(strings, along, first[:, None], last[:, None])
    return _placed(strings.power, piece, share)


def where_at(strings: Strings, along: Floats, first: Ints, last: Ints) -> tuple[Ints, Floats]:
    """The piece at lengths, of those from `first` to before `last`, and the share of its parameter."""
    at = np.interp(along, strings.along, strings.at)
    piece = np.clip(at.astype(np.int64), first, last - 1)
    return piece, np.clip(at - piece, 0.0, 1.0)


def _placed(power: Floats, piece: Ints, share: Floats) -> Floats:
    value = power[-1][piece]
    for factors in power[-2::-1]:
        value = value * share[..., None] + factors[piece]
    place: Floats = value[..., :2] / value[..., 2:]
    return place


def _powers(control: Floats) -> Floats:
    """Coefficients (p + 1, n, 3) of powers from control points: binomials of p times differences of each order."""
    degree = control.shape[1] - 1
    rows, part = [], control
    for order in range(degree + 1):
        rows.append(math.comb(degree, order) * part[:, 0])
        part = np.diff(part, axis=1)
    return np.stack(rows)


def _directions(control: Floats) -> tuple[Floats, Floats]:
    """The legs (n, 2) of control polygons along which pieces start and end."""
    leg, length = legs_of(control)
    seen = length > _SEEN * length.max(axis=1, keepdims=True)
    rows = np.arange(len(leg))
    return leg[rows, seen.argmax(axis=1)], leg[rows, leg.shape[1] - 1 - seen[:, ::-1].argmax(axis=1)]


def _between(this: Floats, other: Floats) -> Floats:
    angle: Floats = np.abs(np.arctan2(this[:, 0] * other[:, 1] - this[:, 1] * other[:, 0], (this * other).sum(axis=1)))
    return angle


_FULLEST = 3.7  # tan of half the sweep, 75°: what runs on an arc then still runs along its chord
_TINY_OF_TOLERANCE = 0.5
_FAR = -7.0  # half as long is looked at next


class Chords(NamedTuple):
    """Lines (n,) from place to place: the middle (n, 2), the unit vector along (n, 2), and half the length (n,)."""

    middle_um: Floats
    along: Floats
    half_um: Floats


class Bends(NamedTuple):
    """The arc of each row that lies best.

    Attributes
    ----------
    bend
        (r,) 1 / distance of its centre from the chord, to the left of it, in 1/µm; 0 for the chord itself.
    is_near
        (r,) whether it lies within the tolerance of all places.
    spare
        (r,) how much of the tolerance is left, of the whole, near enough: below 0 where it lies farther off.
    """

    bend: Floats
    is_near: Bools
    spare: Floats


def chords_between(start_um: Floats, end_um: Floats) -> Chords:
    """The chords between places (n, 2); along X where they are the same."""
    by = end_um - start_um
    length = np.hypot(by[:, 0], by[:, 1])
    along = np.where(length[:, None] > 0.0, by / np.where(length > 0.0, length, 1.0)[:, None], (1.0, 0.0))
    return Chords(0.5 * (start_um + end_um), along, 0.5 * length)


def bends_near(place_um: Floats, tolerance_um: Floats) -> Bends:
    """The best arc through the first and the last of places (r, m, 2), of those within a tolerance (r,) of all.

    In the frame of the chord, of half length a, with the centre at (0, h): the arc passes (x, y) within t where
    |x² + y² − a² − t² − 2hy| ≤ 2t√(a² + h²). Squared, and with v = 1/h, that is a range between the two roots of
    (S² − 4t²a²)v² − 4Syv + 4(y² − t²), with S = x² + y² − a² − t². The ranges of all places have one in common.
    """
    x, y, half = _in_frame(place_um)
    t, a = tolerance_um[:, None], half[:, None]
    power = x**2 + y**2 - a**2 - t**2
    bound = power**2 - 4.0 * t**2 * a**2
    free = bound <= 1e-9 * power**2
    bound = np.where(free, 1.0, bound)
    root = 2.0 * t * np.sqrt(np.maximum(bound + 4.0 * a**2 * y**2, 0.0)) / bound
    best = 2.0 * power * y / bound
    fullest = _FULLEST / np.maximum(half, 1e-300)
    low = np.maximum(np.where(free, -np.inf, best - root).max(axis=1), -fullest)
    high = np.minimum(np.where(free, np.inf, best + root).min(axis=1), fullest)
    bend = 0.5 * (low + high)
    flat = np.abs(bend) * FLATTEST_UM < 1.0
    bend = np.where(flat, 0.0, bend)
    ahead = (np.diff(x, axis=1, prepend=-a, append=a) > 0.0).all(axis=1) & (power < 0.0).all(axis=1)
    near = ahead & (low <= high) & (~flat | ((low <= 0.0) & (high >= 0.0)))
    common = np.where(flat, 2.0 * np.minimum(high, -low), high - low)
    spare = common / np.minimum(2.0 * np.where(free, np.inf, root).min(axis=1), 2.0 * fullest)
    return _with_tiny(place_um, tolerance_um, Bends(bend, near, np.where(ahead, np.maximum(spare, _FAR), _FAR)))


def _in_frame(place_um: Floats) -> tuple[Floats, Floats, Floats]:
    """Places but the ends as x and y (r, m − 2) from the middle of the chord and along it, and half its length (r,)."""
    chord = chords_between(place_um[:, 0], place_um[:, -1])
    out = place_um[:, 1:-1] - chord.middle_um[:, None]
    x = out[:, :, 0] * chord.along[:, None, 0] + out[:, :, 1] * chord.along[:, None, 1]
    y = out[:, :, 1] * chord.along[:, None, 0] - out[:, :, 0] * chord.along[:, None, 1]
    return x, y, chord.half_um


def _with_tiny(place_um: Floats, tolerance_um: Floats, bends: Bends) -> Bends:
    """What lies within half the tolerance of its start may be a line, whatever it does there."""
    out = place_um - place_um[:, :1]
    tiny = ~bends.is_near & (np.hypot(out[:, :, 0], out[:, :, 1]).max(axis=1) <= _TINY_OF_TOLERANCE * tolerance_um)
    return Bends(np.where(tiny, 0.0, bends.bend), bends.is_near | tiny, np.where(tiny, 0.5, bends.spare))


STEPS = 18
"""In which an arc is held against the curve. On most curves the deviation is largest at 0.211 and 0.789 of its length,
about a vertex in the middle and at 0.117 and 0.883: eighteenths come near to all of these, within 0.2 % of it."""
MOST_ARCS = 600_000
_GOOD_SPARE = 0.01  # of the tolerance: 0.3 % of the length
_GOOD_STEP = 2e-3  # of the length
_AIM = 0.005  # of the tolerance that the next try shall spare
_MOST_TRIES = 10  # from where on only the middle is tried


class Runs(NamedTuple):
    """Ways along strings that are to be covered: from `low` to `high` (r,) on pieces `first` to before `last` (r,)."""

    low: Floats
    high: Floats
    first: Ints
    last: Ints

    def picked(self, row: Ints | Bools) -> "Runs":
        """The rows `row`."""
        return Runs(self.low[row], self.high[row], self.first[row], self.last[row])


class Arcs(NamedTuple):
    """Arcs (n,) along runs: the run of each, where on it it starts and ends, its bend and what it spares (`Bends`)."""

    run: Ints
    start: Floats
    end: Floats
    bend: Floats
    spare: Floats

    def picked(self, row: Ints | Bools) -> "Arcs":
        """The rows `row`."""
        return Arcs(self.run[row], self.start[row], self.end[row], self.bend[row], self.spare[row])


class _Search:
    """Where each of the runs that are not yet covered stands.

    From `start` the arc to `good` is near with `bend` and `spare`, that to `bad` is not, and `next` is to be tried.
    """

    def __init__(self, runs: Runs, tolerance_um: Floats, like: Arcs | None) -> None:
        self.row = np.arange(len(runs.low))
        self.runs, self.tolerance_um = runs, tolerance_um
        self.start, self.next = runs.low.copy(), runs.high.copy()
        self.good, self.bad = runs.low.copy(), np.full(len(runs.low), np.inf)
        self.bend, self.spare = np.zeros((2, len(runs.low)))
        self.tries, self.arc = np.zeros((2, len(runs.low)), dtype=np.int64)
        if like is not None:
            self.length = like.end - like.start
            self.arc = np.searchsorted(like.run, self.row)
            self.last = np.searchsorted(like.run, self.row, side="right") - 1
            self.next = np.minimum(self.start + self.length[self.arc], runs.high)
        else:
            self.length, self.last = np.empty(0), self.arc

    def likely(self) -> Floats:
        """How long the next arc of each row is likely to be: as that of the arcs given to go by, or as the last one."""
        if not len(self.length):
            return np.asarray(self.good - self.start)
        return np.asarray(self.length[np.minimum(self.arc, self.last)])

    def keep(self, row: Bools) -> None:
        """Let go of the runs that are covered."""
        self.runs = self.runs.picked(row)
        for name in ("row", "tolerance_um", "start", "next", "good", "bad", "bend", "spare", "tries", "arc", "last"):
            setattr(self, name, getattr(self, name)[row])


def longest_arcs(
    strings: Strings, runs: Runs, tolerance_um: Floats, like: Arcs | None = None, steps: int = STEPS
) -> Arcs:
    """Arcs that cover the runs, each as long as it may be within a tolerance (r,) of the places looked at.

    `like` are arcs that cover them within about that tolerance: with these it goes faster, and a run that needs more
    arcs than it has there is left when it has one more. ValueError where there are arcs without number.
    """
    search = _Search(runs, tolerance_um, like)
    share = np.arange(steps + 1) / steps
    found: list[Arcs] = []
    total = 0
    while len(search.row):
        along = search.start[:, None] + (search.next - search.start)[:, None] * share
        place = places_on(strings, along, search.runs.first, search.runs.last)
        done = _learn(search, bends_near(place, search.tolerance_um))
        found.append(
            Arcs(search.row[done], search.start[done], search.good[done], search.bend[done], search.spare[done])
        )
        total += int(done.sum())
        if total > MOST_ARCS:
            raise ValueError("arcs without number")
        _go_on(search, done)
    return joined_arcs(found)


def joined_arcs(parts: Sequence[Arcs]) -> Arcs:
    """Arcs of one or more parts, by runs and along them."""
    run, start, end, bend, spare = (np.concatenate(column) for column in zip(*parts, strict=True))
    return Arcs(run, start, end, bend, spare).picked(np.lexsort((start, run)))


def _learn(search: _Search, bends: Bends) -> Bools:
    """Take in what the tries gave, and choose the next; which (k,) rows have found their arc."""
    near, tried = bends.is_near, search.next
    length = tried - search.start
    hopeless = ~near & (length <= 0.1 * search.tolerance_um)  # nothing so short can be far off
    near = near | hopeless
    search.good = np.where(near, tried, search.good)
    search.bend = np.where(near, np.where(hopeless, 0.0, bends.bend), search.bend)
    search.spare = np.where(near, bends.spare, search.spare)
    search.bad = np.where(near, search.bad, tried)
    search.tries += 1
    spare = np.where(near, np.maximum(bends.spare, 0.0), np.minimum(bends.spare, -1e-3))
    by = length * np.cbrt((1.0 - _AIM) / np.maximum(1.0 - spare, 0.03))
    bracketed = np.isfinite(search.bad)
    between = search.bad - search.good
    low = np.where(bracketed, search.good + 0.03 * between, search.start + 1.05 * length)
    high = np.where(bracketed, search.bad - 0.03 * between, np.inf)
    next_end = np.clip(search.start + by, low, np.maximum(low, high))
    halfway = bracketed & (search.tries > _MOST_TRIES)
    next_end = np.where(halfway, search.good + 0.5 * np.where(bracketed, between, 0.0), next_end)
    search.next = np.minimum(next_end, search.runs.high)
    reached = search.good - search.start
    close = (between <= _GOOD_STEP * reached) | hopeless
    return np.asarray((reached > 0.0) & ((search.good >= search.runs.high) | close | (near & (spare <= _GOOD_SPARE))))


def _go_on(search: _Search, done: Bools) -> None:
    """Start the next arc of the rows that found theirs."""
    search.arc = search.arc + done
    length = search.likely()
    search.start = np.where(done, search.good, search.start)
    search.next = np.where(done, np.minimum(search.good + length, search.runs.high), search.next)
    search.bad = np.where(done, np.inf, search.bad)
    search.tries = np.where(done, 0, search.tries)
    more = (search.arc <= search.last + 1) if len(search.length) else np.ones(len(length), dtype=np.bool_)
    search.keep((search.start < search.runs.high) & more)
