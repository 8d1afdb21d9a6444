"""Blocks in the order in which they run, to the toolpath: modes, places, arcs, jumps, stops, compensation."""

from typing import NamedTuple

import numpy as np

from parser.dialect.reader import Assumption, Choices, Damage
from parser.findings.findings import Finding
from parser.geometry.curves import Curves, Floats, Ints
from parser.iso.arc_checks import arc_findings
from parser.iso.centers import Agreement, agreement
from parser.iso.flow import Flow, flow
from parser.iso.given import Given
from parser.iso.listing import Listing
from parser.iso.modes import Modes, modes
from parser.iso.move_checks import move_findings
from parser.iso.order_checks import order_findings
from parser.iso.places import Coordinates, Places, coordinates, places
from parser.iso.profile import Profile
from parser.iso.registers import Offsets, offsets
from parser.iso.rows import Rows, rows, source
from parser.toolpath import Compensation, CompensationRules, Stop, Toolpath

STOPS = ("stop", "thread", "cut")
"""What M words do behind which the wire may be threaded elsewhere."""


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
    first_row
        (b,) int64, the row that each block of the text makes when it first runs; −1 where it makes none.
    agreement
        What the arcs say of I J.
    """

    toolpath: Toolpath
    findings: tuple[Finding, ...]
    damages: tuple[Damage, ...]
    assumptions: tuple[Assumption, ...]
    first_row: Ints
    agreement: Agreement


class _Run(NamedTuple):
    """All columns of the running blocks; `offsets` are None where nothing compensates."""

    flow: Flow
    mode: Modes
    numbers: Coordinates
    place: Places
    rows: Rows
    offsets: Offsets | None


def moved(listing: Listing, profile: Profile, choices: Choices) -> Moved:
    """The toolpath of a listing."""
    given = Given(listing, profile)
    run = _run(given, choices)
    arcs = agreement(run.mode, run.numbers, run.place, run.rows)
    centred = () if arcs.is_otherwise else arc_findings(given, run.flow.block, run.numbers, run.rows)
    findings = (
        *order_findings(given, run.flow, run.mode.side, run.place, run.rows.at),
        *move_findings(given, run.flow.block, run.mode, run.rows),
        *centred,  # of arcs that are read the wrong way nothing is said but that
    )
    return Moved(
        toolpath=_toolpath(given, run),
        findings=findings,
        damages=_damages(given, run),
        assumptions=_assumptions(given, run),
        first_row=_first_rows(given, run),
        agreement=arcs,
    )


def _run(given: Given, choices: Choices) -> _Run:
    order = flow(given)
    mode = modes(given, order.block)
    numbers = coordinates(given, order.block, mode)
    place = places(numbers, mode.is_absolute, given.m(*STOPS)[order.block])
    path = rows(mode, numbers, place, given.profile.resolution_um)
    compensates = mode.side[path.at].any()
    return _Run(order, mode, numbers, place, path, offsets(given, order.block, mode, choices) if compensates else None)


def _toolpath(given: Given, run: _Run) -> Toolpath:
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


def _compensation(run: _Run, rules: CompensationRules) -> Compensation | None:
    if run.offsets is None:
        return None
    at = run.rows.at
    side = run.mode.side[at]
    by_um = np.where(side != 0, run.offsets.by_um[at], 0.0)
    return Compensation(side, by_um, tuple(map(run.offsets.names.__getitem__, run.offsets.name[at].tolist())), rules)


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


def _damages(given: Given, run: _Run) -> tuple[Damage, ...]:
    """Pieces that could not be read in blocks that run, calls and arcs that could not be made, in file order."""
    blocks = given.listing.blocks
    lost = [one.span for one in given.listing.unread]
    lost += [(int(blocks.first[one.block]), int(blocks.past[one.block])) for one in run.flow.faults]
    straight = run.flow.block[run.rows.at[run.rows.turning[run.rows.arcs.sweep_rad == 0]]]
    lost += [(int(blocks.first[one]), int(blocks.past[one])) for one in np.unique(straight).tolist()]
    if not lost:
        return ()
    before = _rows_before(run, len(blocks.line))
    behind = np.searchsorted(blocks.past, [first for first, _ in lost], side="right")
    after = before[behind]
    return tuple(sorted(Damage(span, int(rows)) for span, rows in zip(lost, after, strict=True) if rows >= 0))


def _rows_before(run: _Run, count: int) -> Ints:
    """(count + 1,) rows before each block first runs; −1 where it never does, all rows behind the last block."""
    before = np.full(count + 1, -1, dtype=np.int64)
    backwards = run.flow.block[::-1]
    before[backwards] = np.searchsorted(run.rows.at, np.arange(len(backwards))[::-1])
    before[count] = len(run.rows.at)
    return before


def _first_rows(given: Given, run: _Run) -> Ints:
    first = np.full(len(given.listing.blocks.line), -1, dtype=np.int64)
    first[run.flow.block[run.rows.at[::-1]]] = np.arange(len(run.rows.at))[::-1]
    return first


def _assumptions(given: Given, run: _Run) -> tuple[Assumption, ...]:
    told = []
    if given.listing.blocks.is_skipped[run.flow.block].any():
        told.append(Assumption("assumed-skips", "/", "because-skips-run"))
    if run.offsets and run.offsets.assumed:
        told.append(Assumption("assumed-register", run.offsets.assumed, "because-only-register"))
    if run.place.is_threaded.any():
        told.append(Assumption("assumed-threading", "G92", "because-behind-stop"))
    if _starts_unnamed(run):
        told.append(Assumption("assumed-start", "X0 Y0", "because-no-start"))
    return tuple(told)


def _starts_unnamed(run: _Run) -> bool:
    """Whether the first motion goes to a place, cutting, from one that nothing names."""
    first = run.rows.at[:1]
    named = run.numbers.names[: first[0]].any() if len(first) else True
    return bool(not named and run.mode.is_absolute[first].any() and run.mode.motion[first].any())
