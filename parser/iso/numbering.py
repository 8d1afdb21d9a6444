"""N and O numbers: whole, rising, and each label once where something calls it.

What is wrong with the words of a listing as text, once the family is known that it was written for.

Blocks as commands: letters that a family knows, and something that is commanded.

The order of the words in a block: N G X Y Z I J K R H D F S T M, as courses teach it.
"""

import numpy as np

from parser.findings.codes import Severity
from parser.findings.findings import Edit, Finding, file_order
from parser.geometry.curves import Bools, Floats, Ints
from parser.iso.listing.listing import Form, Listing, Unread
from parser.iso.profiles.profile import Profile
from parser.iso.word_checks import word_findings

ENDS = (2, 30, 99, 199)
"""M words behind which numbers may begin anew: what follows is a subprogram."""
_WIDTHS = (9_999, 99_999)  # the largest number of four and of five digits: a CAM goes on from the beginning
_USUAL_STEP = 10


def numbering_findings(listing: Listing) -> list[Finding]:
    """ISO120 where N does not rise, ISO121 where a label is no whole number or stands twice (docs/iso.md §2)."""
    return [*_falls(listing), *_not_whole(listing), *_twice(listing)]


def are_called(listing: Listing, number: Floats) -> Bools:
    """(k,) bool, whether P words name some numbers (k,)."""
    called = np.sort(listing.words.value[listing.of("P")])
    are: Bools = called.searchsorted(number, side="right") > called.searchsorted(number)
    return are


def _falls(listing: Listing) -> list[Finding]:
    words = listing.words
    number = listing.of("N")
    if len(number) < 2:
        return []
    value = words.value[number]
    is_fall = np.append(False, value[1:] <= value[:-1])
    step = _usual_step(value)
    for most in _WIDTHS:
        is_fall[1:] &= ~((value[:-1] <= most) & (value[:-1] + step > most) & (value[1:] <= step))
    ends = listing.of("M")
    ends = ends[np.isin(words.value[ends], ENDS)]
    restarts = np.sort(np.concatenate([listing.of("O"), ends])).searchsorted(number)
    is_fall[1:] &= restarts[1:] == restarts[:-1]
    label = listing.stands_alone()[words.block[number]] & are_called(listing, value)
    is_fall &= ~label & ~np.append(False, label[:-1])
    found = [
        listing.at_word("ISO120", word, number=listing.written(word), before=listing.written(before))
        for before, word in zip(number[np.flatnonzero(is_fall) - 1].tolist(), number[is_fall].tolist(), strict=True)
    ]
    return [found[0]._replace(edits=_renumbered(listing, number, step)), *found[1:]] if found else []


def _usual_step(value: Floats) -> int:
    """What a number is mostly larger by than the one before."""
    rises, times = np.unique(np.diff(value)[np.diff(value) > 0], return_counts=True)
    return int(rises[times.argmax()]) if len(rises) and rises[times.argmax()] >= 1 else _USUAL_STEP


def _renumbered(listing: Listing, number: Ints, step: int) -> tuple[Edit, ...]:
    """All N in equal steps from the first one; none where something may refer to them, or a digit more is needed."""
    words = listing.words
    value = words.value[number]
    last = value[0] + step * (len(number) - 1)
    refers = (
        len(listing.of("P"))
        or len(listing.of("O"))
        or any(statement.form is Form.MACRO for statement in listing.statements)
    )
    most = next((most for most in _WIDTHS if value.max() <= most), value.max())
    if refers or last > most or (words.decimals[number] >= 0).any() or value[0] < 0:
        return ()
    edits = []
    for at, (first, past) in enumerate(zip(words.first[number].tolist(), words.past[number].tolist(), strict=True)):
        digits = listing.lines.text[first + 1 : past]
        new = str(int(value[0]) + step * at).zfill(len(digits.strip()))
        if new != digits:
            edits.append(Edit(first + 1, past, new))
    return tuple(edits)


def _not_whole(listing: Listing) -> list[Finding]:
    words = listing.words
    is_label = (words.letter == ord("N")) | (words.letter == ord("O"))
    wrong = np.flatnonzero(is_label & ((words.decimals >= 0) | (words.value < 0)))
    return [_label(listing, at, "label-not-whole", str(_line(listing, at))) for at in wrong.tolist()]


