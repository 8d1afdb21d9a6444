"""Blocks in the order in which they run, to the toolpath: modes, places, arcs, jumps, stops, compensation."""

from typing import NamedTuple

import numpy as np

from parser.dialect.choices import Choices
from parser.dialect.reader import Assumption, Damage
from parser.findings.findings import Finding
from parser.geometry.curves import Curves, Floats, Ints
from parser.iso.listing.listing import Listing
from parser.iso.path.arc_checks import arc_findings
from parser.iso.path.arcs import ROUNDING
from parser.iso.path.centers import Agreement, agreement
from parser.iso.path.doubts import assumptions, damages
from parser.iso.path.given import STOPS, Given
from parser.iso.path.move_checks import move_findings
from parser.iso.path.order_checks import order_findings
from parser.iso.path.rows import Rows, source
from parser.iso.path.runs import Run, run_of
from parser.iso.profiles.profile import Profile
from parser.told.compensation import Compensation, CompensationRules
from parser.toolpath import Stop, Toolpath


class Moved(NamedTuple):
    """What the blocks of a listing move.

    Attributes
    ----------
    toolpath
        The path, in the order in which blocks run.
    findings
        What is wrong with it.
    damages
        Blocks whose motion is not known, and calls that cannot be followed.
    assumptions
        What the text leaves open of where the wire goes.
    threadings
        How many jumps of the path are no motion: the wire is threaded elsewhere.
    first_row
        (b,) int64, the row that each block of the text makes when it first runs; −1 where it makes none.
    agreement
        What the arcs say of I J.
    """

    toolpath: Toolpath
    findings: tuple[Finding, ...]
    damages: tuple[Damage, ...]
    assumptions: tuple[Assumption, ...]
    threadings: int
    first_row: Ints
    agreement: Agreement


def moved(listing: Listing, profile: Profile, choices: Choices) -> Moved:
    """The toolpath of a listing."""
    given = Given(listing, profile)
    run = run_of(given, choices)
    arcs = agreement(run.mode, run.numbers, run.place, run.rows, ROUNDING * given.profile.resolution_um)
    centred = () if arcs.is_otherwise else arc_findings(given, run)
    findings = (
        *order_findings(given, run.flow, run.mode.side, run.place, run.rows.at),
        *move_findings(given, run.flow.block, run.mode, run.numbers.lacks_motion, run.rows),
        *centred,  # of arcs that are read the wrong way nothing is said but that
    )
    return Moved(
        toolpath=_toolpath(given, run),
        findings=findings,
        damages=damages(given, run),
        assumptions=assumptions(given, run),
        threadings=int((~run.numbers.moves[run.rows.at]).sum()),
        first_row=_first_rows(given, run),
        agreement=arcs,
    )


def _toolpath(given: Given, run: Run) -> Toolpath:
    curves = run.rows.curves
    return Toolpath(
        **{name: getattr(curves, name) for name in Curves.__slots__},
        printed_end_um=np.full((len(curves), 2), np.nan),
        words=None,
        source=source(given, run.flow.block[run.rows.at]),
        stops=_stops(given, run.flow.block, run.rows.at),
        compensation=_compensation(run, given.profile.rules),
        told_center_um=_told_centers(run.rows),
    )


def _told_centers(rows: Rows) -> Floats:
    """(n, 2) centres of arcs as written, NaN where none is."""
    told = np.full((len(rows.at), 2), np.nan)
    told[rows.turning] = rows.arcs.told_um
    return told


def _compensation(run: Run, rules: CompensationRules) -> Compensation | None:
    if run.offsets is None:
        return None
    at = run.rows.at
    side = run.mode.side[at]
    by_um = np.where(side != 0, run.offsets.by_um[at], 0.0)
    names = tuple(map(run.offsets.names.__getitem__, run.offsets.name[at].tolist()))
    return Compensation(side, by_um, names, rules, run.offsets.lacking)


def _stops(given: Given, runs: Ints, at: Ints) -> tuple[Stop, ...]:
    """Stops and ends; words that stop count behind the motion of their block."""
    line = given.listing.blocks.line
    ends = given.m("end")
    stops = np.flatnonzero((given.m(*STOPS) | ends)[runs])
    after = np.searchsorted(at, stops, side="right")
    return tuple(
        Stop("end" if ends[block] else "pause", rows_before, int(line[block]))
        for block, rows_before in zip(runs[stops].tolist(), after.tolist(), strict=True)
    )


def _first_rows(given: Given, run: Run) -> Ints:
    first = np.full(len(given.listing.blocks.line), -1, dtype=np.int64)
    first[run.flow.block[run.rows.at[::-1]]] = np.arange(len(run.rows.at))[::-1]
    return first
