"""Entries of the report on what a run measured: deviation by cause, limits that were met, what was lost."""

import math
from typing import Any

from sim.measure.deviation.causes import Part
from sim.measure.deviation.deviation import Deviation, Where
from sim.measure.deviation.measured import Deviations
from sim.run.report.rounded import rounded
from sim.table.record.losses import Loss
from sim.table.record.peaks import Peak


def deviation_entries(deviations: Deviations) -> dict[str, Any]:
    """``deviation``: of steps, table and wire, and what each cause adds."""
    kinds = ("interpolation", "steps", "table", "wire")
    causes = {name: _part(part) for name, part in deviations.by_cause._asdict().items()}
    return {kind: _deviation(getattr(deviations, kind)) for kind in kinds} | {"by_cause": causes}


def _deviation(deviation: Deviation) -> dict[str, Any]:
    return {
        "max_um": rounded(deviation.max_um),
        "rms_um": rounded(deviation.rms_um),
        "p95_um": rounded(deviation.p95_um),
        "where": _where(deviation.where),
    }


def _part(part: Part) -> dict[str, Any]:
    return {"max_um": rounded(part.max_um), "where": _where(part.where)}


def _where(where: Where | None) -> dict[str, Any] | None:
    if where is None:
        return None
    return {"block": where.block, "x_um": rounded(where.x_um), "y_um": rounded(where.y_um), "t_s": rounded(where.t_s)}


def limit_entry(peak: Peak) -> dict[str, Any]:
    """One entry of ``limits[]``: force N, speed µm/s, lag µm."""
    limited = math.isfinite(peak.limit)
    return {
        "quantity": peak.quantity,
        "axis": peak.axis.name,
        "value": rounded(peak.value),
        "limit": rounded(peak.limit) if limited else None,
        "share": rounded(peak.share) if limited else None,
        **_met(peak),
    }


def loss_entry(loss: Loss) -> dict[str, Any]:
    """One entry of ``losses[]``."""
    return {"kind": loss.kind, "axis": loss.axis.name, "amount_um": rounded(loss.amount_um), **_met(loss)}


def _met(event: Peak | Loss) -> dict[str, Any]:
    """Block, time and place of what happened."""
    x, y = rounded(event.x_um), rounded(event.y_um)
    return {"block": event.row + 1, "t_s": rounded(event.t_s), "x_um": x, "y_um": y}
