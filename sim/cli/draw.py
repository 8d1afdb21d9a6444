"""``drycut draw``."""

from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from parser.findings.errors import Message, ProgramError
from sim.cli.scenario_options import overridden, overrides_of, refused, scenario_options
from sim.cli.spoken import Spoken, spoken, words
from sim.cli.spoken.values import FilePath

if TYPE_CHECKING:
    from collections.abc import Collection, Iterator

    from parser.findings.findings import Finding
    from sim.setup.scenario import Scenario
    from sim.show.draw.style import ThemeName
    from sim.show.pictures.files import Drawable, PictureFiles

SUFFIXES = (".png", ".svg")


class Width(click.ParamType):  # type: ignore[type-arg]  # generic in newer clicks alone
    """A width in px, or the name of one."""

    name = "width"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> int:
        """The width in px."""
        from sim.show.draw.sheet import SIZES_PX
        from sim.show.draw.style import LEAST_THUMBNAIL, MOST_WIDTH

        if isinstance(value, int):
            return value
        if value.lower() in SIZES_PX:
            return SIZES_PX[value.lower()]
        if value.isdecimal() and LEAST_THUMBNAIL <= int(value) <= MOST_WIDTH:
            return int(value)
        names, widths = ", ".join(SIZES_PX), f"{LEAST_THUMBNAIL} to {MOST_WIDTH} px"
        raise click.BadParameter(Message("neither-page-nor-width", found=value, pages=names, widths=widths), ctx, param)


@click.command(cls=Spoken)
@click.argument("path", type=FilePath(path_type=Path), metavar="PROGRAM|SCENARIO")
@click.option(
    "-o",
    "--output",
    type=FilePath(path_type=Path),
    required=True,
    metavar="FILE|DIR",
)
@click.option(
    "--picture",
    "names",
    multiple=True,
    metavar="NAME",
)
@click.option("--size", type=Width(), default="screen", show_default=True)
@click.option("--theme", type=click.Choice(["light", "dark"]), default="light", show_default=True)
@click.option("--svg", is_flag=True)
@scenario_options
def draw(  # noqa: PLR0913, PLR0917 - click hands over each option by its name
    path: Path,
    output: Path,
    names: tuple[str, ...],
    size: int,
    theme: "ThemeName",
    svg: bool,
    **options: Any,
) -> None:
    """Draw a 3B or ISO program, or a scenario folder that holds one: its path, or pictures of a dry run of it.

    \b
    drycut draw part.3b -o part.png
    drycut draw part.3b -o part.svg --lang zh --theme dark
    drycut draw scenarios/keyhole -o pictures/ --size a3
    drycut draw part.3b -o cut.png --picture cut
    """  # noqa: D301 - click keeps the lines of a paragraph that begins with a backspace
    from sim.run.findings import verdict
    from sim.show.pictures.files import write_pictures
    from sim.show.terminal.printer import say

    files = _picture_files(output, names, svg)
    scenario = overridden(path, overrides_of(options))
    try:
        with _drawn_from(files, scenario) as (subject, findings):
            written = write_pictures(subject, files, size, theme, spoken())
    except ProgramError as error:
        raise refused(scenario, error) from None
    say(words()("commands.written", names=", ".join(map(str, written))))
    raise click.exceptions.Exit(0 if verdict(findings) == "pass" else 1)


@contextmanager
def _drawn_from(
    picture_files: "PictureFiles", scenario: "Scenario"
) -> "Iterator[tuple[Drawable, tuple[Finding, ...]]]":
    """What the pictures are drawn of, with its findings: the program alone where no other picture needs a run."""
    from parser.program import moving
    from sim.jobs.shop import program_read, source_of
    from sim.show.pictures.cut.of_path import PATH, PathAlone

    program = moving(program_read(scenario, source_of(scenario)))
    if set(picture_files.files) == {PATH}:
        from sim.show.pictures.cut.of_path import programmed

        alone = PathAlone(programmed(program, scenario))
        yield alone, alone.programmed.findings
        return
    from sim.cli.progress import StageProgress
    from sim.run.recording import recorded, stages_of
    from sim.show.pictures.gallery import subject_of

    stages = [*stages_of(scenario), "pictures"]
    with StageProgress(*stages) as progress, recorded(program, scenario, progress) as recording:
        progress("pictures", 0, 1)
        yield subject_of(recording), recording.run.findings


def _picture_files(output: Path, names: tuple[str, ...], svg: bool) -> "PictureFiles":
    """Which pictures are to become which files. BadParameter for what does not fit together."""
    from sim.show.pictures.cut.of_path import PATH
    from sim.show.pictures.files import PictureFiles

    for name in names:
        if name != PATH and name not in _all():
            raise click.BadParameter(Message("none-of", name=name, names=", ".join(_all())), param_hint="--picture")
    suffix = output.suffix.lower()
    if suffix not in SUFFIXES or output.is_dir():
        if suffix and not output.is_dir():
            raise click.BadParameter(Message("neither-folder-nor-picture", output=output), param_hint="-o")
        kind = ".svg" if svg else ".png"
        return PictureFiles(output, {name: name + kind for name in names or _all()})
    if len(set(names)) > 1:
        raise click.BadParameter(
            Message("one-picture-of-many", output=output, names=" or ".join(names)), param_hint="-o"
        )
    if svg and suffix != ".svg":
        raise click.BadParameter(Message("svg-is-for-folders", output=output), param_hint="--svg")
    return PictureFiles(output.parent, {(names or (PATH,))[0]: output.name})


def _all() -> "Collection[str]":
    """The names of all pictures; what draws those of a run takes long to load."""
    from sim.show.pictures.gallery import PICTURES

    return PICTURES
