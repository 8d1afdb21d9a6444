"""The two pages of a set of fault drills, each a file that needs no other."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any, Final

from parser.program import Program
from parser.text.encoding import printable
from sim.drill.drills import Drill
from sim.drill.kinds import groups_of
from sim.show.drill_page.picture import HEIGHT, WIDTH
from sim.show.drill_page.view import places_of, view_of
from sim.show.html.environment import rendered

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
