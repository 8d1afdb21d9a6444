"""The two pages of a set of fault drills, each a file that needs no other.

A drill as its pages show it: texts in both languages, lines of the program, picture.
"""

from collections.abc import Sequence
from pathlib import Path
from typing import Any, Final

import numpy as np

from parser.findings.catalogue import LANGUAGES, Said, length, texts
from parser.findings.codes import Severity
from parser.findings.findings import Finding
from parser.program import Program
from parser.text.encoding import printable
from parser.toolpath import Toolpath
from parser.units import mm_text
from sim.show.drill_page.picture import HEIGHT, WIDTH, picture_of
from sim.show.html.environment import rendered
from sim.show.words import said
from sim.teach.drill.drills import Drill, lines_of
from sim.teach.drill.kinds import groups_of

_MOST_FINDINGS: Final = 4
"""That an answer cites: a fault near the beginning may have dozens."""


def view_of(drill: Drill, sound: Program) -> dict[str, Any]:
    """What a page shows of a drill."""
    gravest = sorted(drill.findings, key=lambda found: _rank(drill, found))
    return {
        "level": drill.level,
        "group": drill.group,
        "lines": drill.lines,
        "listed": list(enumerate(map(printable, lines_of(drill.program)), 1)),
        "kind": said(f"drill.kind-{drill.kind}"),
        "was": [printable(line) for line in drill.was],
        "stands": [printable(line) for line in drill.stands],
        "does": _does(drill),
        "findings": [_told(found) for found in gravest[:_MOST_FINDINGS]],
        "picture": picture_of(sound.toolpath, drill.program.toolpath, drill.lines),
    }


def places_of(path: Toolpath) -> list[dict[str, Any]]:
    """Where the blocks of a drawing end, and how they go there: what people need to work a fault out."""
    return [
        {
            "name": printable(path.source.names.of_row(row)),
            "form": _form(path, row),
            "centre": _pair(path.center_um[row]) if path.is_arc[row] else "",
            "end": _pair(path.end_um[row]),
        }
        for row in range(len(path))
    ]


def _form(path: Toolpath, row: int) -> Said:
    if path.is_arc[row]:
        turn = "counter_clockwise" if path.sweep_rad[row] > 0.0 else "clockwise"
        return said(f"drill.{turn}", radius=mm_text(float(path.radius_um[row])))
    return said("drill.jump" if path.is_jump[row] else "drill.line")


def _pair(place: "np.ndarray[tuple[int], np.dtype[np.float64]]") -> str:
    return ", ".join(mm_text(float(value)) for value in place)


def _does(drill: Drill) -> Said:
    if drill.by.is_cut_otherwise:
        return said("drill.cuts-otherwise")
    if drill.by.is_there:
        return said("drill.leaves", far=length(drill.by.most_um))
    return said("drill.path-stays")


def _rank(drill: Drill, found: Finding) -> tuple[bool, int]:
    """Findings in the lines of the fault come first, and the graver of them."""
    return found.line not in drill.lines, list(Severity).index(found.severity)


def _told(found: Finding) -> dict[str, Any]:
    said_of = {language: texts(found, language) for language in LANGUAGES}
    return {
        "code": found.code,
        "line": found.line,
        "severity": found.severity.value,
        "message": Said(*(said_of[language].message for language in LANGUAGES)),
    }


_ASSETS: Final = Path(__file__).with_name("assets")


def drill_page(sound: Program, drills: Sequence[Drill], number: int, files: Sequence[str]) -> str:
    """``drill.html``: the tasks one after the other, with what weighs the answers; printed, the tasks alone.

    `number` is that of the set, `files` are the names of the damaged programs. The same set gives the same bytes.
    Whatever a program says stands escaped.
    """
    data = {
        "set": number,
        "drills": [{"lines": drill.lines, "group": drill.group, "level": drill.level} for drill in drills],
    }
    return _page("drill.html.j2", sound, drills, number, files=files, data=data, places=places_of(sound.toolpath))


def answers_page(sound: Program, drills: Sequence[Drill], number: int) -> str:
    """``answers.html``: what is wrong in each drill, what stood there, and what it does. It needs no script."""
    return _page("answers.html.j2", sound, drills, number)


def _page(template: str, sound: Program, drills: Sequence[Drill], number: int, **more: Any) -> str:
    return rendered(
        _ASSETS,
        template,
        name=printable(sound.name),
        number=number,
        drills=[view_of(drill, sound) for drill in drills],
        groups=groups_of(sound),
        box=(WIDTH, HEIGHT),
        **more,
    )
