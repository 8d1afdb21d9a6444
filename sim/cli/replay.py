"""``drycut replay``."""

import math
import re
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from parser.findings.errors import Message, ProgramError
from sim.cli.scenario_options import overridden, overrides_of, refused, scenario_options, spark_options
from sim.cli.spoken import Spoken, spoken, words
from sim.cli.spoken.values import DecimalNumber, FilePath, WholeNumber

if TYPE_CHECKING:
    from sim.base.progress import Progress
    from sim.run.recording import Recording
    from sim.show.draw.style import ThemeName
    from sim.show.film.screen import Look

_SIZE = re.compile(r"(\d{3,4})\s*[x×]\s*(\d{3,4})", re.ASCII)
PAGE = ".html"
LEAST_PX, MOST_PX = (320, 240), (3840, 2160)
_BOUNDS = f"{LEAST_PX[0]}x{LEAST_PX[1]} to {MOST_PX[0]}x{MOST_PX[1]}"


class FrameSize(click.ParamType):  # type: ignore[type-arg]  # generic in newer clicks alone
    """Width and height of a frame, px."""

    name = "size"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> tuple[int, int]:
        """Width and height."""
        if isinstance(value, tuple):
            return value
        match = _SIZE.fullmatch(value.strip().lower())
        if not match:
            raise click.BadParameter(Message("no-size", found=value), ctx, param)
        size = int(match[1]), int(match[2])
        if any(not least <= side <= most for least, side, most in zip(LEAST_PX, size, MOST_PX, strict=True)):
            raise click.BadParameter(Message("size-out-of-bounds", found=value, bounds=_BOUNDS), ctx, param)
        return size


class Seconds(DecimalNumber):
    """A length of time within bounds, which "nan" passes."""

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """The length, s."""
        seconds = super().convert(value, param, ctx)
        if math.isnan(seconds):
            raise click.BadParameter(Message("no-duration", found=value), ctx, param)
        return seconds


@click.command(cls=Spoken)
@click.argument("path", type=FilePath(path_type=Path), metavar="PROGRAM|SCENARIO")
@click.option(
    "-o",
    "--output",
    type=FilePath(path_type=Path, dir_okay=False),
    metavar="FILE",
)
@click.option(
    "--seconds",
    type=Seconds(0.5, 600.0),
    default=10.0,
    show_default=True,
)
@click.option("--fps", type=WholeNumber(1, 60), default=25, show_default=True)
@click.option("--size", type=FrameSize(), default="1280x720", show_default=True)
@click.option("--theme", type=click.Choice(["light", "dark"]), default="light", show_default=True)
@scenario_options
@spark_options
def replay(  # noqa: PLR0913, PLR0917 - click hands over each option by its name
    path: Path,
    output: Path | None,
    seconds: float,
    fps: int,
    size: tuple[int, int],
    theme: "ThemeName",
    **options: Any,
) -> None:
    """Dry-run a 3B or ISO program, or a scenario folder that holds one, and watch it being cut.

    \b
    drycut replay part.3b -o part.html
    drycut replay part.3b -o cut.mp4
    drycut replay scenarios/keyhole -o cut.gif --seconds 5 --fps 20 --size 640x360
    drycut replay part.3b -o cut.webp --thickness 60mm --theme dark --lang zh
    """  # noqa: D301 - click keeps the lines of a paragraph that begins with a backspace
    from parser.program import moving
    from sim.cli.progress import StageProgress
    from sim.jobs.shop import program_read, source_of
    from sim.run.findings import verdict
    from sim.run.recording import recorded, stages_of
    from sim.show.film.screen import Look
    from sim.show.terminal.printer import say

    if output is None:
        raise click.UsageError(Message("replay-without-output"))
    look, is_page = Look(*size, theme, spoken()), output.suffix.lower() == PAGE
    if not is_page:
        _refuse(output, seconds, fps, look)
    scenario = overridden(path, overrides_of(options))
    try:
        program = moving(program_read(scenario, source_of(scenario)))
        stages = [*stages_of(scenario), "pages" if is_page else "film"]
        with StageProgress(*stages) as progress, recorded(program, scenario, progress) as recording:
            if is_page:
                _write_page(output, recording, progress)
            else:
                _write_film(output, recording, seconds, fps, look, progress)
            passed = verdict(recording.run.findings) == "pass"
    except ProgramError as error:
        raise refused(scenario, error) from None
    say(words()("commands.written", names=output))
    raise click.exceptions.Exit(0 if passed else 1)


def _refuse(output: Path, seconds: float, fps: int, look: "Look") -> None:
    """SettingsError, before anything runs, where there can be no such film."""
    from sim.show.film.writers import format_of

    format_of(output, seconds, fps, look)


def _write_page(output: Path, recording: "Recording", progress: "Progress") -> None:
    from sim.base.files import staged
    from sim.show.replay.document import replay_page

    progress("pages", 0, 1)
    with staged(output.parent, [output.name]) as stage:
        (stage / output.name).write_text(replay_page(recording), encoding="utf-8")


def _write_film(  # noqa: PLR0913, PLR0917 - a run, where to, and how
    output: Path, recording: "Recording", seconds: float, fps: int, look: "Look", progress: "Progress"
) -> None:
    from sim.show.film.writers import write_film

    write_film(output, recording, seconds, fps, look, progress)
