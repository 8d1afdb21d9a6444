"""``drycut time``."""

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from parser.findings.errors import Message, ProgramError
from sim.cli.options import setting_options, taken_settings, with_dialect, with_options
from sim.cli.spoken import Spoken, spoken, words
from sim.cli.spoken.values import FilePath, offer_machines
from sim.setup.part import MATERIAL, THICKNESS
from sim.setup.wire import DIAMETER

if TYPE_CHECKING:
    from collections.abc import Mapping

    from parser.dialect.reader import ChosenDialect
    from sim.run.times.predicted import Predicted
    from sim.setup.scenario import Scenario
    from sim.setup.shop import Shop
    from sim.setup.technology import Technology

_OF_WORK = (THICKNESS, MATERIAL, DIAMETER)


@click.command(cls=Spoken)
@click.argument("paths", type=FilePath(path_type=Path), metavar="PROGRAM|SCENARIO", nargs=-1, required=True)
@click.option("--log", type=FilePath(path_type=Path, dir_okay=False), metavar="FILE.csv")
@click.option("--shop", type=FilePath(path_type=Path, dir_okay=False), metavar="FILE.toml")
@click.option("--machine", metavar="NAME|FILE", shell_complete=offer_machines)
@click.option("--technology", type=FilePath(path_type=Path, dir_okay=False), metavar="FILE.toml")
@with_options(setting_options(_OF_WORK))
@with_dialect
@click.option("-o", "--output", type=FilePath(path_type=Path), metavar="FILE.csv")
@click.option("--json", "as_json", is_flag=True)
def time(  # noqa: PLR0913 - click hands over each option by its name
    *,
    paths: tuple[Path, ...],
    log: Path | None,
    shop: Path | None,
    machine: str | None,
    technology: Path | None,
    dialect: "ChosenDialect | None",
    unit: str | None,
    output: Path | None,
    as_json: bool,
    **options: Any,
) -> None:
    """Tell how long programs take, with an interval, and what that costs.

    \b
    drycut time part.3b --log cuts.csv
    drycut time programs/*.3b --thickness 25mm --shop shop.toml -o times.csv
    """  # noqa: D301 - click keeps the lines of a paragraph that begins with a backspace
    from parser.text.encoding import printable
    from sim.run.times.document import document_text, rows_text
    from sim.run.times.estimate import estimated
    from sim.run.times.log import Log, read_log
    from sim.setup.shop import Shop, load_shop
    from sim.setup.technology import load_technology
    from sim.show.terminal.printer import say, write
    from sim.show.terminal.time import note_text, print_times

    if output is not None and output.suffix.lower() != ".csv":
        raise click.BadParameter(Message("times-are-csv", output=output), param_hint="-o")
    settings = taken_settings(_OF_WORK, options)
    of_wire = None if technology is None else load_technology(technology)
    scenarios = [_scenario(path, machine, (dialect, unit), of_wire, settings) for path in paths]
    of_shop = Shop() if shop is None else load_shop(shop)
    programs = [
        _predicted(scenario, of_shop)._replace(name=printable(str(path)))
        for path, scenario in zip(paths, scenarios, strict=True)
    ]
    cuts = Log() if log is None else read_log(log, scenarios[0], of_shop)
    each = [(of, estimated([of], cuts, of_shop.rates)) for of in programs]
    whole = estimated(programs, cuts, of_shop.rates)
    if output is not None:
        _write(rows_text(each), output)
    language = spoken()
    if as_json:
        write(document_text(whole, each, cuts, lambda note: note_text(note, language)), "json")
    else:
        print_times(whole, each, language)
        if output is not None:
            say(words()("commands.written", names=str(output)))


def _scenario(
    path: Path,
    machine: str | None,
    read_as: "tuple[ChosenDialect | None, str | None]",
    technology: "Technology | None",
    settings: "Mapping[str, Any]",
) -> "Scenario":
    """The scenario of a path with the options in place of its own values."""
    from sim.cli.scenario_options import of_options, read_with
    from sim.setup.machine.machine import load_machine
    from sim.setup.scenario import load_scenario, with_values

    scenario = read_with(load_scenario(path), *read_as, ())
    if machine is not None:
        scenario = replace(scenario, machine=load_machine(machine), machine_by_default=False)
    return with_values(scenario, of_options(_OF_WORK, settings), technology)


def _predicted(scenario: "Scenario", shop: "Shop") -> "Predicted":
    """What a program takes; one that cannot be read or run is refused."""
    from sim.cli.scenario_options import refused
    from sim.jobs.shop import program_read, source_of
    from sim.run.times.predicted import predicted

    try:
        return predicted(program_read(scenario, source_of(scenario)), scenario, shop)
    except ProgramError as error:
        raise refused(scenario, error) from None


def _write(text: str, output: Path) -> None:
    from sim.base.files import staged

    with staged(output.parent, [output.name]) as stage:
        (stage / output.name).write_text(text, encoding="utf-8", newline="")
