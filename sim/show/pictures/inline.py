"""Pictures of a run for its report: SVG in both languages."""

from collections.abc import Mapping
from typing import NamedTuple

from parser.findings.catalogue import LANGUAGES, Language
from sim.show.draw.sheet import drawing
from sim.show.pictures.gallery import PICTURES, Subject
from sim.show.pictures.path import PATH
from sim.show.pictures.shown import label
from sim.table.progress import Progress

WIDTH_PX = 1600


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
    drawn = {one: subject.draw(name, drawing(WIDTH_PX, language=one)) for one in LANGUAGES}
    svg = {one: svg.fragment(label(name, subject.title, one)) for one, svg in drawn.items() if svg is not None}
    return Inline(name, svg)
