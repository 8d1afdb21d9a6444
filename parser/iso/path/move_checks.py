"""Checks of coordinates: ways of no length, and numbers finer than the machine's steps (docs/iso.md §5)."""

from collections.abc import Iterator

import numpy as np

from parser.findings.findings import Finding
from parser.geometry.boxes import distinct
from parser.geometry.curves import Bools, CurveKind, Ints
from parser.iso.path.given import STOPS, Given
from parser.iso.path.modes import Modes
from parser.iso.path.rows import Rows

_HAIR = 1e-6  # of a step
_MOVING = "XYIJR"


def move_findings(given: Given, runs: Ints, mode: Modes, lacks_motion: Bools, path: Rows) -> Iterator[Finding]:
    """What is wrong with the coordinates of the running blocks `runs` (e,); a block that runs often is told once."""
    yield from _without_motion(given, runs, lacks_motion)
    yield from _no_length(given, runs, mode, path)
    yield from _finer_than_steps(given, runs, mode)


def _without_motion(given: Given, runs: Ints, lacks_motion: Bools) -> Iterator[Finding]:
    """ISO110 at each block that runs with numbers to move by before any motion word did, at the first of these."""
    listing = given.listing
    blocks = distinct(runs[lacks_motion])
    word = listing.of_any(_MOVING)
    first = word[np.searchsorted(listing.words.block[word], blocks)]
    for one in first.tolist():
        span = (int(listing.words.first[one]), int(listing.words.past[one]))
        yield listing.lines.finding("ISO110", span, text=listing.text[slice(*span)], what="no-motion-yet")


def _no_length(given: Given, runs: Ints, mode: Modes, path: Rows) -> Iterator[Finding]:
    """ISO218: lines told to cut that end where they start, but for those that meet the wire where it is threaded."""
    still = (path.curves.kind == CurveKind.LINE) & (path.curves.length_um == 0) & (mode.motion[path.at] == 1)
    row = np.flatnonzero(still)
    row = row[~_at_stop(given, runs, path, row)]
    _, first = np.unique(runs[path.at[row]], return_index=True)
    blocks, lines = given.listing.blocks, given.listing.lines
    for one in row[first].tolist():
        block = int(runs[path.at[one]])
        yield lines.finding("ISO218", (int(blocks.first[block]), int(blocks.past[block])), one + 1)


def _at_stop(given: Given, runs: Ints, path: Rows, row: Ints) -> Bools:
    """(k,) whether a stop stands between the motion before and the motion behind some rows (k,) that do not move."""
    moving = path.at[path.curves.length_um > 0]
    stops = np.concatenate([[0], np.cumsum(given.m(*STOPS)[runs])])
    around = np.searchsorted(moving, path.at[row])
    first, last = np.concatenate([[0], moving])[around], np.concatenate([moving, [len(runs)]])[around]
    some: Bools = stops[last] > stops[first]
    return some


def _finer_than_steps(given: Given, runs: Ints, mode: Modes) -> Iterator[Finding]:
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
