"""Rapids as a language says them: 3B has no word for one, and a line is in the air because the wire is out."""

from dataclasses import replace

import numpy as np

from parser.geometry.curves import CurveKind, Curves, Ints, curves_between, joined
from parser.write.draft import Draft, picked

_SAME_UM = 2.0


def with_rapid_to_start(draft: Draft) -> Draft:
    """A draft that begins at (0, 0), with a rapid to where it began; for languages that have no words to count by."""
    if not len(draft) or not draft.curves.start_um[0].any():
        return draft
    curves = draft.curves
    rapid = curves_between(np.zeros((1, 2)), curves.start_um[:1], np.full((1, 2), np.nan), np.zeros(1))
    rapid.kind[:] = CurveKind.JUMP
    told = draft.compensation and replace(
        draft.compensation,
        side=np.append(0, draft.compensation.side),
        by_um=np.append(0.0, draft.compensation.by_um),
        register=("", *draft.compensation.register),
    )
    return replace(
        draft,
        curves=joined([rapid, curves]),
        stops=tuple(stop._replace(after=stop.after + 1) for stop in draft.stops),
        events=tuple(event._replace(after=event.after + 1) for event in draft.events),
        is_placed=np.append(False, draft.is_placed),
        told_um=np.concatenate([np.full((1, 2), np.nan), draft.told_um]),
        words=None,
        compensation=told,
    )


def without_rapids(draft: Draft) -> Draft:
    """A draft that begins with a cut, and whose rapids lead to other figures.

    Where the first cut begins the wire is threaded, however it gets there. A rapid back to a place of its own figure,
    such as the way out to the start hole, runs with the wire through what is cut: it is a block like others.
    """
    cuts = np.flatnonzero(draft.curves.kind != CurveKind.JUMP)
    begun = picked(draft, np.arange(cuts[0] if len(cuts) else len(draft), len(draft)))
    kind = begun.curves.kind.copy()
    kind[_returning(begun)] = CurveKind.LINE
    stops = tuple(stop for stop in begun.stops if stop.kind == "end" or stop.after > 0)
    return replace(begun, curves=replace(begun.curves, kind=kind), stops=stops)


def _returning(draft: Draft) -> Ints:
    """Rows in the air, not placed, that end where a block of the figure before them begins."""
    jumps = np.flatnonzero(draft.curves.kind == CurveKind.JUMP)
    figures = zip([0, *(jumps[:-1] + 1).tolist()], jumps.tolist(), strict=True) if len(jumps) else ()
    back = [row for first, row in figures if not draft.is_placed[row] and _is_back(draft.curves, first, row)]
    return np.array(back, dtype=np.int64)


def _is_back(curves: Curves, first: int, row: int) -> bool:
    away = curves.start_um[first:row] - curves.end_um[row]
    return bool((np.hypot(away[:, 0], away[:, 1]) <= _SAME_UM).any())
