"""The block that a question is about: its words and places as the quiz says them."""

from typing import NamedTuple

import numpy as np

from controller.stepping.strokes import walk_arcs
from parser.controller_words import Axis, StepWords
from parser.geometry.curves import Floats
from parser.step_words.words import label
from parser.units import mm
from sim.run.dryrun import DryRun


class AskedBlock(NamedTuple):
    """One block, whole µm unless said otherwise.

    Attributes
    ----------
    name
        What people call the block.
    is_arc
        Whether it is an arc.
    start_um, end_um, center_um
        (2,) float64, exact places; the centre of a line is NaN.
    length_um
        Length of its curve.
    extent_um, count_um, axis, quadrant, turn
        Its words: X and Y, J, G as X or Y, the quadrant, and +1 for NR, −1 for SR, 0 for a line.
    first_step
        (2,) which way its first step goes; (0, 0) where it makes none.
    steps
        How many it makes.
    is_worded
        Whether its words stand in the program; else they are the controller's own.
    senses
        How the program writes arcs clockwise and counter-clockwise, such as ``SR`` and ``NR``.
    """

    name: str
    is_arc: bool
    start_um: Floats
    end_um: Floats
    center_um: Floats
    length_um: float
    extent_um: tuple[int, int]
    count_um: int
    axis: str
    quadrant: int
    turn: int
    first_step: tuple[int, int]
    steps: int
    is_worded: bool
    senses: tuple[str, str]

    @property
    def by_um(self) -> Floats:
        """From its start to its end, (2,) µm."""
        return self.end_um - self.start_um

    @property
    def kind(self) -> str:
        """``line`` or ``arc``."""
        return "arc" if self.is_arc else "line"

    @property
    def sense(self) -> str:
        """What tells the sense of an arc, as it is written: with the digit of its quadrant where it has one."""
        return label(self.turn, self.quadrant) if self.is_worded else self.senses[self.turn > 0]

    @property
    def motion(self) -> int:
        """Quadrant of its first step: on an axis that which an arc enters."""
        if not self.is_arc:
            return self.quadrant
        x, y = np.rint(self.start_um - self.center_um).astype(np.int64)
        unit = np.ones(1, dtype=np.int64)
        (quarter,) = walk_arcs(x * unit, y * unit, unit, unit, self.turn * unit).quarter.tolist()
        return int(quarter) + 1 if self.turn > 0 else 4 - int(quarter)


def asked_block(run: DryRun, words: StepWords, row: int, first_um: tuple[int, int] | None) -> AskedBlock:
    """The block in a row, whose first step leads to a place; `words` are those of all rows."""
    toolpath = run.toolpath
    from_x, from_y = run.stepped.corner_um[row].tolist()
    to_x, to_y = first_um or (from_x, from_y)
    return AskedBlock(
        name=toolpath.source.names.of_row(row),
        is_arc=bool(toolpath.is_arc[row]),
        start_um=toolpath.start_um[row],
        end_um=toolpath.end_um[row],
        center_um=toolpath.center_um[row],
        length_um=float(toolpath.length_um[row]),
        extent_um=(int(words.x_um[row]), int(words.y_um[row])),
        count_um=int(words.count_um[row]),
        axis=Axis(int(words.count_axis[row])).name,
        quadrant=int(words.quadrant[row]),
        turn=int(words.turn[row]),
        first_step=(to_x - from_x, to_y - from_y),
        steps=int(run.stepped.count[row]),
        is_worded=toolpath.words is not None,
        senses=run.program.reading.spelling[:2],
    )


def way(step: tuple[int, int]) -> str:
    """A step as people write it: +X, −X, +Y or −Y."""
    axis = "X" if step[0] else "Y"
    return f"{'+' if sum(step) > 0 else '−'}{axis}"


def signed(um: float) -> str:
    """A length in whole µm with its sign, none before 0."""
    whole = round(um)
    return str(whole) if not whole else f"{'+' if whole > 0 else '−'}{abs(whole)}"


def plain(um: int) -> str:
    """A coordinate in whole µm."""
    return str(um).replace("-", "−")


def in_mm(um: float) -> str:
    """A coordinate in mm with three digits, as programs print it, but never −0.000."""
    text = f"{mm(um):.3f}"
    return text.removeprefix("-") if float(text) == 0.0 else text.replace("-", "−")
