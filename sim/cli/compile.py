"""All compiled loops, compiled beforehand: ``python -m sim.cli.compile``, as setting up does."""

import importlib
from typing import Final

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
    "sim.measure.curve_rows",
    "sim.measure.deviation",
    "sim.measure.causes",
    "sim.table.forms",
    "sim.table.course",
    "sim.table.events",
    "sim.table.rating",
    "sim.table.history",
    "sim.table.axis",
    "sim.table.recording",
    "sim.table.swings",
)
"""Modules with compiled loops."""


def compile_loops() -> None:
    """Compile all loops of `LOOPS` that are not on disk yet."""
    for module in LOOPS:
        for value in vars(importlib.import_module(module)).values():
            if isinstance(value, Loop):
                value.loaded()


if __name__ == "__main__":
    compile_loops()
