"""3B as a pupil writes it, read to blocks and marks: spellings of docs/3b.md, sections 1 and 2."""

from typing import NamedTuple

MOST_DIGITS = 8
"""Of a number, leading zeros aside: 99 m, so that squares of µm stay exact in the doubles of a script."""
MOST_CHARACTERS = 200000
"""Of a program that a lesson reads."""
_DIGITS = "0123456789"
_BLANKS = " \t"
_REMARKS = ";/(*"
_HEADERS = ["CAXA", "CONNER", "CORNER", "OFFSET", "LENGTH", "START"]


class Block(NamedTuple):
    """A block in its words.

    Attributes
    ----------
    x, y, count_um
        X, Y and J, µm.
    axis
        Count direction G: 0 for X, 1 for Y.
    turn
        0 for a line, 1 for NR, −1 for SR.
    quadrant
        1 to 4.
    line
        Where it stands, from 1.
    """

    x: int
    y: int
    count_um: int
    axis: int
    turn: int
    quadrant: int
    line: int


class Mark(NamedTuple):
    """A pause ``D`` or the end ``DD``, behind so many blocks, and the line where it stands, from 1."""

    is_end: bool
    after: int
    line: int


class Place(NamedTuple):
    """A place in a text: line and column, from 1."""

    line: int
    column: int


class Listing(NamedTuple):
    """A text that was read.

    Attributes
    ----------
    blocks, marks
        In order, up to the end of the program.
    unread
        Where something stands that is neither a block nor a mark nor a remark, once a line.
    behind_end
        How many lines of words stand behind the end: no machine comes to them.
    """

    blocks: list[Block]
    marks: list[Mark]
    unread: list[Place]
    behind_end: int


class _Word(NamedTuple):
    """What stands at a place of a line: a number, or a letter's meaning; `past` is where it ends, −1 if nothing."""

    value: int
    past: int


_NOTHING = _Word(0, -1)


def read_listing(text: str) -> Listing:
    """The blocks and marks of a text. What is longer than `MOST_CHARACTERS` is unread from its first line on."""
    listing = Listing([], [], [], 0)
    if len(text) > MOST_CHARACTERS:
        return Listing([], [], [Place(1, 1)], 0)
    behind = 0
    lines = folded(text).split("\n")
    for number in range(len(lines)):
        if len(listing.marks) > 0 and listing.marks[len(listing.marks) - 1].is_end:
            behind += 0 if _is_remark(lines[number]) else 1
        else:
            _read_line(lines[number], number + 1, listing)
    return Listing(listing.blocks, listing.marks, listing.unread, behind)


def folded(text: str) -> str:
    """A text in capitals and half-width characters, its lines ended by a line feed, each as long as before."""
    narrow = []
    for character in text.replace("\r\n", "\n").replace("\r", "\n"):
        code = ord(character)
        if 0xFF01 <= code <= 0xFF5E:
            narrow.append(chr(code - 0xFEE0))
        elif code in {0x3000, 0xA0}:
            narrow.append(" ")
        else:
            narrow.append(character)
    return _capitals("".join(narrow))


def _capitals(text: str) -> str:
    """ASCII letters as capitals; others stay, for some become two."""
    capitals = []
    for character in text:
        is_small = "a" <= character <= "z"
        capitals.append(chr(ord(character) - 32) if is_small else character)
    return "".join(capitals)


def _is_remark(line: str) -> bool:
    """Whether a line is blank, a remark or a header."""
    at = _past_blanks(line, 0)
    return at == len(line) or line[at] in _REMARKS or _begins_header(line, at)


def _begins_header(line: str, at: int) -> bool:
    return any(line[at : at + len(header)] == header for header in _HEADERS)


def _read_line(line: str, number: int, listing: Listing) -> None:
    """Read a line, folded, into a listing, up to the first place that cannot be read, or the end of the program."""
    at = _past_blanks(line, 0)
    while at < len(line):
        if line[at] in ";/*" or _begins_header(line, at):
            return
        if line[at] == "(":
            closing = line.find(")", at)
            past = len(line) if closing < 0 else closing + 1
        else:
            past = _read_word(line, at, number, listing)
        if past < 0:
            listing.unread.append(Place(number, at + 1))
            return
        if len(listing.marks) > 0 and listing.marks[len(listing.marks) - 1].is_end:
            return
        at = _past_blanks(line, past)


