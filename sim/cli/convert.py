"""``drycut convert``."""

from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import click

from parser.findings.errors import Message
from sim.cli.options import (
    Dialect,
    Length,
    Offsets,
    OrRegister,
    offsets_of,
)
from sim.cli.spoken import Spoken, spoken
from sim.cli.spoken.values import FilePath, WholeNumber

if TYPE_CHECKING:
    from parser.dialect.reader import Choices
    from parser.findings.catalogue import Language as Tongue
    from parser.program import Program
    from parser.write.iso import IsoChoices, Unit
    from parser.write.pmac import PmacChoices
    from sim.make.convert import Converted
    from sim.make.wanted import Language, Wanted

_UNITS = click.Choice(["um", "mm", "inch"])


class _ConvertOptions(NamedTuple):
    """The options, by their names; None and False where they are left out."""

    to: "Language | None"
    dialect: str | None
    unit: "Unit | None"
    from_dialect: str | None
    from_unit: "Unit | None"
    offset: tuple[Any, ...]
    side: str | None
    compensation: str | None
    form: Any
    distance: Any
    centers: Any
    decimals: int | None
    number_step: int | None
    tape: bool | None
    crlf: bool
    pmac: Any
    card: Any
    upper: Path | None


@click.command(cls=Spoken)
@click.argument("path", type=FilePath(path_type=Path, dir_okay=False), metavar="PROGRAM")
@click.option(
    "-o",
    "--output",
    type=FilePath(path_type=Path, dir_okay=False),
    required=True,
    metavar="FILE",
)
@click.option("--to", type=click.Choice(["3b", "4b", "iso", "pmac"]))
@click.option("--dialect", type=Dialect())
@click.option("--unit", type=_UNITS)
@click.option("--from-dialect", type=Dialect())
@click.option("--from-unit", type=_UNITS)
@click.option(
    "--offset",
    type=OrRegister(Length()),
    multiple=True,
)
@click.option("--side", type=click.Choice(["left", "right"]))
@click.option(
    "--compensation",
    type=click.Choice(["kept", "worked-in"]),
)
@click.option("--form", type=click.Choice(["compact", "aligned", "detailed"]))
@click.option("--distance", type=click.Choice(["absolute", "incremental"]))
@click.option("--centers", type=click.Choice(["from-start", "absolute"]))
@click.option("--decimals", type=WholeNumber(1, 6))
@click.option("--number-step", type=WholeNumber(0, 1000))
@click.option("--tape/--no-tape", default=None)
@click.option("--upper", type=FilePath(path_type=Path, dir_okay=False), metavar="FILE")
@click.option("--pmac", type=click.Choice(["native", "gcode"]))
@click.option("--card", type=click.Choice(["turbo", "power"]))
@click.option("--crlf", is_flag=True)
def convert(path: Path, output: Path, **options: Any) -> None:
    """Convert a program from 3B, 4B, ISO or PMAC to 3B, 4B, any dialect of ISO or PMAC.

    \b
    drycut convert part.iso -o part.3b
    drycut convert part.3b -o part.iso --dialect robofil
    drycut convert part.iso -o part.3b --offset D0=0.1mm
    drycut convert part.3b -o part-caxa.3b --form detailed
    drycut convert part.iso -o part.pmc
    drycut convert lower.3b --upper upper.3b -o part.iso
    """  # noqa: D301 - click keeps the lines of a paragraph that begins with a backspace
    from parser.findings.errors import ProgramError
    from parser.program import read_program
    from sim.cli.scenario_options import describe
    from sim.make.convert import Converted, converted
    from sim.show.terminal.convert import converted_lines, read_as_lines, refused_lines
    from sim.show.terminal.printer import say
    from sim.show.terminal.streams import outlet
    from sim.show.terminal.wrap import width_of

    conversion = _ConvertOptions(**options)
    language = conversion.to or _language(output)
    _refuse_misfits(conversion, language)
    given = offsets_of(conversion.offset)
    tongue: Tongue = spoken()
    try:
        program = _with_upper(read_program(path, _choices(conversion, language, given)), conversion.upper)
        program = _with_offset(program, given, conversion.side)
        wanted = _wanted(conversion, language, program, given)
        done = converted(program, wanted)
    except ProgramError as error:
        for line in describe(str(path), error):
            say(line, err=True)
        raise click.exceptions.Exit(2) from None
    width = width_of(outlet())
    if isinstance(done, Converted):
        _write((path, conversion.upper), output, done)
        lines = converted_lines(done, output, wanted, tongue, width)
    else:
        lines = refused_lines(done, str(path), tongue, width)
    for line in (*read_as_lines(program, str(path), tongue, width), *lines):
        say(line)
    raise click.exceptions.Exit(0 if isinstance(done, Converted) else 1)


