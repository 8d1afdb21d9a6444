"""Every kind of fault that a hand, a cable or a memory makes."""

from collections.abc import Mapping
from typing import Final, Literal, NamedTuple, get_args

from parser.program import Program
from parser.text.source import Field
from sim.drill import lines, words
from sim.drill.words import Maker

Group = Literal["number", "axis", "quadrant", "sense", "side", "unreadable", "missing", "twice", "order", "mark"]
"""What is wrong, as people are asked for it."""
GROUPS: Final[tuple[Group, ...]] = get_args(Group)


class Kind(NamedTuple):
    """How a fault is made, and what people call it."""

    group: Group
    make: Maker


def groups_of(program: Program) -> tuple[Group, ...]:
    """What can be wrong in a program of its dialect."""
    lacks: set[Group] = set() if program.toolpath.compensation is not None else {"side"}
    if program.toolpath.words is None:
        lacks |= {"axis", "quadrant"}
    return tuple(group for group in GROUPS if group not in lacks)


_NUMBERS: Final = {"x": Field.X, "y": Field.Y, "count": Field.COUNT, "radius": Field.RADIUS}

KINDS: Final[Mapping[str, Kind]] = {
    **{
        f"{name}-digit-{how}": Kind("number", words.digit(field, how))
        for name, field in _NUMBERS.items()
        for how in ("changed", "lost", "doubled")
    },
    "centre-digit-changed": Kind("number", words.digit_of_centre()),
    **{f"{name}-sign": Kind("number", words.sign(_NUMBERS[name])) for name in "xy"},
    **{f"{name}-point": Kind("number", words.point(_NUMBERS[name])) for name in "xy"},
    "axis": Kind("axis", words.axis()),
    "quadrant": Kind("quadrant", words.quadrant()),
    "turn": Kind("sense", words.turned()),
    "bent": Kind("sense", words.bent()),
    "side": Kind("side", words.other_side()),
    "b-lost": Kind("unreadable", words.letter_lost("B")),
    "g-lost": Kind("unreadable", words.letter_lost("G")),
    "axis-lost": Kind("unreadable", words.letter_lost("XY")),
    "sense-lost": Kind("unreadable", words.letter_lost("LNSR")),
    "letter-o": Kind("unreadable", words.letter_for_digit()),
    "block-lost": Kind("missing", lines.block_lost),
    "jump-lost": Kind("missing", lines.jump_lost),
    "block-doubled": Kind("twice", lines.block_doubled),
    "swapped": Kind("order", lines.swapped),
    "pause-lost": Kind("mark", lines.mark_lost("pause")),
    "end-lost": Kind("mark", lines.mark_lost("end")),
    "pause-early": Kind("mark", lines.mark_early("pause")),
    "end-early": Kind("mark", lines.mark_early("end")),
}
"""Name of a kind -> it."""
