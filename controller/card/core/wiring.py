"""How a switch is wired, and what the card takes its level for.

The level of an input is never turned. Sense bit 0 says that the high level triggers, 1 that the low one does. An input
with nothing on it reads 1: so 1 is right for a switch that is open while it is idle, 0 for one that is closed. Grade B:
three programs for the card send the word, one checks the levels at rest after it.
"""

from typing import Final, Literal, TypeAlias, get_args

Wiring: TypeAlias = Literal["as-sensed", "normally-open", "normally-closed"]
"""``as-sensed`` is the one that the program's sense word is right for, whatever that says."""
AS_SENSED: Final = "as-sensed"
WIRINGS: Final[tuple[Wiring, ...]] = get_args(Wiring)


def sense_of(word: int | None, at: int) -> int | None:
    """Bit of a sense word; None before the program sends one."""
    return None if word is None else word >> at & 1


def idle_level(wiring: Wiring, sense: int | None) -> int:
    """Level of the input while the switch is idle."""
    if wiring == AS_SENSED:
        return 1 if sense is None else sense
    return int(wiring == "normally-open")


def is_taken_for_met(wiring: Wiring, sense: int | None) -> bool:
    """Whether the card takes an idle switch for one that is met, and one that is met for idle.

    Before the program sends a word the high level triggers (grade C).
    """
    return wiring != AS_SENSED and idle_level(wiring, sense) != bool(sense)
