"""Drafts of two contours as ISO has them: partners in one block, with a colon between them, or with U and V."""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from parser.geometry.curves import Curves, Ints
from parser.geometry.ruled import Ruled
from parser.write.draft import Draft, picked
from parser.write.strokes import Strokes, all_strokes, some_strokes

_SAME_UM, _SAME_RAD = 1e-6, 1e-9


class PairedStrokes(NamedTuple):
    """The strokes of both contours, as many of each."""

    lower: Strokes
    upper: Strokes


def paired_strokes(draft: Draft, step_um: float) -> PairedStrokes:
    """The strokes of a draft of two contours, row by row; rows that move in neither are none.

    ValueError for arcs of more than a turn: they have to be divided in both contours alike.
    """
    upper = _upper(draft)
    above = replace(draft, curves=upper, told_um=np.full_like(draft.told_um, np.nan), upper=None)
    if any((np.abs(of.sweep_rad) > 2.0 * np.pi + _SAME_RAD).any() for of in (draft.curves, upper)):
        raise ValueError("arcs of more than a turn")
    (strokes, moves), (others, also) = all_strokes(draft, step_um), all_strokes(above, step_um)
    rows = np.flatnonzero(moves | also | draft.is_placed)
    return PairedStrokes(some_strokes(strokes, rows), some_strokes(others, rows))


def straightened(draft: Draft, sagitta_um: float) -> Draft:
    """A draft that U and V can say.

    U and V hold to the end of a block, so they cannot change along an arc. Arcs are cut into chords, but where the
    upper contour is the same arc moved aside.
    """
    lower, upper = draft.curves, _upper(draft)
    by_start, by_end = upper.start_um - lower.start_um, upper.end_um - lower.end_um
    alike = lower.is_arc & upper.is_arc & (np.abs(lower.sweep_rad - upper.sweep_rad) < _SAME_RAD)
    bent = (lower.is_arc | upper.is_arc) & ~(alike & (np.hypot(*(by_end - by_start).T) < _SAME_UM))
    ruled, row = Ruled(lower, upper, 0.0, 1.0).straightened(bent, sagitta_um)
    told_um = np.where(bent[row][:, None], np.nan, draft.told_um[row])
    events = tuple(event._replace(after=int(np.searchsorted(row, event.after))) for event in draft.events)
    return replace(picked(draft, row), curves=ruled.lower, upper=ruled.upper, told_um=told_um, events=events)


def in_one_block(below: Sequence[str], above: Sequence[str], planes: str) -> list[str]:
    """Blocks of both contours; one alone where they are the same: both run it then."""
    first, second = (below, above) if planes == "lower-upper" else (above, below)
    return [
        before if before == behind else f"{before} : {behind}" for before, behind in zip(first, second, strict=True)
    ]


def aside(pair: PairedStrokes, *, is_absolute: bool) -> Iterator[Ints | None]:
    """U and V of each block in steps, as places or as ways; None where they do not change."""
    by = pair.upper.end - pair.lower.end
    before = np.concatenate([np.zeros((1, 2), dtype=np.int64), by[:-1]])
    for at, was in zip(by, before, strict=True):
        yield None if (at == was).all() else at if is_absolute else at - was


def _upper(draft: Draft) -> Curves:
    if draft.upper is None:
        raise ValueError("a draft of one contour")
    return draft.upper
