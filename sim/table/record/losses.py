"""What the drives lose: steps that a stepper slips past, the following error at which a servo trips."""

from typing import Literal, NamedTuple

import numpy as np

from parser.toolpath import Axis
from sim.setup.machine.table_model import TableModel
from sim.table.record.travelled import Travelled

LossKind = Literal["lost-steps", "trip"]


class Loss(NamedTuple):
    """A loss of one axis in one block.

    Attributes
    ----------
    kind
        ``lost-steps``: a stepper slipped by whole electrical periods; ``trip``: a servo gave up, and the machine
        stopped.
    axis
        Whose drive it was.
    row
        Row of the toolpath that was running (block number less one).
    t_s
        Time of the loss; where there are several slips, that of the first.
    amount_um
        Of lost steps, the sum of the block's slips: positive where the table stands short of its command in the
        positive direction. Where the slips cancel out, the sum of their magnitudes instead. Of a trip, the following
        error: command less place.
    x_um, y_um
        Place of the table then, in program coordinates.
    """

    kind: LossKind
    axis: Axis
    row: int
    t_s: float
    amount_um: float
    x_um: float
    y_um: float


class LossTally:
    """Sums up losses as a table travels, one entry for each block and axis."""

    def __init__(self, model: TableModel) -> None:
        self._limit_um = model.motor.following_error_limit_um
        self._lost: dict[tuple[int, int], Loss] = {}
        self._slipped: dict[tuple[int, int], float] = {}
        self._trip: Loss | None = None

    def take(self, travelled: Travelled) -> None:
        """Take the next ticks."""
        for tick, axis in np.argwhere(travelled.lost_um != 0.0).tolist():
            key = int(travelled.row[tick]), axis
            amount = float(travelled.lost_um[tick, axis])
            self._slipped[key] = self._slipped.get(key, 0.0) + abs(amount)
            known = self._lost.get(key)
            if known is None:
                self._lost[key] = _loss("lost-steps", travelled, tick, axis, amount)
            else:
                self._lost[key] = known._replace(amount_um=known.amount_um + amount)
        if self._trip is None:
            over = np.argwhere(np.abs(travelled.lag_um) > self._limit_um)
            if len(over):
                tick, axis = over[0].tolist()
                self._trip = _loss("trip", travelled, tick, axis, float(travelled.lag_um[tick, axis]))

    def result(self) -> tuple[Loss, ...]:
        """All losses, in order of time."""
        lost = [
            loss if loss.amount_um != 0.0 else loss._replace(amount_um=self._slipped[key])
            for key, loss in self._lost.items()
        ]
        losses = [*lost, *([self._trip] if self._trip else [])]
        return tuple(sorted(losses, key=lambda loss: (loss.t_s, loss.axis)))


def _loss(kind: LossKind, travelled: Travelled, tick: int, axis: int, amount_um: float) -> Loss:
    x_um, y_um = travelled.place_um[tick].tolist()
    t_s, row = float(travelled.t_s[tick]), int(travelled.row[tick])
    return Loss(kind, Axis(axis), row, t_s, amount_um, x_um, y_um)
