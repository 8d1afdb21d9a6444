"""Blocks in the order in which they run, to the toolpath: modes, places, arcs, jumps, stops, compensation.

Checks of coordinates: ways of no length, and numbers finer than the machine's steps (docs/iso.md §5).

What is in doubt of a path: blocks whose motion is not known, and what the text leaves open of where it goes.
"""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from parser.controller_words import Compensation, CompensationRules
from parser.dialect.reader import Assumption, Choices, Damage
from parser.findings.findings import Finding, Stands
from parser.geometry.curves import Bools, CurveKind, Curves, Floats, Ints
from parser.geometry.near import distinct
from parser.iso.listing.listing import Form, Listing
from parser.iso.path.arcs import Agreement, agreement, arc_findings
from parser.iso.path.flow import STOPS, GivenColumns
from parser.iso.path.order_checks import order_findings
from parser.iso.path.places import Modes, bare_place
from parser.iso.path.registers import Run, run_of
from parser.iso.path.rows import ROUNDING, Rows, source
from parser.iso.path.taper import ProgrammedLean, lean_of
from parser.iso.profiles.profile import Profile
from parser.text.source import Span
from parser.toolpath import Stop, Toolpath

_MOST_CALLS = 3
"""Calls that are told with their labels; of more the first ones."""


def damages(given: GivenColumns, run: Run) -> tuple[Damage, ...]:
    """Pieces that could not be read in blocks that run, calls and moves that could not be made, in file order."""
    blocks = given.listing.blocks
    lost = [*(each.span for each in given.listing.unread), *_macros_that_move(given.listing)]
    lost += [(int(blocks.first[fault.block]), int(blocks.past[fault.block])) for fault in run.flow.faults]
    straight = run.rows.at[run.rows.turning[run.rows.arcs.sweep_rad == 0]]
    unmoved = run.flow.block[np.concatenate([straight, np.flatnonzero(run.numbers.lacks_motion)])]
    lost += [(int(blocks.first[each]), int(blocks.past[each])) for each in sorted(set(unmoved.tolist()))]
    if not lost:
        return ()
    before = _rows_before(run, len(blocks.line))
    behind = np.searchsorted(blocks.past, [first for first, _ in lost], side="right")
    after = before[behind]
    return tuple(sorted(Damage(span, int(rows)) for span, rows in zip(lost, after, strict=True) if rows >= 0))


def _macros_that_move(listing: Listing) -> Iterator[Span]:
    """Places of macros but those that only set a variable: they move the wire, or choose which blocks run."""
    for statement in listing.statements:
        if statement.form is Form.MACRO and listing.text[statement.span[0]] != "#":
            yield statement.span


def _rows_before(run: Run, count: int) -> Ints:
    """(count + 1,) rows before each block first runs; −1 where it never does, all rows behind the last block."""
    before = np.full(count + 1, -1, dtype=np.int64)
    backwards = run.flow.block[::-1]
    before[backwards] = np.searchsorted(run.rows.at, np.arange(len(backwards))[::-1])
    before[count] = len(run.rows.at)
    return before


def assumptions(given: GivenColumns, run: Run) -> tuple[Assumption, ...]:
    """What was taken where the text leaves it open."""
    assumed = [*_call_targets(given, run)]
    if given.listing.blocks.is_skipped[run.flow.block].any():
        assumed.append(Assumption("assumed-skips", "/", "because-skips-run"))
    if run.offsets and run.offsets.assumed:
        assumed.append(Assumption("assumed-register", run.offsets.assumed, "because-only-register"))
    if run.place.is_threaded.any():
        assumed.append(Assumption("assumed-threading", _text(given, run, run.place.is_threaded), "because-behind-stop"))
    is_bare = bare_place(given)[run.flow.block]
    if is_bare.any():
        assumed.append(Assumption("assumed-place", "X0 Y0", "because-bare"))
    if _starts_unnamed(run):
        assumed.append(Assumption("assumed-start", "X0 Y0", "because-no-start"))
    return tuple(assumed)


