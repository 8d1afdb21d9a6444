"""Blocks of G-code as a motion program of PMAC: in the card's own words, or as G words that call its routines.

The six conversions of docs/pmac.md §6 come out as they stand there.
"""

import math
from collections.abc import Iterator, Sequence
from typing import Literal, NamedTuple

from parser.dialect.decoding import DecodedBlock, Decoder
from parser.iso.listing.lexer import read_listing
from parser.toolpath import Toolpath
from parser.units import UM_PER_MM, from_mm, mm

Way = Literal["native", "gcode"]
Card = Literal["turbo", "power"]

_MOTIONS = {0: "RAPID", 1: "LINEAR", 2: "CIRCLE1", 3: "CIRCLE2"}
_ROUTINES = ((0, "RAPID"), (1, "LINEAR"), (2, "CIRCLE1"), (3, "CIRCLE2"), (90, "ABS"), (91, "INC"))
_OWN_LINE = {90, 91}  # ABS and INC may take axes, and would take the words of the line that calls them
_KNOWN_G = {0, 1, 2, 3, 4, 17, 21, 40, 90, 91, 92}
_LOST_M = {3, 4, 5}
_KNOWN_M = {0, 1, 2, 30} | _LOST_M
_LENGTHS = "XYZIJR"
_DIGITS = 6
_RAMPS_MS = (50, 20, 10, 5, 2, 1)
_USUAL_RAMP_MS = 100.0
_DWELL, _PLACE = 4, 92


class GBlock(NamedTuple):
    """One block: its G and M numbers, lengths in mm by their letters, F in mm/min and a dwell in ms; None without."""

    g: tuple[int, ...]
    m: tuple[int, ...]
    lengths: dict[str, float]
    feed: float | None = None
    dwell_ms: float | None = None


class PmacChoices(NamedTuple):
    """How a motion program is written.

    Attributes
    ----------
    way
        ``native`` words, or the G words of the source, ``gcode``.
    card
        ``turbo`` or ``power``.
    blocks
        Those of the source, where they can be taken over word for word; None where they are made of its path.
    """

    way: Way = "native"
    card: Card = "turbo"
    blocks: tuple[GBlock, ...] | None = None


def blocks_of_source(text: str, toolpath: Toolpath, decoder: Decoder | None) -> tuple[GBlock, ...] | None:
    """Blocks of an ISO program that can be taken over word for word; None where one holds more than moves and dwells.

    Offsets, subprograms, skipped blocks, values and functions are no such blocks.
    """
    if decoder is None or toolpath.compensation is not None:
        return None
    if any(line.lstrip().startswith("/") for line in text.splitlines()):
        return None
    blocks = [_with_move(block) for block in decoder.blocks()]
    return None if None in blocks else tuple(block for block in blocks if block is not None)


def blocks_of_text(text: str) -> tuple[GBlock, ...]:
    """Blocks of a written ISO text in mm, with no other words than those of moves, places, pauses and the end."""
    words = read_listing(text).words
    rows: dict[int, GBlock] = {}
    for code, value, block in zip(words.letter.tolist(), words.value.tolist(), words.block.tolist(), strict=True):
        row, letter = rows.setdefault(block, GBlock((), (), {})), chr(code)
        if letter == "G":
            rows[block] = row._replace(g=(*row.g, int(value)))
        elif letter == "M":
            rows[block] = row._replace(m=(*row.m, int(value)))
        elif letter in _LENGTHS:
            row.lengths[letter] = value
    return tuple(rows.values())


def written_pmac(blocks: Sequence[GBlock], choices: PmacChoices) -> str:
    """Text of a motion program: settings, the routines of G words where they are kept, PROG 1."""
    native = choices.way == "native"
    body = [*_ramp(blocks), *(_native(blocks) if native else _with_g_words(blocks))]
    routines = [] if native else _buffer(1000, _routines(choices.card), choices.card)
    return "\n".join([*_head(choices.card), *routines, *_buffer(1, body, choices.card), ""])


def _with_move(block: DecodedBlock) -> GBlock | None:
    whole = all(number == int(number) for number in (*block.g, *block.m))
    g, m = tuple(map(int, block.g)), tuple(map(int, block.m))
    known = whole and set(g) <= _KNOWN_G and set(m) <= _KNOWN_M
    others = set(block.others) - ({"P"} if _DWELL in g else set()) or block.d is not None or block.h is not None
    fields = {step.field for step in block.steps}
    odd = any(field.islower() and field not in {"block_num", "buf_state"} for field in fields)
    if not known or others or odd or block.t is not None or set(block.coor_um) - set(_LENGTHS):
        return None
    dwell = _dwell_ms(block) if _DWELL in g else None
    lengths = {} if _DWELL in g else {letter: mm(um) for letter, um in block.coor_um.items()}
    return GBlock(g, m, lengths, block.f, dwell)


