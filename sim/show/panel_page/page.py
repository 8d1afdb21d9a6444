"""The panel of a control under sparks as one page, driven live."""

import hashlib
import json
from pathlib import Path
from typing import Any, Final

import numpy as np

from parser.geometry.along import places
from parser.geometry.curves import Curves, Ints
from parser.text.encoding import printable
from parser.units import mm
from sim.process.cut import Started
from sim.process.sparks import CRATERS
from sim.process.ticks import state as ticks
from sim.setup.scenario import Scenario
from sim.show.html.environment import rendered
from sim.show.panel_page.model import PanelEntry

_ASSETS: Final = Path(__file__).with_name("assets")
_DIGEST: Final = 16
_TURN_RAD: Final = np.radians(4.0)


def panel_page(scenario: Scenario, started: Started) -> str:
    """``panel.html`` of a cut that begins; the same cut gives the same bytes, and what its program says is escaped."""
    data = panel_entry(started)
    return rendered(_ASSETS, "panel.html.j2", title=scenario.titles, modes=list(CRATERS), data=data)


def panel_entry(started: Started) -> PanelEntry:
    """What the page hands over to its script."""
    work, rows, job, walls = started.work, started.rows, started.job, started.walls
    source, row = work.toolpath.source, rows.row
    entry: dict[str, Any] = {
        "blocks": [source.names.of_row(each) for each in row.tolist()],
        "texts": [printable(source.text[low:high]) for low, high in source.span[row].tolist()],
        "starts_um": (work.steps.corner_um[row] + np.rint(work.toolpath.start_um[0]).astype(np.int64)).tolist(),
        "points": _points(work.toolpath, row),
        "way": {name: column.tolist() for name, column in job.way._asdict().items()},
        "words": _words(started, row),
        "discharge": job.discharge._asdict(),
        "servo": job.servo._asdict(),
        "bounds": _bounds(started),
        "events": {name: column.tolist() for name, column in job.events._asdict().items()},
        "modes": [
            {"name": name, "crater_um3": crater.mean_um3, "spread_um3": crater.spread_um3}
            for name, crater in CRATERS.items()
        ],
        "mode": started.spark.mode,
        "law": started.spark.law,
        "seeds": started.state[[ticks.SEED_1, ticks.SEED_2]].tolist(),
        "set_share": float(started.state[ticks.SET_SHARE]),
        "open_v": started.spark.open_v,
        "stretch_um": float(job.records.stretch_um[0]),
        "half": walls.half,
        "usual_s": walls.usual_s.tolist(),
        "gap_um": walls.gap_um.tolist(),
        "start_um": walls.start_um.tolist(),
    }
    text = json.dumps(entry, ensure_ascii=False, sort_keys=True, allow_nan=False)
    return {"digest": hashlib.sha256(text.encode()).hexdigest()[:_DIGEST], **entry}  # type: ignore[typeddict-item]


def _words(started: Started, row: Ints) -> dict[str, list[int]]:
    words = started.work.words
    columns = {
        "x_um": words.x_um,
        "y_um": words.y_um,
        "count_um": words.count_um,
        "axis": words.count_axis,
        "turn": words.turn,
        "quadrant": words.quadrant,
    }
    return {name: column[row].tolist() for name, column in columns.items()}


def _bounds(started: Started) -> dict[str, float | None]:
    bounds = started.job.bounds._asdict()
    del bounds["is_manned"], bounds["is_reversed"]
    most = bounds["area_rate_mm2_min"]
    return {**bounds, "area_rate_mm2_min": most if np.isfinite(most) else None}


def _points(curves: Curves, row: Ints) -> list[list[float]]:
    """Evenly spaced places along each of the rows, µm to a tenth, x and y by turns."""
    parts = np.maximum(np.ceil(np.abs(curves.sweep_rad[row]) / _TURN_RAD), 1.0).astype(np.int64)
    ends = np.cumsum(parts + 1)
    share = (np.arange(ends[-1]) - np.repeat(ends - parts - 1, parts + 1)) / np.repeat(parts, parts + 1)
    found = np.round(places(curves, np.repeat(row, parts + 1), share), 1)
    return [part.ravel().tolist() for part in np.split(found, ends[:-1])]


def length_mm(started: Started) -> float:
    """Length of what the panel cuts."""
    return mm(float(started.job.way.along_um[-1]))
