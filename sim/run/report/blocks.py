"""Entries of the report on each block."""

from typing import Any

import numpy as np

from parser.geometry.curves import CurveKind
from parser.told.step_words import Axis
from parser.toolpath import Toolpath
from sim.base.rounded import DEG_DIGITS, column, points, rows
from sim.run.dryrun import DryRun

_CURVES = (None, "convex", "concave")


def block_entries(run: DryRun) -> list[dict[str, Any]]:
    """All of ``blocks[]``."""
    toolpath = run.toolpath
    columns = {
        "block": list(range(1, len(toolpath) + 1)),
        "line": toolpath.source.line.tolist(),
        "label": [label or None for label in toolpath.source.label],
        "text": [toolpath.source.text[low:high] for low, high in toolpath.source.span.tolist()],
        "kind": [CurveKind(kind).name.lower() for kind in toolpath.kind.tolist()],
        **_words(toolpath),
        "exact": rows(_exact(toolpath)),
        "stepped": rows(_stepped(run)),
        "table": rows({"max_deviation_um": column(run.deviations.table.by_row_um)}),
        "printed_end_um": points(toolpath.printed_end_um),
    }
    return rows(columns)


def _words(toolpath: Toolpath) -> dict[str, list[Any]]:
    """What the blocks say of steps; None where the dialect has no words for that."""
    words = toolpath.words
    if words is None:
        return dict.fromkeys(("count_um", "radius_um", "curve", "count_axis"), [None] * len(toolpath))
    return {
        "count_um": words.count_um.tolist(),
        "radius_um": [None if radius < 0 else radius for radius in words.radius_um.tolist()],
        "curve": [_CURVES[curve] for curve in words.curve.tolist()],
        "count_axis": [Axis(axis).name for axis in words.count_axis.tolist()],
    }


def _exact(toolpath: Toolpath) -> dict[str, list[Any]]:
    arc = toolpath.is_arc
    degrees = np.where(arc, np.degrees(toolpath.sweep_rad), np.nan)
    return {
        "start_um": points(toolpath.start_um),
        "end_um": points(toolpath.end_um),
        "center_um": points(toolpath.center_um),
        "radius_um": column(toolpath.radius_um),
        "sweep_deg": column(degrees, DEG_DIGITS),
        "start_angle_deg": column(np.degrees(toolpath.start_angle_rad), DEG_DIGITS),
        "end_angle_deg": column(np.degrees(toolpath.end_angle_rad), DEG_DIGITS),
        "is_major": toolpath.is_major.tolist(),
        "length_um": column(toolpath.length_um),
    }


def _stepped(run: DryRun) -> dict[str, list[Any]]:
    return {
        "end_um": run.stepped.corner_um[1:].tolist(),
        "steps": run.stepped.count.tolist(),
        "max_deviation_um": column(run.deviations.steps.by_row_um),
        "interpolation_um": column(run.deviations.interpolation.by_row_um),
    }