def _dwell_ms(block: DecodedBlock) -> float:
    """A dwell: X in seconds; P in seconds with a point, else in ms."""
    dwell = next((step for step in block.steps if step.word.upper().startswith(("P", "X"))), None)
    number = float(dwell.word[1:]) if dwell else 0.0
    return number if dwell and dwell.word[0] in "Pp" and "." not in dwell.word else number * 1000.0


def _head(card: Card) -> Iterator[str]:
    yield from ("CLOSE", "&1", "#1->1000X", "#2->1000Y", "#3->1000Z")
    if card == "turbo":
        yield from ("I5113=10", "I5190=60000")
    else:
        yield from ("Coord[1].SegMoveTime=10", "Coord[1].FeedTime=60000")


def _buffer(number: int, lines: Sequence[str], card: Card) -> list[str]:
    """A buffer with its lines; Power PMAC clears it by opening it."""
    return [f"OPEN PROG {number}", *(["CLEAR"] if card == "turbo" else []), *lines, "CLOSE"]


def _routines(card: Card) -> list[str]:
    lines = []
    for number, command in _ROUTINES:
        label = f"N{number * 1000}{':' if card == 'power' else ''} " if number else ""
        lines += [f"{label}{command}", "RET"] if number in _OWN_LINE else [f"{label}{command} RET"]
    return lines


def _native(blocks: Sequence[GBlock]) -> Iterator[str]:
    """In words of the card: a mode is written where it changes."""
    distance = _first_distance(blocks)
    yield distance
    if any("X" in block.lengths or "Y" in block.lengths for block in blocks):
        yield "FRAX(X,Y,Z)"
    if any({2, 3} & set(block.g) for block in blocks):
        yield "NORMAL K-1"
    motion = ""
    for block in blocks:
        native = _distance(block) or distance
        if native != distance:
            yield native
        distance = native
        now = next((_MOTIONS[number] for number in reversed(block.g) if number in _MOTIONS), motion)
        words = _words(block)
        if words and _PLACE not in block.g:
            yield " ".join([*([now] if now != motion else []), *words])
            motion = now
        elif now != motion:
            yield now
            motion = now
        yield from _between(block)
    yield "DWELL0"


def _with_g_words(blocks: Sequence[GBlock]) -> Iterator[str]:
    """With the G words of the moves kept; what PROG 1000 does not hold is a command of the card."""
    kept_routines = {number for number, _ in _ROUTINES}
    for block in blocks:
        words = [] if _PLACE in block.g else _words(block)
        line = " ".join([*(f"G{number:02d}" for number in block.g if number in kept_routines), *words])
        if line:
            yield line
        yield from _between(block)


def _between(block: GBlock) -> Iterator[str]:
    """Places, dwells and stops."""
    if _PLACE in block.g:
        yield " ".join(["PSET", *_words(block)])
    if block.dwell_ms is not None:
        yield f"DWELL{_number(block.dwell_ms)}"
    if {0, 1} & set(block.m):
        yield "STOP"


def _words(block: GBlock) -> list[str]:
    words = [f"{letter}{_number(block.lengths[letter])}" for letter in _LENGTHS if letter in block.lengths]
    return [*words, *([] if block.feed is None else [f"F{_number(block.feed)}"])]


def _number(value: float) -> str:
    text = f"{value:.{_DIGITS}f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text


def _distance(block: GBlock) -> str:
    return "ABS" if 90 in block.g else "INC" if 91 in block.g else ""


def _first_distance(blocks: Sequence[GBlock]) -> str:
    return next(filter(None, map(_distance, blocks)), "ABS")


def ramp_of(blocks: Sequence[GBlock]) -> int:
    """Acceleration time, ms, where a block is shorter than the usual one, to which the card stretches it; else 0."""
    least = min(_times_ms(blocks), default=math.inf)
    if least >= _USUAL_RAMP_MS:
        return 0
    return next((ramp for ramp in _RAMPS_MS if ramp <= least), _RAMPS_MS[-1])


def _ramp(blocks: Sequence[GBlock]) -> list[str]:
    ramp_ms = ramp_of(blocks)
    return [f"TA{ramp_ms}", "TS0"] if ramp_ms else []


def _times_ms(blocks: Sequence[GBlock]) -> Iterator[float]:
    """Times of the moves that cut, by their chords: no arc is shorter."""
    place, absolute, motion, feed = (0.0, 0.0), _first_distance(blocks) == "ABS", 0, None
    for block in blocks:
        absolute = (_distance(block) or ("ABS" if absolute else "INC")) == "ABS"
        motion = next((number for number in block.g if number in _MOTIONS), motion)
        feed = feed if block.feed is None else block.feed
        before = place if absolute or _PLACE in block.g else (0.0, 0.0)
        times = (block.lengths.get("X", before[0]), block.lengths.get("Y", before[1]))
        by = (times[0] - before[0], times[1] - before[1])
        moved = math.hypot(*by)
        place = times if absolute or _PLACE in block.g else (place[0] + by[0], place[1] + by[1])
        if moved and motion and feed and _PLACE not in block.g:
            yield from_mm(moved) / UM_PER_MM / feed * 60_000.0
