"""Pictures of a run for its report: SVG in both languages, of which the second one uses the long lines of the first."""

import re
from collections.abc import Mapping
from typing import Final, NamedTuple

from parser.findings.catalogue import LANGUAGES, Language
from sim.base.progress import Progress
from sim.show.draw.sheet import drawing
from sim.show.pictures.cut.of_path import PATH
from sim.show.pictures.files import label
from sim.show.pictures.gallery import PICTURES, Subject

WIDTH_PX = 1600


_LINE: Final = re.compile(r"<path [^>]{1000,}/>")


"""What is long enough to be shared."""


class Inline(NamedTuple):
    """A picture by its name, as SVG elements."""

    name: str
    svg: Mapping[Language, str]


def inline_pictures(subject: Subject, progress: Progress) -> list[Inline]:
    """All pictures that there are of what a run did."""
    names = [name for name in PICTURES if name != PATH]  # the cut shows it, and more
    found: list[Inline] = []
    for done, name in enumerate(names):
        progress("pictures", done, len(names))
        found.append(_inline(name, subject))
    return [picture for picture in found if picture.svg]


def _inline(name: str, subject: Subject) -> Inline:
    """A picture in both languages; in none where the run has nothing to show there."""
    drawn = {language: subject.draw(name, drawing(WIDTH_PX, language=language)) for language in LANGUAGES}
    svg = {key: svg.fragment(label(name, subject.title_in(key), key)) for key, svg in drawn.items() if svg is not None}
    return Inline(name, _sharing(name, svg) if svg else svg)


def _sharing(name: str, svg: Mapping[Language, str]) -> dict[Language, str]:
    """Pictures whose long lines stand in the first language alone; the others use them there, by ids of their own."""
    first, *others = svg
    lines = [line for line in dict.fromkeys(_LINE.findall(svg[first])) if all(line in svg[other] for other in others)]
    shared = dict(svg)
    for number, line in enumerate(lines, 1):
        own = f"{name}-line-{number}"
        shared[first] = shared[first].replace(line, line.replace("<path", f'<path id="{own}"', 1), 1)
        for other in others:
            shared[other] = shared[other].replace(line, f'<use href="#{own}"/>')
    return shared