def _call_targets(given: GivenColumns, run: Run) -> Iterator[Assumption]:
    """Which label each call was taken to name: families name programs or blocks."""
    listing = given.listing
    calls = [f"{listing.written(call.name)} → {listing.written(call.label)}" for call in run.flow.calls]
    targets = list(dict.fromkeys(calls))
    if targets:
        more = ", …" if len(targets) > _MOST_CALLS else ""
        why = "because-calls-programs" if given.profile.calls[0] == "program" else "because-calls-labels"
        yield Assumption("assumed-calls", ", ".join(targets[:_MOST_CALLS]) + more, why)


def _text(given: GivenColumns, run: Run, chosen: Bools) -> str:
    """The first of some running blocks as written."""
    block = run.flow.block[int(np.argmax(chosen))]
    blocks = given.listing.blocks
    return given.listing.text[int(blocks.first[block]) : int(blocks.past[block])]


def _starts_unnamed(run: Run) -> bool:
    """Whether the first motion goes to a place, cutting, from one that nothing names."""
    first = run.rows.at[:1]
    named = run.numbers.names[: first[0]].any() if len(first) else True
    return bool(not named and run.mode.is_absolute[first].any() and run.mode.motion[first].any())


_HAIR = 1e-6  # of a step
_MOVING = "XYIJR"


def move_findings(given: GivenColumns, runs: Ints, mode: Modes, lacks_motion: Bools, path: Rows) -> Iterator[Finding]:
    """What is wrong with the coordinates of the running blocks `runs` (e,); a block that runs often is told once."""
    yield from _without_motion(given, runs, lacks_motion)
    yield from _no_length(given, runs, mode, path)
    yield from _finer_than_steps(given, runs, mode)


def _without_motion(given: GivenColumns, runs: Ints, lacks_motion: Bools) -> Iterator[Finding]:
    """ISO110 at each block that runs with numbers to move by before any motion word did, at the first of these."""
    listing = given.listing
    blocks = distinct(runs[lacks_motion])
    word = listing.of_any(_MOVING)
    first = word[np.searchsorted(listing.words.block[word], blocks)]
    for each in first.tolist():
        span = (int(listing.words.first[each]), int(listing.words.past[each]))
        yield listing.lines.finding("ISO110", span, text=listing.text[slice(*span)], what="no-motion-yet")


def _no_length(given: GivenColumns, runs: Ints, mode: Modes, path: Rows) -> Iterator[Finding]:
    """ISO218: lines told to cut that end where they start, but for those that meet the wire where it is threaded."""
    still = (path.curves.kind == CurveKind.LINE) & (path.curves.length_um == 0) & (mode.motion[path.at] == 1)
    row = np.flatnonzero(still)
    row = row[~_at_stop(given, runs, path, row)]
    _, first = np.unique(runs[path.at[row]], return_index=True)
    blocks, lines = given.listing.blocks, given.listing.lines
    for each in row[first].tolist():
        block = int(runs[path.at[each]])
        span = int(blocks.first[block]), int(blocks.past[block])
        yield lines.finding("ISO218", span, each + 1).with_fact(Stands())


def _at_stop(given: GivenColumns, runs: Ints, path: Rows, row: Ints) -> Bools:
    """(k,) whether a stop stands between the motion before and the motion behind some rows (k,) that do not move."""
    moving = path.at[path.curves.length_um > 0]
    stops = np.concatenate([[0], np.cumsum(given.m(*STOPS)[runs])])
    around = np.searchsorted(moving, path.at[row])
    first, last = np.concatenate([[0], moving])[around], np.concatenate([moving, [len(runs)]])[around]
    some: Bools = stops[last] > stops[first]
    return some


