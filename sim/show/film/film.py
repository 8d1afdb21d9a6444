"""Write a film of a run."""

from collections.abc import Iterator
from pathlib import Path
from typing import Final

from parser.findings.errors import SettingsError
from sim.base.files import staged
from sim.base.progress import Progress
from sim.run.course import course_of
from sim.run.recording import Recording
from sim.show.film.scene import Pixels
from sim.show.film.screen import Look, Screen
from sim.show.film.writers import FORMATS, MOST_HELD_PX, FilmClock, Format, Frames, encoder

FORMAT_NAMES: Final = ", ".join(FORMATS)


def format_of(path: Path, seconds: float, fps: int, look: Look) -> Format:
    """How a file of this name is written; SettingsError where a film of this length and size cannot be."""
    suffix = path.suffix.lower()
    if suffix not in FORMATS:
        raise SettingsError("film-suffix", path=path, formats=FORMAT_NAMES)
    found = FORMATS[suffix]
    if fps > found.most_fps:
        raise SettingsError("too-many-frames-a-second", suffix=suffix, most_fps=found.most_fps, fps=fps)
    pixels = round(seconds * fps) * look.width_px * look.height_px
    if found.holds_frames and pixels > MOST_HELD_PX:
        raise SettingsError(
            "film-needs-memory",
            suffix=suffix,
            frames=round(seconds * fps),
            width_px=look.width_px,
            height_px=look.height_px,
            memory_gb=2 * pixels / 1e9,
        )
    if not found.holds_frames and (look.width_px % 2 or look.height_px % 2):
        raise SettingsError("film-size-odd", suffix=suffix, width_px=look.width_px, height_px=look.height_px)
    if suffix == ".mp4":
        encoder()
    return found


def write_film(  # noqa: PLR0913, PLR0917 - a file, what it shows, and how
    path: Path, recording: Recording, seconds: float, fps: int, look: Look, progress: Progress
) -> None:
    """Write a film of a recorded run, whole or not at all; its end stands for a second.

    SettingsError where there can be no such film, FileUnreadableError where the file cannot be written.
    """
    chosen = format_of(path, seconds, fps, look)
    course = course_of(recording)
    clock = FilmClock(seconds, fps, course.duration_s)
    screen = Screen(course, look)

    def frame_at(t_s: float) -> Pixels:
        return screen.frame(t_s, screen.whole, clock.speed)

    def frames() -> Iterator[Pixels]:
        for number, t_s in enumerate(clock.times_s.tolist()):
            progress("film", number, clock.frames)
            yield frame_at(t_s)

    with staged(path.parent, [path.name]) as stage:
        samples = tuple(frame_at(share * course.duration_s) for share in (1.0, 0.5, 0.0))
        chosen.write(stage / path.name, Frames(frames(), samples), clock)
