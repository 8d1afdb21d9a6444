"""Circles with known errors, for tests of the circular test."""

import numpy as np

from sim.run.ballbar.circle import Measured, measure
from sim.run.ballbar.figures import SENSES, MeasuredTurn, Sense

SAMPLES = 6000


def travelled(samples: int = SAMPLES) -> np.ndarray:
    """Angles of a motor from −X for one turn."""
    return np.linspace(np.pi, 3.0 * np.pi, samples + 1)


def perfect(sense: Sense, radius_um: float = 50_000.0) -> MeasuredTurn:
    angle = sense * travelled()
    return MeasuredTurn(sense, radius_um * np.stack([np.cos(angle), np.sin(angle)], axis=1))


def with_play(turn: MeasuredTurn, x_um: float, y_um: float) -> MeasuredTurn:
    """The turn of a slide that is pushed by a motor with a dead zone of this width."""
    pushed = [_pushed(turn.points_um[:, axis], play_um) for axis, play_um in enumerate((x_um, y_um))]
    return MeasuredTurn(turn.sense, np.stack(pushed, 1))


def _pushed(motor: np.ndarray, width: float) -> np.ndarray:
    """A plain walk over two turns, of which the second is settled."""
    at, places = float(motor[0]), []
    for place in np.concatenate([motor[:-1], motor]).tolist():
        at = min(max(at, place - width / 2.0), place + width / 2.0)
        places.append(at)
    return np.array(places[len(motor) - 1 :])


def moved_out(turn: MeasuredTurn, out_um: np.ndarray) -> MeasuredTurn:
    """The turn with each place moved outward."""
    unit = turn.points_um / np.hypot(*turn.points_um.T)[:, None]
    return MeasuredTurn(turn.sense, turn.points_um + out_um[:, None] * unit)


def past(turn: MeasuredTurn, at_deg: float) -> np.ndarray:
    """Degrees travelled past a direction, −180 to 180."""
    angle = np.degrees(np.arctan2(turn.points_um[:, 1], turn.points_um[:, 0]))
    return np.mod(turn.sense * (angle - at_deg) + 180.0, 360.0) - 180.0


def with_spikes(turn: MeasuredTurn, height_um: float, at_deg: float = 2.0, wide_deg: float = 0.8) -> MeasuredTurn:
    """The turn with a bell of this height after each reversal."""
    bells = [np.exp(-(((past(turn, quarter * 90.0) - at_deg) / wide_deg) ** 2)) for quarter in range(4)]
    return moved_out(turn, height_um * np.sum(bells, axis=0))


def measured(ccw: MeasuredTurn, cw: MeasuredTurn, radius_um: float = 50_000.0) -> Measured:
    """What two turns tell that were commanded by perfect circles."""
    steps = perfect(1, radius_um), perfect(-1, radius_um)
    result = measure((ccw, cw), steps, steps, radius_um)
    assert result is not None
    return result


def both(change: object) -> Measured:
    """What both directions tell after the same change."""
    return measured(*(change(perfect(sense)) for sense in SENSES))
