"""The page of a shop.

A path as a picture the size of a thumbnail: data of an SVG path, some hundred bytes, drawn in the page's colours.
"""

from collections.abc import Sequence
from pathlib import Path
from typing import Final, NamedTuple

import numpy as np

from parser.findings.catalogue import LANGUAGES, Bilingual, page
from parser.geometry.curves import Curves, Floats
from sim.base.units import hours_text
from sim.show.draw.flatten import bounds_um, cut_runs, flatten, simplify
from sim.show.draw.svg import path_data
from sim.show.html.environment import rendered
from sim.show.index_page.model import CountsEntry, IndexDocument, IndexEntry, IndexRowEntry, ProgramEntry

WIDTH, HEIGHT = 96, 72
"""Of the box that the picture fills, whole units; y points down."""
_EDGE: Final = 3.0  # units left free on each side
_OFF: Final = 0.4  # units that a drawn line may leave the true one; it is rounded to half of a unit beside
_MOST: Final = 600  # corners; a path of more is drawn coarser


def thumbnail(toolpath: Curves) -> str:
    """The cuts of a path as SVG path data in a box of `WIDTH` by `HEIGHT`, jumps left out.

    Lines are at most 0.9 of a unit off, of which there are 90 from side to side; of more than `_MOST` corners each
    coarser drawing is off by twice as much.
    """
    low, high = bounds_um(toolpath)
    room = np.array([WIDTH, HEIGHT]) - 2.0 * _EDGE
    unit_um = max(float(((high - low) / room).max()), 1e-6)
    middle = (low + high) / 2.0
    points, row = flatten(toolpath, _OFF / 2.0 * unit_um)
    runs = cut_runs(points, row, toolpath.kind == 2)
    off = _OFF / 2.0
    while True:
        lines = [_in_box(simplify((run - middle) / unit_um, off)) for run in runs]
        if sum(map(len, lines)) <= _MOST or off > WIDTH:
            return "".join(map(path_data, lines[:_MOST]))
        off *= 2.0


def _in_box(points: Floats) -> Floats:
    """Points in units of the box."""
    return np.asarray(points * (1.0, -1.0) + (WIDTH / 2.0, HEIGHT / 2.0), dtype=np.float64)


_ASSETS: Final = Path(__file__).with_name("assets")


class BesideTheIndex(NamedTuple):
    """What of a program the index lacks: its picture as SVG path data, and its message in both languages."""

    picture: str
    message: Bilingual


def index_page(index: IndexDocument, additions: Sequence[BesideTheIndex]) -> str:
    """``index.html`` of an index; `additions` are more of its programs, in their order.

    The same index gives the same bytes. Whatever a program or a file name says stands escaped.
    """
    programs = index["programs"]
    codes = sorted({found["code"] for program in programs for found in program["findings"]})
    data: IndexEntry = {
        "programs": [_program(program, more) for program, more in zip(programs, additions, strict=True)],
        "titles": {code: title_of(code).entry() for code in codes},
        "box": [WIDTH, HEIGHT],
    }
    return rendered(_ASSETS, "index.html.j2", counts=counts_shown(index["counts"]), data=data)


def _program(program: IndexRowEntry, more: BesideTheIndex) -> ProgramEntry:
    time_s, least_s, most_s = (program[name] for name in ("time_s", "time_least_s", "time_most_s"))
    return {
        **program,
        "time": "" if time_s is None else hours_text(time_s),
        "time_within": "" if least_s is None or most_s is None else f"{hours_text(least_s)} … {hours_text(most_s)}",
        "worst_um": program["max_um"] if program["drawing_um"] is None else program["drawing_um"],
        "verdict": outcome_of(program),
        "picture": more.picture,
        "message": more.message.entry() if more.message.en else None,
    }


def outcome_of(program: IndexRowEntry) -> str:
    """The verdict of a program of an index as people are told it."""
    return "to-check" if program["to_check"] else str(program["verdict"])


def counts_shown(counts: CountsEntry) -> CountsEntry:
    """Counts of an index as people are told them: what is to be checked does not count among what passes."""
    return {**counts, "pass": counts["pass"] - counts["to_check"]}


def title_of(code: str) -> Bilingual:
    """Title of a code."""
    return Bilingual(*(page(code, language).title for language in LANGUAGES))
