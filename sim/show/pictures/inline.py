"""Pictures of a run for its report: SVG in both languages."""

from collections.abc import Mapping
from typing import NamedTuple

from parser.findings.catalogue import LANGUAGES, Language
from sim.run.recording import Recording
from sim.show.draw.sheet import drawing
from sim.show.pictures.gallery import PICTURES, Subject, label, subject_of
from sim.table.motion import Progress

WIDTH_PX = 1600


class Inline(NamedTuple):
    """A picture by its name, as SVG elements."""

    name: str
    svg: Mapping[Language, str]


def inline_pictures(recording: Recording, progress: Progress) -> list[Inline]:
    """All pictures that there are of a run."""
    subject = subject_of(recording)
    found: list[Inline] = []
    for done, name in enumerate(PICTURES):
        progress("pictures", done, len(PICTURES))
        found.append(_inline(name, subject))
    return [picture for picture in found if picture.svg]


def _inline(name: str, subject: Subject) -> Inline:
    """A picture in both languages; in none where the run has nothing to show there."""
    drawn = {one: PICTURES[name].draw(drawing(WIDTH_PX, language=one), subject) for one in LANGUAGES}
    svg = {one: svg.fragment(label(name, subject, one)) for one, svg in drawn.items() if svg is not None}
    return Inline(name, svg)
