"""Where the neighbours of a corner meet when they are prolonged or shortened, and curves ended there."""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from controller.offset.shifted import turned_rad
from parser.geometry.curves import Bools, Curves, Floats, Ints
from parser.geometry.meets import prolonged_meet


class Met(NamedTuple):
    """Where k pairs of curves meet.

    Attributes
    ----------
    place_um
        (k, 2), NaN where they do not.
    on_um, before_um
        (k,) how far the early one runs on behind its end to there, and the late one before its start; negative where
        they are shortened.
    """

    place_um: Floats
    on_um: Floats
    before_um: Floats

    def take(self, at: Bools) -> "Met":
        """Those that are True."""
        return Met(self.place_um[at], self.on_um[at], self.before_um[at])


def met_near(curves: Curves, early: Ints, late: Ints, near_um: Floats) -> Met:
    """Where pairs of rows (k,) meet, prolonged by less than half a turn, nearest to places (k, 2)."""
    places = prolonged_meet(curves, early, late).place_um
    off = np.hypot(*np.moveaxis(places - near_um[:, None], 2, 0))
    second = off[:, 1] < np.where(np.isnan(off[:, 0]), np.inf, off[:, 0])
    place = np.where(second[:, None], places[:, 1], places[:, 0])
    return Met(place, _behind_ends(curves, early, place), _before_starts(curves, late, place))


def with_ends(curves: Curves, start_um: Floats, end_um: Floats) -> Curves:
    """The curves (n,) from and to places (n, 2) on them, or on what they are prolonged to by less than half a turn.

    Arcs keep their circles: a place beside one is taken at its angle.
    """
    by = end_um - start_um
    length = np.hypot(by[:, 0], by[:, 1])
    begin, sweep = curves.start_angle_rad.copy(), curves.sweep_rad.copy()
    arc = np.flatnonzero(curves.is_arc)
    if len(arc):
        sense = np.sign(sweep[arc])
        early = turned_rad(curves, arc, begin[arc], start_um[arc]) * sense
        late = turned_rad(curves, arc, begin[arc] + sweep[arc], end_um[arc]) * sense
        begin[arc] += early
        sweep[arc] += late - early
        length[arc] = curves.radius_um[arc] * np.abs(sweep[arc])
    return replace(curves, start_um=start_um, end_um=end_um, start_angle_rad=begin, sweep_rad=sweep, length_um=length)


def _behind_ends(curves: Curves, row: Ints, place_um: Floats) -> Floats:
    along = _along_chords(curves, row, place_um - curves.end_um[row])
    arc = np.flatnonzero(curves.is_arc[row])
    on = row[arc]
    at_end = curves.start_angle_rad[on] + curves.sweep_rad[on]
    along[arc] = turned_rad(curves, on, at_end, place_um[arc]) * curves.radius_um[on]
    return along


def _before_starts(curves: Curves, row: Ints, place_um: Floats) -> Floats:
    along = _along_chords(curves, row, curves.start_um[row] - place_um)
    arc = np.flatnonzero(curves.is_arc[row])
    on = row[arc]
    along[arc] = -turned_rad(curves, on, curves.start_angle_rad[on], place_um[arc]) * curves.radius_um[on]
    return along


def _along_chords(curves: Curves, row: Ints, way_um: Floats) -> Floats:
    chord = curves.end_um[row] - curves.start_um[row]
    length = np.hypot(chord[:, 0], chord[:, 1])
    along: Floats = (way_um * chord).sum(axis=1) / np.where(length > 0.0, length, 1.0)
    return along
