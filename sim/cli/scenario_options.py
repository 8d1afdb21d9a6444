"""Options of the commands that run a scenario, and those that take the place of its own values.

Options of the commands that run a scenario, and what they say where its program cannot be read or run.

Options of ``drycut run`` that take the place of a scenario's own values.
"""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, Final, NamedTuple, TypeVar

import click

from parser.findings.errors import ProgramError, SettingsError
from parser.units import mm
from sim.cli.options import (
    READ_WITH,
    TAPER_OPTIONS,
    Lengths,
    OrRegister,
    TaperOptions,
    offsets_of,
    setting_options,
    taken_settings,
    taken_taper,
    taper_of,
    with_options,
)
from sim.cli.spoken import spoken, words
from sim.cli.spoken.values import FilePath, WholeNumber, offer_machines
from sim.setup.part import (
    CORNERS,
    FIT,
    LAYER,
    OFFSET_MM,
    PASSES,
    SIDE,
    SIDES,
    TOLERANCE,
    DrawingTarget,
    Offset,
    OffsetPass,
)
from sim.setup.settable import INTERPOLATOR, SETTABLE
from sim.setup.spark import SEED
from sim.setup.toml.keys import Key
from sim.setup.toml.reader import number
from sim.show.terminal.finding import finding_lines
from sim.show.terminal.printer import painted, say
from sim.show.terminal.streams import outlet
from sim.show.terminal.wrap import width_of

if TYPE_CHECKING:
    from parser.dialect.reader import ChosenDialect
    from sim.cli.options import RegisterSet
    from sim.setup.machine.table import TableEngine
    from sim.setup.scenario import Scenario


Command = TypeVar("Command", bound=Callable[..., Any])


ENGINE_OPTION = click.option(
    "--engine",
    type=click.Choice(["compiled", "pymunk"]),
)

COMPARISON: Final = (LAYER, TOLERANCE, FIT, CORNERS)
"""How a cut is held against a drawing; ``--gap`` is the spark gap of a run."""
_OPTIONS = (
    *READ_WITH,
    click.option("--machine", metavar="NAME|FILE", shell_complete=offer_machines),
    click.option("--technology", type=FilePath(path_type=Path, dir_okay=False), metavar="FILE.toml"),
    *setting_options([INTERPOLATOR, *SETTABLE.values()]),
    click.option(
        "--offset",
        type=OrRegister(Lengths()),
        multiple=True,
    ),
    *setting_options([SIDE]),
    ENGINE_OPTION,
    click.option(
        "--drawing",
        type=FilePath(path_type=Path, dir_okay=False),
        metavar="DXF",
    ),
    click.option("--drawing-upper", type=FilePath(path_type=Path, dir_okay=False), metavar="DXF"),
    *setting_options(COMPARISON),
    *TAPER_OPTIONS,
)


_SEED = click.option("--seed", type=WholeNumber(int(SEED.low), int(SEED.high)), metavar="N")
seed_option = with_options((_SEED,))
"""Gives a command that cuts under sparks alone the seed of what is random, which is of `Overrides` too."""
spark_options = with_options((click.option("--sparks", is_flag=True), _SEED))
"""Gives a command that runs a program the options of a cut under sparks, which are of `Overrides` too."""
scenario_options = with_options(_OPTIONS)
"""Gives a command the options that take the place of a scenario's own values: those of `Overrides`."""


def refused(scenario: "Scenario", error: ProgramError) -> click.exceptions.Exit:
    """Tell what is wrong with a program that cannot be read or run; the end of the command, to be raised."""
    for line in describe(str(scenario.program), error):
        say(line, err=True)
    return click.exceptions.Exit(2)


def describe(name: str, error: ProgramError) -> list[str]:
    """The finding that makes a program unreadable, in lines for stderr: its source line where the place is known."""
    finding = error.finding
    excerpt = error.excerpt if error.excerpt and finding.column else None
    lines = finding_lines(name, finding, excerpt, spoken(), width_of(outlet(err=True)))
    return [painted(line, finding.severity) for line in lines]


class Overrides(NamedTuple):
    """The options as given, lengths in µm; None where an option was left out.

    `settings` has those that take the place of settings, by the names of their keys (`sim.setup.settable`), and
    `comparison` likewise those of `COMPARISON`; `offset` has the offset of the controller, and registers of ISO.
    """

    dialect: "ChosenDialect | None" = None
    unit: str | None = None
    machine: str | None = None
    technology: Path | None = None
    settings: Mapping[str, Any] = MappingProxyType({})
    interpolator: str | None = None
    engine: "TableEngine | None" = None
    offset: tuple["tuple[float, ...] | RegisterSet", ...] = ()
    side: str | None = None
    drawing: Path | None = None
    drawing_upper: Path | None = None
    comparison: Mapping[str, Any] = MappingProxyType({})
    taper: TaperOptions = TaperOptions()
    sparks: bool = False
    seed: int | None = None


