"""Registers: which offset is in force in each block as it runs, and how much it is (docs/iso.md §9).

A program as it runs: all columns of its blocks, in the order in which they do.
"""

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

from parser.dialect.reader import Choices
from parser.geometry.curves import Bools, Floats, Ints
from parser.iso.listing.listing import Assignment
from parser.iso.path.flow import STOPS, Flow, GivenColumns, flow
from parser.iso.path.places import Coordinates, Modes, Places, carried, coordinates, lost, modes, places
from parser.iso.path.rows import Rows, rows

_PAST_NUMBERS = 1 << 32  # no register has so large a number

Values = dict[str, list[tuple[int, float]]]
"""Of each register that is ever set: before which of the running blocks (−1: by option), and to how many µm."""


class Offsets(NamedTuple):
    """Registers in force, for each of e blocks as they run.

    Attributes
    ----------
    names
        Of all that are ever in force, without leading zeros, such as ``H1``; empty for none.
    name
        (e,) int64, which of them it is.
    by_um
        (e,) their values, NaN where they are not known.
    assumed
        The register that was taken where nothing selects one: the only one with a value; empty where it was not needed.
    lacking
        Registers without a value by which sums are not known, by the registers that are set to them.
    """

    names: tuple[str, ...]
    name: Ints
    by_um: Floats
    assumed: str
    lacking: Mapping[str, str]


def offsets(given: GivenColumns, runs: Ints, mode: Modes, choices: Choices) -> Offsets:
    """What is selected in the blocks `runs` (e,), and the value that it has by then."""
    values, lacking = _values(given, runs, mode, choices)
    number = _selected(given, runs)
    open_ = (number < 0) & (mode.side != 0)
    assumed = next(iter(values)) if len(values) == 1 and open_.any() else ""
    distinct, at = np.unique(number, return_inverse=True)
    names = [_name(each) if each >= 0 else assumed for each in distinct.tolist()]
    by = np.full(len(runs), np.nan)
    order = np.argsort(at, kind="stable")
    for name, own in zip(names, np.split(order, np.cumsum(np.bincount(at))[:-1]), strict=True):
        by[own] = _value(given, name, values, own)
    return Offsets(tuple(names), at, by, assumed, lacking)


def _selected(given: GivenColumns, runs: Ints) -> Ints:
    """(e,) the register in force as a number, its letter above its figures; −1 before the first."""
    words = given.listing.words
    selects = np.full(len(given.listing.blocks.line), -1, dtype=np.int64)
    for letter in given.profile.offset_letters:
        word = given.listing.of(letter)
        figures = np.clip(words.value[word], 0, _PAST_NUMBERS - 1).astype(np.int64)
        selects[words.block[word]] = ord(letter) * _PAST_NUMBERS + figures
    return carried(selects[runs], -1)


def _name(number: int) -> str:
    return f"{chr(number // _PAST_NUMBERS)}{number % _PAST_NUMBERS}"


def _value(given: GivenColumns, name: str, values: Values, rows: Ints) -> Floats | float:
    """(k,) what a register holds while the running blocks `rows` (k,), in order, run."""
    if given.profile.zero_register_is_off and name[1:] == "0":
        return 0.0
    when = np.array([set_before for set_before, _ in values.get(name, ())], dtype=np.int64)
    value = np.array([np.nan, *(um for _, um in values.get(name, ()))])
    in_force: Floats = value[np.searchsorted(when, rows, side="right")]
    return in_force


def _values(given: GivenColumns, runs: Ints, mode: Modes, choices: Choices) -> tuple[Values, dict[str, str]]:
    """All that registers are set to, in the order in which it happens; and what sums lack, as in `Offsets`."""
    values: Values = {name: [(-1, um)] for name, um in choices.registers}
    lacking: dict[str, str] = {}
    set_in: dict[int, list[Assignment]] = {}
    for assignment in given.listing.assignments:
        set_in.setdefault(assignment.block, []).append(assignment)
    for at in np.flatnonzero(np.isin(runs, list(set_in))).tolist():
        integer_um, point_um = _scales(given, mode, at)
        for assignment in set_in[int(runs[at])]:
            named = [term for term in assignment.terms if isinstance(term, str)]
            known = {name: values.get(name, [(-1, np.nan)])[-1][1] for name in named}
            terms = (
                known[term] if isinstance(term, str) else term[0] * (integer_um if term[1] < 0 else point_um)
                for term in assignment.terms
            )
            values.setdefault(assignment.register, []).append((at, round(sum(terms), 6)))
            for name in (name for name, um in known.items() if np.isnan(um)):
                lacking.setdefault(assignment.register, lacking.get(name, name))
    return values, lacking


def _scales(given: GivenColumns, mode: Modes, at: int) -> tuple[float, float]:
    """µm of register values without a point, and with one: those of the profile, in the unit of coordinates there."""
    profile = given.profile
    return (
        profile.register_integer_um * float(mode.integer_um[at]) / profile.integer_um,
        profile.register_point_um * float(mode.point_um[at]) / profile.point_um,
    )


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


def run_of(given: GivenColumns, choices: Choices) -> Run:
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
