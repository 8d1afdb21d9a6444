"""Entries of the report on what a cut leaves: kerf, frame, pieces and sizes."""

import math
from collections.abc import Iterable
from typing import Any

import numpy as np
import shapely

from parser.toolpath import Point
from sim.base.rounded import column, known, moment, points, rounded, rows
from sim.cut.kerf.edges import Range
from sim.cut.kerf.swept import Kerf
from sim.cut.pieces.pieces import Frame, Piece
from sim.cut.play.freedom import Play
from sim.cut.remains import Remains
from sim.cut.sizes.sizes import BoxSize, DistanceSize, RadiusSize, Sizes
from sim.run.outlines import simpler

_OUTLINE_UM = 1.0  # one step, as exact as the cut is known anyway


def remains_entry(remains: Remains | None, ran_s: float) -> dict[str, Any] | None:
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


def _kerf(kerf: Kerf) -> dict[str, Any]:
    number = list(range(1, len(kerf.width.mean_um) + 1))
    sides = {"left_um": kerf.left, "right_um": kerf.right, "width_um": kerf.width}
    return {
        "area_mm2": rounded(kerf.area_mm2),
        "blocks": rows({"block": number, **{name: rows(_range(side)) for name, side in sides.items()}}),
    }


def _range(side: Range) -> dict[str, list[Any]]:
    return {"mean": column(side.mean_um), "min": column(side.min_um), "max": column(side.max_um)}


def _frame(frame: Frame) -> dict[str, Any]:
    return {
        "area_mm2": known(frame.area_mm2),
        "mass_g": known(frame.mass_g),
        "openings_um": [_ring(opening.exterior) for opening in frame.openings_um],
    }


def _piece(piece: Piece, play: Play, ran_s: float) -> dict[str, Any]:
    freed, bridge = piece.freed, piece.bridge
    return {
        "kind": piece.kind,
        "area_mm2": rounded(piece.area_mm2),
        "mass_g": rounded(piece.mass_g),
        "center_um": _place(piece.center_um),
        "freed": {
            "contour": freed.contour,
            "block": freed.block,
            "t_s": moment(freed.t_s, ran_s),
            "wire_um": _place(freed.wire_um),
        },
        "bridge": {
            "place_um": _place(bridge.place_um),
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


def _play(play: Play) -> dict[str, Any]:
    pinch = play.pinch
    return {
        "shifts": [
            {"toward_deg": shift.toward_deg, "by_um": _finite(shift.by_um), "touches_um": _touched(shift.touches_um)}
            for shift in play.shifts
        ],
        "turns": [{"by_deg": _finite(turn.by_deg), "touches_um": _touched(turn.touches_um)} for turn in play.turns],
        "pinch": {
            "wall_um": _place(pinch.wall_um),
            "width_um": rounded(pinch.width_um),
            "narrowest_um": rounded(pinch.narrowest_um),
            "pinches": pinch.pinches,
            "after_um": rounded(pinch.after_um),
        },
        "exact_to_um": rounded(play.exact_to_um),
    }


def _sizes(sizes: Sizes) -> dict[str, Any]:
    return {
        "boxes": [_box(box) for box in sizes.boxes],
        "radii": [_radius(radius) for radius in sizes.radii],
        "distances": [_distance(distance) for distance in sizes.distances],
    }


def _box(box: BoxSize) -> dict[str, Any]:
    return {
        "what": box.what,
        "piece": box.piece + 1,
        "center_um": _place(box.center_um),
        "cut_um": _place(box.cut_um),
        "nominal_um": _place(box.nominal_um),
    }


def _radius(radius: RadiusSize) -> dict[str, Any]:
    return {
        "what": radius.what,
        "block": radius.block,
        "center_um": _place(radius.center_um),
        "cut_um": rounded(radius.cut_um),
        "nominal_um": rounded(radius.nominal_um),
        "form_um": rounded(radius.form_um),
    }


def _distance(distance: DistanceSize) -> dict[str, Any]:
    return {
        "what": distance.what,
        "blocks": list(distance.blocks),
        "cut_um": rounded(distance.cut_um),
        "nominal_um": rounded(distance.nominal_um),
    }


def _ring(ring: shapely.LinearRing) -> list[list[float] | None]:
    """Corners of a closed outline, the first one once; of 100,000 some 1000 tell it to 1 µm."""
    return points(np.asarray(simpler(ring, _OUTLINE_UM).coords)[:-1, :2])


def _place(place: Iterable[float]) -> list[float]:
    return [rounded(by) for by in place]


def _finite(value: float) -> float | None:
    return rounded(value) if math.isfinite(value) else None


def _touched(place: Point) -> list[float] | None:
    return _place(place) if math.isfinite(place.x) else None
