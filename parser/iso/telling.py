"""Which family a listing was written for, and all that had to be assumed of scale and modes (docs/iso.md §4, §6)."""

from typing import NamedTuple

import numpy as np

from parser.dialect.reader import Assumption, Choices
from parser.findings.findings import Finding
from parser.geometry.curves import Ints
from parser.iso.listing import Listing
from parser.iso.marks import Seen, mark_of
from parser.iso.profile import Profile, profile
from parser.iso.scale import amount, scaled

_G = {"absolute": "G90", "incremental": "G91"}
_CHOSEN = "because-chosen"
_DISTANCE, _CENTERS, _UNIT = (90.0, 91.0), (90.1, 91.1), (20.0, 21.0, 70.0, 71.0)


class Told(NamedTuple):
    """The profile that a listing is read by, its scale and modes those that were taken; and what was assumed.

    Attributes
    ----------
    profile
        Of the family.
    assumptions
        What the text leaves open, in the order in which it is told; also what was chosen in its place.
    says_centers
        Whether the text itself says what I and J are.
    """

    profile: Profile
    assumptions: tuple[Assumption, ...]
    says_centers: bool = False

    @property
    def is_chosen(self) -> bool:
        """Whether the family was named, not told by marks."""
        return all(assumption.what != "assumed-dialect" for assumption in self.assumptions)


def told(listing: Listing, choices: Choices) -> Told:
    """The profile of a listing: as chosen, or by its marks; ``common`` where nothing tells."""
    seen = Seen(listing)
    mark = None if choices.dialect else mark_of(seen)
    base = profile(choices.dialect or (mark.dialect if mark else "common"))
    of, inches = scaled(seen, base, choices.unit)
    habit = _CHOSEN if choices.dialect else "because-profile"
    first, says_centers = _first_move(listing), _says(listing, _CENTERS, len(listing.blocks.line))
    assumed = []
    if not choices.dialect:
        assumed.append(Assumption("assumed-dialect", of.name, mark.why if mark else "because-none"))
    if len(seen.coordinates) and not choices.unit and not _says(listing, _UNIT, first):
        assumed.append(Assumption("assumed-unit", _unit(seen, of), inches or habit))
    if not _says(listing, _DISTANCE, first):
        assumed.append(Assumption("assumed-distance", _G[of.distance], habit))
    if not says_centers and (seen.has("I") or seen.has("J")):
        assumed.append(Assumption("assumed-centres", of.centers, habit))
    return Told(of, tuple(assumed), says_centers)


def assumption_findings(family: Told) -> list[Finding]:
    """Finding ISO112: how the text was read, where something of it was neither written nor chosen."""
    if all(assumption.why == _CHOSEN for assumption in family.assumptions):
        return []
    of = family.profile
    values = {"integer": amount(of.integer_um), "point": amount(of.point_um), "centers": f"centres-{of.centers}"}
    return [Finding("ISO112", {"dialect": of.name, "distance": _G[of.distance], **values})]


def _unit(seen: Seen, of: Profile) -> str:
    """The scale of the numbers that there are: integers, numbers with a point, or both."""
    taken = []
    if not seen.is_pointed.all():
        taken.append(f"1 = {amount(of.integer_um)}")
    if seen.is_pointed.any():
        taken.append(f"1. = {amount(of.point_um)}")
    return ", ".join(taken)


def _says(listing: Listing, numbers: tuple[float, ...], block: int) -> bool:
    """Whether one of some G words stands in or before a block."""
    word = listing.of("G")
    is_one = np.isin(listing.words.value[word], numbers)
    return bool((is_one & (listing.words.block[word] <= block)).any())


def _first_move(listing: Listing) -> int:
    """The first block with X or Y that is no G92; behind all blocks where there is none."""
    word = listing.words
    places = _blocks(listing, np.flatnonzero((word.letter == ord("X")) | (word.letter == ord("Y"))))
    named = _blocks(listing, np.flatnonzero((word.letter == ord("G")) & (word.value == 92.0)))
    moving = np.setdiff1d(places, named)
    return int(moving[0]) if len(moving) else len(listing.blocks.line)


def _blocks(listing: Listing, word: Ints) -> Ints:
    return np.unique(listing.words.block[word])
