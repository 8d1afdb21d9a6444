"""A draft: what is to be written, whatever the language, with the curve marks that 4B has for it.

A draft: what is to be written, whatever the language; from a toolpath, or made by whoever has curves.

Rapids as a language says them: 3B has no word for one, and a line is in the air because the wire is out.

What an ISO program switches where it stands, beside moving the wire: dwells, optional stops, feeds, conditions.

Words mean the same in every family for a dwell and for M01. A feed and a condition are numbers of one family's tables:
they are kept where that family's ISO is written, and else told to be lost.

Curve marks of 4B: which arcs are convex on the part (docs/3b.md §6).
"""

import math
import re
from dataclasses import dataclass, fields, replace
from typing import Literal, NamedTuple

import numpy as np

from parser.controller_words import Compensation, StepWords, Taper
from parser.geometry.curves import Bools, CurveKind, Curves, Floats, Ints, curves_between, joined
from parser.iso.listing.lexer import read_listing
from parser.iso.listing.listing import Listing
from parser.toolpath import Stop, Toolpath

EventKind = Literal["dwell", "optional-stop", "feed", "condition"]
OF_THE_FAMILY = "FECS"
"""Letters of feeds and cutting conditions (docs/iso.md §4)."""
_DWELL, _OPTIONAL = 4, 1
_TIMES = "XUP"


class Event(NamedTuple):
    """One of them: how many rows of a toolpath run before it, its word as it is written, and its number.

    The number of a dwell is s, that of the others as written.
    """

    kind: EventKind
    after: int
    word: str
    number: float

    @property
    def is_common(self) -> bool:
        """Whether its word means the same in every family."""
        return self.kind in {"dwell", "optional-stop"}


def events_of(toolpath: Toolpath) -> tuple[Event, ...] | None:
    """Events of an ISO program in the order in which they stand; None where blocks do not run in that order.

    A stop counts behind the move of its block, the others in front of it. What stands behind the end is none.
    """
    first = toolpath.source.span[:, 0]
    if (np.diff(first) < 0).any():
        return None
    listing = read_listing(toolpath.source.text)
    words, blocks = listing.words, listing.blocks
    end = next((stop.line for stop in toolpath.stops if stop.kind == "end"), math.inf)
    is_dwell = listing.blocks_of(np.flatnonzero((words.letter == ord("G")) & (words.value == _DWELL)))
    is_time = is_dwell[words.block] & np.isin(words.letter, [ord(letter) for letter in _TIMES])
    is_optional = (words.letter == ord("M")) & (words.value == _OPTIONAL)
    is_of_family = np.isin(words.letter, [ord(letter) for letter in OF_THE_FAMILY])
    runs = blocks.line[words.block] <= end
    found = []
    for at in np.flatnonzero((is_time | is_optional | is_of_family) & runs).tolist():
        place = (blocks.past if is_optional[at] else blocks.first)[words.block[at]]
        after = int(np.searchsorted(first, place))
        found.append(_dwell(listing, at, after) if is_time[at] else _other(listing, at, after))
    return tuple(found)


def _dwell(listing: Listing, word: int, after: int) -> Event:
    """X and U are s; P is s with a point, else ms (docs/iso.md §4)."""
    number, letter = float(listing.words.value[word]), chr(listing.words.letter[word])
    seconds = number / 1000.0 if letter == "P" and listing.words.decimals[word] < 0 else number
    return Event("dwell", after, f"G04 X{seconds:.3f}", seconds)


def _other(listing: Listing, word: int, after: int) -> Event:
    letter, number = chr(listing.words.letter[word]), float(listing.words.value[word])
    kind: EventKind = "optional-stop" if letter == "M" else "feed" if letter == "F" else "condition"
    return Event(kind, after, "M01" if letter == "M" else listing.written(word), number)


def written_events(events: tuple[Event, ...]) -> dict[int, list[str]]:
    """Blocks by how many rows run before them: dwells alone, feeds and conditions together."""
    blocks: dict[int, list[str]] = {}
    together: set[int] = set()
    for event in events:
        lines = blocks.setdefault(event.after, [])
        if event.kind == "dwell":
            lines.append(event.word)
            together.discard(event.after)
        elif event.kind != "optional-stop":
            if event.after in together:
                lines[-1] += f" {event.word}"
            else:
                lines.append(event.word)
            together.add(event.after)
    return blocks


def optional_stops(events: tuple[Event, ...]) -> set[int]:
    """How many rows run before each optional stop."""
    return {event.after for event in events if event.kind == "optional-stop"}


_PLACED = re.compile(r"\s*(?:N\s*\d+\s*)?(?:Start|PSET|.*G\s*92(?!\d))", re.IGNORECASE)
_STAYS_UM = 1.5
"""An arc whose radii at start and end differ by no more, as rounding both to whole µm makes it, keeps its centre."""


