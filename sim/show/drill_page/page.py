"""The two pages of a set of fault drills, each a file that needs no other.

A drill as its pages show it: texts in both languages, lines of the program, picture.

The drawing and the path of a damaged program over it, as SVG path data in one box.
"""

from collections.abc import Collection, Sequence
from pathlib import Path
from typing import Any, Final, NamedTuple, TypedDict

import numpy as np

from parser.documents import SaidEntry
from parser.findings.catalogue import LANGUAGES, Bilingual, length, texts
from parser.findings.codes import Severity
from parser.findings.findings import Finding
from parser.geometry.curves import Curves, Floats
from parser.program import Program
from parser.text.encoding import printable
from parser.toolpath import Toolpath
from parser.units import mm_text
from sim.show.draw.flatten import bounds_um, cut_runs, flatten, simplify
from sim.show.draw.svg import path_data
from sim.show.html.environment import rendered
from sim.show.texts import bilingual
from sim.teach.drills import LEVELS, Drill, Level, lines_of
from sim.teach.kinds import groups_of

WIDTH, HEIGHT = 720, 480
"""Of the box that the picture fills, whole units; y points down."""
_EDGE: Final = 12.0  # units left free on each side
_OFF: Final = 0.5  # units that a drawn line may leave the true one
_BEYOND: Final = 0.6  # of the drawing's extent: as far as a path is shown beside it


class Picture(NamedTuple):
    """SVG path data.

    Attributes
    ----------
    drawing, path, fault
        The sound path, the damaged one, and of that the blocks in which the fault stands; cuts alone.
    is_beyond
        Whether the damaged path leaves the box.
    """

    drawing: str
    path: str
    fault: str
    is_beyond: bool


class _Frame(NamedTuple):
    """µm to a unit of the box, and the place in its middle, µm."""

    unit_um: float
    middle_um: Floats


def picture_of(sound: Toolpath, damaged: Toolpath, lines: Collection[int]) -> Picture:
    """Both paths, in the box that holds the drawing and as much of the damaged path as stays near it."""
    low, high = bounds_um(sound)
    near = _BEYOND * float((high - low).max())
    reached = bounds_um(damaged)
    low = np.minimum(low, np.maximum(reached[0], low - near))
    high = np.maximum(high, np.minimum(reached[1], high + near))
    room = np.array([WIDTH, HEIGHT]) - 2.0 * _EDGE
    frame = _Frame(max(float(((high - low) / room).max()), 1e-6), (low + high) / 2.0)
    is_fault = np.isin(damaged.source.line, list(lines))
    return Picture(
        _data(sound, ~sound.is_jump, frame),
        _data(damaged, ~damaged.is_jump, frame),
        _data(damaged, ~damaged.is_jump & is_fault, frame),
        bool((reached[0] < low - 1.0).any() or (reached[1] > high + 1.0).any()),
    )


def _data(path: Curves, is_drawn: np.ndarray[tuple[int], np.dtype[np.bool_]], frame: _Frame) -> str:
    points, row = flatten(path, _OFF / 2.0 * frame.unit_um)
    runs = cut_runs(points, row, ~is_drawn)
    return "".join(path_data(_in_box(simplify((run - frame.middle_um) / frame.unit_um, _OFF / 2.0))) for run in runs)


def _in_box(points: Floats) -> Floats:
    return np.asarray(points * (1.0, -1.0) + (WIDTH / 2.0, HEIGHT / 2.0), dtype=np.float64)


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
        "kind": bilingual(f"drill.kind-{drill.kind}"),
        "was": [printable(line) for line in drill.was],
        "stands": [printable(line) for line in drill.stands],
        "does": _does(drill),
        "findings": [_drill_document(found) for found in gravest[:_MOST_FINDINGS]],
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


def _form(path: Toolpath, row: int) -> Bilingual:
    if path.is_arc[row]:
        turn = "counter_clockwise" if path.sweep_rad[row] > 0.0 else "clockwise"
        return bilingual(f"drill.{turn}", radius=mm_text(float(path.radius_um[row])))
    return bilingual("drill.jump" if path.is_jump[row] else "drill.line")


def _pair(place: "np.ndarray[tuple[int], np.dtype[np.float64]]") -> str:
    return ", ".join(mm_text(float(value)) for value in place)


def _does(drill: Drill) -> Bilingual:
    if drill.by.is_cut_otherwise:
        return bilingual("drill.cuts-otherwise")
    if drill.by.is_there:
        return bilingual("drill.leaves", far=length(drill.by.most_um))
    return bilingual("drill.path-stays")


def _rank(drill: Drill, found: Finding) -> tuple[bool, int]:
    """Findings in the lines of the fault come first, and the graver of them."""
    return found.line not in drill.lines, list(Severity).index(found.severity)


def _drill_document(found: Finding) -> dict[str, Any]:
    said_of = {language: texts(found, language) for language in LANGUAGES}
    return {
        "code": found.code,
        "line": found.line,
        "severity": found.severity.value,
        "message": Bilingual(*(said_of[language].message for language in LANGUAGES)),
    }


_ASSETS: Final = Path(__file__).with_name("assets")


class DrillEntry(TypedDict):
    """A task: lines of the program that are right answers, what is wrong, and what gives it away."""

    lines: list[int]
    group: str
    level: Level


class DrillsEntry(TypedDict):
    """The number of the set, its tasks, and what the kinds of fault and the levels are called."""

    set: int
    drills: list[DrillEntry]
    groups: dict[str, SaidEntry]
    levels: dict[str, SaidEntry]


def drill_page(sound: Program, drills: Sequence[Drill], number: int, files: Sequence[str]) -> str:
    """``drill.html``: the tasks one after the other, with what weighs the answers; printed, the tasks alone.

    `number` is that of the set, `files` are the names of the damaged programs. The same set gives the same bytes.
    Whatever a program says stands escaped.
    """
    data: DrillsEntry = {
        "set": number,
        "drills": [{"lines": list(drill.lines), "group": drill.group, "level": drill.level} for drill in drills],
        "groups": {group: _in_both(f"drill.group-{group}") for group in groups_of(sound)},
        "levels": {level: _in_both(f"drill.level-name-{level}") for level in LEVELS},
    }
    return _page("drill.html.j2", sound, drills, number, files=files, data=data, places=places_of(sound.toolpath))


def _in_both(key: str) -> SaidEntry:
    en, zh = bilingual(key)
    return {"en": en, "zh": zh}


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
