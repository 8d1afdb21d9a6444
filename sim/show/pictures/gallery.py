"""All pictures of a run by name."""

from collections.abc import Mapping
from typing import Final, NamedTuple, Protocol

from parser.findings.catalogue import Language
from sim.run.recording import Recording
from sim.show.draw import style
from sim.show.draw.sheet import AnyCanvas, Sheet
from sim.show.pictures.cut.of_run import cut_picture
from sim.show.pictures.deviation.along import draw_along
from sim.show.pictures.deviation.histogram import draw_histogram
from sim.show.pictures.deviation.polar import draw_polar
from sim.show.pictures.deviation.samples import Samples, samples_of
from sim.show.pictures.deviation.whiskers import draw_whiskers
from sim.show.pictures.deviation.worst import draw_worst
from sim.show.pictures.motion.picture import draw_motion
from sim.show.words import Words


class Subject(NamedTuple):
    """What pictures show: a recorded run, and how far its samples lie from the ideal path."""

    recording: Recording
    samples: Samples

    @property
    def title(self) -> str:
        """Title of the run."""
        return self.recording.run.scenario.title


def subject_of(recording: Recording) -> Subject:
    """A recorded run as the subject of pictures."""
    return Subject(recording, samples_of(recording.run))


class Draw(Protocol):
    """Draws a picture on a sheet of any kind."""

    def __call__(self, sheet: Sheet[AnyCanvas], subject: Subject) -> AnyCanvas | None:
        """The page, drawn; None where the run has nothing to show there."""


class Picture(NamedTuple):
    """A picture: how it is drawn, and how narrow it can be, px."""

    draw: Draw
    least_px: int = style.LEAST_WIDTH


def _cut(sheet: Sheet[AnyCanvas], subject: Subject) -> AnyCanvas:
    return cut_picture(sheet, subject.recording.run, subject.recording.pieces)


def _along(sheet: Sheet[AnyCanvas], subject: Subject) -> AnyCanvas:
    return draw_along(sheet, subject.samples)


def _whiskers(sheet: Sheet[AnyCanvas], subject: Subject) -> AnyCanvas:
    return draw_whiskers(sheet, subject.samples)


def _polar(sheet: Sheet[AnyCanvas], subject: Subject) -> AnyCanvas | None:
    return draw_polar(sheet, subject.samples)


def _histogram(sheet: Sheet[AnyCanvas], subject: Subject) -> AnyCanvas:
    return draw_histogram(sheet, subject.samples)


def _worst(sheet: Sheet[AnyCanvas], subject: Subject) -> AnyCanvas:
    return draw_worst(sheet, subject.samples, subject.recording.steps)


def _motion(sheet: Sheet[AnyCanvas], subject: Subject) -> AnyCanvas:
    return draw_motion(sheet, subject.recording.run)


PICTURES: Final[Mapping[str, Picture]] = {
    "cut": Picture(_cut, least_px=style.LEAST_THUMBNAIL),
    "along": Picture(_along),
    "whiskers": Picture(_whiskers),
    "polar": Picture(_polar),
    "histogram": Picture(_histogram),
    "worst": Picture(_worst),
    "motion": Picture(_motion),
}


def label(name: str, subject: Subject, language: Language) -> str:
    """What a picture is, for those who cannot see it."""
    return f"{subject.title}: {Words(language)(f'common.picture_{name}')}"
