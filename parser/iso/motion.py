"""Blocks in the order in which they run, to the toolpath: modes, places, arcs, jumps, stops, compensation."""

from typing import NamedTuple

import numpy as np

from parser.dialect.reader import Choices
from parser.findings.findings import Finding
from parser.geometry.curves import Bools, CurveKind, Curves, Floats, Ints
from parser.iso.arcs import ROUNDING, Arcs, arcs_about, arcs_of_radius
from parser.iso.flow import run_order
from parser.iso.given import Given
from parser.iso.listing import Listing
from parser.iso.modes import Modes, modes
from parser.iso.places import Coordinates, Places, coordinates, places
from parser.iso.profile import Profile
from parser.text.source import Source
from parser.toolpath import Stop, Toolpath

_STOPS = ("stop", "thread", "cut")


class Moved(NamedTuple):
    """What the blocks of a listing move: the toolpath, and what is wrong with it."""

    toolpath: Toolpath
    findings: tuple[Finding, ...]


def moved(listing: Listing, profile: Profile, choices: Choices) -> Moved:
    """The toolpath of a listing."""
    given = Given(listing, profile)
    runs = run_order(given)
    mode = modes(given, runs)
    numbers = coordinates(given, runs, mode)
    stops = given.m(*_STOPS)[runs]
    place = places(given, runs, mode, numbers, _is_threaded(given, runs, mode, numbers, stops))
    row = np.flatnonzero(place.moves | (place.is_named & (place.start_um != place.end_um).any(axis=1)))
    curves = _curves(mode, numbers, place, row, profile.resolution_um)
    toolpath = Toolpath(
        **{name: getattr(curves, name) for name in Curves.__slots__},
        printed_end_um=np.full((len(row), 2), np.nan),
        words=None,
        source=_source(given, runs[row]),
        stops=_stops(given, runs, row),
    )
    return Moved(toolpath, ())


def _is_threaded(given: Given, runs: Ints, mode: Modes, numbers: Coordinates, stops: Bools) -> Bools:
    """(e,) whether a stop stands between a block and the last one with coordinates before it."""
    moves = ~np.isnan(numbers.end).all(axis=1)
    at = np.arange(len(runs))
    last_stop = np.maximum.accumulate(np.where(stops, at, -1))
    last_move = np.maximum.accumulate(np.where(moves, at, -1))
    before = np.concatenate([[-1], last_move[:-1]])
    return (last_stop >= 0) & (last_stop >= before)


def _curves(mode: Modes, numbers: Coordinates, place: Places, row: Ints, resolution_um: float) -> Curves:
    start, end = place.start_um[row], place.end_um[row]
    motion = np.where(place.moves[row], mode.motion[row], 0)
    kind = np.where(motion == 0, CurveKind.JUMP, CurveKind.LINE).astype(np.int64)
    length = np.hypot(*(end - start).T)
    center, radius, angle = np.full((len(row), 2), np.nan), np.full(len(row), np.nan), np.full(len(row), np.nan)
    sweep = np.zeros(len(row))
    turning = np.flatnonzero(motion >= 2)
    arcs = _arcs(mode, numbers, place, row[turning], resolution_um)
    round_ = arcs.sweep_rad != 0
    turning = turning[round_]
    kind[turning] = CurveKind.ARC
    center[turning], radius[turning] = arcs.center_um[round_], arcs.radius_um[round_]
    sweep[turning] = arcs.sweep_rad[round_]
    out = start[turning] - center[turning]
    angle[turning] = np.arctan2(out[:, 1], out[:, 0])
    length[turning] = radius[turning] * np.abs(sweep[turning])
    return Curves(kind, start, end, center, radius, angle, sweep, length)


def _arcs(mode: Modes, numbers: Coordinates, place: Places, row: Ints, resolution_um: float) -> Arcs:
    start, end = place.start_um[row], place.end_um[row]
    turn = np.where(mode.motion[row] == 3, 1.0, -1.0)
    origin = np.where(mode.has_absolute_centers[row, None], place.shift_um[row], start)
    about = arcs_about(start, end, origin + np.nan_to_num(numbers.center[row]), turn)
    radius = numbers.radius[row]
    by_radius = ~np.isnan(radius)
    if not by_radius.any():
        return about
    of_radius = arcs_of_radius(start, end, np.nan_to_num(radius), turn, ROUNDING * resolution_um)
    return Arcs(*(_chosen(by_radius, one, other) for one, other in zip(of_radius, about, strict=True)))


def _chosen(choice: Bools, one: Floats, other: Floats) -> Floats:
    return np.where(choice if one.ndim == 1 else choice[:, None], one, other)


def _source(given: Given, block: Ints) -> Source:
    blocks = given.listing.blocks
    number = given.word("N")[block]
    label = tuple(f"N{int(value)}" if has else "" for value, has in _numbers(given, number))
    return Source(
        given.listing.text,
        np.arange(1, len(block) + 1),
        np.column_stack([blocks.first[block], blocks.past[block]]),
        blocks.line[block],
        label,
    )


def _numbers(given: Given, word: Ints) -> list[tuple[float, bool]]:
    value = given.listing.words.value[word] if len(given.listing.words.value) else np.zeros(len(word))
    return list(zip(value.tolist(), (word >= 0).tolist(), strict=True))


def _stops(given: Given, runs: Ints, row: Ints) -> tuple[Stop, ...]:
    line = given.listing.blocks.line[runs]
    ends = given.m("end")[runs]
    at = np.flatnonzero(given.m(*_STOPS)[runs] | ends)
    after = np.searchsorted(row, at, side="right")
    return tuple(
        Stop("end" if ends[one] else "pause", int(rows), int(line[one]))
        for one, rows in zip(at.tolist(), after.tolist(), strict=True)
    )
