"""What is written of fault drills: their two pages, and the damaged programs with them; all or none."""

from collections.abc import Sequence
from pathlib import Path
from typing import Final

from parser.findings.catalogue import Bilingual
from parser.program import Program, usual_name
from sim.base.files import staged
from sim.process.cut import Started
from sim.show.drill_page import answers_page, drill_page
from sim.show.operation_page.page import operation_answers_page, operation_page
from sim.teach.drills import Drill
from sim.teach.operation.incidents import OperationDrill

PAGES: Final = ("drill.html", "answers.html")
OPERATION_PAGES: Final = ("operation.html", "operation-answers.html")
"""Those of drills of operation."""


def drills_into(folder: Path, program: Program, drills: Sequence[Drill], number: int) -> None:
    """Write the drills of a set of a program, as one set of files or not at all.

    FileUnreadableError where the folder cannot be written.
    """
    names = drill_names(program, len(drills))
    with staged(folder, [*PAGES, *names]) as stage:
        (stage / PAGES[0]).write_text(drill_page(program, drills, number, names), "utf-8")
        (stage / PAGES[1]).write_text(answers_page(program, drills, number), "utf-8")
        for name, drill in zip(names, drills, strict=True):
            (stage / name).write_bytes(drill.program.text.encode(program.encoding))


def operation_into(folder: Path, title: Bilingual, cut: Started, drills: Sequence[OperationDrill], number: int) -> None:
    """Write the two pages of drills of operation, as one set of files or not at all.

    FileUnreadableError where the folder cannot be written.
    """
    pages = (operation_page, operation_answers_page)
    with staged(folder, OPERATION_PAGES) as stage:
        for name, page in zip(OPERATION_PAGES, pages, strict=True):
            (stage / name).write_text(page(title, cut, drills, number), "utf-8")


def drill_names(program: Program, count: int) -> list[str]:
    """Names of the files of so many damaged programs: they end as that of the sound one does, where that is a word."""
    suffix = Path(program.name).suffix
    if not (suffix.isascii() and suffix[1:].isalnum()):
        suffix = Path(usual_name(program.text)).suffix
    return [f"drill-{at:02}{suffix}" for at in range(1, count + 1)]
