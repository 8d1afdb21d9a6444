"""The pieces that the kerf leaves: what each is, which contour frees it and when, and what held it last."""

from collections.abc import Iterator, Sequence
from typing import Literal, NamedTuple

import numpy as np
import shapely

from parser.shape.loops import rounds_from_within
from parser.toolpath import Point, Toolpath
from sim.cut.kerf.swept import Kerf
from sim.cut.kerf.ways import WireWay
from sim.cut.pieces.cut_on import Rest, cut_on_um
from sim.cut.pieces.frees import Cutting, FreeMoment, moments_of
from sim.cut.pieces.kinds import Bridge, Kind, Loose, bridge_of, held_after, kinds_of, older_place
from sim.cut.regions import parted
from sim.setup.obstacles import Outline

_CRUMB_MM2 = 0.001  # some 30 µm square, or cusps where the wire leaves its kerf: nothing that anyone picks up
_BESIDE_UM = 1.0  # from a part to the kerfs that bound it: far more than their regions are inexact by
_EARLY = 2.0  # kerf widths that the wire may still cut in a piece that is free


class Material(NamedTuple):
    """Thickness of the work, and its density: 7.85 g/cm³ of steel, 8.0 of tool steels."""

    thickness_mm: float
    density_g_cm3: float

    def mass_g(self, area_mm2: float) -> float:
        """Mass of a piece of the work."""
        return area_mm2 * self.thickness_mm * self.density_g_cm3 * 1e-3


class Freed(NamedTuple):
    """When a piece comes free: contour and block numbers, from 1, time, and where the wire's centre is then."""

    contour: int
    block: int
    t_s: float
    wire_um: Point


class Piece(NamedTuple):
    """What comes free of the frame.

    Attributes
    ----------
    kind
        ``slug`` where the wire came from inside of it, a die's waste, and where it is scrap; else ``part``.
    is_scrap
        Whether it is waste that falls off beside a larger piece: it leaves no opening that is kept.
    outline_um
        Shapely polygon, with holes.
    area_mm2, mass_g, center_um
        Of the piece; its centre of gravity.
    freed
        When and by what.
    bridge
        What held it last.
    held_after_block
        The program pauses behind this block, where the piece still hangs on its last bridge: there the operator can
        clamp it. None where there is no such pause.
    cut_after_um
        How far the wire still cuts in it once it is free: on the contour that freed it and, in a part, on later ones,
        such as trims.
    early
        Whether it comes free before its cut is done, and nobody holds it: whether `cut_after_um` is more than two kerf
        widths. In a slug the wire may also cut a lead-out, as long as its lead-in.
    """

    kind: Literal["part", "slug"]
    is_scrap: bool
    outline_um: shapely.Polygon
    area_mm2: float
    mass_g: float
    center_um: Point
    freed: Freed
    bridge: Bridge
    held_after_block: int | None
    cut_after_um: float
    early: bool


class Frame(NamedTuple):
    """What stays.

    Attributes
    ----------
    outline_um, area_mm2, mass_g
        Its polygon, area and mass where the outline of the work is known.
    openings_um
        The openings in it.
    cleared_um
        Those of them that the wire went round from within, and of which nothing is left that falls: cut without a core,
        or so small that their slugs are crumbs.
    """

    outline_um: shapely.Polygon | None
    area_mm2: float | None
    mass_g: float | None
    openings_um: tuple[shapely.Polygon, ...]
    cleared_um: tuple[shapely.Polygon, ...] = ()


class Pieces(NamedTuple):
    """All that is left: the frame, pieces in the order they come free, and how many crumbs under 0.001 mm² besides."""

    frame: Frame
    freed: tuple[Piece, ...]
    crumbs: int


def pieces_of(kerf: Kerf, work_um: Outline | None, material: Material, pauses: Sequence[int] = ()) -> Pieces:
    """Pieces that a kerf leaves of the work, or of a plane without end where its outline is not known.

    `pauses` tell how many blocks run before each pause of the program, in order.
    """
    stock = stock_of(kerf, work_um)
    parts = parted(stock, kerf.region_um)
    frame = _frame(parts, stock)
    others = [part for part in parts if part is not frame]
    whole = [part for part in others if part.area * 1e-6 >= _CRUMB_MM2]
    kerfs = shapely.STRtree([each.region_um for each in kerf.swept])
    rounds = _rounds(kerfs, whole)
    crumbs = [part for part in others if part.area * 1e-6 < _CRUMB_MM2]
    moments = moments_of(Cutting(stock, frame, whole, rounds, crumbs, kerf.swept))
    loosened = zip(whole, rounds, moments, strict=True)
    loose = [_loose(kerf, stock, part, round_, moment) for part, round_, moment in loosened if moment is not None]
    kinds = kinds_of(loose, kerf)
    cuts = _Cuts(kerf, kerfs, pauses, material, {})
    found = [_piece(cuts, piece, kind) for piece, kind in zip(loose, kinds, strict=True)]
    pieces = sorted(found, key=lambda piece: piece.freed.t_s)
    stays = _as_frame(frame, work_um, material)
    stays = stays._replace(cleared_um=tuple(_cleared(kerf.toolpath, stays.openings_um, whole)))
    return Pieces(stays, tuple(pieces), len(others) - len(whole))


def stock_of(kerf: Kerf, work_um: Outline | None) -> shapely.Polygon:
    """Polygon of the work, or a box round the kerf for a plane without end."""
    if work_um is not None:
        return shapely.Polygon(work_um)
    if shapely.is_empty(kerf.region_um):
        return shapely.Polygon()
    low_x, low_y, high_x, high_y = kerf.region_um.bounds
    margin = 10.0 * kerf.offset_um
    return shapely.box(low_x - margin, low_y - margin, high_x + margin, high_y + margin)


