"""``drycut drill``."""

from collections import Counter
from pathlib import Path
from typing import TYPE_CHECKING

import click

from parser.findings.errors import Message, ProgramError, SettingsError
from sim.cli.options import RegisterSet, RegisterValue, with_dialect
from sim.cli.scenario_options import describe
from sim.cli.spoken import Spoken, localised, words
from sim.cli.spoken.values import FilePath, WholeNumber

if TYPE_CHECKING:
    from collections.abc import Sequence

    from parser.dialect.reader import Choices, ChosenDialect
    from parser.program import Program
    from sim.teach.drills import Drill, DrillRequest, Level

_LEVELS: "dict[str, Level]" = {"easy": "words", "medium": "picture", "hard": "sums"}


@click.command(cls=Spoken)
@click.argument("path", type=FilePath(path_type=Path), metavar="PROGRAM")
@click.option("-o", "--output", type=FilePath(path_type=Path, file_okay=False), required=True, metavar="DIR")
@click.option("--set", "number", type=WholeNumber(1, 9999), default=1, show_default=True)
@click.option("--count", type=WholeNumber(1, 30), default=10, show_default=True)
@click.option("--level", type=click.Choice(list(_LEVELS)))
@click.option("--kind", type=click.Choice(["program", "operation"]), default="program", show_default=True)
@with_dialect
@click.option("--offset", "registers", type=RegisterValue(), multiple=True)
def drill(  # noqa: PLR0913, PLR0917 - click hands over each option by its name
    path: Path,
    output: Path,
    number: int,
    count: int,
    level: str | None,
    kind: str,
    dialect: "ChosenDialect | None",
    unit: str | None,
    registers: tuple[RegisterSet, ...],
) -> None:
    """Damage a sound program on purpose, each time in one place, for those who learn to find what is wrong.

    \b
    drycut drill part.3b -o drills/
    drycut drill part.3b -o drills/ --set 17 --count 5 --level hard
    drycut drill part.3b -o drills/ --kind operation
    """  # noqa: D301 - click keeps the lines of a paragraph that begins with a backspace
    from parser.dialect.reader import Choices
    from sim.jobs.drills_into import PAGES, drill_names, drills_into
    from sim.show.terminal.printer import say
    from sim.teach.drills import DrillRequest

    choices = Choices(dialect=dialect or "", unit=unit or "", registers=registers)
    if kind == "operation":
        if level is not None:
            raise click.UsageError(Message("level-of-programs"))
        _drill_operation(path, choices, output, number, count)
        return
    request = DrillRequest(number, count, None if level is None else _LEVELS[level])
    program = _read(path, choices)
    _refuse_own_file(path, output, program, count)
    drills = _drills(program, request)
    drills_into(output, program, drills, number)
    names = drill_names(program, len(drills))
    if len(drills) < count:
        say(words()("drill.few", name=program.name, made=len(drills), asked=count), err=True)
    say(_counts_text(program, drills, number))
    say(words()("commands.written", names=f"{output}/ {', '.join(PAGES)}, {names[0]} … {names[-1]}"))


def _drill_operation(path: Path, choices: "Choices", output: Path, number: int, count: int) -> None:
    """Drills of operation on a program, on the machine that runs are on."""
    from dataclasses import replace

    from sim.jobs.drills_into import OPERATION_PAGES, operation_into
    from sim.run.running import dry_run
    from sim.run.sparks import panel_cut
    from sim.setup.scenario import load_scenario, under_sparks
    from sim.show.terminal.printer import say
    from sim.teach.operation.incidents import operation_drills

    scenario = load_scenario(path)
    scenario = replace(scenario, dialect=choices.dialect, unit=choices.unit, registers=choices.registers)
    cut = panel_cut(dry_run(_read(path, choices), scenario, measured=False), under_sparks(scenario))
    drills = operation_drills(cut, number, count)
    operation_into(output, scenario.titles, cut, drills, number)
    say(words()("operation.told", count=len(drills), name=path.name, set=number))
    say(words()("commands.written", names=f"{output}/ {', '.join(OPERATION_PAGES)}"))


def _read(path: Path, choices: "Choices") -> "Program":
    from parser.program import moving, read_program
    from sim.show.terminal.printer import say

    try:
        return moving(read_program(path, choices))
    except ProgramError as error:
        for line in describe(str(path), error):
            say(line, err=True)
        raise click.exceptions.Exit(2) from None


def _refuse_own_file(path: Path, output: Path, program: "Program", count: int) -> None:
    """BadParameter where a damaged program would take the place of the sound one."""
    from sim.jobs.drills_into import drill_names

    for file in (output / name for name in drill_names(program, count)):
        if file.exists() and file.samefile(path):
            raise click.BadParameter(Message("output-is-the-drilled-program", file=file), param_hint="-o")


def _drills(program: "Program", request: "DrillRequest") -> "tuple[Drill, ...]":
    """Drills of a program; the end of the command where none can be made of it."""
    from sim.check.settings import CheckSettings
    from sim.cli.progress import StageProgress
    from sim.show.terminal.printer import say
    from sim.teach.drills import drills_of

    try:
        with StageProgress("drills") as progress:
            progress("drills", 0, 1)
            return drills_of(program, CheckSettings.reading(program.choices), request)
    except SettingsError as error:
        say(words()("commands.error", message=localised(error.message)), err=True)
        raise click.exceptions.Exit(1) from None


def _counts_text(program: "Program", drills: "Sequence[Drill]", number: int) -> str:
    """How many drills of which level there are."""
    say = words()
    counts = Counter(each_drill.level for each_drill in drills)
    levels = say("findings.comma").join(
        f"{counts[level]} {say(f'drill.level-name-{level}')}" for level in _LEVELS.values() if counts[level]
    )
    return say("drill.told", count=len(drills), name=program.name, set=number, levels=levels)
