"""Which pieces are parts and which are waste: slugs, and what falls off between cuts.

The wire is threaded in the waste, and its leads run through it. So a piece is waste where the wire came from inside of
it. Besides, two kinds of waste fall beside a larger piece that the same contour cuts: a sliver between two passes, no
wider than the kerf anywhere, and a scrap between leads that part from it: those of one pass, or of a rough cut and of a
trim that starts elsewhere, in a contour of its own or not.

The last uncut bridge of a piece: where the wire closes on to an older kerf, how long the piece still held by it.

Where the program pauses in front of it, the operator can clamp the piece before the bridge is cut.
"""

import math
from collections.abc import Callable, Sequence
from functools import cache
from typing import Literal, NamedTuple

import numpy as np
import shapely

from parser.geometry.curves import Floats, Ints
from parser.shape.contours import CLOSED_WITHIN_UM, are_in_kerf
from parser.shape.passes import WIDEST_TAB
from parser.toolpath import Point
from sim.cut.kerf.swept import Kerf, Swept
from sim.cut.kerf.ways import WireWay, lines_of, share_made
from sim.cut.pieces.frees import FreeMoment

_FRESH = 3.0  # offsets: so far back along its way the wire is in the kerf it is cutting, and closes on to nothing
_BRIDGE = 0.5  # of the outer edge of a piece, at most
_LAST_UM = 1000.0  # of way before a piece comes free: here it is still held well


class Bridge(NamedTuple):
    """What held a piece last.

    Attributes
    ----------
    place_um
        Half way between the wire and its older place that it closes on to; at the edge of the work, the wire's place.
    closes_on_block
        Block number of the older kerf; None where there is none, at the edge of the work.
    left_um
        How far the wire had to go at the start of the block that freed the piece.
    last_mm_block, last_mm_t_s
        Block number and time one millimetre of way before it came free; of a shorter contour, those at its start.
    """

    place_um: Point
    closes_on_block: int | None
    left_um: float
    last_mm_block: int
    last_mm_t_s: float


class Older(NamedTuple):
    """An older place of the wire: index of its contour, its index on that way, and its distance from the wire."""

    contour: int
    at: int
    off_um: float


def older_place(
    swept: Sequence[Swept], earlier: Sequence[int], contour: int, at: int, offset_um: float
) -> Older | None:
    """The older place, on an earlier contour or on this one, that the wire closes on to; None at the work's edge.

    Discs that touch are two offsets apart; a place farther off has no part in it.
    """
    way, reach = swept[contour].way, _FRESH * offset_um
    x, y = way.place_um[at].tolist()
    fresh = int(np.searchsorted(way.along_um, way.along_um[at] - reach))
    near = {index: swept[index].places_near((x - reach, y - reach, x + reach, y + reach)) for index in earlier}
    near[contour] = _before(swept[contour].places_near((x - reach, y - reach, x + reach, y + reach)), fresh)
    older = [_nearest(swept[index].way, places, (x, y), index) for index, places in near.items() if len(places)]
    nearest = min(older, key=lambda each: each.off_um, default=None)
    return nearest if nearest is not None and nearest.off_um < reach else None


def _before(places: Ints, past: int) -> Ints:
    return places[: int(np.searchsorted(places, past))]


def bridge_of(ways: Sequence[WireWay], contour: int, at: int, older: Older | None) -> Bridge:
    """The bridge that the wire cuts at a place of a contour, on to an older place."""
    way = ways[contour]
    wire = way.place_um[at]
    other = None if older is None else ways[older.contour]
    x, y = (wire if other is None or older is None else 0.5 * (wire + other.place_um[older.at])).tolist()
    begin = int(np.searchsorted(way.row, way.row[at]))
    last = int(np.searchsorted(way.along_um, way.along_um[at] - _LAST_UM))
    return Bridge(
        place_um=Point(x, y),
        closes_on_block=None if other is None or older is None else int(other.row[older.at]) + 1,
        left_um=float(way.along_um[at] - way.along_um[begin]),
        last_mm_block=int(way.row[last]) + 1,
        last_mm_t_s=float(way.t_s[last]),
    )


