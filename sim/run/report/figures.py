"""Entries of the report: how the run went, and what its cut leaves.

Entries of the report on how the run went: the offset added, deviation by cause, limits met, and what was lost.

Entries of the report on what a cut leaves: kerf, frame, pieces and sizes.
"""

import math

import numpy as np
import shapely

from controller.offset.chain import RowOrigin
from parser.geometry.curves import CurveKind, Ints
from parser.toolpath import Point
from sim.base.units import DEG_DIGITS, column, corners, known, moment, place, points, rounded, rows
from sim.check.offset import Offsetting
from sim.cut.kerf.edges import Range
from sim.cut.kerf.swept import Kerf
from sim.cut.pieces.pieces import Frame, Piece
from sim.cut.play import Play
from sim.cut.regions import simpler
from sim.cut.remains import Remains
from sim.cut.sizes import BoxSize, DistanceSize, RadiusSize, Sizes
from sim.measure.causes import Deviations, Part
from sim.measure.deviation import Deviation, Where
from sim.process.cut import Moment, ProcessRun
from sim.process.spread import LEVEL
from sim.run.dryrun import DryRun, Ending
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
from sim.run.report.run_model import (
    CauseEntry,
    DeviationEntry,
    DeviationsEntry,
    EndedEntry,
    LimitEntry,
    LossEntry,
    OffsetBlockEntry,
    OffsetEntry,
    SparkEntry,
    SparkMomentEntry,
    WhereEntry,
)
from sim.table.losses import Loss, Peak


def deviation_entries(deviations: Deviations, ran_s: float) -> DeviationsEntry:
    """``deviation`` in a run of `ran_s`: of steps, table and wire, and what each cause adds."""
    causes = deviations.by_cause
    return {
        "interpolation": _deviation(deviations.interpolation, ran_s),
        "steps": _deviation(deviations.steps, ran_s),
        "table": _deviation(deviations.table, ran_s),
        "wire": _deviation(deviations.wire, ran_s),
        "by_cause": {
            "interpolation": _part(causes.interpolation, ran_s),
            "carried": _part(causes.carried, ran_s),
            "planning": _part(causes.planning, ran_s),
            "table": _part(causes.table, ran_s),
            "wire": _part(causes.wire, ran_s),
        },
    }


def _deviation(deviation: Deviation, ran_s: float) -> DeviationEntry:
    return {
        "max_um": rounded(deviation.max_um),
        "rms_um": rounded(deviation.rms_um),
        "p95_um": rounded(deviation.p95_um),
        "where": _where(deviation.where, ran_s),
    }


def _part(part: Part, ran_s: float) -> CauseEntry:
    return {"max_um": rounded(part.max_um), "where": _where(part.where, ran_s)}


def _where(where: Where | None, ran_s: float) -> WhereEntry | None:
    if where is None:
        return None
    x, y = rounded(where.x_um), rounded(where.y_um)
    return {"block": where.block, "x_um": x, "y_um": y, "t_s": moment(where.t_s, ran_s)}


def limit_entry(peak: Peak, ran_s: float) -> LimitEntry:
    """One entry of ``limits[]`` of a run of `ran_s`: force N, speed µm/s, lag µm."""
    limited = math.isfinite(peak.limit)
    return {
        "quantity": peak.quantity,
        "axis": peak.axis.name,
        "value": rounded(peak.value),
        "limit": rounded(peak.limit) if limited else None,
        "share": rounded(peak.share) if limited else None,
        **_met(peak, ran_s),
    }


def loss_entry(loss: Loss, ran_s: float) -> LossEntry:
    """One entry of ``losses[]`` of a run of `ran_s`."""
    return {
        "kind": loss.kind,
        "axis": loss.axis.name,
        "amount_um": rounded(loss.amount_um),
        "least_um": rounded(loss.least_um),
        "most_um": rounded(loss.most_um),
        **_met(loss, ran_s),
    }


def ended_entry(run: DryRun) -> EndedEntry | None:
    """``ended``; None where the program ran to its end."""
    ended = run.ended
    return ended and {"cause": ended.cause, "axis": ended.axis.name, **_met(ended, ended.t_s)}


def _met(event: Peak | Loss | Ending, ran_s: float) -> WhereEntry:
    """Block, time and place of what happened in a run of `ran_s`."""
    x, y = rounded(event.x_um), rounded(event.y_um)
    return {"block": event.row + 1, "t_s": moment(event.t_s, ran_s), "x_um": x, "y_um": y}


