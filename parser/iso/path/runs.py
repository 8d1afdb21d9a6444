"""A program as it runs: all columns of its blocks, in the order in which they do."""

from typing import NamedTuple

from parser.dialect.choices import Choices
from parser.geometry.curves import Bools
from parser.iso.path.flow import Flow, flow
from parser.iso.path.given import STOPS, Given
from parser.iso.path.modes import Modes, modes
from parser.iso.path.places import Coordinates, Places, coordinates, lost, places
from parser.iso.path.registers import Offsets, offsets
from parser.iso.path.rows import Rows, rows


class Run(NamedTuple):
    """What is known of the e running blocks.

    `is_lost` (e,) tells where places mean nothing, behind a block whose motion is not known; `offsets` are None where
    nothing compensates.
    """

    flow: Flow
    mode: Modes
    numbers: Coordinates
    place: Places
    rows: Rows
    is_lost: Bools
    offsets: Offsets | None


def run_of(given: Given, choices: Choices) -> Run:
    """The run of a listing."""
    order = flow(given)
    mode = modes(given, order.block)
    numbers = coordinates(given, order.block, mode)
    place = places(numbers, mode.is_absolute, given.m(*STOPS)[order.block])
    path = rows(mode, numbers, place, given.profile.resolution_um)
    compensates = mode.side[path.at].any()
    to_places = mode.is_absolute | mode.has_absolute_centers
    is_lost = to_places & lost(numbers, mode.is_absolute, given.listing.blocks.is_damaged[order.block])
    by_um = offsets(given, order.block, mode, choices) if compensates else None
    return Run(order, mode, numbers, place, path, is_lost, by_um)
