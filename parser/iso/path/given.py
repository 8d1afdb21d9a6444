"""What each block gives: words by letter, G and M words by what the profile says that they do."""

from functools import cached_property

import numpy as np

from parser.geometry.curves import Bools, Ints
from parser.iso.listing.listing import Listing
from parser.iso.profiles.profile import Profile

_TENFOLD = 10_000  # G words are numbers below 1000 with one decimal at most


STOPS = ("stop", "thread", "cut")
"""What M words do behind which the wire may be threaded elsewhere."""


class Given:
    """Columns (b,) of the blocks of a listing, in file order. Of words that contradict each other the last one counts.

    G words go by ten times their number: 901 is G90.1.
    """

    def __init__(self, listing: Listing, profile: Profile) -> None:
        self.listing = listing
        self.profile = profile
        self._size = len(listing.blocks.line)

    def word(self, letter: str) -> Ints:
        """(b,) the word with a letter; −1 where a block has none."""
        return self._last(self.listing.of(letter))

    def group(self, name: str) -> Ints:
        """(b,) the G word of a group; −1 where a block has none."""
        chosen = np.flatnonzero(self._group_of[self._tenfold] == self._groups.get(name, -1))
        at = np.full(self._size, -1, dtype=np.int64)
        at[self._block_of_g[chosen]] = self._tenfold[chosen]
        return at

    def contradicts(self, name: str) -> Bools:
        """(b,) whether a block has G words of a group that differ."""
        chosen = np.flatnonzero(self._group_of[self._tenfold] == self._groups.get(name, -1))
        block = self._block_of_g[chosen]
        return self._any(block[self._tenfold[chosen] != self.group(name)[block]])

    def g(self, tenfold: int) -> Bools:
        """(b,) whether a block has one G word."""
        return self._any(self._block_of_g[self._tenfold == tenfold])

    def m(self, *effects: str) -> Bools:
        """(b,) whether a block has an M word with one of the effects that profiles name."""
        return self._any(self.listing.words.block[self.m_words(*effects)])

    def m_words(self, *effects: str) -> Ints:
        """(k,) the M words with one of the effects that profiles name, in file order."""
        numbers = [float(number) for number, effect in self.profile.m.items() if effect in effects]
        word = self.listing.of("M")
        return word[np.isin(self.listing.words.value[word], numbers)]

    def _last(self, word: Ints) -> Ints:
        at = np.full(self._size, -1, dtype=np.int64)
        at[self.listing.words.block[word]] = word
        return at

    def _any(self, block: Ints) -> Bools:
        has = np.zeros(self._size, dtype=np.bool_)
        has[block] = True
        return has

    @cached_property
    def _block_of_g(self) -> Ints:
        return self.listing.words.block[self.listing.of("G")]

    @cached_property
    def _tenfold(self) -> Ints:
        """(k,) ten times the number of each G word; the last place of the table where it is beyond it."""
        number = np.rint(self.listing.words.value[self.listing.of("G")] * 10)
        return np.where((number >= 0) & (number < _TENFOLD - 1), number, _TENFOLD - 1).astype(np.int64)

    @cached_property
    def _groups(self) -> dict[str, int]:
        return {name: at for at, name in enumerate(sorted(set(self.profile.g.values())))}

    @cached_property
    def _group_of(self) -> Ints:
        table = np.full(_TENFOLD, -2, dtype=np.int64)
        for number, name in self.profile.g.items():
            table[round(float(number) * 10)] = self._groups[name]
        return table
