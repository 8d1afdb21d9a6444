"""What the steps of a run came to: how many each block made, and where the table was told to stand after it."""

from dataclasses import dataclass

import numpy as np

from controller.stepping.pulses import Pulses
from parser.geometry.curves import Ints


@dataclass(frozen=True, slots=True, eq=False)
class Stepped:
    """Steps of n blocks.

    Attributes
    ----------
    count
        (n,) int64, steps of each block.
    corner_um
        (n + 1, 2) int64, place before each block and at the end, µm of the program.
    """

    count: Ints
    corner_um: Ints

    def __len__(self) -> int:
        return int(self.count.sum())


class StepTally:
    """Counts steps as they stream in, in memory that does not grow with them."""

    def __init__(self, blocks: int, origin_um: tuple[int, int]) -> None:
        self._count = np.zeros(blocks, dtype=np.int64)
        self._end = np.zeros((blocks, 2), dtype=np.int64)
        self._origin = np.array([origin_um], dtype=np.int64)

    def take(self, pulses: Pulses) -> None:
        """Take the next pulses, in program coordinates, rows never falling."""
        if not len(pulses.row):
            return
        first = np.flatnonzero(np.diff(pulses.row, prepend=-1))
        last = np.append(first[1:], len(pulses.row)) - 1
        rows = pulses.row[first]
        self._count[rows] += last - first + 1
        self._end[rows, 0], self._end[rows, 1] = pulses.x_um[last], pulses.y_um[last]

    def result(self) -> Stepped:
        """Of all steps so far; a block without steps ends where it began."""
        stepped = np.arange(1, len(self._count) + 1) * (self._count > 0)
        latest = np.maximum.accumulate(np.concatenate([[0], stepped]))
        return Stepped(self._count.copy(), np.concatenate([self._origin, self._end])[latest])