def _twice(listing: Listing) -> list[Finding]:
    """Labels that calls name, or that stand alone, and program numbers, behind the first of each number."""
    words = listing.words
    n, o = listing.of("N"), listing.of("O")
    is_label = are_called(listing, words.value[n]) | listing.stands_alone()[words.block[n]]
    found = []
    for label in (n[is_label], o):
        _, first, inverse = np.unique(words.value[label], return_index=True, return_inverse=True)
        for at in np.flatnonzero(first[inverse] != np.arange(len(label))).tolist():
            before, here = int(label[first[inverse[at]]]), int(label[at])
            where = f"{_line(listing, before)}, {_line(listing, here)}"
            found.append(_label(listing, here, "label-twice", where))
    return found


def _label(listing: Listing, word: int, what: str, where: str) -> Finding:
    return listing.at_word("ISO121", word, label=listing.written(word), what=what, lines=where)


def _line(listing: Listing, word: int) -> int:
    return int(listing.blocks.line[listing.words.block[word]])


ORDER = ("N", "G", "X", "Y", "Z", "IJKR", "H", "D", "F", "S", "T", "M")
"""Letters in their order; those that are told together may stand in any, and all other letters anywhere."""

_RANK = np.zeros(256, dtype=np.int64)  # 0: anywhere
for _rank, _letters in enumerate(ORDER, 1):
    _RANK[[ord(letter) for letter in _letters]] = _rank


def order_findings(listing: Listing, *, strict: bool) -> list[Finding]:
    """ISO130 at the first word that stands behind one that it comes before; in each block where the order is strict."""
    words = listing.words
    ranked = np.flatnonzero(_RANK[words.letter])
    rank, block = _RANK[words.letter[ranked]], words.block[ranked]
    behind = np.flatnonzero((np.diff(rank) < 0) & (np.diff(block) == 0))
    behind = behind[np.flatnonzero(np.diff(block[behind], prepend=-1))]
    late = behind if strict else behind[:1]
    more = 0 if strict else len(behind) - 1
    found = [
        listing.at_word("ISO130", word, word=listing.written(word), before=listing.written(before), more=more)
        for before, word in zip(ranked[late].tolist(), ranked[late + 1].tolist(), strict=True)
    ]
    return [each._replace(graver=Severity.ERROR if strict else None) for each in found]


def unknown_letters(listing: Listing, letters: str) -> tuple[list[Finding], Ints]:
    """ISO103 at each word with a letter that is none of `letters`; and the blocks of these words."""
    letter = listing.words.letter
    unknown = np.flatnonzero(~np.isin(letter, [ord(letter) for letter in letters]))
    found = [
        listing.at_word("ISO103", word, letter=chr(int(letter[word])), text=listing.written(word))
        for word in unknown.tolist()
    ]
    return found, np.flatnonzero(listing.blocks_of(unknown))


def without_command(listing: Listing) -> list[Finding]:
    """ISO110 at block numbers of nothing (docs/iso.md §2)."""
    labels = listing.blocks.word[np.flatnonzero(_empty(listing))].tolist()
    return [listing.at_word("ISO110", word, what="nothing-but-n", text=listing.written(word)) for word in labels]


def _empty(listing: Listing) -> Bools:
    """(b,) bool, whether a line holds a block number alone, no label that is called or ends a program, no remark."""
    words, blocks = listing.words, listing.blocks
    empty = listing.stands_alone()
    if not empty.any():
        return empty
    number = words.value[np.minimum(blocks.word[:-1], len(words.value) - 1)]
    ends = words.block[(words.letter == ord("M")) & np.isin(words.value, ENDS)]
    empty &= ~are_called(listing, number)
    empty[int(ends[0]) + 1 if len(ends) else len(empty) :] = False
    remarked = listing.lines.lines(listing.remarks[:, 0])
    empty &= remarked.searchsorted(blocks.line, side="right") == remarked.searchsorted(blocks.line)
    return empty


def checked(listing: Listing, profile: Profile) -> Listing:
    """The listing with the findings of its text, and with the blocks damaged whose motion is not known by them."""
    letters, unknown = unknown_letters(listing, profile.letters)
    found = [
        *(*listing.findings, *letters, *without_command(listing), *numbering_findings(listing)),
        *order_findings(listing, strict=profile.strict_order),
        *word_findings(listing, profile),
    ]
    is_damaged = listing.blocks.is_damaged.copy()
    is_damaged[unknown] = True
    spans = zip(listing.blocks.first[unknown].tolist(), listing.blocks.past[unknown].tolist(), strict=True)
    unread = [Unread(span, block) for span, block in zip(spans, unknown.tolist(), strict=True)]
    return listing._replace(
        blocks=listing.blocks._replace(is_damaged=is_damaged),
        unread=tuple(sorted([*listing.unread, *unread])),
        findings=tuple(sorted(found, key=file_order)),
    )
