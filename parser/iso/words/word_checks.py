"""Checks of the words in each block: groups, repeats, numbers (docs/iso.md §2, §3)."""

from collections.abc import Iterator, Mapping
from typing import NamedTuple

import numpy as np

from parser.findings.facts import TooLarge
from parser.findings.findings import Finding
from parser.geometry.curves import Bools, Floats, Ints
from parser.iso.listing.listing import Listing
from parser.iso.profiles.profile import Profile
from parser.units import mm

GROUPS = (
    *("motion", "plane", "distance", "centres", "unit", "compensation", "taper", "system", "rotation"),
    *("path-mode", "cycle", "feed", "lifecycle"),
)
"""Groups of G words of which a block has one at most; other effects are none."""

_TENFOLD = 10_000  # G and M words are numbers below 1000 with one decimal at most
_COORDINATES, _RADII = "XYUVZ", "IJKR"
_LETTERS = 256
_MM_PER_M = 1000.0
_EXACT = 1e-6


class Effects(NamedTuple):
    """The words with one letter, G or M, (k,) in file order, each with its effect: its place in `names`, or −1."""

    word: Ints
    effect: Ints
    names: tuple[str, ...]

    def are(self, *names: str) -> Bools:
        """(k,) whether each has one of some effects."""
        wanted = [at for at, name in enumerate(self.names) if name in names]
        found: Bools = np.isin(self.effect, wanted)
        return found


def effects(listing: Listing, letter: str, table: Mapping[str, str]) -> Effects:
    """The words with a letter, and what a profile says that they do."""
    names = tuple(sorted(set(table.values())))
    effect_of = np.full(_TENFOLD, -1, dtype=np.int64)
    for number, name in table.items():
        effect_of[round(float(number) * 10)] = names.index(name)
    word = listing.of(letter)
    tenfold = listing.words.value[word] * 10
    at = np.rint(tenfold)
    is_known = (np.abs(tenfold - at) < _EXACT) & (at >= 0) & (at < _TENFOLD)
    effect = np.where(is_known, effect_of[np.where(is_known, at, 0).astype(np.int64)], -1)
    return Effects(word, effect, names)


def word_findings(listing: Listing, profile: Profile) -> Iterator[Finding]:
    """Findings ISO200 to ISO203, ISO205, ISO206 and ISO209, each at its word."""
    if not len(listing.words.letter):
        return
    g, m = effects(listing, "G", profile.g), effects(listing, "M", profile.m)
    yield from _two_of_a_group(listing, g)
    yield from _repeated_letters(listing, profile)
    yield from _centers_and_radius(listing)
    yield from _unknown(listing, g, m)
    yield from _parts_of_numbers(listing, profile)
    yield from _out_of_range(listing, profile)
    yield from _repeated_m(listing, profile, m)


def _two_of_a_group(listing: Listing, g: Effects) -> Iterator[Finding]:
    """ISO200: at the later word."""
    group = np.array([GROUPS.index(name) if name in GROUPS else -1 for name in g.names])
    grouped = np.flatnonzero((g.effect >= 0) & (group[g.effect] >= 0))
    word = g.word[grouped]
    for later, before in _repeats(listing, word, group[g.effect[grouped]]):
        name = f"group-{GROUPS[group[g.effect[np.searchsorted(g.word, later)]]]}"
        yield listing.at_word("ISO200", later, word=listing.written(later), other=listing.written(before), group=name)


def _repeated_letters(listing: Listing, profile: Profile) -> Iterator[Finding]:
    """ISO201: at the later word."""
    word = listing.of_any("".join(sorted(set(profile.letters) - set(profile.repeatable))))
    for later, before in _repeats(listing, word, listing.words.letter[word]):
        yield listing.at_word("ISO201", later, word=listing.written(later), other=listing.written(before))


def _centers_and_radius(listing: Listing) -> Iterator[Finding]:
    """ISO202: at the radius."""
    radius = listing.of("R")
    centers = np.concatenate([listing.of("I"), listing.of("J")])
    for word in radius[np.isin(listing.words.block[radius], listing.words.block[centers])].tolist():
        yield listing.at_word("ISO202", word, word=listing.written(word))


