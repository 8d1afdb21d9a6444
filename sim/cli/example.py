"""``drycut example``."""

from pathlib import Path

import click

from parser.findings.errors import Message, did_you_mean
from sim.cli.spoken import Spoken, words
from sim.cli.spoken.values import FilePath, offer_examples


@click.command(cls=Spoken)
@click.argument("name", required=False, metavar="[NAME]", shell_complete=offer_examples)
@click.option("-o", "--output", type=FilePath(path_type=Path, file_okay=False), metavar="DIR")
def example(name: str | None, output: Path | None) -> None:
    """Write an example to try: a scenario with its program and what belongs to it.

    \b
    drycut example
    drycut example keyhole
    drycut example keyhole -o try/
    """  # noqa: D301 - click keeps the lines of a paragraph that begins with a backspace
    from sim.jobs.examples import example_into, example_names
    from sim.show.terminal.printer import say

    names = example_names()
    if name is None:
        _list(names)
        return
    if name not in names:
        raise click.UsageError(
            Message("no-example", name=name, hint=did_you_mean(name, names, Message("lists-examples")))
        )
    folder = output or Path(name)
    if folder.exists():
        raise click.BadParameter(Message("example-is-there", folder=folder), param_hint="-o")
    written = example_into(folder, name)
    say(words()("commands.written", names=f"{folder}/ {', '.join(written)}"))
    say(words()("commands.try-it", folder=folder))


def _list(names: tuple[str, ...]) -> None:
    from sim.jobs.examples import example
    from sim.show.terminal.printer import say
    from sim.show.terminal.streams import outlet
    from sim.show.terminal.wrap import width_of, wrapped

    wide = max(map(len, names)) + 2
    for name in names:
        for line in wrapped(example(name).title, width_of(outlet()), head=name.ljust(wide)):
            say(line)
