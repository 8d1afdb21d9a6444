"""What a scenario asks for of a drawing: how its program is written, and the program, without a proof."""

from parser.dialect.reader import OwnDialect
from parser.findings.errors import SettingsError
from parser.write.iso import IsoChoices, iso_choices
from sim.base.progress import Progress, silent
from sim.make.cam.lean.angle import in_plane, leaning
from sim.make.cam.maker import MadeProgram, NotMade, unproved
from sim.make.wanted import (
    Wanted,
)
from sim.setup.making import Language, Making, ToMake, Writing
from sim.setup.part import DrawingTarget
from sim.setup.scenario import Scenario

_USUAL_DIALECT = "fast-wire"


def wanted_of(to_make: ToMake, language: Language, scenario: Scenario) -> Wanted:
    """How a program is to be written for the machine of a scenario, whose dialect and unit ISO has.

    SettingsError where the dialect has no such numbers.
    """
    writing = to_make.writing
    return Wanted(
        language=language,
        iso=_iso(writing, scenario) if language == "iso" else None,
        form=writing.form,
        keeps=writing.compensation == "kept",
        newline="\r\n" if writing.crlf else "\n",
        name=to_make.file.stem,
        offset_um=_offset_um(leaning(to_make.making, scenario, says_angle=language == "iso"), in_plane(scenario)),
        end_code=writing.end_code,
        pause_code=writing.pause_code,
        encoding=writing.encoding,
    )


def _offset_um(making: Making, scenario: Scenario) -> float | None:
    """The offset that makes the edge, for headers; None where it is not one for all, or the controller's."""
    if any(wish.passes_um for wish in making.layers):
        return None
    return min(making.passes_um or (scenario.wire.reach_um,)) or None


def _iso(writing: Writing, scenario: Scenario) -> IsoChoices:
    if isinstance(scenario.dialect, OwnDialect):
        raise SettingsError("own-dialect-not-written", name=scenario.dialect.name)
    unit = scenario.unit or None
    return iso_choices(scenario.dialect or _USUAL_DIALECT, unit, writing.decimals)  # type: ignore[arg-type]  # checked


def program_of(scenario: Scenario, to_make: ToMake, progress: Progress = silent) -> MadeProgram | NotMade:
    """The program of a scenario's drawing, without a proof: the run that it is made for is one.

    Raises FileUnreadableError and DrawingError where there is no drawing, SettingsError where it cannot be written as
    it is asked for.
    """
    drawing = drawing_to_cut(scenario)
    wanted = wanted_of(to_make, to_make.language, scenario)
    return unproved(drawing.file, to_make.making, wanted, scenario, progress)


def drawing_to_cut(scenario: Scenario) -> DrawingTarget:
    """The drawing of a scenario. SettingsError where it has none."""
    if scenario.drawing is None:
        raise SettingsError("scenario-without-drawing", title=scenario.title)
    return scenario.drawing