@dataclass(frozen=True, slots=True, eq=False)
class Draft:
    """What is to be written, n rows.

    Attributes
    ----------
    curves
        Lines, arcs and jumps; each begins where the one before it ends.
    stops
        Pauses and the end; no two at one place.
    is_placed
        (n,) jumps whose end is named as a place, and not gone to: the wire is threaded there by hand.
    told_um
        (n, 2) ways from the starts of arcs to their centres that are to be written so; NaN where the centre may move
        until the arc ends where it should.
    words
        The words of a counting controller that are to be written; None where they are to be told.
    compensation
        The controller's offset that is to be written; None where it has none.
    events
        What is switched where it stands, in ISO.
    taper
        The lean of the wire that is to be written, in ISO; None of an upright one.
    upper
        The contour at the top of the work, each of its n rows the partner of a row of `curves`; None of one contour.
    is_meant
        Whether the curves are what is meant, and not what a program made of it: the nearest whole numbers are written
        then, in place of those that a CAM would have written.
    """

    curves: Curves
    stops: tuple[Stop, ...]
    is_placed: Bools
    told_um: Floats
    words: StepWords | None = None
    compensation: Compensation | None = None
    is_meant: bool = False
    events: tuple[Event, ...] = ()
    taper: Taper | None = None
    upper: Curves | None = None

    def __len__(self) -> int:
        return len(self.curves)

    def without_compensation(self) -> "Draft":
        """The same path, with nothing said of the controller's offset."""
        return replace(self, compensation=None)


class Written(NamedTuple):
    """A text.

    Attributes
    ----------
    text
        All of it.
    row
        (m,) row of the draft that each of its blocks is of; a row may make no block, or some.
    ramp_ms
        Acceleration time that it sets, as its shortest blocks ask for it; 0 where it leaves that to the card.
    upper
        Text of the upper contour, block by block, where that has one of its own, as in 3B; else None.
    """

    text: str
    row: Ints
    ramp_ms: int = 0
    upper: str | None = None


def draft_of(toolpath: Toolpath) -> Draft:
    """The draft of a toolpath: its words where it has such, the centres of arcs as they are told."""
    pauses = {stop.after: stop for stop in toolpath.stops if stop.kind == "pause"}
    ends = [stop for stop in toolpath.stops if stop.kind == "end"]
    return Draft(
        curves=Curves(**{field.name: getattr(toolpath, field.name) for field in fields(Curves)}),
        stops=(*(stop for after, stop in sorted(pauses.items()) if 0 < after < len(toolpath)), *ends[:1]),
        is_placed=_placed(toolpath),
        told_um=_center_ways(toolpath),
        words=toolpath.words,
        compensation=toolpath.compensation,
        taper=toolpath.taper,
        upper=toolpath.upper,
    )


def _placed(toolpath: Toolpath) -> Bools:
    placed = np.zeros(len(toolpath), dtype=np.bool_)
    for row in np.flatnonzero(toolpath.is_jump).tolist():
        placed[row] = bool(_PLACED.match(toolpath.source.block_text(row)))
    return placed


def _center_ways(toolpath: Toolpath) -> Floats:
    """Ways to the centres: of blocks with words exactly as they say, else as told where start and end agree."""
    nowhere = np.full((len(toolpath), 2), np.nan)
    if toolpath.words is not None:
        out = np.column_stack([toolpath.words.x_um, toolpath.words.y_um]) * toolpath.words.signs
        return np.where(toolpath.is_arc[:, None], -out, nowhere)
    if toolpath.told_center_um is None:
        return nowhere
    by = toolpath.told_center_um - toolpath.start_um
    back = toolpath.told_center_um - toolpath.end_um
    differ = np.abs(np.hypot(by[:, 0], by[:, 1]) - np.hypot(back[:, 0], back[:, 1]))
    return np.where((toolpath.is_arc & (differ <= _STAYS_UM))[:, None], by, nowhere)


def picked(draft: Draft, row: Ints) -> Draft:
    """The rows `row` (m,) of a draft, rising; a row may be there more than once. Stops keep their places among them."""
    compensation = draft.compensation and replace(
        draft.compensation,
        side=draft.compensation.side[row],
        by_um=draft.compensation.by_um[row],
        register=tuple(draft.compensation.register[at] for at in row.tolist()),
    )
    words = draft.words and StepWords(*(getattr(draft.words, name)[row] for name in StepWords.__slots__))
    stops = (stop._replace(after=int(np.searchsorted(row, stop.after))) for stop in draft.stops)
    columns = draft.curves.picked(row), tuple(stops), draft.is_placed[row], draft.told_um[row]
    taper = draft.taper and Taper(draft.taper.side[row], draft.taper.angle_rad[row])
    upper = draft.upper and draft.upper.picked(row)
    return Draft(*columns, words, compensation, draft.is_meant, taper=taper, upper=upper)


