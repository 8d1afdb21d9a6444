"""Which family a listing was written for, told by its marks; and all that had to be assumed."""

from typing import NamedTuple

from parser.dialect.reader import Assumption, Choices
from parser.iso.listing import Listing
from parser.iso.profile import Profile, profile


class Told(NamedTuple):
    """The profile that a listing is read by, its scale and modes those that were taken; and what was assumed."""

    profile: Profile
    assumptions: tuple[Assumption, ...]


def told(listing: Listing, choices: Choices) -> Told:
    """The profile of a listing: as chosen, or by its marks."""
    return Told(profile(choices.dialect or "common"), ())
