"""``drycut card``, and the work behind ``drycut card run``."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple, TypeVar

import click

from sim.cli.spoken import SpokenGroup, spoken
from sim.cli.spoken.values import DecimalNumber, FilePath, offer_machines
from sim.show.terminal.printer import say, write

if TYPE_CHECKING:
    from controller.card.log import Difference, Replay
    from sim.setup.scenario import Scenario


SHOWN = 20
"""Differences that are printed; the others are counted."""
_Command = TypeVar("_Command", bound=Callable[..., None])


def _into(told_text: str) -> Callable[[_Command], _Command]:
    """The option that names the folder of what is made."""
    kind = FilePath(path_type=Path, file_okay=False)
    return click.option("-o", "--output", type=kind, required=True, metavar="DIR")


@click.group(cls=SpokenGroup)
def card() -> None:
    """Work with the emulated motion card."""


@card.command()
@click.argument("log", type=FilePath(path_type=Path), metavar="FILE")
@click.option("--json", "as_json", is_flag=True)
def replay(log: Path, as_json: bool) -> None:
    """Replay a log of the card and compare.

    \b
    drycut card replay part.log
    """  # noqa: D301 - click keeps the lines of a paragraph that begins with a backspace
    from controller.card.log import replay_file

    done = replay_file(log)
    differences: list[Difference] = []
    count = 0
    for difference in done:
        count += 1
        if count <= SHOWN:
            differences.append(difference)
    if as_json:
        write(_json(str(log), done, count, differences), "json")
    else:
        for line in _text(str(log), done, count, differences):
            say(line)
    raise click.exceptions.Exit(1 if count else 0)


@card.command()
@_into("Folder of the libraries; the headers are put in DIR/include.")
def build(output: Path) -> None:
    """Make the card's library for programs in C: libges.so with ges.h.

    \b
    drycut card build -o ges
    cc client.c -o client -I ges/include -L ges -lges -ldrycut_sleep
    LD_LIBRARY_PATH=ges ./client
    """  # noqa: D301 - click keeps the lines of a paragraph that begins with a backspace
    from sim.clients.library import build as made_in
    from sim.clients.library import found_compiler

    for path in made_in(output, found_compiler()):
        say(str(path))


@card.command(context_settings={"ignore_unknown_options": True})
@click.argument("command", nargs=-1, required=True, type=click.UNPROCESSED, metavar="CLIENT [ARGS]...")
@_into("Write report.html, replay.html, cut.png, report.json, card.log and calls.txt here.")
@click.option(
    "--library",
    type=FilePath(path_type=Path, file_okay=False),
    metavar="DIR",
)
@click.option(
    "--card",
    "settings",
    type=FilePath(path_type=Path, dir_okay=False),
    metavar="FILE.toml",
)
@click.option("--call-s", type=DecimalNumber(1e-9, 1.0), metavar="S")
@click.option(
    "--timeout",
    "longest_s",
    type=DecimalNumber(0.1, 86_400.0),
    default=60.0,
    show_default=True,
    metavar="S",
)
@click.option("--machine", metavar="NAME|FILE", shell_complete=offer_machines)
@click.option("--json", "as_json", is_flag=True)
def run(  # noqa: PLR0913 - click hands over each option by its name
    *,
    command: tuple[str, ...],
    output: Path,
    library: Path | None,
    settings: Path | None,
    call_s: float | None,
    longest_s: float,
    machine: str | None,
    as_json: bool,
) -> None:
    """Run a program for the card, in C, and show what its calls did to the table, and what it did not look at.

    \b
    drycut card run ./client -o out/
    drycut card run --card machine.toml --timeout 300 -o out/ ./client part.dat
    """  # noqa: D301 - click keeps the lines of a paragraph that begins with a backspace
    client = ClientOptions(command, output, library, settings, call_s, longest_s, machine)
    raise click.exceptions.Exit(run_client(client, as_json=as_json))


def _text(name: str, done: "Replay", count: int, shown_differences: "list[Difference]") -> Iterator[str]:
    for entry in shown_differences:
        yield f"{name}:{entry.line}: error: the card differs"
        yield f"  expected: {entry.expected}"
        yield f"     found: {entry.found}"
    if count > len(shown_differences):
        yield f"{name}: and {count - len(shown_differences):,} more"
    verdict = f"{count:,} {'difference' if count == 1 else 'differences'}" if count else "equal"
    places = "; ".join(", ".join(f"{place:,}" for place in axes) for axes in done.card.places)
    yield (
        f"{name}: {verdict}: {done.calls:,} calls, {done.card.time_s:.6g} s, {done.pulses:,} pulses, "
        f"axes at {places}, status {done.card.status:04x}"
    )


def _json(name: str, done: "Replay", count: int, shown_differences: "list[Difference]") -> str:
    import json

    result = {
        "log": name,
        "equal": count == 0,
        "calls": done.calls,
        "time_s": done.card.time_s,
        "pulses": done.pulses,
        "places": done.card.places,
        "status": f"{done.card.status:04x}",
        "differences": count,
        "first": [entry._asdict() for entry in shown_differences],
    }
    return json.dumps(result, ensure_ascii=False, indent=2) + "\n"


_STDERR = 2
"""Number of the stream that errors go to, in every process."""


class ClientOptions(NamedTuple):
    """The options as given; None where one was left out."""

    command: tuple[str, ...]
    output: Path
    library: Path | None
    settings: Path | None
    call_s: float | None
    longest_s: float
    machine: str | None


def run_client(options: ClientOptions, *, as_json: bool) -> int:
    """Start the client, run its calls again and print what came of it; the exit code."""
    from sim.base.files import scratch
    from sim.cli.progress import StageProgress
    from sim.clients.session import Wanted, started
    from sim.jobs.client_into import STAGES, client_into, names_of
    from sim.run.findings import verdict
    from sim.run.report import report_text
    from sim.show.terminal.batch import print_client
    from sim.show.terminal.printer import say, write
    from sim.show.texts import Words

    scenario = scenario_of(options)
    _refuse_settings(options)
    with scratch() as folder, _library(options.library, folder) as library:
        log = folder / "card.log"
        wanted = Wanted(options.command, library, options.settings, options.call_s, options.longest_s)
        ended = started(wanted, log, out=_STDERR if as_json else None)
        with StageProgress(*STAGES) as progress:
            done = client_into(options.output, log, ended, scenario, progress)
    if as_json:
        write(report_text(done.report), "json")
    else:
        tongue = spoken()
        print_client(done, scenario.title, options.longest_s, tongue)
        say(Words(tongue)("client.written", out=options.output, names=", ".join(names_of(done))))
    findings = done.run.findings if done.run else done.read.program.findings
    return 0 if ended.exit_code == 0 and verdict(findings) == "pass" else 1


def scenario_of(options: ClientOptions) -> "Scenario":
    """The machine that is asked for, with what else is usual; its title is the client."""
    from dataclasses import replace

    from parser.text.encoding import printable
    from sim.cli.scenario_options import Overrides, overridden
    from sim.clients.run import following
    from sim.jobs.client_into import LOG

    scenario = overridden(options.output / LOG, Overrides(machine=options.machine))
    machine = scenario.machine.stepping_by("card")
    if options.machine is None:
        machine = following(machine)
    return replace(scenario, title=printable(Path(options.command[0]).name), machine=machine, machine_by_default=False)


def _refuse_settings(options: ClientOptions) -> None:
    """SettingsError where the card's file is none; the client would see no more than a call that fails."""
    from controller.card.abi.environment import CARD, card_environment

    if options.settings is not None:
        card_environment({CARD: str(options.settings)})


@contextmanager
def _library(given: Path | None, scratch: Path) -> Iterator[Path]:
    """The folder of the library; made where none is given."""
    if given is not None:
        yield given
        return
    from sim.clients.library import build, found_compiler

    build(scratch / "library", found_compiler())
    yield scratch / "library"
