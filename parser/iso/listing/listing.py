"""The listing: words of a text as columns, gathered in blocks, one a line; what `lexer` makes and all others read."""

from enum import StrEnum
from typing import NamedTuple

import numpy as np

from parser.findings.findings import Finding, Value
from parser.geometry.curves import Bools, Floats, Ints
from parser.text.source import LineIndex

_LETTERS = 256  # codes of letters, with room


class Words(NamedTuple):
    """m words, such as ``X-1.5``, in file order; each column has shape (m,).

    Attributes
    ----------
    letter
        int64, the code of its letter as a capital: ``ord("X")``.
    value
        float64, its number as written, without a unit.
    decimals
        int64, digits behind the point; 0 with a point and none behind it, −1 without a point.
    first, past
        int64, its first character and one past its last.
    block
        int64, the block that it stands in, from 0.
    """

    letter: Ints
    value: Floats
    decimals: Ints
    first: Ints
    past: Ints
    block: Ints


class Blocks(NamedTuple):
    """b blocks: lines that hold more than remarks, titles and tape marks, in file order.

    Each column has shape (b,) but for the last.

    Attributes
    ----------
    line
        int64, its line, from 1.
    first, past
        int64, its first character, and one past its last, without blanks, remarks and a closing ``;`` at its ends.
    is_skipped
        bool, whether it begins with ``/``: an operator may switch it off.
    is_damaged
        bool, whether something in it could not be read: its motion is not known.
    word
        (b + 1,) int64, the first word of each block, and one past the last.
    """

    line: Ints
    first: Ints
    past: Ints
    is_skipped: Bools
    is_damaged: Bools
    word: Ints


class Assignment(NamedTuple):
    """A register that the program sets, such as ``H001=110`` or ``H1 =.0085 + H175``.

    Attributes
    ----------
    block
        Block that it stands in, from 0.
    register
        Its name without leading zeros: ``H1``.
    terms
        What is summed: numbers as written, each with its decimals as in `Words`, and names of registers.
    span
        First character, and one past the last.
    """

    block: int
    register: str
    terms: tuple[tuple[float, int] | str, ...]
    span: tuple[int, int]


class Form(StrEnum):
    """What a line says that is neither words nor an offset register (docs/iso.md §1)."""

    SETTING = "setting"
    """Other values that are set, such as ``C001 = 012 014``: cutting conditions."""
    FUNCTION = "function"
    """A function of the controller, such as ``QAIC(2,1,0.1250)``."""
    MACRO = "macro"
    """Variables, sums in brackets, jumps and loops, such as ``#100 = #101 + 1`` or ``IF [#1 GT 0] GOTO 10``."""
    FEED = "feed"
    """A feed that is held in a variable, such as ``F#61``: it moves nothing."""
    TWO_PLANES = "two-planes"
    """Upper contour, ``:``, lower contour; the words of the block are those of the lower one."""


class Statement(NamedTuple):
    """A line, or of two planes the upper contour, in another form than words.

    Attributes
    ----------
    form
        Which one.
    block
        Block that it stands in, from 0; the block of a macro is damaged, as its motion is not known.
    span
        First character, and one past the last.
    """

    form: Form
    block: int
    span: tuple[int, int]


class Unread(NamedTuple):
    """A piece of text that is no word: its span, and the block it stands in, from 0; −1 where it stands in none."""

    span: tuple[int, int]
    block: int


class ByLetter:
    """Words (m,) by their letters, each letter looked for once."""

    def __init__(self, letter: Ints) -> None:
        self._letter = letter.astype(np.uint8)
        self._words: dict[str, Ints] = {}

    def of(self, letter: str) -> Ints:
        """(k,) words with a letter, in file order."""
        if letter not in self._words:
            self._words[letter] = np.flatnonzero(self._letter == ord(letter))
        return self._words[letter]


class Listing(NamedTuple):
    """All that stands in one text.

    Attributes
    ----------
    text, lines
        The text as written, and places in it folded to narrow characters.
    words, blocks
        Words, in blocks.
    by_letter
        The words by their letters.
    assignments
        Of offset registers, in file order.
    statements
        Lines in other forms than words, in file order.
    remarks
        (k, 2) int64, first character and one past the last of each remark.
    unread
        What is no word.
    tape_end
        One past the last character before the ``%`` that ends the tape; the length of the text where none does.
    findings
        ISO1xx of the text itself.
    """

    text: str
    lines: LineIndex
    words: Words
    blocks: Blocks
    by_letter: ByLetter
    assignments: tuple[Assignment, ...]
    statements: tuple[Statement, ...]
    remarks: Ints
    unread: tuple[Unread, ...]
    tape_end: int
    findings: tuple[Finding, ...]

    def of(self, letter: str) -> Ints:
        """(k,) words with a letter, in file order."""
        return self.by_letter.of(letter)

    def blocks_of(self, word: Ints) -> Bools:
        """(b,) bool, which blocks hold any of some words."""
        holds = np.zeros(len(self.blocks.line), dtype=np.bool_)
        holds[self.words.block[word]] = True
        return holds

    def stands_alone(self) -> Bools:
        """(b,) bool, whether a block is one N word and nothing else, which makes it a label."""
        words, blocks = self.words, self.blocks
        alone: Bools = (np.diff(blocks.word) == 1) & ~blocks.is_damaged
        alone[alone] = words.letter[blocks.word[:-1][alone]] == ord("N")
        alone[[assignment.block for assignment in self.assignments]] = False
        alone[[statement.block for statement in self.statements]] = False
        return alone

    def of_any(self, letters: str) -> Ints:
        """(k,) words with one of some letters, in file order."""
        is_one = np.zeros(_LETTERS, dtype=np.bool_)
        is_one[[ord(letter) for letter in letters]] = True
        return np.flatnonzero(is_one[self.words.letter])

    def written(self, word: int) -> str:
        """A word as written."""
        return self.lines.text[int(self.words.first[word]) : int(self.words.past[word])]

    def at_word(self, code: str, word: int, /, **values: Value) -> Finding:
        """Finding at a word, in its block of the text."""
        span = int(self.words.first[word]), int(self.words.past[word])
        return self.lines.finding(code, span, int(self.words.block[word]) + 1, **values)