_SAME_UM = 2.0


def with_rapid_to_start(draft: Draft) -> Draft:
    """A draft that begins at (0, 0), with a rapid to where it began; for languages that have no words to count by."""
    if not len(draft) or not draft.curves.start_um[0].any():
        return draft
    curves = draft.curves
    rapid = _rapid_to(curves.start_um[:1])
    compensation = draft.compensation and replace(
        draft.compensation,
        side=np.append(0, draft.compensation.side),
        by_um=np.append(0.0, draft.compensation.by_um),
        register=("", *draft.compensation.register),
    )
    return replace(
        draft,
        curves=joined([rapid, curves]),
        stops=tuple(stop._replace(after=stop.after + 1) for stop in draft.stops),
        events=tuple(event._replace(after=event.after + 1) for event in draft.events),
        is_placed=np.append(False, draft.is_placed),
        told_um=np.concatenate([np.full((1, 2), np.nan), draft.told_um]),
        words=None,
        compensation=compensation,
        taper=draft.taper and Taper(np.append(0, draft.taper.side), np.append(0.0, draft.taper.angle_rad)),
        upper=draft.upper and joined([_rapid_to(draft.upper.start_um[:1]), draft.upper]),
    )


def _rapid_to(place_um: Floats) -> Curves:
    """A rapid from (0, 0) to a place (1, 2)."""
    rapid = curves_between(np.zeros((1, 2)), place_um, np.full((1, 2), np.nan), np.zeros(1))
    rapid.kind[:] = CurveKind.JUMP
    return rapid


def without_rapids(draft: Draft) -> Draft:
    """A draft that begins with a cut, and whose rapids lead to other figures.

    Where the first cut begins the wire is threaded, however it gets there. A rapid back to a place of its own figure,
    such as the way out to the start hole, runs with the wire through what is cut: it is a block like others.
    """
    cuts = np.flatnonzero(draft.curves.kind != CurveKind.JUMP)
    begun = picked(draft, np.arange(cuts[0] if len(cuts) else len(draft), len(draft)))
    back = np.isin(np.arange(len(begun)), _returning(begun))
    stops = tuple(stop for stop in begun.stops if stop.kind == "end" or stop.after > 0)
    curves = replace(begun.curves, kind=np.where(back, CurveKind.LINE, begun.curves.kind))
    upper = begun.upper and replace(begun.upper, kind=np.where(back, CurveKind.LINE, begun.upper.kind))
    return replace(begun, curves=curves, upper=upper, stops=stops)


def _returning(draft: Draft) -> Ints:
    """Rows in the air, not placed, that end where a block of the figure before them begins."""
    jumps = np.flatnonzero(draft.curves.kind == CurveKind.JUMP)
    figures = zip([0, *(jumps[:-1] + 1).tolist()], jumps.tolist(), strict=True) if len(jumps) else ()
    back = [row for first, row in figures if not draft.is_placed[row] and _is_back(draft.curves, first, row)]
    return np.array(back, dtype=np.int64)


def _is_back(curves: Curves, first: int, row: int) -> bool:
    away = curves.start_um[first:row] - curves.end_um[row]
    return bool((np.hypot(away[:, 0], away[:, 1]) <= _SAME_UM).any())


_CONVEX, _CONCAVE = 1, 2


def curve_marks(curves: Curves) -> Ints:
    """(n,) 1 for convex arcs, 2 for concave ones, 0 elsewhere.

    A figure that is run counter-clockwise turns so along its convex arcs. Figures end where the wire goes on in the
    air; ways in and out along each other take no part in which way one runs.
    """
    figure = np.cumsum(curves.kind == CurveKind.JUMP)
    segment = np.where(curves.is_arc, curves.radius_um**2 * (curves.sweep_rad - np.sin(curves.sweep_rad)), 0.0)
    cut = np.flatnonzero(curves.kind != CurveKind.JUMP)
    area = np.zeros(int(figure[-1]) + 1 if len(figure) else 0)
    np.add.at(area, figure[cut], (_under(curves.start_um, curves.end_um) + segment)[cut])
    number, first = np.unique(figure[cut], return_index=True)
    last = np.append(first[1:], len(cut)) - 1
    area[number] += _under(curves.end_um[cut[last]], curves.start_um[cut[first]])
    convex = np.sign(curves.sweep_rad) == np.sign(area[figure])
    return np.where(curves.is_arc, np.where(convex, _CONVEX, _CONCAVE), 0).astype(np.int64)


def _under(start_um: Floats, end_um: Floats) -> Floats:
    """(n,) twice the area between straight ways and the origin; round a figure they add up to that of the figure."""
    area: Floats = start_um[:, 0] * end_um[:, 1] - start_um[:, 1] * end_um[:, 0]
    return area
