"""The command line. This module stays light: what a command needs is imported when it runs."""

import importlib
import os
import sys

import click

from parser.errors import DrycutError
from sim import __version__

_COMMANDS = {"run": "sim.cli.run"}


class _LazyGroup(click.Group):
    """Group whose commands are imported when they are asked for."""

    def list_commands(self, ctx: click.Context) -> list[str]:
        return sorted(_COMMANDS)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        if cmd_name not in _COMMANDS:
            return None
        command = getattr(importlib.import_module(_COMMANDS[cmd_name]), cmd_name)
        assert isinstance(command, click.Command)  # noqa: S101 - a slip in the table above
        return command


@click.group(
    cls=_LazyGroup,
    invoke_without_command=True,
    context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 100},
)
@click.version_option(__version__, prog_name="drycut")
@click.pass_context
def cli(ctx: click.Context) -> None:
    """Dry-run wire-cut EDM programs: what the controller and the table will really do, before a wire is threaded."""
    if ctx.invoked_subcommand is None:
        click.echo(ctx.get_help(), err=True)
        ctx.exit(2)


def main() -> None:
    """Run the command line; exit 0 for good, 1 for a failed verdict, 2 for bad use or unreadable input."""
    try:
        code = cli.main(prog_name="drycut", standalone_mode=False)
    except click.ClickException as error:
        code = _complain(error.format_message())
    except click.Abort:
        code = 130
    except DrycutError as error:
        code = _complain(str(error))
    except BrokenPipeError:
        # The reader of our output has gone; nothing more can be said to it.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        code = 1
    sys.exit(code)


def _complain(message: str) -> int:
    click.echo(message if "error[" in message else f"drycut: error: {message}", err=True)
    return 2
