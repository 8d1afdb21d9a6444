"""Rows of the toolpath: lines, arcs and jumps of the blocks that move, and where each is written.

Where words stand in the text of a block that findings of the path point at.

Arcs: centre, radius and sweep of G02 and G03 blocks from I J or R (docs/iso.md §5).
"""

import re
from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

from parser.geometry.curves import Bools, CurveKind, Curves, Floats, Ints
from parser.iso.path.flow import GivenColumns
from parser.iso.path.places import Coordinates, Modes, Places, exact
from parser.text.source import Field, Source, Span

ROUNDING = 8.0**0.5
"""How far radii at start and end differ at most, in steps of the file, where places and centre are rounded to them."""


class Arcs(NamedTuple):
    """Arcs as told, k of them.

    Attributes
    ----------
    center_um
        (k, 2), on the bisector of start and end where such a centre is near the one that is written.
    sweep_rad
        (k,) signed; 0 where nothing makes an arc of it: such a block goes straight to its end.
    radius_um
        (k,) of the arc; the mean of both ends where the centre stays as written.
    written_um
        (k,) radius as written: at the start, or R without its sign.
    differ_um
        (k,) how much more it is at the end about the centre as written; 0 by R.
    chord_um
        (k,) from start to end.
    told_um
        (k, 2) centre as written; NaN by R.
    """

    center_um: Floats
    sweep_rad: Floats
    radius_um: Floats
    written_um: Floats
    differ_um: Floats
    chord_um: Floats
    told_um: Floats


def arcs_about(start: Floats, end: Floats, center: Floats, turn: Floats) -> Arcs:
    """Arcs (k,) from start to end (k, 2) about centres (k, 2) as written, turn +1 counter-clockwise or −1."""
    out, back = start - center, end - center
    at_start, at_end = _length(out), _length(back)
    differ = at_end - at_start
    by = end - start
    chord = _length(by)
    written = np.where(chord == 0, 2 * np.pi, _sweep(out, back, turn))
    along = by / np.where(chord > 0, chord, 1.0)[:, None]
    move = (start + end) / 2 - center
    aside = np.where(chord > 0, (move * along).sum(axis=1), 0.0)
    moved = center + aside[:, None] * along
    sweep = np.where(chord == 0, 2 * np.pi, _sweep(start - moved, end - moved, turn))
    stays = (np.abs(sweep - written) > np.pi) | ((written > np.pi) & (np.abs(aside) > 2 * np.abs(differ)))
    radius = np.where(stays, (at_start + at_end) / 2, _length(start - moved))
    sweep = np.where(stays, written, sweep)
    sweep = np.where((at_start > 0) & (at_end > 0), sweep, 0.0)
    return Arcs(np.where(stays[:, None], center, moved), sweep * turn, radius, at_start, differ, chord, center)


def arcs_of_radius(start: Floats, end: Floats, radius: Floats, turn: Floats, slack_um: float) -> Arcs:
    """Arcs (k,) of a radius (k,): positive up to a half turn, negative beyond.

    A chord longer than the diameter by no more than the slack is a half turn.
    """
    by = end - start
    chord = _length(by)
    size = np.abs(radius)
    half = chord / 2
    fits = (chord > 0) & (half <= size + slack_um / 2) & (size > 0)
    height = np.sqrt(np.maximum(size**2 - half**2, 0.0))
    normal = np.column_stack([-by[:, 1], by[:, 0]]) / np.where(chord > 0, chord, 1.0)[:, None]
    center = (start + end) / 2 + (turn * np.where(radius > 0, 1.0, -1.0) * height)[:, None] * normal
    minor = 2 * np.arcsin(np.minimum(half / np.where(size > 0, size, 1.0), 1.0))
    sweep = np.where(fits, np.where(radius > 0, minor, 2 * np.pi - minor), 0.0)
    return Arcs(
        center, sweep * turn, _length(start - center), size, np.zeros_like(size), chord, np.full_like(start, np.nan)
    )


def _sweep(out: Floats, back: Floats, turn: Floats) -> Floats:
    """(k,) from one direction to another in the sense of the turn, 0 up to 2π."""
    cross = out[:, 0] * back[:, 1] - out[:, 1] * back[:, 0]
    angle = np.arctan2(cross * turn, (out * back).sum(axis=1))
    swept: Floats = np.where(angle <= 0, angle + 2 * np.pi, angle)
    return swept


def _length(by: Floats) -> Floats:
    return np.hypot(by[:, 0], by[:, 1])


_REMARK = re.compile(r"\([^)]*\)?|;.*", re.DOTALL)
_NUMBER = r"\s*[-+]?[\d.]+"
_WORDS: Mapping[Field, re.Pattern[str]] = {
    Field.X: re.compile(f"X{_NUMBER}", re.IGNORECASE),
    Field.Y: re.compile(f"Y{_NUMBER}", re.IGNORECASE),
    Field.SENSE: re.compile(r"G\s*0*[23](?![\d.])", re.IGNORECASE),
    Field.SIDE: re.compile(r"G\s*0*4[012](?![\d.])", re.IGNORECASE),
    Field.REGISTER: re.compile(r"[DH]\s*\d+", re.IGNORECASE),
}


