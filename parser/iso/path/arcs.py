"""Arcs: centre, radius and sweep of G02 and G03 blocks from I J or R (docs/iso.md §5)."""

from typing import NamedTuple

import numpy as np

from parser.geometry.curves import Floats

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
