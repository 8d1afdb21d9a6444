"""The program that a scenario asks for, made of its drawing."""

from sim.cam.asked import wanted_of
from sim.cam.maker import Made, NotMade, unproved
from sim.setup.making import ToMake
from sim.setup.scenario import Scenario
from sim.table.motion import Progress, silent


def program_of(scenario: Scenario, to_make: ToMake, progress: Progress = silent) -> Made | NotMade:
    """The program of a scenario's drawing, without a proof: the run that it is made for is one.

    Raises FileUnreadableError and DrawingError where there is no drawing, SettingsError where it cannot be written as
    it is asked for.
    """
    assert scenario.drawing is not None  # noqa: S101 - what is to be made has a drawing
    wanted = wanted_of(to_make.writing, to_make.language, scenario, to_make.file.stem)
    return unproved(scenario.drawing.file, to_make.making, wanted, scenario, progress)
