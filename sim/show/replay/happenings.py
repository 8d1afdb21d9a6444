"""What a replay's document says of what happens in a run: stops, findings, contours and losses."""

from typing import Any

import numpy as np

from parser.findings.catalogue import LANGUAGES, texts
from parser.findings.findings import Finding
from parser.units import from_mm
from sim.run.dryrun import DryRun
from sim.run.report.rounded import rounded
from sim.table.record.losses import Loss


def stop_entries(run: DryRun) -> list[dict[str, Any]]:
    """Pauses and the end: `after` so many blocks."""
    return [{"kind": stop.kind, "after": stop.after, "line": stop.line} for stop in run.toolpath.stops]


def finding_entries(run: DryRun) -> list[dict[str, Any]]:
    """All findings with their texts in both languages.

    Each has the row of the first block it is about and the time at which that begins, or its own time and place where
    it knows them; None where no block that ran is meant.
    """
    begins = np.concatenate([[0.0], np.cumsum(run.block_time_s)])
    return [_finding(finding, _row(run, finding.block), begins.tolist()) for finding in run.findings]


def contour_entries(run: DryRun) -> list[dict[str, Any]]:
    """Contours by the rows of their first and last blocks."""
    return [
        {
            "first_row": contour.first - 1,
            "last_row": contour.last - 1,
            "closure_exact_um": rounded(contour.closure_exact_um),
            "closure_stepped_um": rounded(contour.closure_stepped_um),
        }
        for contour in run.contours
    ]


def loss_entry(loss: Loss) -> dict[str, Any]:
    """Steps that a stepper lost, or where a servo tripped."""
    return {
        "kind": loss.kind,
        "axis": loss.axis.name,
        "row": loss.row,
        "t_s": rounded(loss.t_s),
        "amount_um": rounded(loss.amount_um),
        "place_um": [rounded(loss.x_um), rounded(loss.y_um)],
    }


def row_of(run: DryRun, block: int) -> int | None:
    """First row that runs for a block of the program; None where none does."""
    rows = np.flatnonzero(run.toolpath.source.block == block)
    return int(rows[0]) if len(rows) else None


def _row(run: DryRun, block: int) -> int | None:
    return row_of(run, block) if block else None


def _finding(finding: Finding, row: int | None, begins_s: list[float]) -> dict[str, Any]:
    values = finding.values
    block_s = None if row is None else begins_s[row]
    time = values.get("t_s", block_s)
    place = [values[name] for name in ("x_mm", "y_mm") if name in values]
    return {
        "code": finding.code,
        "severity": str(finding.severity),
        "line": finding.line or None,
        "block": finding.block or None,
        "row": row,
        "t_s": None if time is None else rounded(float(time)),
        "place_um": [rounded(from_mm(float(along))) for along in place] or None,
        "texts": {language: texts(finding, language)._asdict() for language in LANGUAGES},
    }