def _unknown(listing: Listing, g: Effects, m: Effects) -> Iterator[Finding]:
    """ISO203; numbers with parts are told by ISO205."""
    for of in (g, m):
        word = of.word[of.effect < 0]
        for each in word[_is_whole(listing.words.value[word])].tolist():
            yield listing.at_word("ISO203", each, word=listing.written(each))


def _parts_of_numbers(listing: Listing, profile: Profile) -> Iterator[Finding]:
    """ISO205: parts behind the point where numbers are whole."""
    words = listing.words
    known = {round(float(number) * 10) for number in profile.g if "." in number}
    told = listing.of_any(profile.whole + "GM")
    for word in told[~_is_whole(words.value[told])].tolist():
        is_known = words.letter[word] == ord("G") and round(float(words.value[word]) * 10, 6) in known
        if not is_known:
            yield listing.at_word("ISO205", word, word=listing.written(word), letter=chr(int(words.letter[word])))


def _out_of_range(listing: Listing, profile: Profile) -> Iterator[Finding]:
    """ISO206: below or above what a word takes, and lengths beyond any table."""
    words = listing.words
    low, high = np.full(_LETTERS, -np.inf), np.full(_LETTERS, np.inf)
    for letter, (least, most) in profile.range.items():
        low[ord(letter)], high[ord(letter)] = least, most
    for word in np.flatnonzero((words.value < low[words.letter]) | (words.value > high[words.letter])).tolist():
        code = int(words.letter[word])
        limits = f"{low[code]:g} … {high[code]:.0f}"
        yield listing.at_word("ISO206", word, word=listing.written(word), limits=limits)
    for letters, most_um in ((_COORDINATES, profile.most_coordinate_um), (_RADII, profile.most_radius_um)):
        lengths = listing.of_any(letters)
        scale = np.where(words.decimals[lengths] < 0, profile.integer_um, profile.point_um)
        for word in lengths[np.abs(words.value[lengths]) * scale > most_um].tolist():
            limits = f"±{mm(most_um) / _MM_PER_M:g} m"
            found = listing.at_word("ISO206", word, word=listing.written(word), limits=limits)
            yield found.with_fact(TooLarge())


def _repeated_m(listing: Listing, profile: Profile, m: Effects) -> Iterator[Finding]:
    """ISO209: at the later word."""
    number = listing.words.value[m.word]
    told_rows = np.flatnonzero(~np.isin(number, profile.meant_twice))
    _, kind = np.unique(number[told_rows], return_inverse=True)
    for later, _ in _repeats(listing, m.word[told_rows], kind):
        yield listing.at_word("ISO209", later, word=listing.written(later))


def _repeats(listing: Listing, word: Ints, kind: Ints) -> Iterator[tuple[int, int]]:
    """Words (k,) in file order that stand behind another one of their kind (k,) in their block, with the first one."""
    if not len(word):
        return
    block = listing.words.block[word]
    order = np.lexsort((word, kind, block)) if _has_repeats(block, kind) else word[:0]
    same = np.flatnonzero((np.diff(block[order]) == 0) & (np.diff(kind[order]) == 0)) + 1
    for at in sorted(same.tolist(), key=lambda each: int(word[order[each]])):
        yield int(word[order[at]]), int(word[order[at - 1]])


def _has_repeats(block: Ints, kind: Ints) -> bool:
    """Whether a kind (k,) stands twice in a block (k,): the sum of its bits is another one than their union."""
    first = np.flatnonzero(np.diff(block, prepend=-1))
    bit = np.left_shift(1, kind - kind.min()) if np.ptp(kind) < 63 else kind
    return bool((np.add.reduceat(bit, first) != np.bitwise_or.reduceat(bit, first)).any())


def _is_whole(value: Floats) -> Bools:
    whole: Bools = np.abs(value - np.rint(value)) < _EXACT
    return whole
