"""The look-ahead mode of one card: off, or on. Blocks are kept back while it is on alone."""

from dataclasses import dataclass
from typing import TypeAlias

from controller.card.lookahead.host import HostRules
from controller.card.lookahead.list import ListLookAhead


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
