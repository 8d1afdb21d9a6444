"""The trace: where the table was asked to be and where it was, over time."""

from dataclasses import dataclass

from parser.toolpath import Floats, Ints


@dataclass(frozen=True, slots=True, eq=False)
class Trace:
    """Motion of the table, n samples, in program coordinates (the program's start point as its header gives it).

    Attributes
    ----------
    t_s
        (n,) float64, strictly rising, from 0.
    commanded_um
        (n, 2) float64, sum of the pulses handed out by then.
    actual_um
        (n, 2) float64, where the wire really was.
    row
        (n,) int64, row of the toolpath that was running (block number less one).
    """

    t_s: Floats
    commanded_um: Floats
    actual_um: Floats
    row: Ints

    def __len__(self) -> int:
        return len(self.t_s)
