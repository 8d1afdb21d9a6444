"""Who does the work of a command on many files: processes of this machine, or the workers of a scheduler."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, NamedTuple, TypeVar

import click

from parser.findings.errors import Message
from sim.cli.options import with_options
from sim.cli.spoken.values import WholeNumber

if TYPE_CHECKING:
    from sim.base.workers.rounds import Pool

Command = TypeVar("Command", bound=Callable[..., Any])

_OPTIONS = (
    click.option("--jobs", type=WholeNumber(1), metavar="N"),
    click.option("--scheduler", metavar="ADDRESS"),
)


class Spread(NamedTuple):
    """So many processes of this machine, or the workers of a scheduler; None where left out."""

    jobs: int | None
    scheduler: str | None


spread_options = with_options(_OPTIONS)
"""Gives a command the options of `Spread`."""


@contextmanager
def pool_of(spread: Spread) -> Iterator["Pool"]:
    """The workers that are asked for. UsageError where both kinds are, ClusterError where none can be reached."""
    if spread.scheduler is None:
        from sim.base.workers.rounds import Processes

        yield Processes(spread.jobs)
        return
    if spread.jobs is not None:
        raise click.UsageError(Message("jobs-and-scheduler"))
    from sim.base.workers.cluster import cluster

    with cluster(spread.scheduler) as pool:
        yield pool
