"""What another language has no words for: told of a text before it is written otherwise."""

from collections.abc import Iterable
from typing import NamedTuple

import numpy as np

from parser.geometry.curves import Bools
from parser.iso.listing.lexer import read_listing
from parser.iso.listing.listing import Form, Listing

_MOST_NAMED = 8
_SWITCHES = "ABCEFQSTUVWZ"
_STOPS = (1, 20, 21, 50, 60)
_OF_THE_PATH = (0, 2, 30, 98, 99, 199, *_STOPS)
_DWELL, _OPTIONAL = 4, 1


class Loss(NamedTuple):
    """Something that is not in the written text any more, or is there otherwise.

    Attributes
    ----------
    what
        Name of its text for people, ``convert.lost-…``.
    of
        The words themselves, for people; empty where they are only counted.
    number
        How many there are.
    """

    what: str
    of: str
    number: int


class CarriedOver(NamedTuple):
    """What a written text has: words of some letters, dwells, optional stops."""

    letters: str = ""
    dwells: bool = False
    optional_stops: bool = False


def lost_words(text: str, carried: CarriedOver) -> tuple[Loss, ...]:
    """Words of an ISO text that switch something, stop, wait or call, and that the written one has not."""
    listing = read_listing(text)
    words = listing.words
    is_m = words.letter == ord("M")
    is_dwell = (words.letter == ord("G")) & (words.value == _DWELL)
    dwells = np.zeros(len(words.letter), dtype=np.bool_) if carried.dwells else is_dwell
    in_dwell = listing.blocks_of(np.flatnonzero(is_dwell))[words.block]
    stops = [stop for stop in _STOPS if stop != _OPTIONAL or not carried.optional_stops]
    switches = np.isin(words.letter, [ord(letter) for letter in _SWITCHES if letter not in carried.letters]) & ~in_dwell
    switches |= is_m & ~np.isin(words.value, _OF_THE_PATH)
    losses = [
        _named("switches", listing, switches),
        _of("settings", listing.text, [each.span for each in listing.statements if each.form is not Form.TWO_PLANES]),
        _named("stops", listing, is_m & np.isin(words.value, stops)),
        _of("dwells", listing.text, [_block_span(listing, at) for at in np.flatnonzero(dwells).tolist()]),
        _named("calls", listing, is_m & (words.value == 98)),
        Loss("remarks", "", len(listing.remarks)),
        Loss("skips", "", int(listing.blocks.is_skipped.sum())),
    ]
    return tuple(loss for loss in losses if loss.number)


def _named(what: str, listing: Listing, chosen: Bools) -> Loss:
    at = np.flatnonzero(chosen)
    first, past = listing.words.first[at].tolist(), listing.words.past[at].tolist()
    return _of(what, listing.text, list(zip(first, past, strict=True)))


def _block_span(listing: Listing, word: int) -> tuple[int, int]:
    """The block of a word, from that word on."""
    return int(listing.words.first[word]), int(listing.blocks.past[listing.words.block[word]])


def _of(what: str, text: str, spans: list[tuple[int, int]]) -> Loss:
    return Loss(what, some(text[slice(*span)] for span in spans), len(spans))


def some(names: Iterable[str]) -> str:
    """Names without those that are there already, the first few of them."""
    distinct = list(dict.fromkeys(names))
    return ", ".join(distinct[:_MOST_NAMED]) + (" …" if len(distinct) > _MOST_NAMED else "")
