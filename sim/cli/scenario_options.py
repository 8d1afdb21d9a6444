"""Options of the commands that run a scenario, and what they say where its program cannot be read or run."""

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

import click

from parser.findings.errors import ProgramError
from sim.cli.dialect_options import READ_WITH, OrRegister
from sim.cli.lengths import Length, Lengths, length_options
from sim.cli.spoken import spoken
from sim.cli.spoken.completing import offer_machines
from sim.cli.spoken.values import FilePath
from sim.setup.settable import SETTABLE
from sim.show.terminal.colours import painted
from sim.show.terminal.finding import finding_lines
from sim.show.terminal.printer import say
from sim.show.terminal.streams import outlet
from sim.show.terminal.wrap import width_of

if TYPE_CHECKING:
    from sim.setup.scenario import Scenario


Command = TypeVar("Command", bound=Callable[..., Any])


ENGINE_OPTION = click.option(
    "--engine",
    type=click.Choice(["compiled", "pymunk"]),
)

_OPTIONS = (
    *READ_WITH,
    click.option("--machine", metavar="NAME|FILE", shell_complete=offer_machines),
    *length_options(SETTABLE.values()),
    click.option(
        "--interpolator",
        type=click.Choice(["point-by-point", "card"]),
    ),
    click.option(
        "--offset",
        type=OrRegister(Lengths()),
        multiple=True,
    ),
    click.option(
        "--side",
        type=click.Choice(["left", "right"]),
    ),
    ENGINE_OPTION,
    click.option("--past-stop", is_flag=True),
    click.option("--kerf", is_flag=True),
    click.option("--open", "may_stay_open", is_flag=True),
    click.option(
        "--drawing",
        type=FilePath(path_type=Path, dir_okay=False),
        metavar="DXF",
    ),
    click.option("--layer", metavar="NAME"),
    click.option("--tolerance", type=Length()),
    click.option("--no-fit", is_flag=True),
    click.option("--sharp-corners", type=click.Choice(["tell", "fail"])),
)


def scenario_options(command: Command) -> Command:
    """Give a command the options that take the place of a scenario's own values: those of `Overrides`."""
    for option in reversed(_OPTIONS):
        command = option(command)
    return command


def refused(scenario: "Scenario", error: ProgramError) -> click.exceptions.Exit:
    """Tell what is wrong with a program that cannot be read or run; the end of the command, to be raised."""
    for line in describe(str(scenario.program), error):
        say(line, err=True)
    return click.exceptions.Exit(2)


def describe(name: str, error: ProgramError) -> list[str]:
    """The finding that makes a program unreadable, in lines for stderr: its source line where the place is known."""
    finding = error.finding
    excerpt = error.excerpt if error.excerpt and finding.column else None
    lines = finding_lines(name, finding, excerpt, spoken(), width_of(outlet(err=True)))
    return [painted(line, finding.severity) for line in lines]
