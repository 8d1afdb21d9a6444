"""Pieces of a way that are too short for whole µm, taken out so that their neighbours meet."""

import numpy as np

from parser.geometry.along import places
from parser.geometry.curves import Curves, Floats, Ints
from sim.make.cam.passes.beside.ends import Met, met_near, with_ends

SHORT_UM = 3.0
"""Of a shorter line, whole µm make a direction that is off by more than 15°."""
MOST_OFF_UM = 0.1
"""How far each of two rounds may move the way."""
_ROUNDS = 2


def without_short(way: Curves) -> Curves:
    """A closed way (m,) without pieces shorter than 3 µm, as far as it moves by no more than 0.2 µm for that.

    Of neighbours that are short the shorter one goes first, the other one in a second round. Where the neighbours of
    a piece do not meet, as two arcs of one circle, their ends are made one in the middle of it if it is short enough.
    """
    for _ in range(_ROUNDS):
        if len(way) < 4 or float(way.length_um.min()) >= SHORT_UM:
            break
        way = _once(way)
    return way


def _once(way: Curves) -> Curves:
    length, number = way.length_um, len(way)
    at = np.flatnonzero((length < SHORT_UM) & (length < np.roll(length, 1)) & (length <= np.roll(length, -1)))
    middle = places(way, at, np.full(len(at), 0.5))
    met = met_near(way, at - 1, (at + 1) % number, middle)
    is_met = _moved(way, at, met) <= MOST_OFF_UM
    gone = is_met | (length[at] <= 2.0 * MOST_OFF_UM)
    place = np.where(is_met[:, None], met.place_um, middle)[gone]
    start, end = way.start_um.copy(), way.end_um.copy()
    end[at[gone] - 1], start[(at[gone] + 1) % number] = place, place
    return with_ends(way, start, end).picked(np.delete(np.arange(number), at[gone]))


def _moved(way: Curves, at: Ints, met: Met) -> Floats:
    """How far (k,) µm the way moves at most where the neighbours of pieces meet; ∞ where they do not, or far away.

    The piece and the place where its neighbours meet make a triangle. Old and new way run along sides of it, or beside
    them by the rise of an arc. So they lie no farther apart than the corner that one of them leaves out lies from the
    side that the other one takes.
    """
    before, behind = at - 1, (at + 1) % len(way)
    a, b, m = way.end_um[before], way.start_um[behind], met.place_um
    on, back = met.on_um, met.before_um
    across = np.select(
        [(on >= 0.0) & (back >= 0.0), (on >= 0.0) & (back < 0.0), (on < 0.0) & (back >= 0.0)],
        [_from_line(m, a, b), _from_line(b, a, m), _from_line(a, m, b)],
        np.maximum(np.hypot(*(a - m).T), np.hypot(*(b - m).T)),
    )
    near = (np.abs(on) <= 0.4 * way.length_um[before]) & (np.abs(back) <= 0.4 * way.length_um[behind])
    rises = _rise(way, before, on) + _rise(way, behind, back) + _rise(way, at, way.length_um[at])
    moved: Floats = np.where(near & ~np.isnan(across), across + rises, np.inf)
    return moved


def _rise(way: Curves, row: Ints, length_um: Floats) -> Floats:
    """How far (k,) arcs so long on the circles of rows lie off their chords at most: L²/8R is no less; 0 on lines."""
    radius = np.where(way.is_arc[row], way.radius_um[row], np.inf)
    rise: Floats = length_um * length_um / (8.0 * radius)
    return rise


def _from_line(place: Floats, start: Floats, end: Floats) -> Floats:
    """Distances (k,) of places from straight lines between others (k, 2), ends included."""
    by, out = end - start, place - start
    square = (by * by).sum(axis=1)
    share = np.clip((out * by).sum(axis=1) / np.where(square > 0.0, square, 1.0), 0.0, 1.0)
    off = out - share[:, None] * by
    away: Floats = np.hypot(off[:, 0], off[:, 1])
    return away
