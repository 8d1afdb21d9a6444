"""Sound programs with one fault, of every kind that a hand, a cable or a memory makes."""

import random
from collections.abc import Callable, Mapping
from typing import NamedTuple

from broken import in_other_quadrant, on_other_axis, with_digit
from cam_programs import Row, Sound
from plain import PlainBlock


class Mutant(NamedTuple):
    """Lines of a broken program; `lines`, from 1, are those at which the fault stands or must show."""

    kind: str
    text: list[str]
    lines: frozenset[int]


Break = Callable[[random.Random, Sound], "tuple[list[str], set[int]] | None"]


def mutant(rng: random.Random, sound: Sound, kind: str | None = None) -> Mutant | None:
    """A mutant of a kind, of any where none is given; None where the program has nothing to break in that way."""
    kind = kind or rng.choice(sorted(KINDS))
    made = KINDS[kind](rng, sound)
    return Mutant(kind, made[0], frozenset(made[1])) if made and made[0] != _texts(sound.rows) else None


def _texts(rows: list[Row]) -> list[str]:
    return [row.text for row in rows]


def _blocks(sound: Sound) -> list[int]:
    return [at for at, row in enumerate(sound.rows) if row.block]


def _rewritten(change: Callable[[random.Random, PlainBlock], PlainBlock | None]) -> Break:
    """A fault in the words of one block; its label and its printed end stay."""

    def make(rng: random.Random, sound: Sound) -> tuple[list[str], set[int]] | None:
        at = rng.choice(_blocks(sound))
        block = sound.rows[at].block
        changed = change(rng, block) if block else None
        if changed is None:
            return None
        rows = [*sound.rows[:at], sound.rows[at]._replace(block=changed), *sound.rows[at + 1 :]]
        return _texts(rows), {at + 1}

    return make


def _digit(field: str, how: str) -> Break:
    return _rewritten(lambda rng, block: with_digit(rng, block, field, how))


def _turned(rng: random.Random, block: PlainBlock) -> PlainBlock | None:
    """NR for SR; the digit stays."""
    other = {"NR": "SR", "SR": "NR"}.get(block.sense)
    return block._replace(sense=other) if other else None


def _bent(rng: random.Random, block: PlainBlock) -> PlainBlock:
    """A line made an arc, or an arc a line."""
    return block._replace(sense=rng.choice(("NR", "SR")) if block.sense == "L" else "L")


def _letter_lost(letters: str) -> Break:
    """One of some letters lost from the text of a block."""

    def make(rng: random.Random, sound: Sound) -> tuple[list[str], set[int]] | None:
        at = rng.choice(_blocks(sound))
        row = sound.rows[at]
        text = row.block.text() if row.block else ""
        places = [place for place, letter in enumerate(text) if letter in letters]
        if not places:
            return None
        place = rng.choice(places)
        texts = _texts(sound.rows)
        texts[at] = f"{row.label}{text[:place]}{text[place + 1 :]}{row.printed}"
        return texts, {at + 1}

    return make


def _deleted(rng: random.Random, sound: Sound) -> tuple[list[str], set[int]] | None:
    """Nothing is left to point at but the block that takes its place, or the one before."""
    at = rng.choice([at for at in _blocks(sound) if sound.rows[at].figure >= 0])
    texts = _texts(sound.rows)
    return texts[:at] + texts[at + 1 :], {at, at + 1}


def _doubled(rng: random.Random, sound: Sound) -> tuple[list[str], set[int]] | None:
    at = rng.choice(_blocks(sound))
    texts = _texts(sound.rows)
    return texts[: at + 1] + texts[at:], {at + 1, at + 2}


def _swapped(rng: random.Random, sound: Sound) -> tuple[list[str], set[int]] | None:
    """Two neighbours of one figure."""
    rows = sound.rows
    pairs = [at for at in range(len(rows) - 1) if rows[at].figure >= 0 and rows[at].figure == rows[at + 1].figure]
    if not pairs:
        return None
    at = rng.choice(pairs)
    texts = _texts(rows)
    texts[at : at + 2] = texts[at + 1], texts[at]
    return texts, {at + 1, at + 2}


def _mark_lost(mark: str) -> Break:
    def make(rng: random.Random, sound: Sound) -> tuple[list[str], set[int]] | None:
        places = [at for at, row in enumerate(sound.rows) if row.mark == mark]
        if not places:
            return None
        at = rng.choice(places)
        texts = _texts(sound.rows)
        return texts[:at] + texts[at + 1 :], {at, at + 1}

    return make


def _mark_early(mark: str) -> Break:
    """A mark before some block that is not the first."""

    def make(rng: random.Random, sound: Sound) -> tuple[list[str], set[int]] | None:
        at = rng.choice(_blocks(sound)[1:] or [0])
        texts = _texts(sound.rows)
        return [*texts[:at], mark, *texts[at:]], {at + 1, at + 2} if at else None

    return make


def _jump_lost(rng: random.Random, sound: Sound) -> tuple[list[str], set[int]] | None:
    jumps = [at for at in _blocks(sound) if sound.rows[at].figure < 0]
    if not jumps:
        return None
    at = rng.choice(jumps)
    texts = _texts(sound.rows)
    return texts[:at] + texts[at + 1 :], {at, at + 1}


def _relabelled(rng: random.Random, sound: Sound) -> tuple[list[str], set[int]] | None:
    at = rng.choice(_blocks(sound))
    texts = _texts(sound.rows)
    texts[at] = texts[at].replace(sound.rows[at].label, f"N{rng.randint(1, 99)}: ", 1)
    return texts, {at + 1}


KINDS: Mapping[str, Break] = {
    **{
        f"{name} digit {how}": _digit(field, how)
        for name, field in (("X", "x"), ("Y", "y"), ("J", "count"))
        for how in ("changed", "lost", "doubled")
    },
    "GX for GY": _rewritten(on_other_axis),
    "quadrant": _rewritten(in_other_quadrant),
    "NR for SR": _rewritten(_turned),
    "L for NR, SR": _rewritten(_bent),
    "B lost": _letter_lost("B"),
    "G lost": _letter_lost("G"),
    "X or Y of G lost": _letter_lost("XY"),
    "letter of sense lost": _letter_lost("LNSR"),
    "block deleted": _deleted,
    "block doubled": _doubled,
    "neighbours swapped": _swapped,
    "D lost": _mark_lost("D"),
    "DD lost": _mark_lost("DD"),
    "DD early": _mark_early("DD"),
    "D early": _mark_early("D"),
    "jump lost": _jump_lost,
    "label changed": _relabelled,
}
"""Kind of fault -> how it is made."""
