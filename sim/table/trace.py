"""The trace: where the table was asked to be and where it was, over time."""

from dataclasses import dataclass

import numpy as np

from parser.controller_words import Axis
from parser.geometry.curves import Floats, Ints
from parser.toolpath import Toolpath


@dataclass(frozen=True, slots=True, eq=False)
class Trace:
    """Motion of the table, n samples, in program coordinates (the program's start point as its header gives it).

    Attributes
    ----------
    t_s
        (n,) float64, strictly rising, from 0.
    commanded_um
        (n, 2) float64, sum of the pulses handed out by then.
    table_um
        (n, 2) float64, where the table stood.
    wire_um
        (n, 2) float64, where the wire really cut: the same array, unless the wire bows back.
    row
        (n,) int64, row of the toolpath that was running (block number less one).
    """

    t_s: Floats
    commanded_um: Floats
    table_um: Floats
    wire_um: Floats
    row: Ints

    def until(self, t_s: float) -> "Trace":
        """The samples up to a time."""
        count = int(np.searchsorted(self.t_s, t_s, side="right"))
        return Trace(
            self.t_s[:count], self.commanded_um[:count], self.table_um[:count], self.wire_um[:count], self.row[:count]
        )

    def place_with(self, axis: Axis, at_um: float, t_s: float) -> tuple[float, float]:
        """Place of the table at a time when one axis was at a place; the other one is taken between two samples."""
        after = min(max(int(np.searchsorted(self.t_s, t_s)), 1), len(self) - 1)
        around = slice(after - 1, after + 1)
        x, y = (float(np.interp(t_s, self.t_s[around], column)) for column in self.table_um[around].T)
        return (at_um, y) if axis is Axis.X else (x, at_um)

    def __len__(self) -> int:
        return len(self.t_s)


def origin_um(toolpath: Toolpath) -> tuple[int, int]:
    """Start of the program in whole µm, where the steps begin."""
    x, y = np.rint(toolpath.start_um[0]).astype(int).tolist()
    return x, y
