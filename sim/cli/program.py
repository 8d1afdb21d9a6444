"""``drycut program``."""

from pathlib import Path

import click

from sim.cli.scenario_options import Length, chosen


@click.command(short_help="Make a program of a drawing, and prove it.")
@click.argument("path", type=click.Path(path_type=Path, dir_okay=False), metavar="DRAWING.dxf")
@click.option("-o", "--output", type=click.Path(path_type=Path, dir_okay=False), required=True, metavar="FILE")
@click.option("--tolerance", type=Length(), default="2um", help="How far the path may lie off the drawing.")
@click.option("--lang", type=click.Choice(["en", "zh"]), help="Language of messages; else that of the locale.")
def program(path: Path, output: Path, tolerance: float, lang: str | None) -> None:
    """Make a program of a drawing (DXF), and prove it by a run before it is written."""
    from sim.cam.maker import Made, made
    from sim.convert.wanted import Wanted
    from sim.files import staged
    from sim.setup.making import Making
    from sim.setup.scenario import load_scenario
    from sim.show.terminal.printer import say
    from sim.show.terminal.program import made_lines, not_made_lines
    from sim.show.terminal.streams import outlet
    from sim.show.terminal.wrap import width_of

    width, tongue = width_of(outlet()), chosen(lang)
    done = made(path, Making(tolerance_um=tolerance), Wanted("3b"), load_scenario(output))
    if not isinstance(done, Made):
        for line in not_made_lines(done, str(path), tongue, width):
            say(line)
        raise click.exceptions.Exit(1)
    with staged(output.parent, [output.name]) as stage:
        (stage / output.name).write_bytes(done.data)
    for line in made_lines(output, tongue, width):
        say(line)
