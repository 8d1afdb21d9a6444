"""Where the program of a scenario comes from: its file, or its drawing where there is no file."""

from typing import NamedTuple

from parser.files import read_bytes
from parser.findings.errors import DrawingError
from parser.program import Program, load_program
from parser.text.encoding import printable
from parser.write.threeb import with_usual_codes
from sim.base.progress import Progress, silent
from sim.setup.making import ToMake
from sim.setup.scenario import Scenario


class Source(NamedTuple):
    """Bytes of a program, and whether they were made of a drawing, so that no file holds them yet."""

    data: bytes
    is_made: bool


def source_of(scenario: Scenario, progress: Progress = silent) -> Source:
    """The bytes of a scenario's program.

    Raises FileUnreadableError where file or drawing cannot be read, DrawingError where no program can be made of the
    drawing, SettingsError where it cannot be written as it is asked for.
    """
    if scenario.to_make is None or scenario.program.exists():
        return Source(read_bytes(scenario.program), is_made=False)
    return Source(_made_bytes(scenario, scenario.to_make, progress), is_made=True)


def _made_bytes(scenario: Scenario, to_make: ToMake, progress: Progress) -> bytes:
    from sim.make.cam.maker import NotMade  # noqa: PLC0415 - few programs are made, and what makes them takes long to load
    from sim.make.cam.request import program_of  # noqa: PLC0415 - as above
    from sim.show.refusals import why_refused  # noqa: PLC0415 - as above

    done = program_of(scenario, to_make, progress)
    if isinstance(done, NotMade):
        drawing = printable(str(scenario.drawing and scenario.drawing.file))
        raise DrawingError("no-program-of-drawing", drawing=drawing, why=why_refused(done.refusal))
    return done.data


def program_read(scenario: Scenario, source: Source) -> Program:
    """The program of its bytes, read by the words for end and pause that it is asked to have. ProgramError if none."""
    return load_program(_in_usual_words(scenario, source.data), printable(scenario.program.name), scenario.choices)


def _in_usual_words(scenario: Scenario, data: bytes) -> bytes:
    """With ``DD`` and ``D``, where ``[program]`` names words of its own."""
    if scenario.to_make is None:
        return data
    writing = scenario.to_make.writing
    codes = writing.end_code, writing.pause_code
    end, pause = (None if code is None else code.encode(writing.encoding, "replace") for code in codes)
    return with_usual_codes(data, end, pause) if end or pause else data
