"""Labels of blocks, Z: letters for a line or the sense of an arc, and the digit of the quadrant (docs/3b.md §1)."""

from typing import Final

SENSES: Final = {0: "L", 1: "NR", -1: "SR"}
"""Letters by the turn: a line, an arc counter-clockwise, an arc clockwise."""


def label(turn: int, quadrant: int) -> str:
    """``L1`` to ``L4``, ``NR1`` to ``NR4``, ``SR1`` to ``SR4``."""
    return f"{SENSES[turn]}{quadrant}"
