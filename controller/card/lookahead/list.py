"""Look-ahead between path calls and list: keeps the youngest blocks back until their end speeds are known.

The look-ahead mode of one card: off, or on. Blocks are kept back while it is on alone.
"""

from collections import deque
from dataclasses import dataclass
from typing import TypeAlias

from controller.card.engine.entries import Entry, Output, Pace, Place, Wait
from controller.card.lookahead.host import HostBlock, HostLookAhead, HostRules


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
        told = self._ahead.take_oldest()
        segment = told.block.segment
        pace = Pace(told.feed_um_s, self.rules.along_um_s2, segment.pace.rapid, told.end_um_s)
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

    kept: ListLookAhead


Mode: TypeAlias = Off | Unruled | On


def blocks_kept(mode: Mode) -> int:
    """Blocks kept back."""
    return len(mode.kept) if isinstance(mode, On) else 0


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
        return Off(mode.kept.rules)
    return mode if isinstance(mode, Off) else Off()
