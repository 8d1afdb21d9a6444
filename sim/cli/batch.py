"""``drycut run`` of many programs: what it is given, and what is said of it."""

import glob
from collections.abc import Sequence
from pathlib import Path

import click

from parser.findings.messages import Message
from sim.cli.overrides import Overrides, overridden
from sim.cli.spoken import spoken
from sim.cli.spread import Spread, pool_of


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
        raise click.UsageError(Message("many-programs-need-a-folder"))
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
        done = run_batch(programs, output, pool, lambda n, total: progress("programs", n, total), spoken())
    if as_json:
        write(index_text(done.document), "json")
    else:
        print_batch(done.document, output, spoken())
    if done.faults:
        from sim.cli.faults import tell_faults

        return tell_faults(done.faults, spoken())
    counts = done.document["counts"]
    return 0 if counts["pass"] == counts["programs"] else 1
