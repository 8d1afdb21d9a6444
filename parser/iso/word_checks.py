"""Checks of the words in each block: groups, repeats, numbers (docs/iso.md §2, §3).

What a program says that is not simulated: other paths, variables, a wire that leans (docs/iso.md §3).
"""

from collections.abc import Iterator, Mapping
from typing import NamedTuple

import numpy as np

from parser.dialect.reader import PATH_IS_ALL, BesideThePath
from parser.findings.findings import Finding, NotSimulated, TooLarge
from parser.geometry.curves import Bools, Floats, Ints
from parser.iso.listing.listing import Form, Listing, Statement
from parser.iso.profiles.profile import Profile
from parser.units import mm

GROUPS = (
    *("motion", "plane", "distance", "centres", "unit", "compensation", "two-planes", "taper", "system", "rotation"),
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
    whole_words = listing.of_any(profile.whole + "GM")
    for word in whole_words[~_is_whole(words.value[whole_words])].tolist():
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


_OTHER_PLANES = (18.0, 19.0)
_LEANS = (51.0, 52.0)
_MOST_NAMED = 8


class AskedBeside(NamedTuple):
    """Findings ISO204, ISO402 and ISO600; and what they are about."""

    findings: tuple[Finding, ...]
    besides: BesideThePath


class _Reason(NamedTuple):
    """Findings of one kind, and the words that they are about, as people name them."""

    findings: list[Finding]
    words: list[str]


def not_simulated(listing: Listing, profile: Profile, *, lean_is_known: bool) -> AskedBeside:
    """What the words of a listing ask for beside its path; a lean that is known is no such thing."""
    found = {
        "reason-other-paths": _other_paths(listing, profile),
        "reason-macros": _macros(listing),
        **({} if lean_is_known else {"reason-taper": _taper(listing, profile)}),
    }
    with_findings = {reason: each for reason, each in found.items() if each.findings}
    if not with_findings:
        return AskedBeside((), PATH_IS_ALL)
    first = next(iter(with_findings))
    words = [word for each in with_findings.values() for word in each.words]
    named = tuple(words[:_MOST_NAMED]) + ("…",) * (len(words) > _MOST_NAMED)
    findings = tuple(
        finding.with_fact(NotSimulated(otherwise=reason != "reason-taper"))
        for reason, each in with_findings.items()
        for finding in each.findings
    )
    return AskedBeside(findings, BesideThePath(first if len(with_findings) == 1 else "reason-other-paths", named))


def _macros(listing: Listing) -> _Reason:
    """ISO402 at the first line of them."""
    lines = [statement for statement in listing.statements if statement.form is Form.MACRO]
    texts = [_text(listing, line) for line in lines]
    first = [listing.lines.finding("ISO402", line.span, 0, text=texts[0], more=len(lines) - 1) for line in lines[:1]]
    return _Reason(first, list(dict.fromkeys(texts)))


def _text(listing: Listing, statement: Statement) -> str:
    return listing.lines.text[slice(*statement.span)].strip()


def _other_paths(listing: Listing, profile: Profile) -> _Reason:
    """ISO204 at the first word of each kind."""
    g, m = effects(listing, "G", profile.g), effects(listing, "M", profile.m)
    value = listing.words.value
    firsts = [
        (first, count)
        for word in (g.word[g.are("path") | np.isin(value[g.word], _OTHER_PLANES)], m.word[m.are("path")])
        for first, count in _first_of_each(value[word].tolist(), word)
    ]
    findings = [
        listing.at_word("ISO204", first, word=listing.written(first), more=count - 1) for first, count in firsts
    ]
    return _Reason(findings, [listing.written(first) for first, _ in firsts])


def _first_of_each(number: list[float], word: Ints) -> list[tuple[int, int]]:
    """The first word of each number, and how many there are of it."""
    _, first, count = np.unique(number, return_index=True, return_counts=True)
    return sorted(zip(word[first].tolist(), count.tolist(), strict=True))


def _taper(listing: Listing, profile: Profile) -> _Reason:
    """ISO600 at the first word or contour by which the wire leans."""
    planes = [statement for statement in listing.statements if statement.form is Form.TWO_PLANES]
    leaning = _leaning_words(listing, profile)
    more = len(planes) + len(leaning) - 1
    names = [*_letters(listing, leaning), *([":"] if planes else [])]
    if len(leaning):
        first = int(leaning[0])
        return _Reason([listing.at_word("ISO600", first, word=listing.written(first), more=more)], names)
    return _Reason([listing.lines.finding("ISO600", plane.span, 0, word=":", more=more) for plane in planes[:1]], names)


def _letters(listing: Listing, word: Ints) -> Iterator[str]:
    """Some words as people name them together: each letter once, G with its number."""
    letter, value = listing.words.letter[word], listing.words.value[word]
    pairs = zip(letter.tolist(), np.where(letter == ord("G"), value, 0.0).tolist(), strict=True)
    for code, number in sorted(set(pairs)):
        yield f"G{number:g}" if code == ord("G") else chr(code)


def _leaning_words(listing: Listing, profile: Profile) -> Ints:
    """U, V and angles that are not 0; G51 and G52 where no angle is written at all."""
    words = listing.words
    switched = listing.of("G")[np.isin(words.value[listing.of("G")], _LEANS)]
    angles = listing.of(profile.angle)
    if profile.angle != "A" and not len(switched):
        angles = angles[:0]  # T switches where nothing leans
    row = np.concatenate([listing.of("U"), listing.of("V"), angles])
    leaning = row[words.value[row] != 0.0]
    return np.sort(leaning if len(angles) else np.concatenate([leaning, switched]))