def fields_of(block: str) -> dict[Field, Span]:
    """Where the words of a block stand that say one of these; those that are written, outside of remarks."""
    bare = _REMARK.sub(lambda remark: " " * len(remark[0]), block)
    found = {field: word.search(bare) for field, word in _WORDS.items()}
    return {field: match.span() for field, match in found.items() if match}


_CLOCKWISE = 2


class Rows(NamedTuple):
    """Blocks that move, n of them as they run.

    Attributes
    ----------
    at
        (n,) which of the running blocks each row is.
    curves
        (n,) lines, arcs and jumps; an arc that nothing makes one is a line to its end.
    turning
        (k,) rows that are told to be arcs.
    lacks_center
        (k,) bool, whether they have neither R nor both of I J; from the start of an arc one of I J is enough.
    arcs
        (k,) what was made of them.
    """

    at: Ints
    curves: Curves
    turning: Ints
    lacks_center: Bools
    arcs: Arcs


def rows(mode: Modes, numbers: Coordinates, place: Places, resolution_um: float) -> Rows:
    """Rows of all blocks that move, and of new threadings away from where the wire was."""
    is_away = place.is_threaded & (place.start_um != place.end_um).any(axis=1)
    at = np.flatnonzero(numbers.moves | is_away)
    end = place.end_um[at]
    start = np.concatenate([place.start_um[at[:1]], end[:-1]])
    motion = np.where(numbers.moves[at], mode.motion[at], 0)
    turning = np.flatnonzero(motion >= _CLOCKWISE)
    here = at[turning]
    is_place = mode.has_absolute_centers[here]
    missing = np.isnan(numbers.center[here]).sum(axis=1)
    lacks_center = np.isnan(numbers.radius[here]) & (missing > np.where(is_place, 0, 1))
    center = np.where(is_place[:, None], place.shift_um[here], start[turning]) + np.nan_to_num(numbers.center[here])
    arcs = _arcs(
        start[turning],
        end[turning],
        np.where(mode.motion[here] == _CLOCKWISE, -1.0, 1.0),
        (np.where(lacks_center[:, None], start[turning], exact(center)), numbers.radius[here]),
        ROUNDING * resolution_um,
    )
    return Rows(at, _curves(start, end, motion, turning, arcs), turning, lacks_center, arcs)


def _arcs(start: Floats, end: Floats, turn: Floats, written: tuple[Floats, Floats], slack_um: float) -> Arcs:
    """Arcs (k,) about the centres (k, 2) that are told, or by the radii (k,) where they are no NaN."""
    center, radius = written
    about = arcs_about(start, end, center, turn)
    by_radius = ~np.isnan(radius)
    if not by_radius.any():
        return about
    of_radius = arcs_of_radius(start, end, np.nan_to_num(radius), turn, slack_um)
    return Arcs(*(_chosen(by_radius, this, other) for this, other in zip(of_radius, about, strict=True)))


def _chosen(choice: Bools, this: Floats, other: Floats) -> Floats:
    return np.where(choice if this.ndim == 1 else choice[:, None], this, other)


def _curves(start: Floats, end: Floats, motion: Ints, turning: Ints, arcs: Arcs) -> Curves:
    """All rows as lines and jumps, then those over them that are arcs."""
    nothing = np.full(len(motion), np.nan)
    kind = np.where(motion == 0, CurveKind.JUMP, CurveKind.LINE).astype(np.int64)
    length = np.hypot(*(end - start).T)
    center, radius, angle, sweep = np.full(start.shape, np.nan), nothing, nothing.copy(), np.zeros(len(motion))
    is_round = arcs.sweep_rad != 0
    row = turning[is_round]
    kind[row] = CurveKind.ARC
    center[row], radius[row], sweep[row] = (
        column[is_round] for column in (arcs.center_um, arcs.radius_um, arcs.sweep_rad)
    )
    out = start[row] - center[row]
    angle[row] = np.arctan2(out[:, 1], out[:, 0])
    length[row] = radius[row] * np.abs(sweep[row])
    return Curves(kind, start, end, center, radius, angle, sweep, length)


def source(given: GivenColumns, block: Ints) -> Source:
    """Where the blocks (n,) of the rows are written; blocks with a number are labelled with it, ``N10``."""
    blocks = given.listing.blocks
    return Source(
        text=given.listing.text,
        block=np.arange(1, len(block) + 1),
        span=np.column_stack([blocks.first[block], blocks.past[block]]),
        line=blocks.line[block],
        label=_labels(given, block),
        fields_of=fields_of,
    )


def _labels(given: GivenColumns, block: Ints) -> tuple[str, ...]:
    word = given.word("N")[block]
    has = word >= 0
    if not has.any():
        return ("",) * len(block)
    labels = [f"N{number}" for number in given.listing.words.value[word].astype(np.int64).tolist()]
    for row in np.flatnonzero(~has).tolist():
        labels[row] = ""
    return tuple(labels)
