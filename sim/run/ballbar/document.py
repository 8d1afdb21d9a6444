"""A circular test as data, schema ``drycut.ballbar/1`` (docs/ballbar.md)."""

import json
from typing import Any, Final

from parser import __version__
from sim.run.ballbar.circle import Ballbar
from sim.run.ballbar.figures import NAMES, Direction, Figures, Sense
from sim.run.ballbar.parts import DeviationParts, Reversal
from sim.table.record.losses import Loss

SCHEMA: Final = "drycut.ballbar/1"
_DIGITS: Final = 6
_DEG_DIGITS: Final = 3


def document(ballbar: Ballbar, tolerance_um: float | None) -> dict[str, Any]:
    """The test as plain lists, dicts, numbers and None; the order of keys is fixed."""
    test, measured = ballbar.test, ballbar.measured
    return {
        "schema": SCHEMA,
        "drycut": __version__,
        "verdict": "pass" if ballbar.passes(tolerance_um) else "fail",
        "machine": test.machine.name,
        "interpolator": test.machine.controller.interpolation,
        "radius_um": test.radius_um,
        "feed_um_s": _round(test.feed_um_s),
        "planned_feed_um_s": _round(ballbar.run_um_s),
        "tolerance_um": None if tolerance_um is None else _round(tolerance_um),
        "circularity_um": None if measured is None else _round(measured.figures.circularity_um),
        "figures": None if measured is None else _figures(measured.figures),
        "parts": None if measured is None else _parts(measured.parts, measured.interpolation_um),
        "losses": [_loss(sense, loss) for sense, loss in ballbar.losses],
    }


def document_text(ballbar: Ballbar, tolerance_um: float | None) -> str:
    """The document as JSON; the same test gives the same bytes."""
    return json.dumps(document(ballbar, tolerance_um), ensure_ascii=False, allow_nan=False, indent=2) + "\n"


def trace_text(ballbar: Ballbar) -> str:
    """Both turns as CSV: ``turn`` (ccw, cw), and the table's place in µm from the nominal centre, in order of time.

    G(b) is the width of the ring about `figures.center_um` that holds the places of both turns (docs/ballbar.md).
    """
    rows = (f"{NAMES[turn.sense]},{x:.4f},{y:.4f}\n" for turn in ballbar.turns for x, y in turn.points_um.tolist())
    return "turn,x_um,y_um\n" + "".join(rows)


def _figures(figures: Figures) -> dict[str, Any]:
    return {
        "mean_radial_um": _round(figures.mean_radial_um),
        "hysteresis_um": _round(figures.hysteresis_um),
        "center_um": [_round(place) for place in figures.center_um],
        "ccw": _direction(figures.ccw),
        "cw": _direction(figures.cw),
    }


def _direction(direction: Direction) -> dict[str, float]:
    return {key: _round(value) for key, value in direction._asdict().items()}


def _parts(parts: DeviationParts, interpolation_um: float) -> dict[str, Any]:
    return {
        "radius_ccw_um": _round(parts.radius_um[0]),
        "radius_cw_um": _round(parts.radius_um[1]),
        "step_x_um": _round(parts.step_um[0]),
        "step_y_um": _round(parts.step_um[1]),
        "diameters_um": _round(parts.diameters_um),
        "lag_um": _round(parts.lag_um),
        "interpolation_um": _round(interpolation_um),
        "rest_um": _round(parts.rest_um),
        "reversals": [_reversal(reversal) for reversal in parts.reversals],
    }


def _reversal(reversal: Reversal) -> dict[str, Any]:
    return {
        "direction": NAMES[reversal.sense],
        "axis": reversal.axis.name,
        "side": reversal.side,
        "step_um": _round(reversal.step_um),
        "spike_um": _round(reversal.spike_um),
        "spike_deg": None if reversal.spike_deg is None else round(reversal.spike_deg, _DEG_DIGITS),
    }


def _loss(sense: Sense, loss: Loss) -> dict[str, Any]:
    return {
        "direction": NAMES[sense],
        "kind": loss.kind,
        "axis": loss.axis.name,
        "t_s": _round(loss.t_s),
        "amount_um": _round(loss.amount_um),
        "x_um": _round(loss.x_um),
        "y_um": _round(loss.y_um),
    }


def _round(value: float) -> float:
    return round(float(value), _DIGITS) + 0.0
