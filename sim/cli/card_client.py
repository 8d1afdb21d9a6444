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


class Asked(NamedTuple):
    """The options as given; None where one was left out."""

    command: tuple[str, ...]
    output: Path
    library: Path | None
    settings: Path | None
    call_s: float | None
    longest_s: float
    machine: str | None


def run_client(asked: Asked, *, as_json: bool) -> int:
    """Start the client, run its calls again and print what came of it; the exit code."""
    from sim.base.files import scratch
    from sim.cli.progress import StageProgress
    from sim.clients.started import Wanted, started
    from sim.jobs.client_into import STAGES, client_into, names_of
    from sim.run.findings import verdict
    from sim.run.report import report_text
    from sim.show.terminal.client import print_client
    from sim.show.terminal.printer import say, write
    from sim.show.words import Words

    scenario = scenario_of(asked)
    _refuse_settings(asked)
    with scratch() as folder, _library(asked.library, folder) as library:
        log = folder / "card.log"
        wanted = Wanted(asked.command, library, asked.settings, asked.call_s, asked.longest_s)
        ended = started(wanted, log, out=_STDERR if as_json else None)
        with StageProgress(*STAGES) as progress:
            done = client_into(asked.output, log, ended, scenario, progress)
    if as_json:
        write(report_text(done.report), "json")
    else:
        tongue = spoken()
        print_client(done, scenario.title, asked.longest_s, tongue)
        say(Words(tongue)("client.written", out=asked.output, names=", ".join(names_of(done))))
    findings = done.run.findings if done.run else done.read.program.findings
    return 0 if ended.exit_code == 0 and verdict(findings) == "pass" else 1


def scenario_of(asked: Asked) -> "Scenario":
    """The machine that is asked for, with what else is usual; its title is the client."""
    from dataclasses import replace

    from parser.text.encoding import printable
    from sim.cli.overrides import Overrides, overridden
    from sim.clients.table import following
    from sim.jobs.client_into import LOG

    given = dict.fromkeys(Overrides._fields, None) | {
        "machine": asked.machine,
        "offset": (),
        "past_stop": False,
        "kerf": False,
        "may_stay_open": False,
        "no_fit": False,
    }
    scenario = overridden(asked.output / LOG, Overrides(**given))  # type: ignore[arg-type]  # by their names
    machine = scenario.machine.stepping_by("card")
    if asked.machine is None:
        machine = following(machine)
    return replace(scenario, title=printable(Path(asked.command[0]).name), machine=machine, machine_by_default=False)


def _refuse_settings(asked: Asked) -> None:
    """SettingsError where the card's file is none; the client would see no more than a call that fails."""
    from controller.card.abi.asked import CARD
    from controller.card.abi.asked import asked as asked_of

    if asked.settings is not None:
        asked_of({CARD: str(asked.settings)})


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
