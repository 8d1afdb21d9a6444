"""Mill code: what in a listing no wire machine is told (docs/iso.md §6)."""

from parser.findings.findings import Finding
from parser.iso.listing.listing import Listing

_LEVELS = 2  # of Z, at which something moves down and up


def mill_code(listing: Listing) -> Finding | None:
    """Finding ISO100 at the word that tells a mill; None where nothing does."""
    word, what = next(
        (
            (word, what)
            for word, what in (
                (_first(listing, "M", 6), "mill-tool"),
                (_first(listing, "G", 43), "mill-length"),
                (_spindle(listing), "mill-spindle"),
                (_depth(listing), "mill-depth"),
            )
            if word >= 0
        ),
        (-1, ""),
    )
    if word < 0:
        return None
    detail = listing.written(word)
    return listing.at_word("ISO100", word, what=what, detail=detail, hint="hint-wire-program")


def _first(listing: Listing, letter: str, number: float) -> int:
    """The first word with a letter and a number; −1 where there is none."""
    word = listing.of(letter)
    found = word[listing.words.value[word] == number]
    return int(found[0]) if len(found) else -1


def _spindle(listing: Listing) -> int:
    """The first M03 or M04 in a block with an S word: a spindle turns."""
    turns = listing.of("M")
    value = listing.words.value[turns]
    turns = turns[(value == 3.0) | (value == 4.0)]
    found = turns[listing.blocks_of(listing.of("S"))[listing.words.block[turns]]]
    return int(found[0]) if len(found) else -1


def _depth(listing: Listing) -> int:
    """The first Z below 0 where Z moves between levels: something goes down into the work."""
    words = listing.words
    sets = listing.blocks_of(listing.of("G")[words.value[listing.of("G")] == 92.0])
    depth = listing.of("Z")
    depth = depth[~sets[words.block[depth]]]
    below = depth[words.value[depth] < 0.0]
    return int(below[0]) if len(below) and len(set(words.value[depth].tolist())) >= _LEVELS else -1
