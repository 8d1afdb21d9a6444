"""Arcs of ISO: in which reading their I J agree, and what is wrong with them (docs/iso.md §4, §5).

I J tested: in which reading, from the start or as places, the radii of the arcs agree (docs/iso.md §4).

Checks of arcs: what makes one, radii at both ends, full circles (docs/iso.md §5).
"""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from parser.findings.codes import Severity
from parser.findings.findings import Finding, Value
from parser.geometry.curves import Bools, Floats, Ints
from parser.iso.path.flow import GivenColumns
from parser.iso.path.places import Coordinates, Modes, Places
from parser.iso.path.registers import Run
from parser.iso.path.rows import ROUNDING, Arcs, Rows

GRAVE_UM = 20.0
"""Radii that differ by more are an error, and no rounding of any file."""

_AXES = "XY"
_HAIR_UM = 1e-6  # rounding of sums of decimals
_TINY_STEPS = 2.0


class _ToldArcs(NamedTuple):
    """Blocks told to be arcs, k of them, each the first time it runs; (k,) but for the last.

    `row` is that of the toolpath, `missing` how many of I J are not given. `is_lost` tells where nobody knows where the
    arc begins or ends. `slack_um` is what the rounding of the file explains.
    """

    given: GivenColumns
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


def arc_findings(given: GivenColumns, run: Run) -> Iterator[Finding]:
    """What is wrong with the arcs of a run; a block that runs often is told once."""
    if not len(run.rows.turning):
        return
    arcs = _told_arcs(given, run)
    centred = ~arcs.by_radius & ~arcs.lacks_center
    yield from _without_center(arcs)
    yield from _without_radius(arcs, centred)
    known = centred & ~arcs.is_lost
    yield from _beside_circle(arcs, known & (arcs.arcs.written_um > 0))
    yield from _by_radius(arcs)
    yield from _too_full(arcs, known)


