"""All compiled loops, compiled beforehand: ``python -m sim.cli.compile``, as setting up does."""

import importlib
from pathlib import Path
from typing import Final

from controller.compiled.entries import file_of, folder
from controller.compiled.loops import Loop

LOOPS: Final[tuple[str, ...]] = (
    "controller.stepping.chunks",
    "sim.make.cam.order",
    "sim.cut.kerf.bands",
    "sim.cut.kerf.stars",
    "sim.cut.kerf.edges",
    "sim.cut.kerf.ways",
    "sim.cut.play",
    "sim.measure.compare.rings",
    "sim.measure.compare.nearest",
    "sim.measure.compare.directed",
    "sim.measure.deviation",
    "sim.measure.causes",
    "sim.process.ticks.chance",
    "sim.process.ticks.hands",
    "sim.process.ticks.tick",
    "sim.process.ticks.walls",
    "sim.show.draw.flatten",
    "sim.table.rating",
    "sim.table.turning",
    "sim.table.history",
    "sim.table.recording",
    "sim.table.swings",
)
"""Modules with loops that Python calls."""


def compile_loops() -> tuple[Path, ...]:
    """Compile the loops of `LOOPS` that Python calls and that are not on disk yet; the files of their machine code."""
    modules = map(importlib.import_module, LOOPS)
    loops = [each for module in modules for each in vars(module).values() if isinstance(each, Loop)]
    called = [loop for loop in loops if not loop.is_part]
    for loop in called:
        loop.loaded()
    return tuple(folder() / file_of(loop.name, loop.digest) for loop in called)


if __name__ == "__main__":
    compile_loops()
