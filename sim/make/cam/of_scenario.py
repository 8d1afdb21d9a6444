"""The program that a scenario asks for, made of its drawing."""

from parser.findings.errors import SettingsError
from sim.base.progress import Progress, silent
from sim.make.cam.asked import wanted_of
from sim.make.cam.maker import Made, NotMade, unproved
from sim.setup.making import ToMake
from sim.setup.part import DrawingTarget
from sim.setup.scenario import Scenario


def program_of(scenario: Scenario, to_make: ToMake, progress: Progress = silent) -> Made | NotMade:
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
