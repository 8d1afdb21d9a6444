"""Rows of the toolpath: lines, arcs and jumps of the blocks that move, and where each is written.

Where words stand in the text of a block that findings of the path point at.
"""

import re
from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

from parser.geometry.curves import Bools, CurveKind, Curves, Floats, Ints
from parser.iso.path.arcs import ROUNDING, Arcs, arcs_about, arcs_of_radius
from parser.iso.path.given import Given
from parser.iso.path.modes import Modes
from parser.iso.path.places import Coordinates, Places, exact
from parser.text.source import Field, Source, Span

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


def _arcs(start: Floats, end: Floats, turn: Floats, told: tuple[Floats, Floats], slack_um: float) -> Arcs:
    """Arcs (k,) about the centres (k, 2) that are told, or by the radii (k,) where they are no NaN."""
    center, radius = told
    about = arcs_about(start, end, center, turn)
    by_radius = ~np.isnan(radius)
    if not by_radius.any():
        return about
    of_radius = arcs_of_radius(start, end, np.nan_to_num(radius), turn, slack_um)
    return Arcs(*(_chosen(by_radius, one, other) for one, other in zip(of_radius, about, strict=True)))


def _chosen(choice: Bools, one: Floats, other: Floats) -> Floats:
    return np.where(choice if one.ndim == 1 else choice[:, None], one, other)


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


def source(given: Given, block: Ints) -> Source:
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


def _labels(given: Given, block: Ints) -> tuple[str, ...]:
    word = given.word("N")[block]
    has = word >= 0
    if not has.any():
        return ("",) * len(block)
    labels = [f"N{number}" for number in given.listing.words.value[word].astype(np.int64).tolist()]
    for row in np.flatnonzero(~has).tolist():
        labels[row] = ""
    return tuple(labels)
