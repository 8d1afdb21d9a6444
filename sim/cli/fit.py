"""``drycut fit``."""

from pathlib import Path
from typing import TYPE_CHECKING

import click

from parser.findings.errors import Message
from sim.cli.ballbar import Speed
from sim.cli.spoken import Spoken, spoken, words
from sim.cli.spoken.values import FilePath, offer_machines

if TYPE_CHECKING:
    from sim.measure.fit.circle import CircleFit

_USUAL = "dk7740"


@click.command(cls=Spoken)
@click.argument("file", type=FilePath(path_type=Path), metavar="FILE.csv")
@click.option("--back", type=FilePath(path_type=Path, dir_okay=False), metavar="FILE.csv")
@click.option("--feed", type=Speed())
@click.option("--machine", metavar="NAME|FILE", shell_complete=offer_machines)
@click.option("-o", "--output", type=FilePath(path_type=Path), metavar="FILE.toml")
@click.option("--json", "as_json", is_flag=True)
def fit(  # noqa: PLR0913, PLR0917 - click hands over each option by its name
    file: Path,
    back: Path | None,
    feed: float | None,
    machine: str | None,
    output: Path | None,
    as_json: bool,
) -> None:
    """Tell what a measured circle says of a machine, with intervals, and what it cannot say.

    \b
    drycut fit circle.csv --feed 500mm/min --machine mine.toml
    drycut fit ccw.csv --back cw.csv -o mine.toml
    """  # noqa: D301 - click keeps the lines of a paragraph that begins with a backspace
    from parser.text.encoding import printable
    from sim.measure.fit.circle import fit_circle
    from sim.measure.fit.model import document_text
    from sim.measure.fit.rows import read_circle
    from sim.setup.machine.machine import load_machine
    from sim.show.terminal.fit import print_fit
    from sim.show.terminal.printer import say, write

    if output is not None and output.suffix.lower() != ".toml":
        raise click.BadParameter(Message("machine-is-toml", output=output), param_hint="-o")
    if feed is not None and feed <= 0.0:
        raise click.BadParameter(Message("not-above-0"), param_hint="--feed")
    own = None if machine is None else load_machine(machine)
    by_points = own is not None and own.controller.interpolation == "point-by-point"
    done = fit_circle(read_circle(file, back), feed, by_points=by_points)
    if output is not None:
        _write(done, machine or _USUAL, feed, output)
    if as_json:
        write(document_text(printable(str(file)), done, words()), "json")
    else:
        print_fit(done, spoken(), is_known=own is not None)
        if output is not None:
            say(words()("commands.written", names=str(output)))


def _write(done: "CircleFit", machine: str, feed_um_s: float | None, output: Path) -> None:
    """The machine file, with a line for what was measured of each of its keys."""
    from sim.base.files import staged
    from sim.cli.progress import StageProgress
    from sim.run.ballbar.fitted import fitted_machine
    from sim.setup.machine.machine import load_machine, machine_sections
    from sim.setup.toml.keys import toml_text

    with StageProgress("run-ccw", "run-cw") as progress:
        fitted = fitted_machine(load_machine(machine), done, feed_um_s, progress)
    lines = [
        f"# {each.name}: {each.value:.3f} {each.unit}, {each.least:.3f} to {each.most:.3f} (95 %)\n"
        for each in done.parameters
        if each.name.startswith("reversal") and each.value is not None
    ]
    text = "".join(lines) + f"# set so: {', '.join(fitted.keys)}\n" + toml_text(machine_sections(fitted.machine))
    with staged(output.parent, [output.name]) as stage:
        (stage / output.name).write_text(text, encoding="utf-8")
