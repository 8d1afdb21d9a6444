"""``drycut drill``."""

from collections import Counter
from pathlib import Path
from typing import TYPE_CHECKING

import click

from parser.findings.errors import ProgramError
from sim.cli.dialect_options import RegisterSet, RegisterValue, with_dialect
from sim.cli.scenario_options import describe
from sim.cli.spoken import Spoken, words

if TYPE_CHECKING:
    from collections.abc import Sequence

    from parser.dialect.choices import Choices
    from parser.program import Program
    from sim.drill.drills import Asked, Drill
    from sim.drill.proof import Level

_LEVELS: "dict[str, Level]" = {"easy": "words", "medium": "picture", "hard": "sums"}
_PAGES = ("drill.html", "answers.html")


@click.command(cls=Spoken)
@click.argument("path", type=click.Path(path_type=Path), metavar="PROGRAM")
@click.option("-o", "--output", type=click.Path(path_type=Path, file_okay=False), required=True, metavar="DIR")
@click.option("--set", "number", type=click.IntRange(1, 9999), default=1, show_default=True)
@click.option("--count", type=click.IntRange(1, 30), default=10, show_default=True)
@click.option("--level", type=click.Choice(list(_LEVELS)))
@with_dialect
@click.option("--offset", "registers", type=RegisterValue(), multiple=True)
def drill(  # noqa: PLR0913, PLR0917 - click hands over each option by its name
    path: Path,
    output: Path,
    number: int,
    count: int,
    level: str | None,
    dialect: str | None,
    unit: str | None,
    registers: tuple[RegisterSet, ...],
) -> None:
    """Damage a sound program on purpose, each time in one place, for those who learn to find what is wrong.

    \b
    drycut drill part.3b -o drills/
    drycut drill part.3b -o drills/ --set 17 --count 5 --level hard
    """  # noqa: D301 - click keeps the lines of a paragraph that begins with a backspace
    from parser.dialect.choices import Choices
    from sim.drill.drills import Asked
    from sim.show.terminal.printer import say

    choices = Choices(dialect=dialect or "", unit=unit or "", registers=registers)
    asked = Asked(number, count, None if level is None else _LEVELS[level])
    program = _read(path, choices)
    drills = _drills(path, program, asked)
    names = _write(path, output, program, drills, number)
    if len(drills) < count:
        say(words()("drill.few", name=program.name, made=len(drills), asked=count), err=True)
    say(_told(program, drills, number))
    say(words()("commands.written", names=f"{output}/ {', '.join(_PAGES)}, {names[0]} … {names[-1]}"))


def _read(path: Path, choices: "Choices") -> "Program":
    """The program. UsageError for one that is too long to look through."""
    from parser.program import moving, read_program
    from sim.drill.drills import MOST_BLOCKS
    from sim.show.terminal.printer import say

    try:
        program = moving(read_program(path, choices))
    except ProgramError as error:
        for line in describe(str(path), error):
            say(line, err=True)
        raise click.exceptions.Exit(2) from None
    blocks = program.reading.counts.run
    if max(blocks, len(program.toolpath)) > MOST_BLOCKS:
        raise click.UsageError(words()("drill.too-long", name=program.name, blocks=blocks, most=MOST_BLOCKS))
    return program


def _drills(path: Path, program: "Program", asked: "Asked") -> "tuple[Drill, ...]":
    """Drills of a program; the end of the command where it is not sound, or there are none."""
    from sim.check.batch import check_program
    from sim.check.settings import CheckSettings
    from sim.drill.drills import drills_of
    from sim.show.terminal.printer import say

    choices = program.choices
    settings = CheckSettings(dialect=choices.dialect, unit=choices.unit, registers=choices.registers)
    result = check_program(program, settings)
    if result.verdict == "fail":
        codes = ", ".join(sorted({found.code for found in result.findings if found.severity == "error"}))
        say(words()("drill.unsound", name=str(path), codes=codes), err=True)
        raise click.exceptions.Exit(1)
    drills = drills_of(program, settings, asked)
    if not drills:
        say(words()("drill.none", name=str(path)), err=True)
        raise click.exceptions.Exit(1)
    return drills


def _write(path: Path, output: Path, program: "Program", drills: "Sequence[Drill]", number: int) -> list[str]:
    """Write the pages and the damaged programs as one set; the names of the programs. BadParameter over `path`."""
    from parser.program import usual_name
    from sim.files import staged
    from sim.show.drill_page import answers_page, drill_page

    known = path.suffix.isascii() and path.suffix[1:].isalnum()
    suffix = path.suffix if known else Path(usual_name(program.text)).suffix
    names = [f"drill-{at:02}{suffix}" for at in range(1, len(drills) + 1)]
    for name in names:
        if (output / name).exists() and (output / name).samefile(path):
            raise click.BadParameter(f"{output / name} is what the drills are made of", param_hint="-o")
    with staged(output, [*_PAGES, *names]) as stage:
        (stage / _PAGES[0]).write_text(drill_page(program, drills, number, names), "utf-8")
        (stage / _PAGES[1]).write_text(answers_page(program, drills, number), "utf-8")
        for name, one in zip(names, drills, strict=True):
            (stage / name).write_bytes(one.program.text.encode(program.encoding))
    return names


def _told(program: "Program", drills: "Sequence[Drill]", number: int) -> str:
    """How many drills of which level there are."""
    say = words()
    counts = Counter(one.level for one in drills)
    levels = say("findings.comma").join(
        f"{counts[level]} {say(f'drill.level-name-{level}')}" for level in _LEVELS.values() if counts[level]
    )
    return say("drill.told", count=len(drills), name=program.name, set=number, levels=levels)
