"""``drycut panel``."""

from pathlib import Path
from typing import Any

import click

from parser.findings.errors import Message, ProgramError
from sim.cli.scenario_options import overridden, overrides_of, refused, scenario_options, seed_option
from sim.cli.spoken import Spoken, spoken, words
from sim.cli.spoken.values import FilePath


@click.command(cls=Spoken)
@click.argument("path", type=FilePath(path_type=Path), metavar="PROGRAM|SCENARIO")
@click.option("-o", "--output", type=FilePath(path_type=Path, dir_okay=False), required=True, metavar="FILE.html")
@scenario_options
@seed_option
def panel(path: Path, output: Path, **options: Any) -> None:
    """Write the panel of a control under sparks, which cuts a program live: for a class that drives it itself.

    \b
    drycut panel part.3b -o panel.html
    drycut panel scenarios/sparks-chip -o panel.html --seed 7
    """  # noqa: D301 - click keeps the lines of a paragraph that begins with a backspace
    from parser.program import moving
    from sim.base.files import staged
    from sim.jobs.shop import program_read, source_of
    from sim.run.running import dry_run
    from sim.run.sparks import panel_cut
    from sim.setup.scenario import without_sparks
    from sim.show.panel_page.page import length_mm, panel_page
    from sim.show.terminal.printer import say
    from sim.show.texts.phrases import lasting

    if output.suffix.lower() != ".html":
        raise click.BadParameter(Message("panel-is-html", file=output), param_hint="-o")
    scenario = overridden(path, overrides_of(options)._replace(sparks=True))
    try:
        program = moving(program_read(scenario, source_of(scenario)))
        started = panel_cut(dry_run(program, without_sparks(scenario), measured=False), scenario)
    except ProgramError as error:
        raise refused(scenario, error) from None
    with staged(output.parent, [output.name]) as stage:
        (stage / output.name).write_text(panel_page(scenario, started), encoding="utf-8")
    figures = {"length": f"{length_mm(started):,.1f}", "time": lasting(started.usual_s)}
    say(words()("panel.made", title=scenario.title_in(spoken()), **figures))
    say(words()("commands.written", names=output))
