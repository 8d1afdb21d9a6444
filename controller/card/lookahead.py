"""Look-ahead as the card's library has it: blocks are kept back until the speed at their end is known.

A `HostBlock` goes in and comes out `OldestBlock`, with its speeds; `Mode` is how a card's look-ahead stands.

Structures of the look-ahead functions, and G-code blocks made into segments.

Look-ahead of the host: the library keeps blocks ahead of the list and tells how fast each of them may end.

What its numbers mean is grade C: at a corner the velocity may change by ``amax T`` (`CornerTime`), an arc may bend it
with `amax`, along the path it changes with `am`; the last block known ends at rest. Blocks are told in order, and what
was told for one is where the next ones start from.

Look-ahead between path calls and list: keeps the youngest blocks back until their end speeds are known.

The look-ahead mode of one card: off, or on. Blocks are kept back while it is on alone.
"""

from collections import deque
from dataclasses import dataclass
from typing import Any, NamedTuple, TypeAlias

import numpy as np

from controller.card.core.call import Char, Code, Double, Long, Reader, Refused, Short, read_arguments
from controller.card.core.settings import UM_S_PER_PULSE_MS
from controller.card.engine.entries import (
    ORIGIN,
    XY,
    YZ,
    ZX,
    Entry,
    Output,
    Pace,
    Place,
    Segment,
    Wait,
    arc_by_radius,
    arc_to,
    checked_line,
    four,
)
from controller.card.engine.speeds import checked
from controller.card.engine.stretch import path_of_segments
from controller.motion.limits import CornerTime, junction_speeds
from controller.motion.planner import RowLimits, border_speeds_sq

_PLANES = {17: XY, 18: ZX, 19: YZ}
"""Planes by their G-code."""
RAPID, LINE, CLOCKWISE, COUNTER_CLOCKWISE = range(4)


class TLookAheadMsg(NamedTuple):
    """What a path call through the look-ahead tells of an error; all 0 where there is none.

    Its fields are graded A, as the vendor's header explains them; which block they tell of is graded C.

    Attributes
    ----------
    mtnNum
        `CodeNum` of the block in which the error occurred.
    num
        Blocks before it that were not sent to the list; 32767 stands for more, too.
    error
        Why: the code that the call returns.
    """

    mtnNum: int = 0  # noqa: N815 - the library's name
    num: int = 0
    error: int = 0


class TLookData(NamedTuple):
    """A block for `GT_AddLookDataEx`; fields as the parameters of `GT_AddLookData`."""

    Code: Char
    PlaneGroup: Char
    r: Double
    x: Double
    y: Double
    z: Double
    F: Double
    cx: Double
    cy: Double
    i: Short
    n: Long
    flag: Short


def checked_data(given: Any) -> TLookData:
    """Refused with 7 where it is no block, or a field does not fit its C type."""
    if not isinstance(given, tuple) or len(given) != len(TLookData._fields):
        raise Refused(Code.PARAMETER)
    return TLookData(*read_arguments(_READERS, given))


_READERS: list[Reader] = [hint.__metadata__[0].reader for hint in TLookData.__annotations__.values()]


def segment_of(data: TLookData, start: Place, pulses_per_unit: float) -> Segment:
    """The path of a block: by its radius, or about its centre where the radius is 0.

    Refused with 7 where code or plane is none, with 4 where the feed is none, and as path calls are.
    """
    plane = _PLANES.get(data.PlaneGroup)
    if plane is None or data.Code not in range(4):
        raise Refused(Code.PARAMETER)
    pace = Pace(checked(data.F) * UM_S_PER_PULSE_MS, 0.0, data.Code == RAPID)
    place = four((*(pulses_per_unit * value for value in (data.x, data.y, data.z)), 0.0))
    if data.Code in {RAPID, LINE}:
        return checked_line(0, pace, start, place)
    sense = 1 if data.Code == COUNTER_CLOCKWISE else -1
    end = (place[plane[0]], place[plane[1]])
    if data.r:
        return arc_by_radius(0, pace, start, plane, end, data.r * pulses_per_unit, sense)
    centre = (data.cx * pulses_per_unit, data.cy * pulses_per_unit)
    return arc_to(0, pace, start, plane, centre, end, sense)


class HostRules(NamedTuple):
    """Numbers of the look-ahead, inside units.

    Attributes
    ----------
    corner_s, corner_um_s2
        Time in which a corner is turned, and the acceleration that turns it and bends arcs.
    along_um_s2
        Acceleration along the path.
    ceiling_um_s
        Highest speed.
    blocks
        Blocks kept at most.
    pulses_per_unit
        Of the coordinates.
    """

    corner_s: float
    corner_um_s2: float
    along_um_s2: float
    ceiling_um_s: float
    blocks: int
    pulses_per_unit: float


class HostBlock(NamedTuple):
    """A block kept: its path, the program's number of it, and whether it ends at rest."""

    segment: Segment
    number: int
    rests: bool


class OldestBlock(NamedTuple):
    """The oldest block with its end speed and the highest speed in it, µm/s."""

    block: HostBlock
    end_um_s: float
    feed_um_s: float


