"""Rapids as 3B can say them, which has no word for one: a line is in the air because the wire is out."""

from dataclasses import replace

import numpy as np

from parser.geometry.curves import CurveKind, Curves, Ints
from parser.write.draft import Draft, picked

_SAME_UM = 2.0


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
