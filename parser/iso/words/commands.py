"""Blocks as commands: letters that a family knows, and something that is commanded."""

import numpy as np

from parser.findings.findings import Finding
from parser.geometry.curves import Bools, Ints
from parser.iso.listing.listing import Listing
from parser.iso.words.numbering import ENDS, are_called


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
