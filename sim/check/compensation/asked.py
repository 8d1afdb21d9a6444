"""Whether a program asks for compensation itself, and whether all is known that it takes."""

from dataclasses import dataclass

import numpy as np

from parser.findings.findings import Fact
from parser.told.compensation import Compensation
from parser.toolpath import Toolpath


@dataclass(frozen=True, slots=True)
class WithoutValue(Fact):
    """The block compensates by an offset that nobody tells: the program cannot run."""


def compensation_of(toolpath: Toolpath) -> Compensation | None:
    """What a program asks for by G41 and G42; None where it does not, or where nothing moves."""
    told = toolpath.compensation
    return told if told is not None and told.side.any() and toolpath.length_um.any() else None


def is_known(told: Compensation) -> bool:
    """Whether the offset of every block that has a side is known, so that the program can run."""
    return not np.isnan(told.by_um[told.side != 0]).any()
