"""The work behind ``drycut card run``."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from sim.cli.spoken import spoken

if TYPE_CHECKING:
    from sim.setup.scenario import Scenario


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
    from sim.clients.started import Wanted, started
    from sim.jobs.run_into import STAGES, client_into, names_of
    from sim.run.findings import verdict
    from sim.run.report import report_text
    from sim.show.terminal.client import print_client
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
    from sim.cli.overrides import Overrides, overridden
    from sim.clients.table import following
    from sim.jobs.run_into import LOG

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
    from sim.clients.library.build import build
    from sim.clients.library.compiler import found_compiler

    build(scratch / "library", found_compiler())
    yield scratch / "library"