def _finer_than_steps(given: GivenColumns, runs: Ints, mode: Modes) -> Iterator[Finding]:
    """ISO207, at the first of these numbers: one that is no whole step of the machine."""
    words = given.listing.words
    scale = np.full(len(given.listing.blocks.line), np.nan)
    scale[runs] = mode.point_um
    coordinate = np.isin(words.letter, [ord(letter) for letter in _MOVING]) & (words.decimals > 0)
    word = np.flatnonzero(coordinate)
    um = words.value[word] * scale[words.block[word]]
    steps = um / given.profile.step_um
    between = np.flatnonzero(np.abs(steps - np.rint(steps)) > _HAIR * np.maximum(1.0, np.abs(steps) * _HAIR))
    if len(between):
        first = int(word[between[0]])
        span = (int(words.first[first]), int(words.past[first]))
        yield given.listing.lines.finding(
            "ISO207",
            span,
            text=given.listing.text[slice(*span)],
            um=float(um[between[0]]),
            step=given.profile.step_um,
            more=len(between) - 1,
        )


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
    lean_is_known
        Whether the wire is known in each plane.
    """

    toolpath: Toolpath
    findings: tuple[Finding, ...]
    damages: tuple[Damage, ...]
    assumptions: tuple[Assumption, ...]
    threadings: int
    first_row: Ints
    agreement: Agreement
    lean_is_known: bool


def moved(listing: Listing, profile: Profile, choices: Choices) -> Moved:
    """The toolpath of a listing."""
    given = GivenColumns(listing, profile)
    run = run_of(given, choices)
    arcs = agreement(run.mode, run.numbers, run.place, run.rows, ROUNDING * given.profile.resolution_um)
    centred = () if arcs.is_otherwise else arc_findings(given, run)
    findings = (
        *order_findings(given, run.flow, run.mode.side, run.place, run.rows.at),
        *move_findings(given, run.flow.block, run.mode, run.numbers.lacks_motion, run.rows),
        *centred,  # of arcs that are read the wrong way nothing is said but that
    )
    lean = lean_of(given, run)
    return Moved(
        toolpath=_toolpath(given, run, lean),
        findings=findings,
        damages=damages(given, run),
        assumptions=assumptions(given, run),
        threadings=int((~run.numbers.moves[run.rows.at]).sum()),
        first_row=_first_rows(given, run),
        agreement=arcs,
        lean_is_known=lean.is_known,
    )


def _toolpath(given: GivenColumns, run: Run, lean: ProgrammedLean) -> Toolpath:
    curves = run.rows.curves
    return Toolpath(
        **{name: getattr(curves, name) for name in Curves.__slots__},
        printed_end_um=np.full((len(curves), 2), np.nan),
        words=None,
        source=source(given, run.flow.block[run.rows.at]),
        stops=_stops(given, run.flow.block, run.rows.at),
        compensation=_compensation(run, given.profile.rules),
        told_center_um=_told_centers(run.rows),
        taper=lean.taper,
        upper=lean.upper,
    )


def _told_centers(rows: Rows) -> Floats:
    """(n, 2) centres of arcs as written, NaN where none is."""
    center = np.full((len(rows.at), 2), np.nan)
    center[rows.turning] = rows.arcs.told_um
    return center


def _compensation(run: Run, rules: CompensationRules) -> Compensation | None:
    if run.offsets is None:
        return None
    at = run.rows.at
    side = run.mode.side[at]
    by_um = np.where(side != 0, run.offsets.by_um[at], 0.0)
    names = tuple(map(run.offsets.names.__getitem__, run.offsets.name[at].tolist()))
    return Compensation(side, by_um, names, rules, run.offsets.lacking)


def _stops(given: GivenColumns, runs: Ints, at: Ints) -> tuple[Stop, ...]:
    """Stops and ends; words that stop count behind the motion of their block."""
    line = given.listing.blocks.line
    ends = given.m("end")
    stops = np.flatnonzero((given.m(*STOPS) | ends)[runs])
    after = np.searchsorted(at, stops, side="right")
    return tuple(
        Stop("end" if ends[block] else "pause", rows_before, int(line[block]))
        for block, rows_before in zip(runs[stops].tolist(), after.tolist(), strict=True)
    )


def _first_rows(given: GivenColumns, run: Run) -> Ints:
    first = np.full(len(given.listing.blocks.line), -1, dtype=np.int64)
    first[run.flow.block[run.rows.at[::-1]]] = np.arange(len(run.rows.at))[::-1]
    return first
