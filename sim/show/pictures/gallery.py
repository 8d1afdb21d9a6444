"""All pictures by name: the list that commands, report and tests go by."""

from collections.abc import Mapping
from typing import Final, NamedTuple, Protocol

from parser.findings.catalogue import Language
from sim.run.dryrun import DryRun
from sim.run.recording import Recording
from sim.show.draw import style
from sim.show.draw.sheet import AnyCanvas, Sheet
from sim.show.pictures.cut.of_path import PATH, Programmed, draw_path
from sim.show.pictures.cut.of_run import draw_cut_of_run
from sim.show.pictures.cut.picture import Shapes
from sim.show.pictures.deviation.along import draw_along, draw_histogram
from sim.show.pictures.deviation.frame import Samples, samples_of
from sim.show.pictures.deviation.polar import draw_polar
from sim.show.pictures.deviation.whiskers import draw_whiskers
from sim.show.pictures.deviation.worst import draw_worst
from sim.show.pictures.motion.picture import draw_motion


class Subject(NamedTuple):
    """What pictures show (`sim.show.pictures.files.Drawable`).

    It is a recorded run, how far its samples lie from the ideal path, and what pictures of its cut have in common.
    """

    recording: Recording
    samples: Samples
    shapes: Shapes

    def title_in(self, language: Language) -> str:
        """Title of the run in a language."""
        return self.recording.run.scenario.title_in(language)

    def least_px(self, name: str) -> int:
        """How narrow a picture can be."""
        return PICTURES[name].least_px

    def draw(self, name: str, sheet: Sheet[AnyCanvas]) -> AnyCanvas | None:
        """The page of a picture, drawn; None where the run has nothing to show there."""
        return PICTURES[name].draw(sheet, self)


def subject_of(recording: Recording) -> Subject:
    """A recorded run as the subject of pictures."""
    return Subject(recording, samples_of(recording.run), Shapes())


class Draw(Protocol):
    """Draws a picture on a sheet of any kind."""

    def __call__(self, sheet: Sheet[AnyCanvas], subject: Subject, /) -> AnyCanvas | None:
        """The page, drawn; None where the run has nothing to show there."""


class DrawSamples(Protocol):
    """Draws a picture of deviations, as `Draw` does."""

    def __call__(self, sheet: Sheet[AnyCanvas], samples: Samples, /) -> AnyCanvas | None:
        """The page, drawn; None where there is nothing to show."""


class DrawRun(Protocol):
    """Draws a picture of a run, as `Draw` does."""

    def __call__(self, sheet: Sheet[AnyCanvas], run: DryRun, /) -> AnyCanvas | None:
        """The page, drawn; None where there is nothing to show."""


class Picture(NamedTuple):
    """A picture: how it is drawn, and how narrow it can be, px."""

    draw: Draw
    least_px: int = style.LEAST_WIDTH


def _of_samples(draw: DrawSamples) -> Draw:
    def drawn(sheet: Sheet[AnyCanvas], subject: Subject) -> AnyCanvas | None:
        return draw(sheet, subject.samples)

    return drawn


def _of_run(draw: DrawRun) -> Draw:
    def drawn(sheet: Sheet[AnyCanvas], subject: Subject) -> AnyCanvas | None:
        return draw(sheet, subject.recording.run)

    return drawn


def _path(sheet: Sheet[AnyCanvas], run: DryRun) -> AnyCanvas:
    return draw_path(sheet, Programmed(run.program, run.scenario, run.offset, run.checked))


def _cut(sheet: Sheet[AnyCanvas], subject: Subject) -> AnyCanvas:
    return draw_cut_of_run(sheet, subject.recording.run, subject.recording.pieces, subject.shapes)


def _worst(sheet: Sheet[AnyCanvas], subject: Subject) -> AnyCanvas:
    return draw_worst(sheet, subject.samples, subject.recording.steps)


PICTURES: Final[Mapping[str, Picture]] = {
    PATH: Picture(_of_run(_path), least_px=style.LEAST_THUMBNAIL),
    "cut": Picture(_cut, least_px=style.LEAST_THUMBNAIL),
    "along": Picture(_of_samples(draw_along)),
    "whiskers": Picture(_of_samples(draw_whiskers)),
    "polar": Picture(_of_samples(draw_polar)),
    "histogram": Picture(_of_samples(draw_histogram)),
    "worst": Picture(_worst),
    "motion": Picture(_of_run(draw_motion)),
}


"""By the names that ``drycut draw --picture`` takes, in the order of the report; all but ``path`` need a run."""
