"""The command line, a command a file; what crosses the border is an exit code. What a command needs is loaded late."""

import importlib
import signal
import sys
import traceback
from types import FrameType

import click

from controller.compiled.compiling import on_compiling
from parser import __version__
from parser.findings.errors import DrycutError, Message, system_message
from sim.cli.faults import missing
from sim.cli.spoken import SpokenGroup, complaint, localised, spoken, words
from sim.show.terminal.printer import say, write
from sim.show.terminal.streams import OutputError, prepare_streams

_COMMANDS = {
    "accept": "sim.cli.accept",
    "ballbar": "sim.cli.ballbar",
    "card": "sim.cli.card",
    "check": "sim.cli.check.command",
    "class": "sim.cli.lesson",
    "compare": "sim.cli.compare",
    "convert": "sim.cli.convert",
    "decode": "sim.cli.decode",
    "dialect": "sim.cli.dialect",
    "drill": "sim.cli.drill",
    "draw": "sim.cli.draw",
    "example": "sim.cli.example",
    "explain": "sim.cli.explain",
    "fit": "sim.cli.fit",
    "lsp": "sim.cli.lsp",
    "machine": "sim.cli.machine",
    "open": "sim.cli.open",
    "panel": "sim.cli.panel",
    "program": "sim.cli.program",
    "replay": "sim.cli.replay",
    "run": "sim.cli.run",
    "time": "sim.cli.time",
}

_NAMES = {"class": "lesson"}
"""What commands are called in their modules where their own name is a word of Python."""


class _LazyGroup(SpokenGroup):
    """Group whose commands are imported when they are asked for."""

    def list_commands(self, ctx: click.Context) -> list[str]:
        return sorted(_COMMANDS)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        if cmd_name not in _COMMANDS:
            return None
        command = getattr(importlib.import_module(_COMMANDS[cmd_name]), _NAMES.get(cmd_name, cmd_name))
        assert isinstance(command, click.Command)  # noqa: S101 - a slip in the table above
        return command


def _show_version(ctx: click.Context, _: click.Parameter, is_wanted: bool) -> None:
    """Print the version, and a digest of the sources: between two releases that alone tells them apart."""
    if not is_wanted or ctx.resilient_parsing:
        return
    from sim.base.workers.maker import sources

    write(f"drycut, version {__version__}, sources {sources()}\n")
    ctx.exit()


@click.group(
    name="drycut",
    cls=_LazyGroup,
    invoke_without_command=True,
    context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 100},
)
@click.option("--version", is_flag=True, is_eager=True, expose_value=False, callback=_show_version)
@click.pass_context
def cli(ctx: click.Context) -> None:
    """Dry-run wire-cut EDM programs: what the controller and the table will really do, before a wire is threaded."""
    if ctx.invoked_subcommand is None:
        write(f"{ctx.get_help()}\n", err=True)
        ctx.exit(2)


def main() -> None:
    """Run the command line.

    Exit code: 0 for good, 1 for a failed verdict, 2 for bad use, input that cannot be read or output that cannot be
    written, 3 for a fault of drycut itself, 130 where the user ended it, 128 + n where signal n did.
    """
    prepare_streams()
    _end_on_signals()
    on_compiling(lambda: say(words()("commands.compiling"), err=True))
    code = _run()
    try:
        sys.stdout.flush()
    except OutputError as error:
        code = max(code, _complain(localised(error.message)))
    sys.stderr.flush()
    sys.exit(code)


def _end_on_signals() -> None:
    """Let a run that is told to end, or whose terminal is closed, take its unfinished files with it.

    Ctrl-C does so by itself. What was ignored stays so, as under nohup.
    """
    for number in _ends():
        if signal.getsignal(number) is not signal.SIG_IGN:
            signal.signal(number, _end)


def _end(number: int, frame: FrameType | None) -> None:
    for other in _ends():  # a second one would cut the clearing up short
        signal.signal(other, signal.SIG_IGN)
    sys.exit(128 + number)


def _ends() -> list[signal.Signals]:
    """Signals that end a run; Windows has SIGBREAK in place of SIGHUP."""
    return [number for number in signal.Signals if number.name in {"SIGTERM", "SIGHUP", "SIGBREAK"}]


def _run() -> int:
    try:
        return int(cli.main(prog_name="drycut", standalone_mode=False) or 0)
    except (click.Abort, KeyboardInterrupt):
        return 130
    except SystemExit as ended:  # by a signal
        return int(ended.code or 0)
    except click.exceptions.NoArgsIsHelpError as error:  # a group without a command
        write(f"{error.ctx.get_help() if error.ctx else error.message}\n", err=True)
        return 2
    except (click.ClickException, DrycutError, OSError) as error:
        return _complain(_message(error))
    except Exception as error:
        extra = missing(error)
        return _complain(localised(extra)) if extra else _tell_fault(traceback.format_exc())


def _message(error: click.ClickException | DrycutError | OSError) -> str:
    if isinstance(error, click.ClickException):
        return complaint(error)
    if isinstance(error, OSError) and error.filename:
        return localised(Message("in-file", file=error.filename, message=system_message(error)))
    return localised(error.message if isinstance(error, DrycutError) else str(error))


def _complain(message: str) -> int:
    say(words()("commands.error", message=message), err=True)
    return 2


def _tell_fault(told_text: str) -> int:
    from sim.cli.faults import tell_faults

    return tell_faults({"": told_text}, spoken())
