"""Films of a run as files: animated pictures through pillow, mp4 through the encoder of imageio-ffmpeg.

The clock of a film: which moment of the run each frame shows.

Write a film of a run.
"""

import importlib
from collections.abc import Callable, Iterator, Mapping
from fractions import Fraction
from itertools import chain, pairwise
from pathlib import Path
from types import ModuleType
from typing import Final, NamedTuple

import numpy as np
from PIL import Image

from parser.findings.errors import FileUnreadableError, SettingsError
from parser.geometry.curves import Floats
from sim.base.files import staged
from sim.base.progress import Progress
from sim.run.course import course_of
from sim.run.recording import Recording
from sim.show.film.scene import Pixels
from sim.show.film.screen import Look, Screen

HOLD_S: Final = 1.0
"""The end stands as long as this, or a tenth of a shorter film."""


class FilmClock(NamedTuple):
    """How a run of `duration_s` becomes a film of `seconds` with `fps` frames in each.

    The run goes by at one speed, jumps and pauses too; then its last moment stands for a while.
    """

    seconds: float
    fps: int
    duration_s: float

    @property
    def frames(self) -> int:
        """Number of frames, 2 or more."""
        return max(round(self.seconds * self.fps), 2)

    @property
    def speed(self) -> float:
        """Seconds of the run in each second of the film."""
        return self.duration_s / (self.seconds - min(HOLD_S, self.seconds / 10.0))

    @property
    def times_s(self) -> Floats:
        """(frames,) moments of the run from 0 on, past its end where that stands."""
        return np.asarray(np.arange(self.frames) * (self.speed / self.fps), dtype=np.float64)

    def delays_ms(self, grain_ms: int) -> list[int]:
        """How long each frame stands, in whole grains of so many ms that add up to the film's length."""
        frame_ms = Fraction(1000, self.fps * grain_ms)
        ends = [round(frame * frame_ms) * grain_ms for frame in range(self.frames + 1)]
        return [past - first for first, past in pairwise(ends)]


COLOURS: Final = 256
MOST_HELD_PX: Final = 600_000_000
"""All frames of an animated picture are held at once, and pillow holds them again: two bytes to each pixel."""
GIF_GRAIN_MS: Final = 10
GIF_FPS: Final = 50
"""Readers of GIFs take shorter delays than two grains for a mistake, and wait 0.1 s."""
CRF: Final = 18
"""Quality of x264: thin lines and text stay sharp."""


class Frames(NamedTuple):
    """Frames as they are made, each (h, w, 3), with some of them beforehand that show what colours there are."""

    made: Iterator[Pixels]
    samples: tuple[Pixels, ...]


class Format(NamedTuple):
    """How a film is written, and how many frames a second it can have."""

    write: Callable[[Path, Frames, FilmClock], None]
    most_fps: int
    holds_frames: bool


def write_gif(path: Path, frames: Frames, clock: FilmClock) -> None:
    """Write a GIF."""
    _write_animated(path, frames, "GIF", duration=clock.delays_ms(GIF_GRAIN_MS), optimize=False)


def write_webp(path: Path, frames: Frames, clock: FilmClock) -> None:
    """Write an animated WebP, without loss: that keeps lines sharp, and is smaller here."""
    _write_animated(
        path, frames, "WEBP", duration=clock.delays_ms(1), lossless=True, quality=30, method=1, kmin=30, kmax=60
    )


def write_apng(path: Path, frames: Frames, clock: FilmClock) -> None:
    """Write an animated PNG."""
    _write_animated(path, frames, "PNG", duration=clock.delays_ms(1))


_SAME_BYTES: Final = ("-sws_flags", "bitexact+accurate_rnd", "-flags:v", "+bitexact", "-fflags", "+bitexact")
"""Colours are rounded the same way wherever a frame lies in memory ("ffmpeg-scaler", "Scaler Options": ``bitexact``,
``accurate_rnd``), and no version is written. Without these, one film among some 300 was seen to have other bytes."""


def write_mp4(path: Path, frames: Frames, clock: FilmClock) -> None:
    """Write H.264. FileUnreadableError where the encoder could not."""
    library = encoder()
    first = next(frames.made)
    tall, wide = first.shape[:2]
    sink = library.write_frames(
        str(path),
        (wide, tall),
        fps=clock.fps,
        codec="libx264",
        quality=None,
        macro_block_size=1,  # any even size: players have long not needed more
        ffmpeg_log_level="error",
        output_params=["-crf", str(CRF), "-preset", "fast", "-movflags", "+faststart", *_SAME_BYTES],
    )
    try:
        sink.send(None)
        for frame in chain([first], frames.made):
            sink.send(frame.tobytes())
    except OSError:
        raise FileUnreadableError("encoder-failed", file=path.name) from None
    finally:
        sink.close()
    if not path.exists() or not path.stat().st_size:
        raise FileUnreadableError("encoder-wrote-nothing", file=path.name)


FORMATS: Final[Mapping[str, Format]] = {
    ".gif": Format(write_gif, GIF_FPS, holds_frames=True),
    ".webp": Format(write_webp, 60, holds_frames=True),
    ".apng": Format(write_apng, 60, holds_frames=True),
    ".mp4": Format(write_mp4, 60, holds_frames=False),
}


def _write_animated(path: Path, frames: Frames, kind: str, **options: object) -> None:
    """Write all frames in the 256 colours that fit the samples best; the picture repeats for ever."""
    palette = _palette(frames.samples)
    images = [Image.fromarray(frame).quantize(palette=palette, dither=Image.Dither.NONE) for frame in frames.made]
    images[0].save(path, format=kind, save_all=True, append_images=images[1:], loop=0, **options)


def _palette(samples: tuple[Pixels, ...]) -> Image.Image:
    wide, tall = samples[0].shape[1], samples[0].shape[0]
    sheet = Image.new("RGB", (wide, tall * len(samples)))
    for number, sample in enumerate(samples):
        sheet.paste(Image.fromarray(sample), (0, number * tall))
    return sheet.quantize(COLOURS, method=Image.Quantize.MEDIANCUT, dither=Image.Dither.NONE)


def encoder() -> ModuleType:
    """The library with the encoder, an extra for this format alone. SettingsError where it is not installed."""
    try:
        return importlib.import_module("imageio_ffmpeg")
    except ImportError:
        raise SettingsError("no-encoder") from None


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
