"""What a program says that is not simulated: other paths, variables, a wire that leans (docs/iso.md §3)."""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from parser.dialect.reader import PATH_IS_ALL, BesideThePath
from parser.findings.facts import NotSimulated
from parser.findings.findings import Finding
from parser.geometry.curves import Ints
from parser.iso.listing.listing import Form, Listing, Statement
from parser.iso.profiles.profile import Profile
from parser.iso.words.word_checks import effects

_OTHER_PLANES = (18.0, 19.0)
_LEANS = (51.0, 52.0)
_MOST_NAMED = 8


class AskedBeside(NamedTuple):
    """Findings ISO204, ISO402 and ISO600; and what they are about."""

    findings: tuple[Finding, ...]
    beside: BesideThePath


class _Reason(NamedTuple):
    """Findings of one kind, and the words that they are about, as people name them."""

    findings: list[Finding]
    words: list[str]


def not_simulated(listing: Listing, profile: Profile) -> AskedBeside:
    """What the words of a listing ask for beside its path."""
    found = {
        "reason-other-paths": _other_paths(listing, profile),
        "reason-macros": _macros(listing),
        "reason-taper": _taper(listing, profile),
    }
    told = {reason: each for reason, each in found.items() if each.findings}
    if not told:
        return AskedBeside((), PATH_IS_ALL)
    first = next(iter(told))
    words = [word for each in told.values() for word in each.words]
    named = tuple(words[:_MOST_NAMED]) + ("…",) * (len(words) > _MOST_NAMED)
    findings = tuple(
        finding.with_fact(NotSimulated(otherwise=reason != "reason-taper"))
        for reason, each in told.items()
        for finding in each.findings
    )
    return AskedBeside(findings, BesideThePath(first if len(told) == 1 else "reason-other-paths", named))


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
    told = np.concatenate([listing.of("U"), listing.of("V"), angles])
    leaning = told[words.value[told] != 0.0]
    return np.sort(leaning if len(angles) else np.concatenate([leaning, switched]))