def held_after(
    edge_um: shapely.LinearRing, ways: Sequence[WireWay], freeing: int, pauses: Sequence[int], offset_um: float
) -> int | None:
    """How many blocks run before the pause at which a piece hangs on its last bridge; None where there is none.

    It is the last pause before the row `freeing`, if the wire has cut half of the piece's outer edge or more by then.
    `ways` are those that cut beside it, and `pauses` tell how many blocks run before each pause, in order.
    """
    at = int(np.searchsorted(pauses, freeing, side="right")) - 1
    if at < 0:
        return None
    before = [way.place_um[way.row < pauses[at]] for way in ways]
    return int(pauses[at]) if share_made(edge_um, lines_of(before), offset_um) >= 1.0 - _BRIDGE else None


def _nearest(way: WireWay, places: Ints, wire: tuple[float, float], contour: int) -> Older:
    """The place nearest to the wire among some of a way, by their indices."""
    off = np.hypot(*(way.place_um[places] - wire).T)
    at = int(np.argmin(off))
    return Older(contour, int(places[at]), float(off[at]))


_ON_IT = 0.1  # offsets: a start this near to the loop lies on it, and is no lead-in
_NOTCH = 1.5  # offsets that an outline grows and shrinks by, which closes notches two offsets wide
_COARSE_UM = 1.0
_CORNERS = 3  # of a polygon
_LED = 2.0  # offsets of edge that leads made: more than where a lead meets its loop


Kind = Literal["part", "slug", "scrap"]
"""A part; a slug that the wire came from inside of; waste besides."""


class Loose(NamedTuple):
    """What comes free, before it is known what it is.

    Attributes
    ----------
    outline_um
        What stays of it in the end.
    stock_um
        What it came free of.
    contours
        Indices of the contours whose kerfs have a share in its outer edge, in order.
    moment
        When it comes free.
    older
        The older place that the wire closes on to then.
    """

    outline_um: shapely.Polygon
    stock_um: shapely.Polygon
    contours: list[int]
    moment: FreeMoment
    older: Older | None


def kinds_of(found: list[Loose], kerf: Kerf) -> list[Kind]:
    """What each of the pieces of a kerf is."""
    figure = _figures(kerf)
    largest: dict[int, float] = {}
    for piece in found:
        for contour in piece.contours:
            largest[figure[contour]] = max(largest.get(figure[contour], 0.0), piece.outline_um.area)
    kinds: list[Kind] = []
    rows = [swept.way.row for swept in kerf.swept]  # none of a contour that the run did not come to
    ends = np.array([row[[0, -1]] if len(row) else (0, 0) for row in rows], dtype=np.int64).reshape(-1, 2)
    in_kerf = are_in_kerf(kerf.toolpath, ends, np.full(len(ends), CLOSED_WITHIN_UM))

    @cache
    def ring_of(contour: int) -> shapely.Polygon | None:
        return _ring_of(kerf.swept[contour].way, kerf)

    @cache
    def leads_of(contours: tuple[int, ...]) -> shapely.MultiLineString:
        stretches = (_leads(kerf.swept[contour].way, kerf, is_led=not in_kerf[contour]) for contour in contours)
        return lines_of([stretch for each in stretches for stretch in each])

    @cache
    def angle_of(contour: int) -> Floats:
        return _angles_about_start(kerf.swept[contour].way)

    for piece in found:
        beside_larger = any(largest[figure[contour]] > piece.outline_um.area for contour in piece.contours)
        if _held_the_start(piece, kerf, angle_of):
            kinds.append("slug")
        elif beside_larger and (
            _is_sliver(piece.outline_um, kerf.offset_um) or _was_led_by(piece, leads_of, kerf.offset_um)
        ):
            kinds.append("scrap")
        elif piece.older is not None and _lay_within_pass(piece, ring_of(piece.contours[0])):
            kinds.append("slug")
        else:
            kinds.append("part")
    return kinds


def _figures(kerf: Kerf) -> list[int]:
    """Of each contour the first one that has an edge in common with it: trims may follow behind a jump."""
    first: dict[int, int] = {}
    figure = []
    for contour, swept in enumerate(kerf.swept):
        edges = [edge for edge in np.unique(kerf.pass_edge[swept.way.row]).tolist() if edge >= 0]
        of = min((first[edge] for edge in edges if edge in first), default=contour)
        first.update(dict.fromkeys(edges, of))
        figure.append(of)
    return figure