def overrides_of(options: dict[str, Any]) -> Overrides:
    """The options as click hands them over."""
    settings, taper = taken_settings(SETTABLE.values(), options), taken_taper(options)
    return Overrides(settings=settings, taper=taper, comparison=taken_settings(COMPARISON, options), **options)


def overridden(path: Path, options: Overrides) -> "Scenario":
    """Scenario of the path with the options of the command line in place of its own values."""
    from sim.setup import scenario as scenarios
    from sim.setup.machine.machine import load_machine
    from sim.setup.technology import load_technology

    offsets = offsets_of(options.offset)
    scenario = read_with(scenarios.load_scenario(path), options.dialect, options.unit, offsets.registers)
    if options.machine is not None:
        scenario = replace(scenario, machine=load_machine(options.machine), machine_by_default=False)
    if options.engine is not None:
        scenario = replace(scenario, machine=scenario.machine._replace(engine=options.engine))
    given = of_options(SETTABLE.values(), options.settings)
    technology = None if options.technology is None else load_technology(options.technology)
    scenario = replace(
        scenarios.with_values(scenario, given, technology),
        offset=_offset(scenario.offset, offsets.plain, options.side),
        drawing=_drawing(scenario.drawing, options),
        taper=taper_of(options.taper, scenario.taper),
    )
    if options.sparks or options.seed is not None:
        scenario = scenarios.under_sparks(scenario, options.seed)
    return _stepping_by(scenario, options.interpolator)


def read_with(
    scenario: "Scenario", dialect: "ChosenDialect | None", unit: str | None, registers: tuple["RegisterSet", ...]
) -> "Scenario":
    """The scenario with what the options say of its program in place of its own values; other registers stay."""
    from parser.dialect.reader import merged

    return replace(
        scenario,
        dialect=dialect or scenario.dialect,
        unit=unit or scenario.unit,
        registers=merged([scenario.registers, registers]),
    )


def _offset(offset: Offset | None, by_um: tuple[float, ...] | None, side_word: str | None) -> Offset | None:
    """The offset with the options in place of its own values. SettingsError where only half of one is known.

    Lengths take the place of all passes: each makes one in the program's direction, at the machine's feed.
    """
    if by_um is None and side_word is None:
        return offset
    passes = offset and offset.passes
    if by_um is not None:
        number(len(by_um), PASSES, "--offset: the number of passes")
        passes = tuple(OffsetPass(each) for each in by_um)
        for pass_ in passes:
            number(mm(pass_.by_um), OFFSET_MM, "--offset in mm")
    side = SIDES[side_word] if side_word is not None else offset and offset.side
    if side is None:
        raise SettingsError("offset-needs-side")
    if passes is None:
        raise SettingsError("side-needs-offset")
    return Offset(passes, side)


def of_options(keys: Iterable[Key], settings: Mapping[str, Any]) -> dict[str, Any]:
    """Values of options as they are inside, by the names of their keys. SettingsError for one out of its bounds."""
    return {key.name: key.of_option(settings[key.name]) for key in keys if key.name in settings}


def drawing_target(
    own: DrawingTarget | None, drawing: Path | None, upper: Path | None, settings: Mapping[str, Any]
) -> DrawingTarget | None:
    """The drawings with options in place of a scenario's own values; None without a drawing.

    `settings` are by the names of the keys of ``[drawing]``, as they are inside. SettingsError where there is a
    drawing of the top alone.
    """
    if drawing is not None:
        own = own._replace(file=drawing) if own is not None else DrawingTarget(drawing)
    if own is None:
        if upper is not None:
            raise SettingsError("option-needs-drawing", option="drawing-upper")
        return None
    return own._replace(**settings, upper=upper or own.upper)


def _drawing(own: DrawingTarget | None, options: Overrides) -> DrawingTarget | None:
    """The drawing of a run. SettingsError where the options say how to hold it but not which."""
    drawing = drawing_target(own, options.drawing, options.drawing_upper, of_options(COMPARISON, options.comparison))
    for key in COMPARISON:
        if drawing is None and key.name in options.comparison:
            raise SettingsError("option-needs-drawing", option=key.option.lstrip("-"))
    return drawing


def _stepping_by(scenario: "Scenario", interpolator: str | None) -> "Scenario":
    """Scenario with another interpolator; counts and ends of steps that it expects of its own are not held to."""
    from sim.setup.expectations import not_of_steps

    if interpolator in (None, scenario.machine.controller.interpolation):
        return scenario
    expectations = not_of_steps(scenario.expect)
    left_out = ", ".join(e.path for e in scenario.expect if e not in expectations)
    if left_out:
        say(words()("commands.not-expected", names=left_out), err=True)
    return replace(scenario, machine=scenario.machine.stepping_by(interpolator), expect=expectations)  # type: ignore[arg-type]
