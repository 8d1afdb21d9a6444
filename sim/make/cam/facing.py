"""Two closed contours that face each other at the bottom and the top of the work, matched piece by piece.

CAMs match contours by their entities, or by the starts and ends of stretches (PTC Creo, "Wire EDM parameters"). Here
contours with as many curves are matched curve by curve, those with as many corners corner by corner, and others at the
places nearest to the corners of one of them; in between by the share of the length.
"""

from typing import Final, Literal, NamedTuple

import numpy as np

from parser.geometry.along import directions, places, places_at
from parser.geometry.curves import Bools, Curves, Floats, Ints, curves_between, total_before
from parser.geometry.distance import lengths_to
from parser.geometry.ruled import Ruled, uneven_partners

MatchedBy = Literal["curves", "corners", "nearest", "length"]
_CORNER_RAD: Final = np.radians(10.0)
_SNAP_UM: Final = 3.0
"""Ends of curves that face each other but for so much are partners, so that no sliver is left between them."""
_NODES: Final = 5


class Facing(NamedTuple):
    """Two contours piece by piece.

    Attributes
    ----------
    lower, upper
        (k,) pieces, each of one curve, one behind the other and closed; partners are run in the same time.
    by
        What they were matched by.
    """

    lower: Curves
    upper: Curves
    by: MatchedBy

    def stretch(self, begin_um: float, way_um: float) -> tuple[Curves, Curves]:
        """Pieces of both from a length µm along the lower contour, over a way µm along it; backwards below 0."""
        before = total_before(self.lower.length_um)
        low, high = sorted((begin_um, begin_um + way_um))
        rounds = np.arange(np.floor(low / before[-1]), np.ceil(high / before[-1]) + 1)
        borders = (before + rounds[:, None] * before[-1]).ravel()
        borders = borders[(borders > low + _SNAP_UM) & (borders < high - _SNAP_UM)]
        row, since, until = _pieces(self.lower, np.concatenate([[low], borders, [high]]))
        if way_um < 0.0:
            row, since, until = row[::-1], until[::-1], since[::-1]
        return _part(self.lower, row, since, until), _part(self.upper, row, since, until)

    def most_aside_um(self) -> float:
        """The most by which partners lie beside each other."""
        row = np.repeat(np.arange(len(self.lower)), _NODES)
        share = np.tile(np.linspace(0.0, 1.0, _NODES), len(self.lower))
        return float(np.hypot(*(places(self.upper, row, share) - places(self.lower, row, share)).T).max())

    def ruled(self, lower_z_um: float, upper_z_um: float) -> Ruled:
        """The surface between them at two heights."""
        return Ruled(self.lower, self.upper, lower_z_um, upper_z_um)

    def cosine(self, height_um: float) -> float:
        """Of the lean across the walls over a height, its mean along the lower contour."""
        row, half = np.arange(len(self.lower)), np.full(len(self.lower), 0.5)
        ruled = self.ruled(0.0, height_um)
        tangent = (ruled.leans(row, half) * ruled.across(row, half)).sum(axis=1)
        return float(np.average(1.0 / np.hypot(1.0, tangent), weights=self.lower.length_um))


def facing(lower: Curves, upper: Curves) -> Facing:
    """Two closed contours that run the same way round, each curve from the end of the one before it, matched.

    Where several matches are possible, the one with the fewest uneven partners; of those, the one whose partners lie
    nearest to each other. A check tells of uneven ones (3B706).
    """
    found = [_faced(lower, upper, anchors, by) for anchors, by in _matches(lower, upper)]
    return min(found, key=lambda each: (_uneven(each.lower.length_um, each.upper.length_um), each.most_aside_um()))


def _uneven(lower_um: Floats, upper_um: Floats) -> int:
    return int(np.count_nonzero(uneven_partners(lower_um, upper_um)))


def _faced(lower: Curves, upper: Curves, anchors: "_Anchors", by: MatchedBy) -> Facing:
    at_lower, at_upper = _borders(anchors, lower, upper)
    return Facing(_part(lower, *_pieces(lower, at_lower)), _part(upper, *_pieces(upper, at_upper)), by)


class _Anchors(NamedTuple):
    """Lengths (k,) along both contours of places that are partners, rising from the first one all round."""

    lower_um: Floats
    upper_um: Floats


def _matches(lower: Curves, upper: Curves) -> list[tuple[_Anchors, MatchedBy]]:
    """How two contours may be matched: one way where their curves or their corners are partners, else several."""
    starts = [total_before(of.length_um)[:-1] for of in (lower, upper)]
    corners = [start[_is_corner(of)] for start, of in zip(starts, (lower, upper), strict=True)]
    alike: list[tuple[list[Floats], MatchedBy]] = [(starts, "curves"), (corners, "corners")]
    for (these, those), by in alike:
        if len(these) == len(those) > 1:
            turned = _turned(these, those, lower, upper)
            if not _uneven(*(np.diff(of) for of in _all_round(turned, lower, upper))):
                return [(turned, by)]
    below, above = _nearest(lower, upper, corners[0]), _nearest(upper, lower, corners[1])
    single = _nearest(lower, upper, starts[0][:1])
    found: list[tuple[_Anchors | None, MatchedBy]] = [(below, "nearest"), (above and _Anchors(*above[::-1]), "nearest")]
    return [(anchors, by) for anchors, by in (*found, (single, "length")) if anchors is not None]


