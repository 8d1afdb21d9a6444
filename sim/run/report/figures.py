"""Entries of the report on how the run went: the offset added, deviation by cause, limits met, and what was lost."""

import math

import numpy as np

from controller.offset.chain import RowOrigin
from parser.geometry.curves import CurveKind, Ints
from sim.base.rounded import DEG_DIGITS, column, moment, points, rounded, rows
from sim.check.pass_over_round import Offsetting
from sim.measure.deviation.causes import Deviations, Part
from sim.measure.deviation.deviation import Deviation, Where
from sim.run.dryrun import DryRun
from sim.run.ending import Ending
from sim.run.report.run_model import (
    CauseEntry,
    DeviationEntry,
    DeviationsEntry,
    EndedEntry,
    LimitEntry,
    LossEntry,
    OffsetBlockEntry,
    OffsetEntry,
    WhereEntry,
)
from sim.table.record.losses import Loss, Peak


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
    return {"kind": loss.kind, "axis": loss.axis.name, "amount_um": rounded(loss.amount_um), **_met(loss, ran_s)}


def ended_entry(run: DryRun) -> EndedEntry | None:
    """``ended``; None where the program ran to its end."""
    ended = run.ended
    return ended and {"cause": ended.cause, "axis": ended.axis.name, **_met(ended, ended.t_s)}


def _met(event: Peak | Loss | Ending, ran_s: float) -> WhereEntry:
    """Block, time and place of what happened in a run of `ran_s`."""
    x, y = rounded(event.x_um), rounded(event.y_um)
    return {"block": event.row + 1, "t_s": moment(event.t_s, ran_s), "x_um": x, "y_um": y}


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
