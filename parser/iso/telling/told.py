"""Which family a listing was written for, and all that had to be assumed of scale and modes (docs/iso.md §4, §6)."""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from parser.dialect.choices import Choices
from parser.dialect.reader import Assumption
from parser.iso.listing.listing import Listing
from parser.iso.path.centers import Agreement
from parser.iso.profiles.profile import Profile, profile
from parser.iso.telling.marks import Seen, mark_of
from parser.iso.telling.scale import amount, scaled

_G = {"absolute": "G90", "incremental": "G91"}
_ASSUMED_CENTERS, _ASSUMED_DISTANCE = "assumed-centres", "assumed-distance"
_CHOSEN = "because-chosen"
_DISTANCE, _CENTERS, _INCH, _METRIC = (90.0, 91.0), (90.1, 91.1), (20.0, 70.0), (21.0, 71.0)
_INCH_WORDS = ("G20", "G70")


class Told(NamedTuple):
    """The profile that a listing is read by, its scale and modes those that were taken; and what was assumed.

    Attributes
    ----------
    profile
        Of the family.
    assumptions
        What the text leaves open, in the order in which it is told; also what was chosen in its place.
    seen
        What stands in the listing.
    distance
        ``G90`` or ``G91``, in force at the first motion.
    says_centers, says_unit
        Whether the text itself says what I and J are, and its unit; or the unit was named for it.
    """

    profile: Profile
    assumptions: tuple[Assumption, ...]
    seen: Seen
    distance: str
    says_centers: bool
    says_unit: bool

    @property
    def is_chosen(self) -> bool:
        """Whether the family was named, not told by marks."""
        return all(assumption.what != "assumed-dialect" for assumption in self.assumptions)

    @property
    def is_settled(self) -> bool:
        """Whether all of it was written or chosen."""
        return all(assumption.why == _CHOSEN for assumption in self.assumptions)


def told(listing: Listing, choices: Choices) -> Told:
    """The profile of a listing: as chosen, or by its marks; ``common`` where nothing tells."""
    seen = Seen(listing)
    mark = None if choices.dialect else mark_of(seen)
    base = profile(choices.dialect or (mark.dialect if mark else "common"))
    first = _first_move(listing)
    unit_word = _said(listing, (*_INCH, *_METRIC), seen.first_length)
    if unit_word:
        base = replace(base, may_be_inch=False)
    of, inches = scaled(seen, base, choices.unit or ("inch" if unit_word in _INCH_WORDS else ""))
    habit = _CHOSEN if choices.dialect else "because-profile"
    distance = _said(listing, _DISTANCE, first)
    says_centers = bool(_said(listing, _CENTERS, len(listing.blocks.line)))
    says_unit = bool(choices.unit or (unit_word and seen.is_pointed.all()))  # what integers are, no word says
    assumed = []
    if not choices.dialect:
        assumed.append(Assumption("assumed-dialect", of.name, mark.why if mark else "because-none"))
    if len(seen.coordinates) and not says_unit:
        assumed.append(Assumption("assumed-unit", _unit(seen, of), inches or habit))
    if not distance:
        assumed.append(Assumption(_ASSUMED_DISTANCE, _G[of.distance], habit))
    if not says_centers and (seen.has("I") or seen.has("J")):
        assumed.append(Assumption(_ASSUMED_CENTERS, of.centers, habit))
    return Told(of, tuple(assumed), seen, distance or _G[of.distance], says_centers, says_unit)


def in_other_distance(family: Told) -> Told | None:
    """The family with the other of G90 and G91 at the start, as arcs tell it; None where it was written or chosen."""
    if family.is_chosen or all(one.what != _ASSUMED_DISTANCE for one in family.assumptions):
        return None
    of = replace(family.profile, distance="incremental" if family.profile.distance == "absolute" else "absolute")
    assumptions = tuple(
        Assumption(one.what, _G[of.distance], "because-arcs") if one.what == _ASSUMED_DISTANCE else one
        for one in family.assumptions
    )
    return family._replace(profile=of, assumptions=assumptions, distance=_G[of.distance])


def reread(family: Told, arcs: Agreement) -> Told:
    """The family with the reading of I J in which the arcs agree, where it was neither written nor chosen."""
    of, why = family.profile, arcs.why
    if arcs.is_otherwise:
        if family.is_chosen or family.says_centers:
            return family
        of = replace(of, centers="from-start" if of.centers == "absolute" else "absolute")
        why = "because-arcs"
    assumptions = tuple(
        Assumption(one.what, of.centers, why) if one.what == _ASSUMED_CENTERS and why else one
        for one in family.assumptions
    )
    return family._replace(profile=of, assumptions=assumptions)


def _unit(seen: Seen, of: Profile) -> str:
    """The scale of the numbers that there are: integers, numbers with a point, or both."""
    taken = []
    if not seen.is_pointed.all():
        taken.append(f"1 = {amount(of.integer_um)}")
    if seen.is_pointed.any():
        taken.append(f"1. = {amount(of.point_um)}")
    return ", ".join(taken)


def _said(listing: Listing, numbers: tuple[float, ...], block: int) -> str:
    """The last of some G words that stands in or before a block, ``G90``; empty where there is none."""
    word = listing.of("G")
    value = listing.words.value[word]
    said = value[np.isin(value, numbers) & (listing.words.block[word] <= block)]
    return f"G{said[-1]:g}" if len(said) else ""


def _first_move(listing: Listing) -> int:
    """The first block with X or Y that is no G92; behind all blocks where there is none."""
    letter, value = listing.words.letter, listing.words.value
    places = listing.blocks_of(np.flatnonzero((letter == ord("X")) | (letter == ord("Y"))))
    named = listing.blocks_of(np.flatnonzero((letter == ord("G")) & (value == 92.0)))
    moving = np.flatnonzero(places & ~named)
    return int(moving[0]) if len(moving) else len(listing.blocks.line)
