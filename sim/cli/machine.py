"""``drycut machine``."""

from pathlib import Path

import click

from parser.findings.errors import Message
from sim.cli.spoken import Spoken, spoken, words
from sim.cli.spoken.values import FilePath, offer_machines

_USUAL = "dk7740"


@click.command(cls=Spoken)
@click.argument("file", type=FilePath(path_type=Path), metavar="FILE")
@click.option("--machine", metavar="NAME|FILE", default=_USUAL, show_default=True, shell_complete=offer_machines)
@click.option("-o", "--output", type=FilePath(path_type=Path, dir_okay=False), metavar="FILE.toml")
def machine(file: Path, machine: str, output: Path | None) -> None:
    """Begin a machine file with what a configuration of LinuxCNC or Klipper says.

    \b
    drycut machine printer.cfg
    drycut machine mill.ini --machine servo-400x500 -o mine.toml
    """  # noqa: D301 - click keeps the lines of a paragraph that begins with a backspace
    from sim.base.files import staged
    from sim.setup.machine.foreign import carried_over, read_foreign
    from sim.setup.machine.machine import load_machine
    from sim.setup.toml.keys import toml_text
    from sim.show.terminal.machine import print_foreign
    from sim.show.terminal.printer import say

    if output is not None and output.suffix.lower() != ".toml":
        raise click.BadParameter(Message("machine-is-toml", output=output), param_hint="-o")
    base, foreign = load_machine(machine), read_foreign(file)
    text = toml_text(carried_over(base, foreign))
    if output is not None:
        with staged(output.parent, [output.name]) as stage:
            (stage / output.name).write_text(text, encoding="utf-8", newline="\n")
            load_machine(str(stage / output.name))
    print_foreign(foreign, spoken())
    if output is not None:
        say(words()("commands.written", names=str(output)))