def _read_word(line: str, at: int, number: int, listing: Listing) -> int:
    """Read a block or a mark, with its label, into a listing; where it ends, −1 where none stands there."""
    begin = _past_label(line, at)
    past = _read_block(line, begin, number, listing)
    return past if past >= 0 else _read_mark(line, begin, number, listing)


def _past_blanks(line: str, at: int) -> int:
    past = at
    while past < len(line) and line[past] in _BLANKS:
        past += 1
    return past


def _past_digits(line: str, at: int) -> int:
    past = at
    while past < len(line) and line[past] in _DIGITS:
        past += 1
    return past


def _past_label(line: str, at: int) -> int:
    """Where a label as ``N7:``, ``N7``, ``7:`` or ``7`` ends, and the blanks behind it; `at` where there is none."""
    has_letter = line[at] == "N"
    first = _past_blanks(line, at + 1) if has_letter else at
    past = _past_digits(line, first)
    if past == first:
        return at
    past = _past_blanks(line, past)
    if past < len(line) and line[past] == ":":
        past = _past_blanks(line, past + 1)
    return past


def _number(line: str, at: int) -> _Word:
    """The number behind a letter B, 0 where no digit stands there."""
    if at >= len(line) or line[at] != "B":
        return _NOTHING
    first = _past_blanks(line, at + 1)
    past = _past_digits(line, first)
    start = first
    while start < past - 1 and line[start] == "0":
        start += 1
    if past - start > MOST_DIGITS:
        return _NOTHING
    return _Word(int(line[start:past]) if past > start else 0, _past_blanks(line, past))


def _read_block(line: str, at: int, number: int, listing: Listing) -> int:
    """Read a block into a listing; where it ends, −1 where none stands there."""
    x = _number(line, at)
    y = _number(line, x.past) if x.past >= 0 else _NOTHING
    count = _number(line, y.past) if y.past >= 0 else _NOTHING
    axis = _axis(line, count.past) if count.past >= 0 else _NOTHING
    turn = _turn(line, axis.past) if axis.past >= 0 else _NOTHING
    if turn.past < 0 or turn.past >= len(line) or line[turn.past] not in "1234":
        return -1
    past = turn.past + 1
    if past < len(line) and line[past] in _DIGITS:
        return -1
    quadrant = int(line[turn.past])
    listing.blocks.append(Block(x.value, y.value, count.value, axis.value, turn.value, quadrant, number))
    return past


def _axis(line: str, at: int) -> _Word:
    """``GX`` as 0, ``GY`` as 1."""
    if at >= len(line) or line[at] != "G":
        return _NOTHING
    letter = _past_blanks(line, at + 1)
    if letter >= len(line) or line[letter] not in "XY":
        return _NOTHING
    return _Word(0 if line[letter] == "X" else 1, _past_blanks(line, letter + 1))


def _turn(line: str, at: int) -> _Word:
    """``L`` as 0, ``NR`` as 1, ``SR`` as −1."""
    if at >= len(line):
        return _NOTHING
    if line[at] == "L":
        return _Word(0, _past_blanks(line, at + 1))
    if line[at] not in "NS":
        return _NOTHING
    letter = _past_blanks(line, at + 1)
    if letter >= len(line) or line[letter] != "R":
        return _NOTHING
    return _Word(1 if line[at] == "N" else -1, _past_blanks(line, letter + 1))


def _read_mark(line: str, at: int, number: int, listing: Listing) -> int:
    """Read ``D`` or ``DD`` into a listing; where it ends, −1 where none stands there."""
    past = at
    while past < len(line) and line[past] == "D":
        past += 1
    is_word = past == len(line) or line[past] in " \t;/(B"
    if not (1 <= past - at <= 2 and is_word):
        return -1
    listing.marks.append(Mark(past - at == 2, len(listing.blocks), number))
    return past