class HostLookAhead:
    """Blocks ahead of the list, oldest first; `end` is where the youngest ends, the origin before any (grade C)."""

    def __init__(self, rules: HostRules) -> None:
        self.rules = rules
        self.blocks: deque[HostBlock] = deque()
        self.end = ORIGIN
        self._from_um_s = 0.0
        self._known: deque[OldestBlock] = deque()

    @property
    def is_full(self) -> bool:
        """Whether no more blocks are kept."""
        return len(self.blocks) >= self.rules.blocks

    def add(self, block: HostBlock) -> None:
        """Keep one more."""
        self.blocks.append(block)
        self.end = block.segment.end
        self._known.clear()

    def rest(self) -> None:
        """Let the youngest block end at rest."""
        if self.blocks:
            self.add(self.blocks.pop()._replace(rests=True))

    def take_oldest(self) -> OldestBlock:
        """The oldest block, which is kept no longer. IndexError where there is none."""
        if not self._known:
            self._known.extend(told_of(list(self.blocks), self.rules, self._from_um_s))
        known = self._known.popleft()
        self.blocks.popleft()
        self._from_um_s = known.end_um_s
        return known


def told_of(blocks: list[HostBlock], rules: HostRules, from_um_s: float) -> list[OldestBlock]:
    """All blocks with their speeds, if nothing comes behind them."""
    if not blocks:
        return []
    path = path_of_segments([block.segment for block in blocks])
    feed = np.minimum([block.segment.pace.speed_um_s for block in blocks], rules.ceiling_um_s)
    bend = np.sqrt(rules.corner_um_s2 / np.maximum(path.curvature, 1e-100))
    feed = np.minimum(feed, bend)
    along = np.full_like(feed, rules.along_um_s2)
    rule = CornerTime(rules.corner_s, rules.corner_um_s2)
    border = np.concatenate([[from_um_s], junction_speeds(path, rule, 0.0, along), [0.0]])
    border[1:][[block.rests for block in blocks]] = 0.0
    limits = RowLimits(path.length_um, feed, along, border, np.zeros_like(border))
    ends = np.sqrt(border_speeds_sq(limits, from_um_s))[1:]
    return [OldestBlock(*entry) for entry in zip(blocks, ends.tolist(), feed.tolist(), strict=True)]


class ListLookAhead:
    """Blocks kept back, with the outputs and waits that come behind each; `begun` tells for which list."""

    def __init__(self, rules: HostRules) -> None:
        self.rules = rules
        self.clear(0)

    def clear(self, begun: int) -> None:
        """Keep nothing, from rest."""
        self.begun = begun
        self._ahead = HostLookAhead(self.rules)
        self._behind: deque[list[Entry]] = deque()

    def __len__(self) -> int:
        """Blocks kept."""
        return len(self._behind)

    @property
    def is_full(self) -> bool:
        """Whether the oldest block has to go before another comes."""
        return self._ahead.is_full

    @property
    def entries(self) -> int:
        """Entries that all of it will be in the list."""
        return sum(1 + len(behind) for behind in self._behind)

    @property
    def oldest_entries(self) -> int:
        """Entries that the oldest block will be in the list."""
        return 1 + len(self._behind[0])

    def end(self) -> Place | None:
        """Where the youngest block ends."""
        return self._ahead.blocks[-1].segment.end if self._behind else None

    def add(self, block: HostBlock) -> None:
        """Keep a block back."""
        self._ahead.add(block)
        self._behind.append([])

    def add_behind(self, entry: Output | Wait) -> None:
        """Keep an output or a wait behind the youngest block; a wait lets it end at rest."""
        self._behind[-1].append(entry)
        if isinstance(entry, Wait):
            self._ahead.rest()

    @property
    def oldest_number(self) -> int:
        """The program's number of the oldest block; 0 without any."""
        return self._ahead.blocks[0].number if self._behind else 0

    def oldest(self, number: int) -> list[Entry]:
        """Let the oldest block go, which becomes `number` of the list: its entries."""
        entry = self._ahead.take_oldest()
        segment = entry.block.segment
        pace = Pace(entry.feed_um_s, self.rules.along_um_s2, segment.pace.rapid, entry.end_um_s)
        return [segment._replace(number=number, pace=pace), *self._behind.popleft()]


@dataclass(frozen=True, slots=True)
class Off:
    """Path calls through the look-ahead are refused; `rules` hold once it is on, None before any are set."""

    rules: HostRules | None = None


@dataclass(frozen=True, slots=True)
class Unruled:
    """The mode is on, and path calls are refused until it has rules."""


@dataclass(frozen=True, slots=True)
class On:
    """Path calls go through the look-ahead, which keeps blocks back by its rules."""

    look_ahead: ListLookAhead


Mode: TypeAlias = Off | Unruled | On


def blocks_kept(mode: Mode) -> int:
    """Blocks kept back."""
    return len(mode.look_ahead) if isinstance(mode, On) else 0


def ruled(mode: Mode, rules: HostRules) -> Mode:
    """With other rules; blocks that are kept are forgotten."""
    return Off(rules) if isinstance(mode, Off) else On(ListLookAhead(rules))


def switched_on(mode: Mode) -> Mode:
    """On, if it is not."""
    if not isinstance(mode, Off):
        return mode
    return On(ListLookAhead(mode.rules)) if mode.rules else Unruled()


def switched_off(mode: Mode) -> Off:
    """Off, with its rules. ValueError where blocks are kept: they would be lost."""
    if blocks_kept(mode):
        raise ValueError(f"{blocks_kept(mode)} blocks are kept, and the mode cannot be left")
    if isinstance(mode, On):
        return Off(mode.look_ahead.rules)
    return mode if isinstance(mode, Off) else Off()
