"""Options of the commands that run a scenario, and what they say where its program cannot be read or run."""

import os
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

import click

from parser.findings.catalogue import LANGUAGES, Language
from parser.findings.errors import ProgramError, SettingsError
from sim.cli.dialect_options import READ_WITH, OrRegister
from sim.show.terminal.colours import painted
from sim.show.terminal.finding import finding_lines
from sim.show.terminal.printer import say
from sim.show.terminal.streams import outlet
from sim.show.terminal.wrap import width_of

if TYPE_CHECKING:
    from sim.setup.scenario import Scenario


SHARP_CORNERS = "What the wire must leave in sharp inside corners: told apart, or held against the drawing too."
Command = TypeVar("Command", bound=Callable[..., Any])


class Length(click.ParamType):  # type: ignore[type-arg]  # generic in newer clicks alone
    """A length with its unit, in µm."""

    name = "length"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> float:
        """The length in µm."""
        from sim.units import parse_length

        return value if isinstance(value, float) else parse_length(value)


class Lengths(click.ParamType):  # type: ignore[type-arg]  # generic in newer clicks alone
    """Lengths with their units, with commas between them, in µm."""

    name = "length,…"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> tuple[float, ...]:
        """The lengths in µm. SettingsError for what is none, and where one is missing beside a comma."""
        from sim.units import parse_length

        if isinstance(value, tuple):
            return value
        lengths = value.split(",")
        if len(lengths) > 1 and not all(one.strip() for one in lengths):
            raise SettingsError(f"{value!r} lacks a length beside a comma; write them such as 0.18mm,0.12mm,0.1mm")
        return tuple(parse_length(one) for one in lengths)


def chosen(asked: str | None) -> Language:
    """The language asked for; else Chinese where the locale is, else English (POSIX: LC_ALL, LC_MESSAGES, LANG)."""
    if asked in LANGUAGES:
        return asked
    locale = next((value for name in ("LC_ALL", "LC_MESSAGES", "LANG") if (value := os.environ.get(name))), "")
    return "zh" if locale.lower().startswith("zh") else "en"


ENGINE_OPTION = click.option(
    "--engine",
    type=click.Choice(["compiled", "pymunk"]),
    help="What works out the motion of the table: one compiled loop, or the same in Python in a pymunk space, for "
    "comparison; that takes some thousand times as long.",
)

_OPTIONS = (
    *READ_WITH,
    click.option("--machine", metavar="NAME|FILE", help="Shipped machine, such as dk7740, or a machine file (.toml)."),
    click.option("--thickness", type=Length(), help="Thickness of the work, such as 40mm."),
    click.option("--wire-diameter", type=Length(), help="Diameter of the wire, such as 0.18mm."),
    click.option("--gap", type=Length(), help="Spark gap on one side, such as 10um."),
    click.option("--wire-lag", type=Length(), help="How far the wire bows back behind its guides, such as 20um."),
    click.option(
        "--interpolator",
        type=click.Choice(["point-by-point", "card"]),
        help="How the path becomes steps: as 3B controllers do, or by a motion card at equal times.",
    ),
    click.option(
        "--offset",
        type=OrRegister(Lengths()),
        multiple=True,
        help="Offset that the controller is to add, such as 0.1mm, or one for each pass: 0.18mm,0.12mm,0.1mm; "
        "with --side. Or the value of a register that an ISO program names, such as D0=0.1mm; this may be given again.",
    ),
    click.option(
        "--side",
        type=click.Choice(["left", "right"]),
        help="Side of the contour on which the wire runs, along the cutting direction of the first pass.",
    ),
    ENGINE_OPTION,
    click.option("--past-stop", is_flag=True, help="Go on where the table meets its end stop, else it ends there."),
    click.option("--kerf", is_flag=True, help="Work out the kerf, the pieces that it leaves, and their sizes."),
    click.option(
        "--drawing",
        type=click.Path(path_type=Path, dir_okay=False),
        metavar="DXF",
        help="Hold the cut edge against a drawing.",
    ),
    click.option("--layer", metavar="NAME", help="Layer of the contour in the drawing."),
    click.option("--tolerance", type=Length(), help="How far edge and drawing may be apart, such as 5um."),
    click.option("--no-fit", is_flag=True, help="Take the drawing as it lies, without fitting place and turn."),
    click.option("--sharp-corners", type=click.Choice(["tell", "fail"]), help=SHARP_CORNERS),
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
    lines = finding_lines(name, finding, excerpt, "en", width_of(outlet(err=True)))
    return [painted(line, finding.severity) for line in lines]
