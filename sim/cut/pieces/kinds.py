"""Which pieces are parts and which are waste: slugs, and what falls off between cuts.

The wire is threaded in the waste, and its leads run through it. So a piece is waste where the wire came from inside of
it. Besides, two kinds of waste fall beside a larger piece that the same contour cuts: a sliver between two passes, no
wider than the kerf anywhere, and a scrap between leads that part from it: those of one pass, or of a rough cut and of a
trim that starts elsewhere, in a contour of its own or not.
"""

import math
from functools import cache
from typing import Literal, NamedTuple

import numpy as np
import shapely

from parser.geometry.curves import Floats
from parser.shape.passes import WIDEST_TAB
from sim.cut.kerf.makers import share_made
from sim.cut.kerf.region import Kerf
from sim.cut.kerf.swept import Swept
from sim.cut.kerf.ways import WireWay
from sim.cut.pieces.bridges import Older
from sim.cut.pieces.frees import FreeMoment

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

    @cache
    def ring_of(contour: int) -> shapely.Polygon | None:
        return _ring_of(kerf.swept[contour].way, kerf)

    for piece in found:
        beside_larger = any(largest[figure[contour]] > piece.outline_um.area for contour in piece.contours)
        if _held_the_start(piece, kerf.swept, kerf.offset_um):
            kinds.append("slug")
        elif beside_larger and (_is_sliver(piece.outline_um, kerf.offset_um) or _was_led_by(piece, kerf)):
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


def _held_the_start(piece: Loose, swept: tuple[Swept, ...], offset_um: float) -> bool:
    """Whether the wire came from inside of a piece; never where it was the edge of the work that closed the cut."""
    if piece.older is None:
        return False
    if piece.older.contour == piece.moment.contour:
        return came_from_inside(swept[piece.moment.contour].way, piece.older.at, piece.moment.at, offset_um)
    # Several contours cut round it, since a bridge was left for later: the start of the first one tells.
    return began_in(swept[piece.contours[0]].way, piece.outline_um, offset_um)


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


def came_from_inside(way: WireWay, begin: int, end: int, offset_um: float) -> bool:
    """Whether a way starts inside the loop between its places `begin` and `end` (indices), and not on the loop."""
    if end - begin < 3:
        return False
    loop = way.place_um[begin : end + 1]
    out = loop - way.place_um[0]
    angle = np.arctan2(out[:, 1], out[:, 0])
    turned = np.diff(np.unwrap(np.append(angle, angle[0]))).sum()
    ring = shapely.LinearRing(loop)
    return bool(abs(turned) > np.pi and ring.distance(shapely.Point(way.place_um[0])) > _ON_IT * offset_um)


def began_in(way: WireWay, piece_um: shapely.Polygon, offset_um: float) -> bool:
    """Whether the wire starts within the outline of a piece, or in the notch that its lead-in left in there."""
    outline = shapely.simplify(shapely.Polygon(piece_um.exterior), _COARSE_UM)
    closed = outline.buffer(_NOTCH * offset_um).buffer(-_NOTCH * offset_um)
    return bool(closed.contains(shapely.Point(way.place_um[0])))


def _is_sliver(piece_um: shapely.Polygon, offset_um: float) -> bool:
    """Whether a piece is nowhere wider than the kerf; the mean width of a strip is twice its area by its length."""
    return 2.0 * piece_um.area < 2.0 * offset_um * piece_um.length and bool(piece_um.buffer(-offset_um).is_empty)


def _was_led_by(piece: Loose, kerf: Kerf) -> bool:
    """Whether leads of the contours about a piece made some of its outer edge: more than where a lead meets it."""
    leads = [stretch for contour in piece.contours for stretch in _leads(kerf.swept[contour].way, kerf)]
    edge = piece.outline_um.exterior
    return share_made(edge, leads, kerf.offset_um) * edge.length > _LED * kerf.offset_um


def _leads(way: WireWay, kerf: Kerf) -> list[Floats]:
    """Stretches of a way that are leads; the first block of a contour is one, also where no pass was found."""
    is_lead = kerf.leads[way.row] | (way.row == way.row[0])
    starts = np.flatnonzero(np.diff(is_lead, prepend=False) & is_lead)
    ends = np.flatnonzero(np.diff(is_lead, append=False) & is_lead) + 1
    return [way.place_um[low:high] for low, high in zip(starts.tolist(), ends.tolist(), strict=True)]
