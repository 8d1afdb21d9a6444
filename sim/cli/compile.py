"""All compiled loops, compiled beforehand: ``python -m sim.cli.compile``, as setting up does."""

import importlib
from typing import Final

LOOPS: Final[tuple[str, ...]] = (
    "sim.cut.kerf.edges",
    "sim.cut.kerf.makers",
    "sim.cut.kerf.stars",
    "sim.cut.play.touching",
)
"""Modules with compiled loops."""


def compile_loops() -> None:
    """Import `LOOPS`, which compiles what is not on disk yet."""
    for module in LOOPS:
        importlib.import_module(module)


if __name__ == "__main__":
    compile_loops()
