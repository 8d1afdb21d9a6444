"""Sound programs with one fault, of every kind that a hand, a cable or a memory makes: those of the fault drills."""

import random
from collections.abc import Mapping
from functools import cache
from typing import NamedTuple

from cam_programs import Sound

import sim.teach.kinds
from parser.program import parse_program
from sim.teach.kinds import KINDS as OF_DRILLS


class Mutant(NamedTuple):
    """Lines of a broken program; `lines`, from 1, are those at which the fault stands or must show."""

    kind: str
    text: list[str]
    lines: frozenset[int]


KINDS: Mapping[str, str] = {
    **{
        f"{name} digit {how}": f"{field}-digit-{how}"
        for name, field in (("X", "x"), ("Y", "y"), ("J", "count"))
        for how in ("changed", "lost", "doubled")
    },
    "GX for GY": "axis",
    "quadrant": "quadrant",
    "NR for SR": "turn",
    "L for NR, SR": "bent",
    "B lost": "b-lost",
    "G lost": "g-lost",
    "X or Y of G lost": "axis-lost",
    "letter of sense lost": "sense-lost",
    "O for 0": "letter-o",
    "block deleted": "block-lost",
    "block doubled": "block-doubled",
    "neighbours swapped": "swapped",
    "D lost": "pause-lost",
    "DD lost": "end-lost",
    "DD early": "end-early",
    "D early": "pause-early",
    "jump lost": "jump-lost",
}
"""What the tables call a kind -> its name in the drills."""


def mutant(rng: random.Random, sound: Sound, kind: str | None = None) -> Mutant | None:
    """A mutant of a kind, of any where none is given; None where the program has nothing to break in that way."""
    kind = kind or rng.choice(sorted(KINDS))
    made = OF_DRILLS[KINDS[kind]].make(rng, _read(sound.text))
    return Mutant(kind, made.text.splitlines(), made.lines) if made and made.text != sound.text else None


@cache
def _read(text: str) -> sim.teach.kinds.Sound:
    return sim.teach.kinds.Sound(parse_program(text))
