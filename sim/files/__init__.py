"""Files written whole or not at all: `staged` sets, `replace_file`, and the arrays of all steps, `StepFiles`."""

from sim.files.replaced import replace_file
from sim.files.staged import staged
from sim.files.steps import StepFiles, write_npz

__all__ = ["StepFiles", "replace_file", "staged", "write_npz"]
