"""Options of ``drycut check``, in the groups in which its help lists them."""

from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeVar

import click

from sim.cli.check.outputs import Output
from sim.cli.dialect_options import READ_WITH, RegisterValue
from sim.cli.scenario_options import Length
from sim.show.findings import FORMATS

Command = TypeVar("Command", bound=Callable[..., Any])


class OutputType(click.ParamType):  # type: ignore[type-arg]  # generic in newer clicks alone
    """``sarif`` or ``sarif=check.sarif``: an `Output`."""

    name = "output"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Output:
        """The output; a format that there is not, or no name of a file behind ``=``, is bad use."""
        if isinstance(value, Output):
            return value
        form, into, file = value.partition("=")
        if form not in FORMATS:
            self.fail(f"{form!r} is not one of {', '.join(FORMATS)}", param, ctx)
        if into and not file:
            self.fail(f"{value!r} lacks the name of a file", param, ctx)
        return Output(form, Path(file) if file else None)


_FILE = click.Path(path_type=Path, dir_okay=False)
_OUTPUT = (
    click.option(
        "--format",
        "formats",
        type=OutputType(),
        multiple=True,
        metavar="FORMAT[=FILE]",
        help=f"How to print the findings: {', '.join(FORMATS)} [text]; with =FILE into a file; several times.",
    ),
    click.option(
        "--output-file", "-o", type=click.Path(path_type=Path), metavar="FILE", help="Print them into a file instead."
    ),
    click.option("--lang", type=click.Choice(["en", "zh"]), help="Language; that of the locale where left out."),
    click.option("--statistics", is_flag=True, help="Count findings by code, and what was looked at."),
    click.option("--quiet", is_flag=True, help="No line for files without findings."),
)
_SELECTION = (
    click.option("--select", metavar="CODES", help="Show these codes alone: 3B2,3B301 is all 3B2xx and 3B301."),
    click.option("--ignore", metavar="CODES", help="Do not show these codes."),
    click.option("--fail-on", type=click.Choice(["warning", "error"]), help="Least severity for exit code 1 [error]."),
    click.option("--exit-zero", is_flag=True, help="Exit code 0 where findings fail; 2 and 3 stay."),
    click.option(
        "--exclude",
        multiple=True,
        metavar="PATTERN",
        help="Leave out files and folders of folders, such as old or 'jigs/*'; may be given again.",
    ),
    click.option("--config", type=_FILE, metavar="FILE", help="Settings file, in place of those near the programs."),
    click.option("--no-config", is_flag=True, help="Take no settings file."),
    click.option("--baseline", type=_FILE, metavar="FILE", help="Show and fail only what is not in this baseline."),
    click.option("--write-baseline", type=_FILE, metavar="FILE", help="Write all findings as known ones."),
)
_MENDS = (
    click.option("--fix", is_flag=True, help="Mend in the files what is certain, and show what was changed."),
    click.option("--diff", is_flag=True, help="Show what --fix would change, for patch -p0, and change nothing."),
)
_WATCH = (click.option("--watch", is_flag=True, help="Check again whenever a file changes, until Ctrl-C."),)
_DEMANDS = (
    click.option(
        "--machine", metavar="NAME|FILE", help="Check the travel of this machine, such as dk7740, or a .toml."
    ),
    click.option("--wire-diameter", type=Length(), help="Check corners for this wire, such as 0.18mm."),
    click.option("--gap", type=Length(), help="Spark gap on one side, such as 10um."),
)
_ISO = (
    *READ_WITH,
    click.option(
        "--offset",
        type=RegisterValue(),
        multiple=True,
        help="Value of an offset register that an ISO program names and does not set; may be given again.",
    ),
)


def check_options(command: Command) -> Command:
    """Give a command the options of ``drycut check``."""
    for option in reversed((*_OUTPUT, *_SELECTION, *_MENDS, *_WATCH, *_DEMANDS, *_ISO)):
        command = option(command)
    return command
