"""What an ISO program switches where it stands, beside moving the wire: dwells, optional stops, feeds, conditions.

Words mean the same in every family for a dwell and for M01. A feed and a condition are numbers of one family's tables:
they are kept where that family's ISO is written, and else told to be lost.
"""

import math
from typing import Literal, NamedTuple

import numpy as np

from parser.iso.listing.lexer import read_listing
from parser.iso.listing.listing import Listing
from parser.toolpath import Toolpath

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
