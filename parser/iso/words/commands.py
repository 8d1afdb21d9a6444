"""Blocks as commands: letters that a family knows, and something that is commanded."""

import numpy as np

from parser.findings.findings import Finding
from parser.geometry.curves import Bools, Ints
from parser.iso.listing.listing import Listing
from parser.iso.words.numbering import ENDS, are_called, stands_alone

_MOTION = (0, 1, 2, 3)
_PASSED = (17, 20, 21, 40, 41, 42, *range(54, 60), 70, 71, 90, 91, 90.1, 91.1)
"""G words that take no X and Y of their block for themselves."""
_PLACES = [ord(letter) for letter in "XYIJR"]
_CALL = 98


def unknown_letters(listing: Listing, letters: str) -> tuple[list[Finding], Ints]:
    """ISO103 at the first word of each letter that is none of `letters`; and the blocks of all these words."""
    words = listing.words
    unknown = np.flatnonzero(~np.isin(words.letter, [ord(letter) for letter in letters]))
    letter, first, times = np.unique(words.letter[unknown], return_index=True, return_counts=True)
    found = [
        listing.at_word(
            "ISO103", int(unknown[at]), letter=chr(one), text=listing.written(int(unknown[at])), more=count - 1
        )
        for one, at, count in zip(letter.tolist(), first.tolist(), times.tolist(), strict=True)
    ]
    return found, np.flatnonzero(listing.blocks_of(unknown))


def without_command(listing: Listing) -> tuple[list[Finding], Ints]:
    """ISO110 at numbers of nothing, and at the first places before any motion word; and the blocks of the latter."""
    words, blocks = listing.words, listing.blocks
    labels = np.flatnonzero(_empty(listing))
    found = [
        listing.at_word("ISO110", word, what="nothing-but-n", text=listing.written(word), more=0)
        for word in blocks.word[labels].tolist()
    ]
    is_g = words.letter == ord("G")
    is_call = (words.letter == ord("M")) & (words.value == _CALL)  # what runs by then, the order of execution tells
    motion = np.flatnonzero((is_g & np.isin(words.value, _MOTION)) | is_call)
    until = int(words.block[motion[0]]) if len(motion) else len(blocks.line)
    head = np.arange(blocks.word[until])
    takes = head[is_g[head]]
    taken = listing.blocks_of(takes[(words.value[takes, None] != _PASSED).all(axis=1)])
    places = head[np.isin(words.letter[head], _PLACES) & ~taken[words.block[head]]]
    lost = np.flatnonzero(listing.blocks_of(places))
    if len(lost):
        first = int(places[0])
        found.append(
            listing.at_word("ISO110", first, what="no-motion-yet", text=listing.written(first), more=len(lost) - 1)
        )
    return found, lost


def _empty(listing: Listing) -> Bools:
    """(b,) bool, whether a line holds a block number alone, no label that is called or ends a program, no remark."""
    words, blocks = listing.words, listing.blocks
    empty = stands_alone(listing)
    if not empty.any():
        return empty
    number = words.value[np.minimum(blocks.word[:-1], len(words.value) - 1)]
    ends = words.block[(words.letter == ord("M")) & np.isin(words.value, ENDS)]
    empty &= ~are_called(listing, number)
    empty[int(ends[0]) + 1 if len(ends) else len(empty) :] = False
    remarked = listing.lines.lines(listing.remarks[:, 0])
    empty &= remarked.searchsorted(blocks.line, side="right") == remarked.searchsorted(blocks.line)
    return empty
