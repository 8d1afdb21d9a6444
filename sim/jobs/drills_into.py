"""Fault drills with their files: the two pages, and the damaged programs beside them."""

from collections.abc import Sequence
from pathlib import Path
from typing import Final

from parser.program import Program, usual_name
from sim.base.files import staged
from sim.show.drill_page import answers_page, drill_page
from sim.teach.drill.drills import Drill

PAGES: Final = ("drill.html", "answers.html")


def drills_into(folder: Path, program: Program, drills: Sequence[Drill], number: int) -> None:
    """Write the drills of a set of a program, as one set of files or not at all.

    FileUnreadableError where the folder cannot be written.
    """
    names = names_of(program, len(drills))
    with staged(folder, [*PAGES, *names]) as stage:
        (stage / PAGES[0]).write_text(drill_page(program, drills, number, names), "utf-8")
        (stage / PAGES[1]).write_text(answers_page(program, drills, number), "utf-8")
        for name, drill in zip(names, drills, strict=True):
            (stage / name).write_bytes(drill.program.text.encode(program.encoding))


def names_of(program: Program, count: int) -> list[str]:
    """Names of the files of so many damaged programs: they end as that of the sound one does, where that is a word."""
    suffix = Path(program.name).suffix
    if not (suffix.isascii() and suffix[1:].isalnum()):
        suffix = Path(usual_name(program.text)).suffix
    return [f"drill-{at:02}{suffix}" for at in range(1, count + 1)]
