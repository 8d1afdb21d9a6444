"""What an editor paints of a text, and the picture of its path.

Words of blocks as semantic tokens: numbers, the count direction, and whether a block is a line or an arc, wherever a
dialect has them.
"""

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Final, NamedTuple

from parser.findings.errors import ProgramError
from parser.program import moving
from parser.text.source import Field, Span
from sim.serve.editor.shown import Text
from sim.setup.scenario import load_scenario
from sim.show.draw.sheet import drawing
from sim.show.draw.style import THEMES, ThemeName
from sim.show.pictures.cut.of_path import PATH, draw_path, programmed
from sim.show.pictures.files import label

TYPES: Final = ("number", "property", "keyword", "function", "variable")
"""Of the protocol's own: numbers, count directions, lines, arcs, sides and registers of an offset."""
_TYPE_OF: Final = {
    **dict.fromkeys((Field.X, Field.Y, Field.COUNT, Field.RADIUS), "number"),
    Field.AXIS: "property",
    **dict.fromkeys((Field.SIDE, Field.REGISTER), "variable"),
}
_MOST_BLOCKS: Final = 20_000
"""That are painted: of more, an editor paints by its grammar alone."""
_WIDTH_PX: Final = 900


class _Painted(NamedTuple):
    span: Span
    type: str


def tokens_of(text: Text) -> list[int]:
    """Semantic tokens as the protocol counts them: five numbers each, places relative to the token before."""
    data: list[int] = []
    line = column = 0
    for painted in sorted(_painted(text)):
        places = text.places.range_of(painted.span)
        if places.start.line != places.end.line:
            continue
        by = places.start.line - line
        data += [by, places.start.character - (0 if by else column), places.end.character - places.start.character]
        data += [TYPES.index(painted.type), 0]
        line, column = places.start.line, places.start.character
    return data


def _painted(text: Text) -> Iterator[_Painted]:
    program = text.opened.program
    if program is None:
        return
    path, ends = program.toolpath, -1
    for row in range(min(len(path), _MOST_BLOCKS)):
        if int(path.source.span[row, 0]) < ends:
            continue  # a routine that runs twice stands there once
        ends = int(path.source.span[row, 1])
        for field in Field:
            span = path.source.field(row, field)
            if span is not None and span[1] > span[0]:
                yield _Painted(span, _TYPE_OF.get(field) or ("function" if path.is_arc[row] else "keyword"))


def path_svg(text: Text, theme: ThemeName) -> str:
    """The picture of the path of a text; empty where it holds no program, or nothing moves."""
    program = text.opened.program
    if program is None:
        return ""
    try:
        moving(program)
    except ProgramError:
        return ""
    machine = text.opened.settings.machine
    scenario = load_scenario(Path(program.name))
    scenario = scenario if machine is None else replace(scenario, machine=machine)
    sheet = drawing(_WIDTH_PX, THEMES[theme], text.language)
    said = label(PATH, scenario.title_in(text.language), text.language)
    return draw_path(sheet, programmed(program, scenario)).document(said, _WIDTH_PX)