def _frame(parts: list[shapely.Polygon], stock: shapely.Polygon) -> shapely.Polygon:
    """The largest part that has some of the stock's own edge: what the clamps hold."""
    edged = [part for part in parts if part.intersects(stock.exterior)]
    return max(edged or parts, key=lambda part: part.area, default=shapely.Polygon())


def _as_frame(frame: shapely.Polygon, work_um: Outline | None, material: Material) -> Frame:
    openings = tuple(shapely.Polygon(ring) for ring in frame.interiors)
    if work_um is None:
        return Frame(None, None, None, openings)
    area = frame.area * 1e-6
    return Frame(frame, area, material.mass_g(area), openings)


def _cleared(
    toolpath: Toolpath, openings: Sequence[shapely.Polygon], whole: Sequence[shapely.Polygon]
) -> Iterator[shapely.Polygon]:
    """Openings without any part in them that hold the start of a loop round its own start hole."""
    places = np.asarray(shapely.point_on_surface(whole), dtype=np.object_)
    full, _ = shapely.STRtree(places).query(np.array(openings, dtype=np.object_), predicate="contains")
    empty = [openings[at] for at in np.setdiff1d(np.arange(len(openings)), full).tolist()]
    if empty:
        starts = np.asarray(shapely.points(toolpath.start_um[rounds_from_within(toolpath)]), dtype=np.object_)
        holds, _ = shapely.STRtree(starts).query(np.array(empty, dtype=np.object_), predicate="contains")
        yield from (empty[at] for at in np.unique(holds).tolist())


class _Cuts(NamedTuple):
    """The kerf, the kerfs of its contours in a tree, the pauses between the blocks, and what is cut.

    `after_um` is what the wire cuts on in pieces that are known, by the polygon at their moment and whether it is a
    slug: parts that come free together are one then.
    """

    kerf: Kerf
    kerfs: shapely.STRtree
    pauses: Sequence[int]
    material: Material
    after_um: dict[tuple[int, bool], float]


def _loose(kerf: Kerf, stock: shapely.Polygon, part: shapely.Polygon, contours: list[int], moment: FreeMoment) -> Loose:
    """A part as it comes free."""
    earlier = [index for index in contours if index < moment.contour]
    older = older_place(kerf.swept, earlier, moment.contour, moment.at, kerf.offset_um)
    return Loose(part, stock, contours, moment, older)


def _piece(cuts: _Cuts, loose: Loose, kind: Kind) -> Piece:
    is_slug = kind != "part"
    kerf, part, older = cuts.kerf, loose.outline_um, loose.older
    contour, at = loose.moment.contour, loose.moment.at
    ways = [each.way for each in kerf.swept]
    lead_um = float(ways[contour].along_um[older.at]) if is_slug and older and older.contour == contour else 0.0
    area = part.area * 1e-6
    after = _cut_after_um(cuts, loose, is_slug=is_slug)
    freed = _freed(ways[contour], loose.moment)
    beside_contours = [ways[index] for index in loose.contours if index <= contour]
    pause = held_after(loose.moment.piece_um.exterior, beside_contours, freed.block - 1, cuts.pauses, kerf.offset_um)
    return Piece(
        kind="slug" if is_slug else "part",
        is_scrap=kind == "scrap",
        outline_um=part,
        area_mm2=area,
        mass_g=cuts.material.mass_g(area),
        center_um=Point(part.centroid.x, part.centroid.y),
        freed=freed,
        bridge=bridge_of(ways, contour, at, older),
        held_after_block=pause,
        cut_after_um=after,
        early=pause is None and after > _EARLY * 2.0 * kerf.offset_um + lead_um,
    )


def _freed(way: WireWay, moment: FreeMoment) -> Freed:
    x, y = way.place_um[moment.at].tolist()
    return Freed(moment.contour + 1, int(way.row[moment.at]) + 1, float(way.t_s[moment.at]), Point(x, y))


def _rounds(kerfs: shapely.STRtree, parts: list[shapely.Polygon]) -> list[list[int]]:
    """Contours whose kerfs have a share in the outer edge of each part: they enclose it, with the edge of the work."""
    edges = shapely.get_exterior_ring(np.array(parts, dtype=np.object_))
    found: list[list[int]] = [[] for _ in parts]
    if not parts:
        return found
    near = shapely.STRtree(edges)
    for contour, region in enumerate(kerfs.geometries):
        shapely.prepare(region)  # one contour may free thousands of parts
        for part in near.query(region, predicate="dwithin", distance=_BESIDE_UM).tolist():
            found[part].append(contour)
    return found


def _cut_after_um(cuts: _Cuts, loose: Loose, *, is_slug: bool) -> float:
    """How far the wire goes on in a part once it is free, and in those that come free with it."""
    together = id(loose.moment.piece_um), is_slug
    if together not in cuts.after_um:
        rests = _after(cuts, loose, is_slug=is_slug)
        cuts.after_um[together] = cut_on_um(loose.moment.piece_um, rests, cuts.kerf.offset_um)
    return cuts.after_um[together]


def _after(cuts: _Cuts, loose: Loose, *, is_slug: bool) -> list[Rest]:
    """What may be cut in a piece once it is free.

    Later contours count in a part alone: a slug is taken out before them. They do not count either in a part with some
    of the work's own edge, since a clamp may hold it there.
    """
    swept, moment = cuts.kerf.swept, loose.moment
    rest = Rest(swept[moment.contour], moment.at)
    if is_slug or moment.piece_um.intersects(loose.stock_um.exterior):
        return [rest]
    met = np.sort(cuts.kerfs.query(moment.piece_um, predicate="intersects"))
    return [rest, *(Rest(swept[at], 0) for at in met[met > moment.contour].tolist())]
