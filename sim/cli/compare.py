"""``drycut compare``."""

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from sim.cli.options import (
    TAPER_OPTIONS,
    Length,
    Offsets,
    OrRegister,
    offsets_of,
    setting_options,
    taken_settings,
    taken_taper,
    taper_of,
    with_dialect,
    with_options,
)
from sim.cli.spoken import Spoken, spoken, words
from sim.cli.spoken.values import FilePath
from sim.setup.part import DRAWING, THICKNESS

if TYPE_CHECKING:
    from parser.dialect.reader import ChosenDialect
    from parser.program import Program
    from sim.run.drawings import Drawings
    from sim.run.faces import CutOffset, Faces
    from sim.setup.part import DrawingTarget
    from sim.setup.scenario import Scenario


@click.command(cls=Spoken)
@click.argument("path", type=FilePath(path_type=Path), metavar="PROGRAM|SCENARIO")
@click.argument("drawing", type=FilePath(path_type=Path), metavar="[DRAWING.dxf]", required=False)
@click.option(
    "--offset",
    type=OrRegister(Length()),
    multiple=True,
)
@with_dialect
@click.option("--drawing-upper", type=FilePath(path_type=Path, dir_okay=False), metavar="DXF")
@with_options(setting_options([*DRAWING.keys, THICKNESS]))
@with_options(TAPER_OPTIONS)
@click.option("--json", "as_json", is_flag=True)
def compare(  # noqa: PLR0913 - click hands over each option by its name
    *,
    path: Path,
    offset: tuple[Any, ...],
    dialect: "ChosenDialect | None",
    unit: str | None,
    as_json: bool,
    drawing: Path | None,
    drawing_upper: Path | None,
    **options: Any,
) -> None:
    """Compare the edge that a program cuts with a drawing (DXF).

    \b
    drycut compare part.3b part.dxf --offset 0.1mm --tolerance 5um
    drycut compare part.3b part.dxf --layer CUT --json
    drycut compare scenarios/punch
    drycut compare part.3b below.dxf --drawing-upper top.dxf --taper 3deg --height 40mm
    """  # noqa: D301 - click keeps the lines of a paragraph that begins with a backspace
    from sim.cli.scenario_options import drawing_target, of_options, read_with
    from sim.run.drawings import drawings_of
    from sim.setup.scenario import load_scenario, with_values

    given = _checked(offsets_of(offset))
    scenario = read_with(load_scenario(path), dialect, unit, given.registers)
    settings = of_options(DRAWING.keys, taken_settings(DRAWING.keys, options))
    thickness = of_options([THICKNESS], taken_settings([THICKNESS], options))
    scenario = with_values(scenario, thickness, None)
    scenario = replace(scenario, taper=taper_of(taken_taper(options), scenario.taper))
    target = drawing_target(scenario.drawing, drawing, drawing_upper, settings)
    if target is None:
        raise click.MissingParameter(param_hint="DRAWING.dxf", param_type="argument")
    program = _program(scenario)
    drawings = drawings_of(target)  # where an extra lacks, this says which has all
    from sim.run.report.drawing import document_text
    from sim.show.terminal.compare import print_comparison
    from sim.show.terminal.printer import write

    cut_offset, source = _offset(given.plain, program, scenario)
    done = _compared(program, scenario, cut_offset, target, drawings)
    if as_json:
        write(document_text(done.plane, done.top), "json")
    else:
        for each in filter(None, done):
            print_comparison(each, program.name, program.toolpath.source.names, source, spoken())
    raise click.exceptions.Exit(0 if all(each.passes for each in done if each is not None) else 1)


def _checked(given: Offsets) -> Offsets:
    """The options, their plain length within its bounds. SettingsError else."""
    from parser.units import mm
    from sim.setup.part import OFFSET_MM
    from sim.setup.toml.reader import number

    number(mm(given.plain or 0.0), OFFSET_MM._replace(low=0.0), "--offset in mm")
    return given


def _program(scenario: "Scenario") -> "Program":
    """The program of a scenario; one that cannot be read is refused."""
    from parser.findings.errors import ProgramError
    from parser.program import moving
    from sim.check.travel import refuse_too_large
    from sim.cli.scenario_options import refused
    from sim.jobs.shop import program_read, source_of

    try:
        program = moving(program_read(scenario, source_of(scenario)))
        refuse_too_large(program)
    except ProgramError as error:
        raise refused(scenario, error) from None
    return program


def _compared(
    program: "Program", scenario: "Scenario", offset: "CutOffset", target: "DrawingTarget", drawings: "Drawings"
) -> "Faces":
    """The edge beside its drawing, at the top too; a program that cannot run is refused."""
    from parser.findings.errors import ProgramError
    from sim.cli.scenario_options import refused
    from sim.measure.compare.result import FitRequest
    from sim.run.faces import compared_faces

    plane, top = drawings
    assert plane is not None  # noqa: S101 - there is a target
    request = FitRequest(target.tolerance_um, target.fit, target.sharp_corners)
    try:
        return compared_faces(program, scenario, offset, (plane, top), request)
    except ProgramError as error:
        raise refused(scenario, error) from None


def _offset(given: float | None, program: "Program", scenario: "Scenario") -> tuple["CutOffset", str]:
    """The offset, and what it is for people; a header without one, or with 0, tells nothing.

    Nor does the header where the controller is to add an offset: the program is that of the drawing's contour. That of
    a header is as it is in the path; the others are of an upright wire.
    """
    from parser.units import mm
    from sim.run.faces import CutOffset

    if given is not None:
        return CutOffset(given), words()("compare.as-given", offset=f"{mm(given):g}")
    header_um = program.header.get("offset_um")
    if isinstance(header_um, float) and header_um and scenario.offset is None:
        offset = CutOffset(abs(header_um), in_plane=True)
        return offset, words()("compare.of-header", offset=f"{mm(offset.by_um):g}")
    reach_um = scenario.wire.reach_um
    return CutOffset(reach_um), words()("compare.of-wire", offset=f"{mm(reach_um):g}")
