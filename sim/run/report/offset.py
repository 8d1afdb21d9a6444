"""Entries of the report on the offset that the controller added."""

from typing import Any

import numpy as np

from controller.offset.path import Made
from parser.geometry.curves import Ints, Kind
from sim.run.dryrun import DryRun
from sim.run.offsetting import Offsetting
from sim.run.report.rounded import DEG_DIGITS, column, points, rounded, rows


def offset_entry(run: DryRun) -> dict[str, Any] | None:
    """``offset``; None where the program ran as written."""
    asked, made = run.scenario.offset, run.offset
    if asked is None or made is None:
        return None
    of_row = run.program.toolpath.source.block
    return {
        "by_um": rounded(asked.by_um),
        "side": asked.side.name.lower(),
        "blocks": _blocks(made, of_row),
        "vanished": [
            {"source_block": row + 1, "left_um": rounded(left_um)}
            for row, left_um in zip(made.path.vanished.tolist(), made.left_um.tolist(), strict=True)
        ],
        "gouges": [
            {
                "block": gouge.path_row + 1,
                "source_block": int(of_row[gouge.path_row]),
                "into_source_block": gouge.row + 1,
                "where_um": [rounded(gouge.place_um.x), rounded(gouge.place_um.y)],
                "depth_um": rounded(gouge.depth_um),
            }
            for gouge in made.gouges
        ],
        "closed_paths": list(made.loops),
    }


def _blocks(made: Offsetting, of_row: Ints) -> list[dict[str, Any]]:
    curves = made.path.curves
    arc = curves.is_arc
    return rows(
        {
            "block": list(range(1, len(curves) + 1)),
            "source_block": of_row.tolist(),
            "kind": [Kind(kind).name.lower() for kind in curves.kind.tolist()],
            "made": [Made(how).name.lower().replace("_", "-") for how in made.path.made.tolist()],
            "start_um": points(curves.start_um),
            "end_um": points(curves.end_um),
            "center_um": points(curves.center_um),
            "radius_um": column(curves.radius_um),
            "sweep_deg": column(np.where(arc, np.degrees(curves.sweep_rad), np.nan), DEG_DIGITS),
        }
    )
