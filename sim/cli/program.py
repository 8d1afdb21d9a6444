"""``drycut program``."""

from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import click

from parser.findings.errors import Message
from sim.cli.program_options import Options, making_of, options_of, program_options, refuse_own_files, writing_of
from sim.cli.spoken import Spoken, spoken
from sim.cli.spoken.values import FilePath

if TYPE_CHECKING:
    from collections.abc import Mapping

    from parser.findings.catalogue import Language as Tongue
    from sim.make.cam.maker import MadeProgram, NotMade
    from sim.setup.making import Language, ToMake
    from sim.setup.scenario import Scenario
    from sim.show.draw.style import ThemeName


class _ProgramRequest(NamedTuple):
    """What is to be made: of which drawing, on whose machine, how, in which language, and whether and where it goes."""

    drawing: Path
    scenario: "Scenario"
    to_make: "ToMake"
    language: "Language"
    output: Path | None
    is_written: bool


class _Picture(NamedTuple):
    """The picture of the plan, as it is asked for; no file where none is."""

    file: Path | None
    theme: "ThemeName"


@click.command(cls=Spoken)
@click.argument("path", type=FilePath(path_type=Path), metavar="DRAWING.dxf|SCENARIO")
@click.option(
    "-o",
    "--output",
    type=FilePath(path_type=Path, dir_okay=False),
    metavar="FILE",
)
@program_options
@click.option("--preview", is_flag=True)
@click.option("--force", is_flag=True)
@click.option(
    "--picture",
    type=FilePath(path_type=Path, dir_okay=False),
    metavar="FILE",
)
@click.option("--theme", type=click.Choice(["light", "dark"]), default="light", show_default=True)
@click.option("--json", "as_json", is_flag=True)
def program(  # noqa: PLR0913 - click hands over each option by its name
    *,
    path: Path,
    output: Path | None,
    preview: bool,
    force: bool,
    picture: Path | None,
    theme: "ThemeName",
    as_json: bool,
    **options: Any,
) -> None:
    """Make a program of a drawing (DXF) or of a scenario that has one, and prove it by a run before it is written.

    \b
    drycut program part.dxf -o part.3b
    drycut program part.dxf -o part.3b --pass 0.18mm --pass 0.12mm --tab 3mm
    drycut program part.dxf -o part.iso --dialect robofil --compensation kept
    drycut program part.dxf --preview --picture plan.png
    drycut program scenarios/plate -o plate.3b
    """  # noqa: D301 - click keeps the lines of a paragraph that begins with a backspace
    from sim.make.cam.maker import MadeProgram
    from sim.show.terminal.printer import write

    request = _program_request(path, output, options_of(options), is_written=not preview)
    _refuse_pictures(picture, request)
    tongue: Tongue = spoken()
    done = _made_program(request)
    made = done if isinstance(done, MadeProgram) else None
    written = _written(made, request, tongue, force=force) if made else None
    if made and picture is not None:
        _draw(made, _Picture(picture, theme), tongue)
    if as_json:
        from sim.make.cam.document import document_text
        from sim.show.texts import Words

        write(document_text(done, Words(tongue)), "json")
    else:
        _tell(done, request, written, picture, tongue)
    raise click.exceptions.Exit(0 if made and made.is_proved else 1)


def _written(made: "MadeProgram", request: _ProgramRequest, tongue: "Tongue", *, force: bool) -> Path | None:
    """The file that a proved program is written to, an unproved one with its findings by `force`; None if neither."""
    if not request.is_written or request.output is None or not (made.is_proved or force):
        return None
    from sim.make.wanted import upper_file

    texts = {request.output: made.data if made.is_proved else _with_findings(made, request, tongue)}
    if made.upper_data is not None:
        texts[upper_file(request.output)] = made.upper_data
    _write(request.output.parent, texts)
    return request.output


def _program_request(path: Path, output: Path | None, options: Options, *, is_written: bool) -> _ProgramRequest:
    """What is to be made. UsageError where it is not said which drawing, or where to."""
    from sim.make.cam.of_scenario import drawing_to_cut
    from sim.setup.making import ToMake, of_drawing, refuse_misfits

    scenario = _scenario(path, output, options)
    if path.is_dir():
        drawing = drawing_to_cut(scenario)
        own = scenario.to_make or ToMake(making=of_drawing(ToMake().making, drawing))
        file, output = drawing.file, output or scenario.program
    else:
        own, file = ToMake(), path
    if output is None and is_written:
        raise click.UsageError(Message("output-and-preview"))
    language = options.language or _language(output)
    to_make = own._replace(
        file=output or Path(f"{file.stem}.{language}"),
        making=making_of(own.making, options),
        writing=writing_of(own.writing, options),
    )
    refuse_misfits(to_make.writing, language, "drycut program")
    above = () if to_make.making.upper is None else (to_make.making.upper,)
    if output is not None:
        refuse_own_files(output, (file, *above, *([path / "scenario.toml"] if path.is_dir() else [])))
    return _ProgramRequest(file, scenario, to_make, language, output, is_written)