def spark_entry(process: ProcessRun | None) -> SparkEntry | None:
    """``spark``; None where nothing was cut under sparks."""
    if process is None:
        return None
    mean, stopped = process.mean, process.stopped
    return {
        "mean_voltage_share": rounded(mean.voltage_share),
        "gap_um": rounded(mean.gap_um),
        "area_rate_mm2_min": rounded(mean.area_rate_mm2_min),
        "feed_um_s": rounded(mean.feed_um_s),
        "shorts": process.shorts,
        "breaks": process.breaks,
        "retreated_um": rounded(process.retreated_um),
        "lost_s": rounded(process.lost_s),
        "time_s": rounded(process.time_s),
        "time_within_s": None
        if process.within is None
        else {"least": rounded(process.within.least_s), "most": rounded(process.within.most_s), "level": LEVEL},
        "sparks": process.sparks,
        "seed": process.spark.seed,
        "stopped": None if stopped is None else _spark_moment(stopped),
        "events": [_spark_moment(each) for each in process.moments],
        "events_unlisted": process.unlisted,
        "marks": [
            {
                "block": mark.row + 1,
                "x_um": rounded(mark.place_um.x),
                "y_um": rounded(mark.place_um.y),
                "depth_um": rounded(mark.depth_um),
                "within_um": rounded(mark.within_um),
            }
            for mark in process.marks
        ],
        "displaced_um": None if process.displaced_um is None else place(process.displaced_um),
        "collided_um": known(process.collided_um),
    }


def _spark_moment(moment: Moment) -> SparkMomentEntry:
    return {
        "kind": moment.kind,
        "block": moment.row + 1,
        "step": moment.counters.made,
        "t_s": rounded(moment.t_s),
        "x_um": rounded(moment.place_um.x),
        "y_um": rounded(moment.place_um.y),
        "deviation": moment.counters.deviation,
        "count_left_um": moment.counters.count_left_um,
    }


def offset_entry(run: DryRun) -> OffsetEntry | None:
    """``offset``; None where the program ran as written."""
    made = run.offset
    if made is None:
        return None
    of_row, of_drawn = run.toolpath.source.block, made.passed.drawn.source.block
    return {
        "by_um": rounded(made.by_um),
        "side": made.side.name.lower(),
        "passes": [
            {
                "by_um": rounded(pass_.by_um),
                "direction": "back" if pass_.is_back else "forward",
                "feed_um_s": rounded(feed_um_s),
            }
            for pass_, feed_um_s in zip(made.passes, run.pass_feed_um_s, strict=True)
        ],
        "blocks": _blocks(made, of_row),
        "vanished": [
            {
                "source_block": int(of_drawn[made.passed.row[row]]),
                "pass": int(made.passed.number[row]) + 1 or None,
                "left_um": rounded(left_um),
            }
            for row, left_um in zip(made.path.vanished.tolist(), made.left_um.tolist(), strict=True)
        ],
        "gouges": [
            {
                "block": gouge.path_row + 1,
                "source_block": int(of_row[gouge.path_row]),
                "into_source_block": int(of_drawn[made.passed.row[gouge.row]]),
                "where_um": [rounded(gouge.place_um.x), rounded(gouge.place_um.y)],
                "depth_um": rounded(gouge.depth_um),
            }
            for gouge in made.gouges
        ],
        "closed_paths": list(made.loops),
    }


def _blocks(made: Offsetting, of_row: Ints) -> list[OffsetBlockEntry]:
    curves = made.path.curves
    arc = curves.is_arc
    return rows(
        OffsetBlockEntry,
        {
            "block": list(range(1, len(curves) + 1)),
            "source_block": of_row.tolist(),
            "pass": [number + 1 or None for number in made.pass_of_row.tolist()],
            "kind": [CurveKind(kind).name.lower() for kind in curves.kind.tolist()],
            "made": [RowOrigin(how).name.lower().replace("_", "-") for how in made.path.made.tolist()],
            "start_um": points(curves.start_um),
            "end_um": points(curves.end_um),
            "center_um": points(curves.center_um),
            "radius_um": column(curves.radius_um),
            "sweep_deg": column(np.where(arc, np.degrees(curves.sweep_rad), np.nan), DEG_DIGITS),
        },
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
    sides = {
        "left_um": _ranges(kerf.left_reach),
        "right_um": _ranges(kerf.right_reach),
        "width_um": _ranges(kerf.width),
    }
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
        "piece": None if box.piece is None else box.piece + 1,
        "center_um": place(box.center_um),
        "cut_um": place(box.cut_um),
        "nominal_um": place(box.nominal_um),
        "least_um": place(box.least_um),
        "most_um": place(box.most_um),
    }


def _radius(radius: RadiusSize) -> RadiusEntry:
    return {
        "what": radius.what,
        "block": radius.block,
        "center_um": place(radius.center_um),
        "cut_um": rounded(radius.cut_um),
        "nominal_um": rounded(radius.nominal_um),
        "form_um": rounded(radius.form_um),
        "least_um": rounded(radius.least_um),
        "most_um": rounded(radius.most_um),
    }


def _distance(distance: DistanceSize) -> DistanceEntry:
    return {
        "what": distance.what,
        "blocks": list(distance.blocks),
        "cut_um": rounded(distance.cut_um),
        "nominal_um": rounded(distance.nominal_um),
        "least_um": rounded(distance.least_um),
        "most_um": rounded(distance.most_um),
    }


def _ring(ring: shapely.LinearRing) -> list[list[float]]:
    """Corners of a closed outline, the first one once; of 100,000 some 1000 tell it to 1 µm."""
    return corners(np.asarray(simpler(ring, _OUTLINE_UM).coords)[:-1, :2])


def _finite(value: float) -> float | None:
    return rounded(value) if math.isfinite(value) else None


def _touched(at: Point) -> list[float] | None:
    return place(at) if math.isfinite(at.x) else None
