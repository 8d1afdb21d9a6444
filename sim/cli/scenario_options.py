"""Options of the commands that run a scenario, and what they say where its program cannot be read or run."""

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

import click

from parser.findings.errors import ProgramError, SettingsError
from sim.cli.dialect_options import READ_WITH, OrRegister
from sim.cli.spoken import spoken
from sim.cli.spoken.values import FilePath
from sim.show.terminal.colours import painted
from sim.show.terminal.finding import finding_lines
from sim.show.terminal.printer import say
from sim.show.terminal.streams import outlet
from sim.show.terminal.wrap import width_of

if TYPE_CHECKING:
    from sim.setup.scenario import Scenario


Command = TypeVar("Command", bound=Callable[..., Any])


class Length(click.ParamType):  # type: ignore[type-arg]  # generic in newer clicks alone
    """A length with its unit, in µm."""

    name = "length"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> float:
        """The length in µm."""
        from sim.base.units import parse_length

        return value if isinstance(value, float) else parse_length(value)


class Lengths(click.ParamType):  # type: ignore[type-arg]  # generic in newer clicks alone
    """Lengths with their units, with commas between them, in µm."""

    name = "length,…"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> tuple[float, ...]:
        """The lengths in µm. SettingsError for what is none, and where one is missing beside a comma."""
        from sim.base.units import parse_length

        if isinstance(value, tuple):
            return value
        lengths = value.split(",")
        if len(lengths) > 1 and not all(length.strip() for length in lengths):
            raise SettingsError("lacks-a-length", found=value)
        return tuple(parse_length(length) for length in lengths)


ENGINE_OPTION = click.option(
    "--engine",
    type=click.Choice(["compiled", "pymunk"]),
)

_OPTIONS = (
    *READ_WITH,
    click.option("--machine", metavar="NAME|FILE"),
    click.option("--thickness", type=Length()),
    click.option("--wire-diameter", type=Length()),
    click.option("--gap", type=Length()),
    click.option("--wire-lag", type=Length()),
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
