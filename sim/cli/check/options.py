"""Options of ``drycut check``, in the groups in which its help lists them."""

from collections.abc import Callable
from typing import Any, TypeVar

import click

from sim.cli.scenario_options import Length

Command = TypeVar("Command", bound=Callable[..., Any])

_OUTPUT = (
    click.option(
        "--format",
        "form",
        type=click.Choice(["text", "concise", "json", "sarif", "junit", "github", "gitlab"]),
        default="text",
        show_default=True,
        help="How to print the findings.",
    ),
    click.option("--lang", type=click.Choice(["en", "zh"]), help="Language; that of the locale where left out."),
    click.option("--statistics", is_flag=True, help="Count findings by code, and what was looked at."),
    click.option("--quiet", is_flag=True, help="No line for files without findings."),
)
_SELECTION = (
    click.option("--select", metavar="CODES", help="Show these codes alone: 3B2,3B301 is all 3B2xx and 3B301."),
    click.option("--ignore", metavar="CODES", help="Do not show these codes."),
    click.option("--fail-on", type=click.Choice(["warning", "error"]), help="Least severity for exit code 1 [error]."),
)
_MENDS = (click.option("--fix", is_flag=True, help="Mend in the files what is certain, and show what was changed."),)
_DEMANDS = (
    click.option(
        "--machine", metavar="NAME|FILE", help="Check the travel of this machine, such as dk7740, or a .toml."
    ),
    click.option("--wire-diameter", type=Length(), help="Check corners for this wire, such as 0.18mm."),
    click.option("--gap", type=Length(), help="Spark gap on one side, such as 10um."),
)


def check_options(command: Command) -> Command:
    """Give a command the options of ``drycut check``."""
    for option in reversed((*_OUTPUT, *_SELECTION, *_MENDS, *_DEMANDS)):
        command = option(command)
    return command
