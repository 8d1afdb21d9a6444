"""The page of a shop."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, Final

from parser.findings.catalogue import LANGUAGES, Said, page
from sim.show.html.environment import rendered
from sim.show.index_page.thumbnail import HEIGHT, WIDTH

_ASSETS: Final = Path(__file__).with_name("assets")


def index_page(index: Mapping[str, Any], pictures: Sequence[str]) -> str:
    """``index.html`` of an index; `pictures` are the thumbnails of its programs, as SVG path data, in their order.

    The same index gives the same bytes. Whatever a program or a file name says stands escaped.
    """
    programs = index["programs"]
    codes = sorted({found["code"] for program in programs for found in program["findings"]})
    return rendered(
        _ASSETS,
        "index.html.j2",
        counts=index["counts"],
        data={
            "programs": [{**program, "picture": path} for program, path in zip(programs, pictures, strict=True)],
            "titles": {code: _title(code)._asdict() for code in codes},
            "box": [WIDTH, HEIGHT],
        },
    )


def _title(code: str) -> Said:
    return Said(*(page(code, language).title for language in LANGUAGES))