def _scenario(path: Path, output: Path | None, options: Options) -> "Scenario":
    """The scenario of a folder, else one of the defaults, with the options in place of its own values."""
    from parser.findings.errors import SettingsError
    from sim.cli.scenario_options import Overrides, overridden
    from sim.setup.wire import SPARK_GAP

    if options.technology is not None and SPARK_GAP.name in options.proof:
        raise SettingsError("technology-tells-gap", where=options.technology.name, key="--spark-gap")
    given = Overrides(
        dialect=options.dialect,
        unit=options.unit,
        machine=options.machine,
        technology=options.technology,
        settings=options.proof,
        taper=options.taper,
    )
    return overridden(path if path.is_dir() else (output or path.with_suffix(".3b")), given)


def _language(output: Path | None) -> "Language":
    from parser.findings.errors import SettingsError
    from sim.setup.making import language_of

    if output is None:
        return "3b"
    try:
        return language_of(output)
    except SettingsError:
        raise click.BadParameter(Message("suffix-needs-as", output=output), param_hint="-o") from None


def _refuse_pictures(picture: Path | None, request: _ProgramRequest) -> None:
    if picture is None:
        return
    if picture.suffix.lower() not in {".png", ".svg"}:
        raise click.BadParameter(Message("neither-png-nor-svg", picture=picture), param_hint="--picture")
    refuse_own_files(picture, (request.drawing,))
    if request.output is not None and picture.resolve() == request.output.resolve():
        raise click.BadParameter(Message("picture-is-the-program", picture=picture), param_hint="--picture")


def _made_program(request: _ProgramRequest) -> "MadeProgram | NotMade":
    """The program, made and proved, with progress on stderr."""
    from dataclasses import replace

    from sim.cli.progress import StageProgress
    from sim.make.cam.maker import made_program
    from sim.make.cam.of_scenario import wanted_of
    from sim.run.recording import stages_of

    wanted = wanted_of(request.to_make, request.language, request.scenario)
    stages = stages_of(replace(request.scenario, kerf=True, drawing=None))
    with StageProgress("drawing", "figures", "write", *stages, "comparison") as progress:
        return made_program(request.drawing, request.to_make.making, wanted, request.scenario, progress)


def _with_findings(done: "MadeProgram", request: _ProgramRequest, tongue: "Tongue") -> bytes:
    """The program with what speaks against it at its head."""
    from sim.make.cam.maker import remarked
    from sim.make.cam.of_scenario import wanted_of
    from sim.show.terminal.program import against

    wanted = wanted_of(request.to_make, request.language, request.scenario)
    return remarked(done, [*against(done, tongue)], wanted).data


def _write(folder: Path, texts: "Mapping[Path, bytes]") -> None:
    from sim.base.files import staged

    with staged(folder, [file.name for file in texts]) as stage:
        for file, data in texts.items():
            (stage / file.name).write_bytes(data)


def _draw(done: "MadeProgram", picture: _Picture, tongue: "Tongue") -> None:
    from sim.show.draw.sheet import SIZES_PX
    from sim.show.pictures.files import PictureFiles, write_pictures
    from sim.show.pictures.plan import PLAN, PlanShown

    assert picture.file is not None  # noqa: S101 - asked before
    files = PictureFiles(picture.file.parent, {PLAN: picture.file.name})
    write_pictures(PlanShown(done.plan), files, SIZES_PX["screen"], picture.theme, tongue)


def _tell(
    done: "MadeProgram | NotMade",
    request: _ProgramRequest,
    written: Path | None,
    picture: Path | None,
    tongue: "Tongue",
) -> None:
    from sim.make.cam.maker import MadeProgram
    from sim.show.terminal.program import print_made, print_not_made

    if isinstance(done, MadeProgram):
        where = "written" if done.is_proved else "forced" if written else "held-back"
        key = where if written or request.is_written else "previewed"
        print_made(done, request.to_make.file, key, picture, tongue)
    else:
        print_not_made(done, request.drawing, tongue)
