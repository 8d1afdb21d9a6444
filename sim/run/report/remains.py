"""Entries of the report on what a cut leaves: kerf, frame, pieces and sizes."""

import math

import numpy as np
import shapely

from parser.toolpath import Point
from sim.base.rounded import column, corners, known, moment, place, rounded, rows
from sim.cut.kerf.edges import Range
from sim.cut.kerf.swept import Kerf
from sim.cut.pieces.pieces import Frame, Piece
from sim.cut.play.freedom import Play
from sim.cut.remains import Remains
from sim.cut.sizes.sizes import BoxSize, DistanceSize, RadiusSize, Sizes
from sim.run.outlines import simpler
from sim.run.report.cut_model import (
    BoxEntry,
    DistanceEntry,
    FrameEntry,
    KerfBlockEntry,
    KerfEntry,
    PieceEntry,
    PlayEntry,
    RadiusEntry,
    RangeEntry,
    RemainsEntry,
    SizesEntry,
)

_OUTLINE_UM = 1.0  # one step, as exact as the cut is known anyway


def remains_entry(remains: Remains | None, ran_s: float) -> RemainsEntry | None:
    """``remains`` of a run of `ran_s`; None where nobody asked for it."""
    if remains is None:
        return None
    pieces = remains.pieces
    return {
        "kerf": _kerf(remains.kerf),
        "frame": _frame(pieces.frame),
        "pieces": [_piece(piece, play, ran_s) for piece, play in zip(pieces.freed, remains.plays, strict=True)],
        "crumbs": pieces.crumbs,
        "sizes": _sizes(remains.sizes),
    }


def _kerf(kerf: Kerf) -> KerfEntry:
    number = list(range(1, len(kerf.width.mean_um) + 1))
    sides = {"left_um": _ranges(kerf.left), "right_um": _ranges(kerf.right), "width_um": _ranges(kerf.width)}
    return {
        "area_mm2": rounded(kerf.area_mm2),
        "blocks": rows(KerfBlockEntry, {"block": number, **sides}),
    }


def _ranges(side: Range) -> list[RangeEntry]:
    columns = {"mean": column(side.mean_um), "min": column(side.min_um), "max": column(side.max_um)}
    return rows(RangeEntry, columns)


def _frame(frame: Frame) -> FrameEntry:
    return {
        "area_mm2": known(frame.area_mm2),
        "mass_g": known(frame.mass_g),
        "openings_um": [_ring(opening.exterior) for opening in frame.openings_um],
    }


def _piece(piece: Piece, play: Play, ran_s: float) -> PieceEntry:
    freed, bridge = piece.freed, piece.bridge
    return {
        "kind": piece.kind,
        "area_mm2": rounded(piece.area_mm2),
        "mass_g": rounded(piece.mass_g),
        "center_um": place(piece.center_um),
        "freed": {
            "contour": freed.contour,
            "block": freed.block,
            "t_s": moment(freed.t_s, ran_s),
            "wire_um": place(freed.wire_um),
        },
        "bridge": {
            "place_um": place(bridge.place_um),
            "closes_on_block": bridge.closes_on_block,
            "left_um": rounded(bridge.left_um),
            "last_mm_block": bridge.last_mm_block,
            "last_mm_t_s": moment(bridge.last_mm_t_s, ran_s),
        },
        "held_after_block": piece.held_after_block,
        "cut_after_um": rounded(piece.cut_after_um),
        "early": piece.early,
        "play": _play(play),
        "outline_um": _ring(piece.outline_um.exterior),
        "holes_um": [_ring(hole) for hole in piece.outline_um.interiors],
    }


def _play(play: Play) -> PlayEntry:
    pinch = play.pinch
    return {
        "shifts": [
            {"toward_deg": shift.toward_deg, "by_um": _finite(shift.by_um), "touches_um": _touched(shift.touches_um)}
            for shift in play.shifts
        ],
        "turns": [{"by_deg": _finite(turn.by_deg), "touches_um": _touched(turn.touches_um)} for turn in play.turns],
        "pinch": {
            "wall_um": place(pinch.wall_um),
            "width_um": rounded(pinch.width_um),
            "narrowest_um": rounded(pinch.narrowest_um),
            "pinches": pinch.pinches,
            "after_um": rounded(pinch.after_um),
        },
        "exact_to_um": rounded(play.exact_to_um),
    }


def _sizes(sizes: Sizes) -> SizesEntry:
    return {
        "boxes": [_box(box) for box in sizes.boxes],
        "radii": [_radius(radius) for radius in sizes.radii],
        "distances": [_distance(distance) for distance in sizes.distances],
    }


def _box(box: BoxSize) -> BoxEntry:
    return {
        "what": box.what,
        "piece": box.piece + 1,
        "center_um": place(box.center_um),
        "cut_um": place(box.cut_um),
        "nominal_um": place(box.nominal_um),
    }


def _radius(radius: RadiusSize) -> RadiusEntry:
    return {
        "what": radius.what,
        "block": radius.block,
        "center_um": place(radius.center_um),
        "cut_um": rounded(radius.cut_um),
        "nominal_um": rounded(radius.nominal_um),
        "form_um": rounded(radius.form_um),
    }


def _distance(distance: DistanceSize) -> DistanceEntry:
    return {
        "what": distance.what,
        "blocks": list(distance.blocks),
        "cut_um": rounded(distance.cut_um),
        "nominal_um": rounded(distance.nominal_um),
    }


def _ring(ring: shapely.LinearRing) -> list[list[float]]:
    """Corners of a closed outline, the first one once; of 100,000 some 1000 tell it to 1 µm."""
    return corners(np.asarray(simpler(ring, _OUTLINE_UM).coords)[:-1, :2])


def _finite(value: float) -> float | None:
    return rounded(value) if math.isfinite(value) else None


def _touched(at: Point) -> list[float] | None:
    return place(at) if math.isfinite(at.x) else None
