"""Blocks in the order in which they run, to the toolpath: modes, places, arcs, jumps, stops, compensation."""

from typing import NamedTuple

from parser.dialect.reader import Choices
from parser.findings.findings import Finding
from parser.iso.listing import Listing
from parser.iso.profile import Profile
from parser.toolpath import Toolpath


class Moved(NamedTuple):
    """What the blocks of a listing move: the toolpath, and what is wrong with it."""

    toolpath: Toolpath
    findings: tuple[Finding, ...]


def moved(listing: Listing, profile: Profile, choices: Choices) -> Moved:
    """The toolpath of a listing."""
    raise NotImplementedError