def _held_the_start(piece: Loose, kerf: Kerf, angle_of: Callable[[int], Floats]) -> bool:
    """Whether the wire came from inside of a piece; never where it was the edge of the work that closed the cut."""
    if piece.older is None:
        return False
    contour = piece.moment.contour
    if piece.older.contour == contour:
        loop = slice(piece.older.at, piece.moment.at + 1)
        return came_from_inside(kerf.swept[contour].way, loop, angle_of(contour), kerf.offset_um)
    # Several contours cut round it, since a bridge was left for later: the start of the first one tells.
    return began_in(kerf.swept[piece.contours[0]].way, piece.outline_um, kerf.offset_um)


def _lay_within_pass(piece: Loose, ring_um: shapely.Polygon | None) -> bool:
    """Whether a pass ran round a piece and round the start of its contour, but for a bridge that was left for later.

    Leads that part widely may have cut the start off the piece, or have closed the cut where they meet at the start.
    """
    return ring_um is not None and ring_um.contains(piece.outline_um.representative_point())


def _ring_of(way: WireWay, kerf: Kerf) -> shapely.Polygon | None:
    """The first pass of a way as a ring, closed over a bridge; None where it does not run round the way's start."""
    edge = kerf.pass_edge[way.row]
    on_pass = np.flatnonzero(edge >= 0)
    if not len(on_pass):
        return None
    begin = int(on_pass[0])
    behind = np.flatnonzero(edge[begin:] != edge[begin])
    place = way.place_um[begin : begin + int(behind[0]) if len(behind) else len(edge)]
    length_um = float(np.hypot(*np.diff(place, axis=0).T).sum())
    if len(place) < _CORNERS or math.dist(place[0], place[-1]) > WIDEST_TAB * length_um:
        return None
    ring = shapely.Polygon(place)
    shapely.prepare(ring)  # a contour may free many pieces
    return ring if ring.contains(shapely.Point(way.place_um[0])) else None


def came_from_inside(way: WireWay, loop: slice, angle_rad: Floats, offset_um: float) -> bool:
    """Whether a way starts inside the loop of some of its places, and not on the loop.

    `angle_rad` are those of `_angles_about_start`.
    """
    places, angle = way.place_um[loop], angle_rad[loop]
    if len(places) < 4:
        return False
    back = (angle[0] - angle[-1] + np.pi) % (2.0 * np.pi) - np.pi
    if abs(angle[-1] - angle[0] + back) <= np.pi:
        return False
    return bool(shapely.LinearRing(places).distance(shapely.Point(way.place_um[0])) > _ON_IT * offset_um)


def _angles_about_start(way: WireWay) -> Floats:
    """Angles (m,) of the places of a way seen from its start, rad; none is half a turn or more from the one before."""
    out = way.place_um - way.place_um[0]
    angles: Floats = np.unwrap(np.arctan2(out[:, 1], out[:, 0]))
    return angles


def began_in(way: WireWay, piece_um: shapely.Polygon, offset_um: float) -> bool:
    """Whether the wire starts within the outline of a piece, or in the notch that its lead-in left in there."""
    outline = shapely.simplify(shapely.Polygon(piece_um.exterior), _COARSE_UM)
    closed = outline.buffer(_NOTCH * offset_um).buffer(-_NOTCH * offset_um)
    return bool(closed.contains(shapely.Point(way.place_um[0])))


def _is_sliver(piece_um: shapely.Polygon, offset_um: float) -> bool:
    """Whether a piece is nowhere wider than the kerf; the mean width of a strip is twice its area by its length."""
    return 2.0 * piece_um.area < 2.0 * offset_um * piece_um.length and bool(piece_um.buffer(-offset_um).is_empty)


def _was_led_by(piece: Loose, leads_of: Callable[[tuple[int, ...]], shapely.MultiLineString], offset_um: float) -> bool:
    """Whether leads of the contours about a piece made some of its outer edge: more than where a lead meets it."""
    edge = piece.outline_um.exterior
    return share_made(edge, leads_of(tuple(piece.contours)), offset_um) * edge.length > _LED * offset_um


def _leads(way: WireWay, kerf: Kerf, *, is_led: bool) -> list[Floats]:
    """Stretches of a way that are leads; of a contour that `is_led`, the first block is one, pass or not."""
    is_lead = kerf.leads[way.row] | ((way.row == way.row[0]) & is_led)
    starts = np.flatnonzero(np.diff(is_lead, prepend=False) & is_lead)
    ends = np.flatnonzero(np.diff(is_lead, append=False) & is_lead) + 1
    return [way.place_um[low:high] for low, high in zip(starts.tolist(), ends.tolist(), strict=True)]
