"""Chains that pass a place twice, parted there: two loops that touch are two, no figure eight."""

from typing import NamedTuple

import numpy as np

from parser.drawing.loops.ends import near
from parser.drawing.loops.labels import merged, place_labels
from parser.drawing.model import BESIDE_UM, SAME_WITHIN_UM, running
from parser.geometry.curves import Bools, Curves, Floats, Ints


class Run(NamedTuple):
    """Chains of curves.

    Attributes
    ----------
    row, backwards
        (n,) rows in running order, and whether each is run backwards.
    of
        (n,) number of the chain of each, never decreasing.
    closed
        (l,) whether the chains close.
    """

    row: Ints
    backwards: Bools
    of: Ints
    closed: Bools


def parted(curves: Curves, run: Run, branch_um: Floats, gap_um: float) -> Run:
    """The chains, those parted that pass a place twice, in the order of the first of their rows.

    Places are one within `SAME_WITHIN_UM`; at the branches (b, 2), where more than two ends meet, within the gap. A
    chain stays whole where a part of it would have no area: it runs there and back, and nobody knows what it is about.
    """
    ran = running(curves, run.row, run.backwards)
    first = np.flatnonzero(np.diff(run.of, prepend=-1))
    past = np.append(first[1:], len(run.of))
    place = _numbers(np.concatenate([ran.start_um, ran.end_um[past - 1]]), branch_um, gap_um)
    start, end = place[: len(run.of)], np.where(run.closed, place[first], place[len(run.of) :])
    loose = np.flatnonzero(~run.closed)
    stop, chain = np.append(start, end[loose]), np.append(run.of, loose)
    key, number = np.unique(chain * (int(place.max()) + 1) + stop, return_counts=True)
    twice = set((key[number > 1] // (int(place.max()) + 1)).tolist())
    if not twice:
        return run
    parts: list[_Part] = []
    for one, (low, high) in enumerate(zip(first.tolist(), past.tolist(), strict=True)):
        whole = _Part(np.arange(low, high), bool(run.closed[one]))
        parts += _parts(curves, run, whole, [*start[low:high].tolist(), int(end[one])]) if one in twice else [whole]
    parts.sort(key=lambda part: int(run.row[part.at].min()))
    return _joined(run, parts)


class _Part(NamedTuple):
    """Where in a run the rows (k,) of a part of a chain stand, and whether it closes."""

    at: Ints
    closed: bool


def _numbers(place_um: Floats, branch_um: Floats, gap_um: float) -> Ints:
    """Numbers (k,) from 0 of places (k, 2), those at branches (b, 2) within the gap the same."""
    label = place_labels(np.concatenate([place_um, branch_um]))
    pair, _ = near(branch_um, max(gap_um, SAME_WITHIN_UM))
    by = np.hypot(*(branch_um[pair[:, 0]] - branch_um[pair[:, 1]]).T)
    at_branch = label[len(place_um) :]
    return merged(label, at_branch[pair[by <= gap_um]])[: len(place_um)]


def _parts(curves: Curves, run: Run, whole: _Part, place: list[int]) -> list[_Part]:
    """Parts of a chain that passes places (m + 1,), each of which passes no place twice; what is open comes last."""
    parts, way, depth = [], [], {place[0]: 0}
    passed = [place[0]]
    for at, number in zip(whole.at.tolist(), place[1:], strict=True):
        way.append(at)
        if number in depth:
            begin = depth[number]
            parts.append(_Part(np.array(way[begin:], dtype=np.int64), closed=True))
            for gone in passed[begin + 1 :]:
                del depth[gone]
            del way[begin:], passed[begin + 1 :]
        else:
            passed.append(number)
            depth[number] = len(way)
    if way:
        parts.append(_Part(np.array(way, dtype=np.int64), closed=False))
    made = _joined(run, parts)
    length = np.bincount(made.of, curves.length_um[made.row])
    flat = made.closed & (2.0 * np.abs(signed_areas(curves, made)) <= BESIDE_UM * length)
    return [whole] if flat.any() else parts


def _joined(run: Run, parts: list[_Part]) -> Run:
    at = np.concatenate([part.at for part in parts])
    of = np.repeat(np.arange(len(parts)), [len(part.at) for part in parts])
    return Run(run.row[at], run.backwards[at], of, np.array([part.closed for part in parts]))


def signed_areas(curves: Curves, run: Run) -> Floats:
    """Signed areas (l,) µm² of chains, arcs included; open ones closed by a line."""
    ran = running(curves, run.row, run.backwards)
    origin = ran.start_um[np.flatnonzero(np.diff(run.of, prepend=-1))][run.of]
    start, end = ran.start_um - origin, ran.end_um - origin
    segment = np.where(ran.is_arc, ran.radius_um**2 * (ran.sweep_rad - np.sin(ran.sweep_rad)), 0.0)
    area = np.bincount(run.of, 0.5 * (start[:, 0] * end[:, 1] - start[:, 1] * end[:, 0] + segment))
    return area.astype(np.float64)
