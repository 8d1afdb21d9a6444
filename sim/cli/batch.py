"""``drycut run`` of many programs: what it is given, who does it, and what is said of it."""

import glob
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple, TypeVar

import click

from sim.cli.overrides import Overrides, overridden

if TYPE_CHECKING:
    from sim.workers.pool import Pool

Command = TypeVar("Command", bound=Callable[..., Any])

_OPTIONS = (
    click.option("--jobs", type=click.IntRange(1), metavar="N", help="Programs run at once [one a core]."),
    click.option(
        "--scheduler", metavar="ADDRESS", help="Run them on the workers of a Dask scheduler: tcp://host:8786."
    ),
)


class Spread(NamedTuple):
    """Who does the work: so many processes of this machine, or the workers of a scheduler; None where left out."""

    jobs: int | None
    scheduler: str | None


def spread_options(command: Command) -> Command:
    """Give a command the options of `Spread`."""
    for option in reversed(_OPTIONS):
        command = option(command)
    return command


def is_shop(names: Sequence[str]) -> bool:
    """Whether names lead to a shop: several, a folder that is no scenario, or a glob."""
    first = Path(names[0])
    if len(names) > 1 or (first.is_dir() and not (first / "scenario.toml").exists()):
        return True
    return glob.has_magic(names[0]) and not first.exists()


def run_shop(names: Sequence[str], output: Path | None, spread: Spread, options: Overrides, *, as_json: bool) -> int:
    """Run all programs that names lead to into folders of `output`; the exit code.

    UsageError without an output, FileUnreadableError for a name that leads to no program.
    """
    if output is None:
        raise click.UsageError("many programs need -o DIR: each gets a folder there")
    from sim.cli.progress import StageProgress
    from sim.jobs.batch import TAKEN, run_batch
    from sim.jobs.index import index_text
    from sim.jobs.shop import find_programs
    from sim.show.terminal.batch import print_batch
    from sim.show.terminal.printer import write

    if options.machine is not None:
        from sim.setup.machine.machine import load_machine

        load_machine(options.machine)  # bad use, which each program would tell again
    programs = find_programs(names, lambda path: overridden(path, options), output, TAKEN)
    with StageProgress() as progress, pool_of(spread) as pool:
        done = run_batch(programs, output, pool, lambda count, total: progress("programs", count, total))
    if as_json:
        write(index_text(done.document), "json")
    else:
        print_batch(done.document, output)
    if done.faults:
        from sim.cli.faults import tell_faults
        from sim.cli.scenario_options import chosen

        return tell_faults(done.faults, chosen(None))
    counts = done.document["counts"]
    return 0 if counts["pass"] == counts["programs"] else 1


@contextmanager
def pool_of(spread: Spread) -> Iterator["Pool"]:
    """The workers that are asked for. UsageError where both kinds are, ClusterError where none can be reached."""
    if spread.scheduler is None:
        from sim.workers.processes import Processes

        yield Processes(spread.jobs)
        return
    if spread.jobs is not None:
        raise click.UsageError("--jobs and --scheduler say two things: the scheduler knows its workers")
    from sim.workers.cluster import cluster

    with cluster(spread.scheduler) as pool:
        yield pool
