"""Options of the commands that run a scenario, and those that take the place of its own values.

Options of the commands that run a scenario, and what they say where its program cannot be read or run.

Options of ``drycut run`` that take the place of a scenario's own values.
"""

from collections.abc import Callable, Mapping
from dataclasses import replace
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, NamedTuple, TypeVar

import click

from parser.findings.errors import ProgramError, SettingsError
from parser.units import mm
from sim.cli.options import READ_WITH, Length, Lengths, OrRegister, length_options, offsets_of, taken_lengths
from sim.cli.spoken import spoken, words
from sim.cli.spoken.values import FilePath, offer_machines
from sim.setup.settable import SETTABLE
from sim.setup.toml.reader import number
from sim.show.terminal.finding import finding_lines
from sim.show.terminal.printer import painted, say
from sim.show.terminal.streams import outlet
from sim.show.terminal.wrap import width_of

if TYPE_CHECKING:
    from parser.dialect.reader import ChosenDialect
    from sim.cli.options import RegisterSet
    from sim.setup.machine.machine import TableEngine
    from sim.setup.part import DrawingTarget, Offset, SharpCorners
    from sim.setup.scenario import Scenario


Command = TypeVar("Command", bound=Callable[..., Any])


ENGINE_OPTION = click.option(
    "--engine",
    type=click.Choice(["compiled", "pymunk"]),
)

_OPTIONS = (
    *READ_WITH,
    click.option("--machine", metavar="NAME|FILE", shell_complete=offer_machines),
    *length_options(SETTABLE.values()),
    click.option(
        "--interpolator",
        type=click.Choice(["point-by-point", "card"]),
    ),
    click.option(
        "--offset",
        type=OrRegister(Lengths()),
        multiple=True,
    ),
    click.option(
        "--side",
        type=click.Choice(["left", "right"]),
    ),
    ENGINE_OPTION,
    click.option("--past-stop", is_flag=True),
    click.option("--kerf", is_flag=True),
    click.option("--open", "may_stay_open", is_flag=True),
    click.option(
        "--drawing",
        type=FilePath(path_type=Path, dir_okay=False),
        metavar="DXF",
    ),
    click.option("--layer", metavar="NAME"),
    click.option("--tolerance", type=Length()),
    click.option("--no-fit", is_flag=True),
    click.option("--sharp-corners", type=click.Choice(["tell", "fail"])),
)


def scenario_options(command: Command) -> Command:
    """Give a command the options that take the place of a scenario's own values: those of `Overrides`."""
    for option in reversed(_OPTIONS):
        command = option(command)
    return command


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

    `lengths` has those that take the place of settings, by the names of their keys (`sim.setup.settable`); `offset` has
    the offset of the controller, and registers that ISO programs name.
    """

    dialect: "ChosenDialect | None" = None
    unit: str | None = None
    machine: str | None = None
    lengths: Mapping[str, float] = MappingProxyType({})
    interpolator: str | None = None
    engine: "TableEngine | None" = None
    offset: tuple["tuple[float, ...] | RegisterSet", ...] = ()
    side: str | None = None
    past_stop: bool = False
    kerf: bool = False
    may_stay_open: bool = False
    drawing: Path | None = None
    layer: str | None = None
    tolerance: float | None = None
    no_fit: bool = False
    sharp_corners: "SharpCorners | None" = None


def overrides_of(options: dict[str, Any]) -> Overrides:
    """The options as click hands them over."""
    from sim.setup.settable import SETTABLE

    return Overrides(lengths=taken_lengths(SETTABLE.values(), options), **options)


def overridden(path: Path, options: Overrides) -> "Scenario":
    """Scenario of the path with the options of the command line in place of its own values."""
    from sim.setup import scenario as scenarios
    from sim.setup.machine.machine import load_machine
    from sim.setup.settable import SETTABLE, with_settings

    offsets = offsets_of(options.offset)
    scenario = read_with(scenarios.load_scenario(path), options.dialect, options.unit, offsets.registers)
    if options.machine is not None:
        scenario = replace(scenario, machine=load_machine(options.machine), machine_by_default=False)
    if options.engine is not None:
        scenario = replace(scenario, machine=scenario.machine._replace(engine=options.engine))
    given = {
        key.name: key.of_option(options.lengths[key.name]) for key in SETTABLE.values() if key.name in options.lengths
    }
    scenario = replace(
        with_settings(scenario, given),
        offset=_offset(scenario.offset, offsets.plain, options.side),
        past_stop=scenario.past_stop or options.past_stop,
        kerf=scenario.kerf or options.kerf,
        may_stay_open=scenario.may_stay_open or options.may_stay_open,
        drawing=_drawing(scenario.drawing, options),
    )
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


def _offset(offset: "Offset | None", by_um: tuple[float, ...] | None, side_word: str | None) -> "Offset | None":
    """The offset with the options in place of its own values. SettingsError where only half of one is known.

    Lengths take the place of all passes: each makes one in the program's direction, at the machine's feed.
    """
    from sim.setup.part import OFFSET_MM, PASSES, SIDES, Offset, OffsetPass

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


class OfDrawing(NamedTuple):
    """Options that say which drawing a cut is held against, and how; lengths in µm, None where left out."""

    drawing: Path | None
    layer: str | None
    tolerance: float | None
    no_fit: bool
    sharp_corners: "SharpCorners | None"
    gap: float | None = None


def drawing_target(own: "DrawingTarget | None", options: OfDrawing) -> "DrawingTarget | None":
    """The drawing with the options in place of a scenario's own values; None without a drawing.

    SettingsError for values out of their bounds.
    """
    from sim.setup.part import GAP, TOLERANCE, DrawingTarget

    if options.drawing is not None:
        own = own._replace(file=options.drawing) if own is not None else DrawingTarget(options.drawing)
    if own is None:
        return None
    if options.layer is not None:
        own = own._replace(layer=options.layer)
    if options.tolerance is not None:
        own = own._replace(tolerance_um=TOLERANCE.of_option(options.tolerance))
    if options.gap is not None:
        own = own._replace(gap_um=GAP.of_option(options.gap))
    if options.sharp_corners is not None:
        own = own._replace(sharp_corners=options.sharp_corners)
    return own._replace(fit=own.fit and not options.no_fit)


def _drawing(own: "DrawingTarget | None", options: Overrides) -> "DrawingTarget | None":
    """The drawing of a run. SettingsError where the options say how to hold it but not which."""
    of = OfDrawing(options.drawing, options.layer, options.tolerance, options.no_fit, options.sharp_corners)
    drawing = drawing_target(own, of)
    settings = {"layer": of.layer, "tolerance": of.tolerance, "no-fit": of.no_fit, "sharp-corners": of.sharp_corners}
    for name, given in settings.items():
        if drawing is None and given not in (None, False):
            raise SettingsError("option-needs-drawing", option=name)
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
