"""The page of a shop."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, Final, NamedTuple

from parser.findings.catalogue import LANGUAGES, Said, page
from sim.show.html.environment import rendered
from sim.show.index_page.thumbnail import HEIGHT, WIDTH

_ASSETS: Final = Path(__file__).with_name("assets")


class Beside(NamedTuple):
    """What of a program the index lacks: its picture as SVG path data, and its message in both languages."""

    picture: str
    message: Said


def index_page(index: Mapping[str, Any], beside: Sequence[Beside]) -> str:
    """``index.html`` of an index; `beside` are more of its programs, in their order.

    The same index gives the same bytes. Whatever a program or a file name says stands escaped.
    """
    programs = index["programs"]
    codes = sorted({found["code"] for program in programs for found in program["findings"]})
    return rendered(
        _ASSETS,
        "index.html.j2",
        counts=index["counts"],
        data={
            "programs": [_program(program, more) for program, more in zip(programs, beside, strict=True)],
            "titles": {code: _title(code)._asdict() for code in codes},
            "box": [WIDTH, HEIGHT],
        },
    )


def _program(program: Mapping[str, Any], more: Beside) -> dict[str, Any]:
    return {**program, "picture": more.picture, "message": more.message._asdict() if more.message.en else None}


def _title(code: str) -> Said:
    return Said(*(page(code, language).title for language in LANGUAGES))