def _language(output: Path) -> "Language":
    from sim.setup.making import SUFFIXES

    language: Language | None = "pmac" if output.suffix.lower() == ".pmc" else SUFFIXES.get(output.suffix.lower())
    if language is None:
        raise click.BadParameter(Message("suffix-needs-to", output=output), param_hint="-o")
    return language


def _refuse_misfits(options: _ConvertOptions, language: "Language") -> None:
    """UsageError for options that the written language has nothing for."""
    of_iso = {
        "--from-dialect": options.from_dialect,
        "--from-unit": options.from_unit,
        "--distance": options.distance,
        "--centers": options.centers,
        "--decimals": options.decimals,
        "--number-step": options.number_step,
        "--tape": options.tape,
    }
    misfits = {"--form": options.form} if language == "iso" else of_iso
    for name, value in ({**of_iso, "--form": options.form} if language == "pmac" else misfits).items():
        if value is not None:
            raise click.UsageError(
                Message(
                    "option-not-for-language",
                    name=name,
                    languages="3B and 4B" if language == "iso" else "ISO",
                    language=language,
                )
            )
    of_pmac = {"--pmac": options.pmac, "--card": options.card}
    for name, value in ({} if language == "pmac" else of_pmac).items():
        if value is not None:
            raise click.UsageError(Message("option-for-pmac", name=name, language=language))
    if language == "pmac" and options.compensation == "kept":
        raise click.UsageError(Message("pmac-keeps-no-compensation"))
    if language == "3b" and options.compensation == "kept":
        raise click.UsageError(Message("3b-keeps-no-compensation"))


def _choices(options: _ConvertOptions, language: "Language", given: Offsets) -> "Choices":
    """What the program is read with: --dialect and --unit say it where nothing of ISO is written."""
    from parser.dialect.reader import Choices, merged

    is_written = language == "iso"
    dialect, unit = (options.from_dialect, options.from_unit) if is_written else (options.dialect, options.unit)
    return Choices(dialect=dialect or "", unit=unit or "", registers=merged([given.registers]))


def _with_offset(program: "Program", given: Offsets, side: str | None) -> "Program":
    """The program with an offset worked in where one is asked for. UsageError where only half of one is."""
    if (given.plain is None) != (side is None):
        raise click.UsageError(Message("convert-offset-without-side"))
    if given.plain is None or side is None:
        return program
    from sim.run.prepare import as_run
    from sim.setup.part import SIDES, Offset, OffsetPass

    return as_run(program, Offset((OffsetPass(given.plain),), SIDES[side]))


def _with_upper(program: "Program", upper: Path | None) -> "Program":
    """The program with the contour of another one at the top of the work."""
    if upper is None:
        return program
    from sim.check.lean import with_upper
    from sim.setup.taper import TaperSettings, read_upper

    return with_upper(program, TaperSettings(upper=read_upper(upper)))


def _wanted(options: _ConvertOptions, language: "Language", program: "Program", given: Offsets) -> "Wanted":
    from sim.make.wanted import Wanted

    keeps = options.compensation != "worked-in" and language in {"4b", "iso"}
    return Wanted(
        language=language,
        iso=_iso(options, program) if language == "iso" else None,
        form=options.form or "compact",
        keeps=keeps,
        newline="\r\n" if options.crlf else "\n",
        name=program.name,
        offset_um=given.plain,
        pmac=_pmac(options, program) if language == "pmac" else None,
    )


def _pmac(options: _ConvertOptions, program: "Program") -> "PmacChoices":
    from parser.write.pmac import PmacChoices, blocks_of_source

    return PmacChoices(
        options.pmac or "native",
        options.card or "turbo",
        blocks_of_source(program.text, program.toolpath, program.decoder),
    )


def _iso(options: _ConvertOptions, program: "Program") -> "IsoChoices":
    """Choices of ISO: of the dialect that is asked for, else of that which was read, else of fast wire."""
    from parser.program import dialects
    from parser.write.iso import iso_choices

    own = program.reading.dialect if program.reading.dialect in dialects() else "fast-wire"
    usual = iso_choices(options.dialect or own, options.unit, options.decimals)
    return usual._replace(
        distance=options.distance or usual.distance,
        centers=options.centers or usual.centers,
        number_step=usual.number_step if options.number_step is None else options.number_step,
        tape=usual.tape if options.tape is None else options.tape,
    )


def _write(sources: tuple[Path, Path | None], output: Path, done: "Converted") -> None:
    """Write the program, and the one of its upper contour. BadParameter where that would take the place of a source."""
    from sim.base.files import staged
    from sim.make.wanted import upper_file

    texts = {output: done.data}
    if done.upper_data is not None:
        texts[upper_file(output)] = done.upper_data
    for file in texts:
        if file.exists() and any(file.samefile(source) for source in sources if source is not None):
            raise click.BadParameter(Message("output-is-the-program-itself", output=file), param_hint="-o")
    with staged(output.parent, [file.name for file in texts]) as stage:
        for file, data in texts.items():
            (stage / file.name).write_bytes(data)