def _told_arcs(given: GivenColumns, run: Run) -> _ToldArcs:
    runs, numbers, path = run.flow.block, run.numbers, run.rows
    block, first = np.unique(runs[path.at[path.turning]], return_index=True)
    first = first[~given.contradicts("motion")[block]]  # such a block is told to be no arc as well
    row = path.turning[first]
    at = path.at[row]
    return _ToldArcs(
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


def _without_center(told_arcs: _ToldArcs) -> Iterator[Finding]:
    """ISO210."""
    for index in np.flatnonzero(told_arcs.lacks_center).tolist():
        what = "arc-one-center" if told_arcs.missing[index] == 1 else "arc-no-center"
        yield _at(told_arcs, "ISO210", index, "", what=what)


def _without_radius(told_arcs: _ToldArcs, centred: Bools) -> Iterator[Finding]:
    """ISO211."""
    for index in np.flatnonzero((centred | told_arcs.by_radius) & (told_arcs.arcs.written_um == 0)).tolist():
        yield _at(told_arcs, "ISO211", index, "IJR")


def _beside_circle(told_arcs: _ToldArcs, centred: Bools) -> Iterator[Finding]:
    """ISO212, an error beyond what any rounding explains."""
    off = np.abs(told_arcs.arcs.differ_um)
    for index in np.flatnonzero(centred & (off > told_arcs.slack_um)).tolist():
        at_start, by = float(told_arcs.arcs.written_um[index]), float(told_arcs.arcs.differ_um[index])
        found = _at(
            told_arcs, "ISO212", index, "IJ", start=at_start, end=at_start + by, off=abs(by), limit=told_arcs.slack_um
        )
        yield found._replace(graver=Severity.ERROR if abs(by) > GRAVE_UM else None)


def _by_radius(told_arcs: _ToldArcs) -> Iterator[Finding]:
    """ISO213 and ISO214."""
    chord, radius = told_arcs.arcs.chord_um, told_arcs.arcs.written_um
    by_radius = told_arcs.by_radius & (radius > 0) & ~told_arcs.is_lost
    for index in np.flatnonzero(by_radius & (chord == 0)).tolist():
        yield _at(told_arcs, "ISO214", index, "R", radius=float(radius[index]))
    for index in np.flatnonzero(by_radius & (chord > 0) & (told_arcs.arcs.sweep_rad == 0)).tolist():
        yield _at(told_arcs, "ISO213", index, "R", chord=float(chord[index]), reach=2 * float(radius[index]))


def _too_full(told_arcs: _ToldArcs, centred: Bools) -> Iterator[Finding]:
    """ISO217: whole circles between neighbours of a few steps, and arcs of a few steps where a whole circle fits."""
    nearly_closed = centred & (told_arcs.arcs.written_um > 0) & (told_arcs.arcs.chord_um <= told_arcs.slack_um)
    is_whole = np.abs(told_arcs.arcs.sweep_rad) > np.pi
    before, behind, is_led = _neighbours(told_arcs)
    tiny = _TINY_STEPS * told_arcs.given.profile.resolution_um + _HAIR_UM
    for_tiny = nearly_closed & is_whole & told_arcs.has_end & ((before < tiny) | (behind < tiny))
    for_whole = nearly_closed & ~is_whole & is_led
    for index in np.flatnonzero(for_tiny | for_whole).tolist():
        what = "circle-for-tiny" if for_tiny[index] else "tiny-for-circle"
        full = 2 * np.pi * float(told_arcs.arcs.written_um[index])
        yield _at(told_arcs, "ISO217", index, _AXES, what=what, chord=float(told_arcs.arcs.chord_um[index]), full=full)


def _neighbours(told_arcs: _ToldArcs) -> tuple[Floats, Floats, Bools]:
    """(k,) lengths of the rows before and behind, infinite where there is none; whether both are one way and back."""
    curves, row = told_arcs.path.curves, told_arcs.row
    length = np.concatenate([[np.inf], curves.length_um, [np.inf]])
    before, behind = length[row], length[row + 2]
    has_both = np.isfinite(before) & np.isfinite(behind)
    way = curves.start_um[np.maximum(row - 1, 0)] - curves.end_um[np.minimum(row + 1, len(curves) - 1)]
    is_back = np.hypot(way[:, 0], way[:, 1]) <= told_arcs.slack_um
    return before, behind, has_both & is_back & (np.minimum(before, behind) > told_arcs.slack_um)


def _at(told_arcs: _ToldArcs, code: str, number: int, letters: str, /, **values: Value) -> Finding:
    """Finding at the first word of the letters in a block, or at the whole block where it has none of them."""
    listing, block = told_arcs.given.listing, int(told_arcs.block[number])
    first, past = int(listing.blocks.word[block]), int(listing.blocks.word[block + 1])
    span = (int(listing.blocks.first[block]), int(listing.blocks.past[block]))
    for word, letter in enumerate(listing.words.letter[first:past].tolist(), first):
        if chr(letter) in letters:
            span = (int(listing.words.first[word]), int(listing.words.past[word]))
            break
    return listing.lines.finding(code, span, int(told_arcs.row[number]) + 1, **values)


_MOST, _HALF = 0.9, 0.5
_SLIGHT = 0.01  # of a radius
_APART_UM = 1.0  # chords, and ways from the zero point, that are too short to tell the readings apart


class Agreement(NamedTuple):
    """How many arcs tell the readings of I J apart, and the shares of them whose radii agree as read, and otherwise."""

    arcs: int = 0
    as_read: float = 0.0
    otherwise: float = 0.0

    @property
    def is_otherwise(self) -> bool:
        """Whether the arcs agree only in the other reading."""
        return self.otherwise >= _MOST and self.as_read < _HALF

    @property
    def is_sure(self) -> bool:
        """Whether the arcs agree in one of the readings."""
        return max(self.as_read, self.otherwise) >= _MOST

    @property
    def is_neither(self) -> bool:
        """Whether some arcs, more than one, agree in neither reading."""
        return self.arcs > 1 and max(self.as_read, self.otherwise) < _HALF

    @property
    def why(self) -> str:
        """Term of what the arcs say of the reading that was taken; empty where no arc says anything."""
        if not self.arcs:
            return ""
        if self.as_read >= _MOST:
            return "because-arcs-both" if self.otherwise >= _HALF else "because-arcs"
        return "because-arcs-neither"


def agreement(mode: Modes, numbers: Coordinates, place: Places, path: Rows, slack_um: float) -> Agreement:
    """How the arcs of the running blocks agree with either reading of their I J.

    The rounding of the file lets radii differ by `slack_um`.
    """
    at = path.at[path.turning]
    start, end = path.curves.start_um[path.turning], path.curves.end_um[path.turning]
    center, base = numbers.center[at], place.shift_um[at]
    tells = ~np.isnan(center).any(axis=1) & (_length(end - start) > _APART_UM) & (_length(start - base) > _APART_UM)
    if not tells.any():
        return Agreement()
    start, end, center, base = start[tells], end[tells], center[tells], base[tells]
    is_absolute = mode.has_absolute_centers[at[tells], None]
    as_read = _agrees(start, end, center + np.where(is_absolute, base, start), slack_um)
    otherwise = _agrees(start, end, center + np.where(is_absolute, start, base), slack_um)
    return Agreement(int(tells.sum()), float(as_read.mean()), float(otherwise.mean()))


def _agrees(start: Floats, end: Floats, center: Floats, slack_um: float) -> Bools:
    """(k,) whether the radii at both ends of arcs (k, 2) agree as well as their size lets one tell."""
    out = _length(start - center)
    near: Bools = np.abs(_length(end - center) - out) <= np.maximum(slack_um, np.minimum(GRAVE_UM, _SLIGHT * out))
    return near


def _length(by: Floats) -> Floats:
    return np.hypot(by[:, 0], by[:, 1])
