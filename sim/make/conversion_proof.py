"""What a written text reads as, held against what it was written of: its path, its turns, stops, offsets and lean."""

from collections import Counter
from dataclasses import replace
from typing import Final, NamedTuple

import numpy as np

from parser.controller_words import Compensation, Taper
from parser.geometry.curves import CurveKind, Curves, Floats, Ints
from parser.toolpath import Toolpath
from parser.write.draft import Draft, Event, Written, events_of

_SHARES: Final = (0.25, 0.5, 0.75)
_OFFSET_UM: Final = 0.1
_ANGLE_RAD: Final = 1e-7
"""Over a height of 1 m it leads 0.1 µm aside."""
_SLIDES_UM: Final = 3.0
"""Of 60,000 ends of random lines and arcs, as near as whole µm let them, none slides 2.3 µm (docs/program.md)."""


class Proof(NamedTuple):
    """How far the written path is from the drafted one, µm; and what else is not the same, empty where all is.

    `differs` names a text for people, ``convert.differs-…``.
    """

    off_um: float
    differs: str = ""


def proof(draft: Draft, made: Written, read: Toolpath) -> Proof:
    """What reading a written text gives, beside what it was written of.

    Both begin at the same place: where that is rounded, the whole path lies as much aside.
    """
    if not len(read) and not len(made.row):
        return Proof(0.0)
    differs = _differs(draft, made.row, read)
    if differs:
        return Proof(np.inf, differs)
    proven = _of_contour(draft, made.row, read)
    if draft.upper is None or read.upper is None:
        return proven
    above = _of_contour(replace(draft, curves=draft.upper), made.row, read.upper)
    return Proof(max(proven.off_um, above.off_um), proven.differs or above.differs)


def _of_contour(draft: Draft, row: Ints, read: Curves) -> Proof:
    """One contour beside its curves in a draft."""
    return Proof(_off_um(draft, row, read), "" if _turns_alike(draft.curves, row, read) else "turns")


def _differs(draft: Draft, row: Ints, read: Toolpath) -> str:
    """What is not the same beside the path itself; empty where all is."""
    if len(read) != len(row):
        return "blocks"
    is_jump = draft.curves.kind == CurveKind.JUMP
    alike = {
        "jumps": ((read.kind == CurveKind.JUMP) == is_jump[row]).all(),
        "stops": _stops_alike(draft, row, read),
        "events": not draft.events or _events_alike(draft.events, row, read),
        "offsets": _sides_alike(draft.compensation, row, read.compensation),
        "leans": _leans_alike(draft.taper, row, read.taper) and (draft.upper is None) == (read.upper is None),
    }
    return next((what for what, is_alike in alike.items() if not is_alike), "")


def _off_um(draft: Draft, row: Ints, read: Curves) -> float:
    """The largest distance: of ends, and of places on each curve from the one that it was written of.

    An end of a path that is meant as it stands may slide along it, where it runs smoothly on, by `_SLIDES_UM`: then it
    lies as far off as it is aside of the curve that ends and of the one that begins.
    """
    curves = draft.curves
    shift = curves.start_um[0] - read.start_um[0]
    last = np.searchsorted(row, np.arange(len(curves)), side="right") - 1
    ends = np.where((last >= 0)[:, None], read.end_um[np.maximum(last, 0)], read.start_um[0]) + shift
    off = np.hypot(*(ends - curves.end_um).T)
    if draft.is_meant:
        following = curves.picked(np.minimum(np.arange(len(curves)) + 1, len(curves) - 1))
        aside = np.maximum(_distances(curves, ends), _distances(following, ends))
        off = np.where(off <= _SLIDES_UM, aside, off)
    source = curves.picked(row)
    distances = [_distances(source, _at(read, share) + shift) for share in _SHARES]
    return float(np.max(np.concatenate([off, *distances])))


def _at(path: Curves, share: float) -> Floats:
    """(m, 2) places at a share of each curve."""
    angle = path.start_angle_rad + share * path.sweep_rad
    round_ = path.center_um + path.radius_um[:, None] * np.column_stack([np.cos(angle), np.sin(angle)])
    return np.where(path.is_arc[:, None], round_, path.start_um + share * (path.end_um - path.start_um))


def _distances(curves: Curves, place: Floats) -> Floats:
    """(m,) how far places lie from the circles and the lines of curves."""
    by = curves.end_um - curves.start_um
    length = np.hypot(by[:, 0], by[:, 1])
    out = place - curves.start_um
    across = np.abs(by[:, 0] * out[:, 1] - by[:, 1] * out[:, 0]) / np.where(length > 0.0, length, 1.0)
    from_center = place - np.where(curves.is_arc[:, None], curves.center_um, 0.0)
    round_ = np.abs(np.hypot(from_center[:, 0], from_center[:, 1]) - curves.radius_um)
    return np.where(curves.is_arc, round_, np.where(length > 0.0, across, np.hypot(out[:, 0], out[:, 1])))


def _turns_alike(curves: Curves, row: Ints, read: Curves) -> bool:
    """Whether what is written of each arc turns as far as it does: ends and distances do not know a turn from none."""
    turned = np.bincount(row, read.sweep_rad, minlength=len(curves))
    return bool((np.abs(turned - curves.sweep_rad) < np.pi).all())


def _stops_alike(draft: Draft, row: Ints, read: Toolpath) -> bool:
    """Whether every pause is there, at its place, and the end; other languages pause where the wire is threaded too."""
    there = {stop.after for stop in read.stops if stop.kind == "pause"}
    wanted = {int(np.searchsorted(row, stop.after)) for stop in draft.stops if stop.kind == "pause"}
    return wanted <= there | {0, len(row)} and any(stop.kind == "end" for stop in read.stops)


def _events_alike(events: tuple[Event, ...], row: Ints, read: Toolpath) -> bool:
    """Whether every event is there, at its place; of optional stops those within the path. Heads may bring others."""
    placed = Counter((int(np.searchsorted(row, event.after)), event.word) for event in events)
    wanted = Counter({at: number for at, number in placed.items() if at[1] != "M01" or 0 < at[0] < len(row)})
    return wanted <= Counter((event.after, event.word) for event in events_of(read) or ())


def _sides_alike(drafted: Compensation | None, row: Ints, read: Compensation | None) -> bool:
    if drafted is None or not drafted.side.any():
        return read is None or not read.side.any()
    if read is None:
        return False
    by_um = np.where(drafted.side != 0, drafted.by_um, 0.0)[row]
    near = np.isclose(read.by_um, by_um, rtol=0.0, atol=_OFFSET_UM, equal_nan=True)
    return bool((read.side == drafted.side[row]).all() and near.all())


def _leans_alike(drafted: Taper | None, row: Ints, read: Taper | None) -> bool:
    if drafted is None or read is None:
        return drafted is read
    near = np.abs(read.angle_rad - drafted.angle_rad[row]) <= _ANGLE_RAD
    return bool((read.side == drafted.side[row]).all() and near[read.side != 0].all())
