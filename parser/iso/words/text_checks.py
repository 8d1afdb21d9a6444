"""What is wrong with the words of a listing as text, once the family is known that it was written for.

Blocks as commands: letters that a family knows, and something that is commanded.

The order of the words in a block: N G X Y Z I J K R H D F S T M, as courses teach it.
"""

import numpy as np

from parser.findings.codes import Severity
from parser.findings.findings import Finding, file_order
from parser.geometry.curves import Bools, Ints
from parser.iso.listing.listing import Listing, Unread
from parser.iso.profiles.profile import Profile
from parser.iso.words.numbering import ENDS, are_called, numbering_findings
from parser.iso.words.word_checks import word_findings

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
    told = behind if strict else behind[:1]
    more = 0 if strict else len(behind) - 1
    found = [
        listing.at_word("ISO130", word, word=listing.written(word), before=listing.written(before), more=more)
        for before, word in zip(ranked[told].tolist(), ranked[told + 1].tolist(), strict=True)
    ]
    return [one._replace(graver=Severity.ERROR if strict else None) for one in found]


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
