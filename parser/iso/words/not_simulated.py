"""What a program says that is not simulated: other paths, variables, a wire that leans (docs/iso.md §3)."""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from parser.findings.findings import Finding
from parser.geometry.curves import Ints
from parser.iso.listing.listing import Form, Listing
from parser.iso.profiles.profile import Profile
from parser.iso.words.word_checks import effects

_OTHER_PLANES = (18.0, 19.0)
_LEANS = (51.0, 52.0)


class NotSimulated(NamedTuple):
    """Findings ISO204, ISO402 and ISO600; and the term of why the path is not all that the machine does, or empty."""

    findings: tuple[Finding, ...]
    reason: str


def not_simulated(listing: Listing, profile: Profile) -> NotSimulated:
    """What the words of a listing ask for beside its path."""
    told = {
        "reason-macros": [*_macros(listing)],
        "reason-other-paths": [*_other_paths(listing, profile)],
        "reason-taper": [*_taper(listing, profile)],
    }
    reason = next((reason for reason, findings in told.items() if findings), "")
    return NotSimulated(tuple(finding for findings in told.values() for finding in findings), reason)


def _macros(listing: Listing) -> Iterator[Finding]:
    """ISO402 at the first line of them."""
    lines = [one for one in listing.statements if one.form is Form.MACRO]
    for one in lines[:1]:
        text = listing.lines.text[slice(*one.span)].strip()
        yield listing.lines.finding("ISO402", one.span, 0, text=text, more=len(lines) - 1)


def _other_paths(listing: Listing, profile: Profile) -> Iterator[Finding]:
    """ISO204 at the first word of each kind."""
    g, m = effects(listing, "G", profile.g), effects(listing, "M", profile.m)
    value = listing.words.value
    for word in (
        g.word[g.are("path") | np.isin(value[g.word], _OTHER_PLANES)],
        m.word[m.are("path")],
    ):
        for first, count in _first_of_each(value[word].tolist(), word):
            yield listing.at_word("ISO204", first, word=listing.written(first), more=count - 1)


def _first_of_each(number: list[float], word: Ints) -> list[tuple[int, int]]:
    """The first word of each number, and how many there are of it."""
    _, first, count = np.unique(number, return_index=True, return_counts=True)
    return sorted(zip(word[first].tolist(), count.tolist(), strict=True))


def _taper(listing: Listing, profile: Profile) -> Iterator[Finding]:
    """ISO600 at the first word or contour by which the wire leans."""
    planes = [one for one in listing.statements if one.form is Form.TWO_PLANES]
    leaning = _leaning_words(listing, profile)
    more = len(planes) + len(leaning) - 1
    if len(leaning):
        first = int(leaning[0])
        yield listing.at_word("ISO600", first, word=listing.written(first), more=more)
    elif planes:
        yield listing.lines.finding("ISO600", planes[0].span, 0, word=":", more=more)


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