def _nearest(this: Curves, other: Curves, at_um: Floats) -> _Anchors | None:
    """Places of a contour with those of another one that lie nearest; None without places, or where they mix."""
    if not len(at_um):
        return None
    on = lengths_to(other, _places_at(this, at_um))
    total = float(other.length_um.sum())
    steps = np.mod(np.diff(np.append(on, on[0])), total)
    if len(on) > 1 and ((steps < _SNAP_UM).any() or abs(float(steps.sum()) - total) > _SNAP_UM):
        return None
    return _Anchors(at_um, on[0] + np.mod(on - on[0], total))


def _all_round(anchors: _Anchors, lower: Curves, upper: Curves) -> tuple[Floats, Floats]:
    """The lengths of anchors along both contours, the first ones again behind a whole round."""
    below, above = (np.append(at, at[0] + of.length_um.sum()) for at, of in zip(anchors, (lower, upper), strict=True))
    return below, above


def _turned(lower_um: Floats, upper_um: Floats, lower: Curves, upper: Curves) -> _Anchors:
    """As many places on both contours as partners, begun so that they lie nearest to each other."""
    low, high = _places_at(lower, lower_um), _places_at(upper, upper_um)
    off = [float(((low - np.roll(high, -by, axis=0)) ** 2).sum()) for by in range(len(low))]
    by = int(np.argmin(off))
    total = float(upper.length_um.sum())
    turned = np.roll(upper_um, -by)
    return _Anchors(lower_um, turned[0] + np.mod(turned - turned[0], total))


def _is_corner(curves: Curves) -> Bools:
    """(n,) whether a closed contour turns at the start of each curve."""
    leaving, arriving = directions(curves)
    before = np.roll(arriving, 1, axis=0)
    turn = np.arctan2(before[:, 0] * leaving[:, 1] - before[:, 1] * leaving[:, 0], (before * leaving).sum(axis=1))
    found: Bools = np.abs(turn) > _CORNER_RAD
    return found


def _borders(anchors: _Anchors, lower: Curves, upper: Curves) -> _Anchors:
    """Lengths of all places at which a piece of either contour ends, and of their partners; the first again behind."""
    known = _all_round(anchors, lower, upper)
    starts = [
        at[0] + np.mod(total_before(of.length_um)[:-1] - at[0], of.length_um.sum())
        for of, at in zip((lower, upper), known, strict=True)
    ]
    below, above = np.interp(starts[1], known[1], known[0]), np.interp(starts[0], known[0], known[1])
    pairs, own, other = (np.stack(columns, axis=1) for columns in (known, (starts[0], above), (below, starts[1])))
    for pair in own:
        near = np.flatnonzero(_are_near(pair, other))
        if len(near):
            pair[1] = other[near[0], 1]
            other = np.delete(other, near[0], axis=0)
    for pair in (*own, *other):
        if not _are_near(pair, pairs).any():
            pairs = np.concatenate([pairs, pair[None, :]])
    low, high = pairs[np.argsort(pairs[:, 0], kind="stable")].T
    return _Anchors(low, np.maximum.accumulate(high))


def _are_near(pair: Floats, pairs: Floats) -> Bools:
    """(k,) whether pairs of lengths (k, 2) are another one but for what may be snapped."""
    near: Bools = np.all(np.abs(pairs - pair) < _SNAP_UM, axis=1)
    return near


def _pieces(curves: Curves, at_um: Floats) -> tuple[Ints, Floats, Floats]:
    """Row (k,) of each piece of a closed contour between lengths (k + 1,) along it, and its shares of that row.

    Lengths may go beyond the end of the contour, and lie before its start.
    """
    before = total_before(curves.length_um)
    middle = 0.5 * (at_um[1:] + at_um[:-1])
    turns = np.floor(middle / before[-1]) * before[-1]
    row = np.clip(np.searchsorted(before, middle - turns, side="right") - 1, 0, len(curves) - 1)
    since, until = (
        np.clip((end - turns - before[row]) / curves.length_um[row], 0.0, 1.0) for end in (at_um[:-1], at_um[1:])
    )
    return row, since, until


def _part(curves: Curves, row: Ints, since: Floats, until: Floats) -> Curves:
    """Parts of rows (k,) from one share to another; backwards where the second is less."""
    start, end = places(curves, row, since), places(curves, row, until)
    sweep = np.where(curves.is_arc[row], curves.sweep_rad[row] * (until - since), 0.0)
    return curves_between(start, end, curves.center_um[row], sweep)


def _places_at(curves: Curves, at_um: Floats) -> Floats:
    """Places (k, 2) at lengths along a closed contour."""
    before = total_before(curves.length_um)
    row = np.clip(np.searchsorted(before, at_um, side="right") - 1, 0, len(curves) - 1)
    return places_at(curves, row, at_um - before[row])
