"""Checks of arcs: what makes one, radii at both ends, full circles (docs/iso.md §5)."""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from parser.findings.codes import Severity
from parser.findings.findings import Finding, Value
from parser.geometry.curves import Bools, Floats, Ints
from parser.iso.path.arcs import ROUNDING, Arcs
from parser.iso.path.given import Given
from parser.iso.path.rows import Rows
from parser.iso.path.runs import Run

GRAVE_UM = 20.0
"""Radii that differ by more are an error, and no rounding of any file."""

_AXES = "XY"
_HAIR_UM = 1e-6  # rounding of sums of decimals
_TINY_STEPS = 2.0


class _Told(NamedTuple):
    """Blocks told to be arcs, k of them, each the first time it runs; (k,) but for the last.

    `row` is that of the toolpath, `missing` how many of I J are not given. `is_lost` tells where nobody knows where the
    arc begins or ends. `slack_um` is what the rounding of the file explains.
    """

    given: Given
    path: Rows
    row: Ints
    block: Ints
    arcs: Arcs
    by_radius: Bools
    missing: Ints
    lacks_center: Bools
    has_end: Bools
    is_lost: Bools
    slack_um: float


def arc_findings(given: Given, run: Run) -> Iterator[Finding]:
    """What is wrong with the arcs of a run; a block that runs often is told once."""
    if not len(run.rows.turning):
        return
    told = _told(given, run)
    centred = ~told.by_radius & ~told.lacks_center
    yield from _without_center(told)
    yield from _without_radius(told, centred)
    known = centred & ~told.is_lost
    yield from _beside_circle(told, known & (told.arcs.written_um > 0))
    yield from _by_radius(told)
    yield from _too_full(told, known)


def _told(given: Given, run: Run) -> _Told:
    runs, numbers, path = run.flow.block, run.numbers, run.rows
    block, first = np.unique(runs[path.at[path.turning]], return_index=True)
    first = first[~given.contradicts("motion")[block]]  # such a block is told to be no arc as well
    row = path.turning[first]
    at = path.at[row]
    return _Told(
        given=given,
        path=path,
        row=row,
        block=runs[at],
        arcs=Arcs(*(column[first] for column in path.arcs)),
        by_radius=~np.isnan(numbers.radius[at]),
        missing=np.isnan(numbers.center[at]).sum(axis=1),
        lacks_center=path.lacks_center[first],
        has_end=np.isnan(numbers.end[at]).sum(axis=1) < len(_AXES),
        is_lost=run.is_lost[at],
        slack_um=ROUNDING * given.profile.resolution_um + _HAIR_UM,
    )


def _without_center(told: _Told) -> Iterator[Finding]:
    """ISO210."""
    for one in np.flatnonzero(told.lacks_center).tolist():
        what = "arc-one-center" if told.missing[one] == 1 else "arc-no-center"
        yield _at(told, "ISO210", one, "", what=what)


def _without_radius(told: _Told, centred: Bools) -> Iterator[Finding]:
    """ISO211."""
    for one in np.flatnonzero((centred | told.by_radius) & (told.arcs.written_um == 0)).tolist():
        yield _at(told, "ISO211", one, "IJR")


def _beside_circle(told: _Told, centred: Bools) -> Iterator[Finding]:
    """ISO212, an error beyond what any rounding explains."""
    off = np.abs(told.arcs.differ_um)
    for one in np.flatnonzero(centred & (off > told.slack_um)).tolist():
        at_start, by = float(told.arcs.written_um[one]), float(told.arcs.differ_um[one])
        found = _at(told, "ISO212", one, "IJ", start=at_start, end=at_start + by, off=abs(by), limit=told.slack_um)
        yield found._replace(graver=Severity.ERROR if abs(by) > GRAVE_UM else None)


def _by_radius(told: _Told) -> Iterator[Finding]:
    """ISO213 and ISO214."""
    chord, radius = told.arcs.chord_um, told.arcs.written_um
    by_radius = told.by_radius & (radius > 0) & ~told.is_lost
    for one in np.flatnonzero(by_radius & (chord == 0)).tolist():
        yield _at(told, "ISO214", one, "R", radius=float(radius[one]))
    for one in np.flatnonzero(by_radius & (chord > 0) & (told.arcs.sweep_rad == 0)).tolist():
        yield _at(told, "ISO213", one, "R", chord=float(chord[one]), reach=2 * float(radius[one]))


def _too_full(told: _Told, centred: Bools) -> Iterator[Finding]:
    """ISO217: whole circles between neighbours of a few steps, and arcs of a few steps where a whole circle fits."""
    nearly_closed = centred & (told.arcs.written_um > 0) & (told.arcs.chord_um <= told.slack_um)
    is_whole = np.abs(told.arcs.sweep_rad) > np.pi
    before, behind, is_led = _neighbours(told)
    tiny = _TINY_STEPS * told.given.profile.resolution_um + _HAIR_UM
    for_tiny = nearly_closed & is_whole & told.has_end & ((before < tiny) | (behind < tiny))
    for_whole = nearly_closed & ~is_whole & is_led
    for one in np.flatnonzero(for_tiny | for_whole).tolist():
        what = "circle-for-tiny" if for_tiny[one] else "tiny-for-circle"
        full = 2 * np.pi * float(told.arcs.written_um[one])
        yield _at(told, "ISO217", one, _AXES, what=what, chord=float(told.arcs.chord_um[one]), full=full)


def _neighbours(told: _Told) -> tuple[Floats, Floats, Bools]:
    """(k,) lengths of the rows before and behind, infinite where there is none; whether both are one way and back."""
    curves, row = told.path.curves, told.row
    length = np.concatenate([[np.inf], curves.length_um, [np.inf]])
    before, behind = length[row], length[row + 2]
    has_both = np.isfinite(before) & np.isfinite(behind)
    way = curves.start_um[np.maximum(row - 1, 0)] - curves.end_um[np.minimum(row + 1, len(curves) - 1)]
    is_back = np.hypot(way[:, 0], way[:, 1]) <= told.slack_um
    return before, behind, has_both & is_back & (np.minimum(before, behind) > told.slack_um)


def _at(told: _Told, code: str, one: int, letters: str, /, **values: Value) -> Finding:
    """Finding at the first word of the letters in a block, or at the whole block where it has none of them."""
    listing, block = told.given.listing, int(told.block[one])
    first, past = int(listing.blocks.word[block]), int(listing.blocks.word[block + 1])
    span = (int(listing.blocks.first[block]), int(listing.blocks.past[block]))
    for word, letter in enumerate(listing.words.letter[first:past].tolist(), first):
        if chr(letter) in letters:
            span = (int(listing.words.first[word]), int(listing.words.past[word]))
            break
    return listing.lines.finding(code, span, int(told.row[one]) + 1, **values)
