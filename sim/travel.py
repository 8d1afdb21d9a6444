"""The table's travel: which block first leaves it."""

import numpy as np

from controller.pulses import Pulses
from parser.findings import Finding
from parser.toolpath import Toolpath
from parser.units import from_mm
from sim.machine import TableModel


class TravelWatch:
    """Watches pulses in program coordinates for the first that leaves the travel."""

    def __init__(self, model: TableModel, start_um: tuple[float, float], toolpath: Toolpath) -> None:
        self._model, self._toolpath = model, toolpath
        self._high = from_mm(np.array([model.travel_x_mm, model.travel_y_mm]))
        self._shift = np.array(start_um) - np.rint(toolpath.start_um[0])
        self._out: int | None = None

    def take(self, pulses: Pulses) -> None:
        """Look at the next pulses."""
        if self._out is not None or not len(pulses.row):
            return
        x, y = pulses.x_um + self._shift[0], pulses.y_um + self._shift[1]
        out = (x < 0.0) | (x > self._high[0]) | (y < 0.0) | (y > self._high[1])
        if out.any():
            self._out = int(pulses.row[np.argmax(out)])

    def findings(self) -> list[Finding]:
        """Finding 3B401 for the first block that left, if any did."""
        if self._out is None:
            return []
        travel = f"{self._model.travel_x_mm:g} × {self._model.travel_y_mm:g} mm"
        return [
            Finding(
                "3B401",
                f"the block leaves the table's travel of {travel}",
                "a start on the table (start_mm of the scenario) from which the whole program fits",
                "the table runs into its end stop, and the rest is cut in the wrong place",
                int(self._toolpath.source.line[self._out]),
                block=self._out + 1,
            )
        ]
