"""``drycut ballbar``."""

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from parser.findings.errors import Message
from sim.cli.options import Length, setting_options, with_options
from sim.cli.scenario_options import ENGINE_OPTION
from sim.cli.spoken import Spoken, spoken, words
from sim.cli.spoken.values import FilePath, offer_machines
from sim.setup.settable import INTERPOLATOR

if TYPE_CHECKING:
    from sim.run.ballbar.circle import Ballbar
    from sim.setup.machine.table import TableEngine


class Speed(click.ParamType):  # type: ignore[type-arg]  # generic in newer clicks alone
    """A speed with its unit, in µm/s."""

    name = "speed"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> float:
        """The speed in µm/s."""
        from sim.base.units import parse_speed

        return value if isinstance(value, float) else parse_speed(value)


@click.command(cls=Spoken)
@click.option("--radius", type=Length(), default="50mm", show_default=True)
@click.option("--feed", type=Speed())
@click.option("--machine", default="dk7740", show_default=True, metavar="NAME|FILE", shell_complete=offer_machines)
@with_options(setting_options([INTERPOLATOR]))
@ENGINE_OPTION
@click.option("--tolerance", type=Length())
@click.option(
    "-o",
    "--output",
    type=FilePath(path_type=Path),
    metavar="FILE.png|DIR",
)
@click.option("--trace", type=FilePath(path_type=Path, dir_okay=False), metavar="FILE.csv")
@click.option("--json", "as_json", is_flag=True)
def ballbar(  # noqa: PLR0913, PLR0917 - click hands over each option by its name
    radius: float,
    feed: float | None,
    machine: str,
    interpolator: str | None,
    engine: "TableEngine | None",
    tolerance: float | None,
    output: Path | None,
    trace: Path | None,
    as_json: bool,
) -> None:
    """Run the circular test of ISO 230-4 on a machine.

    \b
    drycut ballbar --radius 50mm --feed 500mm/min -o ballbar.png
    """  # noqa: D301 - click keeps the lines of a paragraph that begins with a backspace
    from sim.cli.progress import StageProgress
    from sim.run.ballbar.circle import circle_test, document_text, run_test
    from sim.setup.machine.machine import load_machine
    from sim.show.terminal.batch import print_ballbar
    from sim.show.terminal.printer import say, write

    if output is not None and output.suffix.lower() not in ("", ".png") and not output.is_dir():
        raise click.BadParameter(Message("neither-folder-nor-png", output=output), param_hint="-o")
    if tolerance is not None and tolerance <= 0.0:
        raise click.BadParameter(Message("not-above-0"), param_hint="--tolerance")
    model = load_machine(machine)
    if interpolator is not None:
        model = model.stepping_by(interpolator)  # type: ignore[arg-type]
    if engine is not None:
        model = model._replace(engine=engine)
    test = circle_test(model, radius, feed)
    with StageProgress("run-ccw", "run-cw") as progress:
        done = run_test(test, progress)
    written = _write(done, tolerance, output) if output is not None else []
    if trace is not None:
        written.append(_write_trace(done, trace))
    if as_json:
        write(document_text(done, tolerance), "json")
    else:
        print_ballbar(done, tolerance, spoken())
        if written:
            say(words()("commands.written", names=", ".join(written)))
    raise click.exceptions.Exit(0 if done.passes(tolerance) else 1)


def _write(done: "Ballbar", tolerance_um: float | None, output: Path) -> list[str]:
    """Files of a test, all of them or none; names of those written. A turn that does not go round has no picture."""
    from sim.base.files import staged
    from sim.run.ballbar.circle import document_text

    alone = output.suffix.lower() == ".png"
    folder, picture = (output.parent, output.name) if alone else (output, "ballbar.png")
    names = [picture] * (done.measured is not None) + ["ballbar.json"] * (not alone)
    with staged(folder, names) as stage:
        if done.measured is not None:
            from sim.show.pictures.ballbar import draw_ballbar

            draw_ballbar(done, done.measured, spoken()).save(stage / picture, dpi=(200, 200))
        if not alone:
            (stage / "ballbar.json").write_text(document_text(done, tolerance_um), encoding="utf-8")
    return [str(folder / name) for name in names]


def _write_trace(done: "Ballbar", file: Path) -> str:
    """Both turns of the table as CSV, whole or not at all; the name of the file."""
    from sim.base.files import staged
    from sim.run.ballbar.circle import trace_text

    with staged(file.parent, [file.name]) as stage:
        (stage / file.name).write_text(trace_text(done), encoding="utf-8", newline="")
    return str(file)
