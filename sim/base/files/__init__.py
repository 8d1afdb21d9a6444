"""Files written whole or not at all: `staged` sets, `replace_file`; `StepFiles` of all steps, a `scratch` folder."""

from sim.base.files.stages import replace_file, scratch, staged
from sim.base.files.steps import StepFiles, write_npz

__all__ = ["StepFiles", "replace_file", "scratch", "staged", "write_npz"]
