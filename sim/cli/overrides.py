"""Options of ``drycut run`` that take the place of a scenario's own values."""

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from parser.findings.errors import SettingsError
from parser.units import mm
from sim.cli.dialect_options import offsets_of
from sim.cli.spoken import words
from sim.setup.toml.reader import number
from sim.show.terminal.printer import say

if TYPE_CHECKING:
    from sim.cli.dialect_options import RegisterSet
    from sim.setup.machine.machine import TableEngine
    from sim.setup.part import DrawingTarget, Offset, SharpCorners
    from sim.setup.scenario import Scenario
    from sim.setup.wire import Wire


class Overrides(NamedTuple):
    """The options as given, lengths in µm; None where an option was left out.

    `offset` has the offset of the controller, and registers that ISO programs name.
    """

    dialect: str | None
    unit: str | None
    machine: str | None
    thickness: float | None
    wire_diameter: float | None
    gap: float | None
    wire_lag: float | None
    interpolator: str | None
    engine: "TableEngine | None"
    offset: tuple["tuple[float, ...] | RegisterSet", ...]
    side: str | None
    past_stop: bool
    kerf: bool
    may_stay_open: bool
    drawing: Path | None
    layer: str | None
    tolerance: float | None
    no_fit: bool
    sharp_corners: "SharpCorners | None"


def overridden(path: Path, options: Overrides) -> "Scenario":
    """Scenario of the path with the options of the command line in place of its own values."""
    from sim.setup import scenario as scenarios
    from sim.setup.machine.machine import load_machine

    offsets = offsets_of(options.offset)
    scenario = read_with(scenarios.load_scenario(path), options.dialect, options.unit, offsets.registers)
    if options.machine is not None:
        scenario = replace(scenario, machine=load_machine(options.machine), machine_by_default=False)
    if options.engine is not None:
        scenario = replace(scenario, machine=scenario.machine._replace(engine=options.engine))
    thickness_mm = scenario.thickness_mm
    if options.thickness is not None:
        thickness_mm = scenarios.THICKNESS.of_option(mm(options.thickness))
    scenario = replace(
        scenario,
        thickness_mm=thickness_mm,
        wire=_wire(scenario.wire, options),
        offset=_offset(scenario.offset, offsets.plain, options.side),
        past_stop=scenario.past_stop or options.past_stop,
        kerf=scenario.kerf or options.kerf,
        may_stay_open=scenario.may_stay_open or options.may_stay_open,
        drawing=_drawing(scenario.drawing, options),
    )
    return _stepping_by(scenario, options.interpolator)


def read_with(
    scenario: "Scenario", dialect: str | None, unit: str | None, registers: tuple["RegisterSet", ...]
) -> "Scenario":
    """The scenario with what the options say of its program in place of its own values; other registers stay."""
    from parser.dialect.choices import merged

    return replace(
        scenario,
        dialect=dialect or scenario.dialect,
        unit=unit or scenario.unit,
        registers=merged([scenario.registers, registers]),
    )


def _wire(wire: "Wire", options: Overrides) -> "Wire":
    """The wire with the options in place of its own values."""
    from sim.setup.wire import DIAMETER, LAG, SPARK_GAP

    if options.wire_diameter is not None:
        wire = replace(wire, diameter_um=DIAMETER.of_option(options.wire_diameter))
    if options.gap is not None:
        wire = replace(wire, spark_gap_um=SPARK_GAP.of_option(options.gap))
    if options.wire_lag is not None:
        wire = replace(wire, lag=LAG.of_option(options.wire_lag))
    return wire


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
