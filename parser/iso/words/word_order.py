"""The order of the words in a block: N G X Y Z I J K R H D F S T M, as courses teach it."""

import numpy as np

from parser.findings.codes import Severity
from parser.findings.findings import Finding
from parser.iso.listing.listing import Listing

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
