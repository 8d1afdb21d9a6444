"""Options of ``drycut check``, in the groups in which its help lists them."""

from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeVar

import click

from parser.findings.errors import Message
from sim.check.settings.read import FAIL_ON
from sim.cli.check.outputs import Output
from sim.cli.dialect_options import UNIT, OwnOrNamed, RegisterValue
from sim.cli.lengths import length_options
from sim.cli.spoken.completing import offer_machines
from sim.cli.spoken.values import FilePath
from sim.setup.wire import DIAMETER, SPARK_GAP
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
            self.fail(Message("not-one-of", found=form, known=", ".join(FORMATS)), param, ctx)
        if into and not file:
            self.fail(Message("lacks-a-file-name", found=value), param, ctx)
        return Output(form, Path(file) if file else None)


_FILE = FilePath(path_type=Path, dir_okay=False)
_OUTPUT = (
    click.option(
        "--format",
        "formats",
        type=OutputType(),
        multiple=True,
        metavar="FORMAT[=FILE]",
    ),
    click.option("--output-file", "-o", type=FilePath(path_type=Path), metavar="FILE"),
    click.option("--statistics", is_flag=True),
    click.option("--quiet", is_flag=True),
)
_SELECTION = (
    click.option("--select", metavar="CODES"),
    click.option("--ignore", metavar="CODES"),
    click.option("--fail-on", type=click.Choice(FAIL_ON)),
    click.option("--exit-zero", is_flag=True),
    click.option(
        "--exclude",
        multiple=True,
        metavar="PATTERN",
    ),
    click.option(
        "--include",
        multiple=True,
        metavar="PATTERN",
    ),
    click.option("--config", type=_FILE, metavar="FILE"),
    click.option("--no-config", is_flag=True),
    click.option("--baseline", type=_FILE, metavar="FILE"),
    click.option("--write-baseline", type=_FILE, metavar="FILE"),
)
_LISTS = (
    click.option("--show-files", is_flag=True),
    click.option("--show-settings", is_flag=True),
)
_MENDS = (
    click.option("--fix", is_flag=True),
    click.option("--diff", is_flag=True),
)
_WATCH = (click.option("--watch", is_flag=True),)
_DEMANDS = (
    click.option("--machine", metavar="NAME|FILE", shell_complete=offer_machines),
    *length_options((DIAMETER, SPARK_GAP)),
    click.option("--open", "may_stay_open", is_flag=True),
)
_ISO = (
    click.option("--dialect", type=OwnOrNamed(is_any=True)),
    UNIT,
    click.option(
        "--offset",
        type=RegisterValue(),
        multiple=True,
    ),
)


def check_options(command: Command) -> Command:
    """Give a command the options of ``drycut check``."""
    for option in reversed((*_OUTPUT, *_SELECTION, *_LISTS, *_MENDS, *_WATCH, *_DEMANDS, *_ISO)):
        command = option(command)
    return command
