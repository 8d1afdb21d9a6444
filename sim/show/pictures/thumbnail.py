"""A program in small, for lists of many: its path with the marks of its findings, without texts."""

from typing import TYPE_CHECKING, Final

from sim.show.draw.sheet import drawing
from sim.show.pictures.cut.of_path import Programmed, draw_path

if TYPE_CHECKING:  # who has a run has loaded this
    from sim.run.dryrun import DryRun

WIDTH_PX: Final = 320


def path_thumbnail(shown: Programmed) -> str:
    """The path of a program as an element ``<svg>`` of a page, which colours it by the classes of its paints."""
    return draw_path(drawing(WIDTH_PX), shown).fragment(shown.scenario.title)


def run_thumbnail(run: "DryRun") -> str:
    """As `path_thumbnail`, with the marks of all findings of a run."""
    return path_thumbnail(Programmed(run.program, run.scenario, run.offset, run.findings))
