"""Target `make`: programs made of drawings that nobody would draw."""

import random
from collections.abc import Iterator
from functools import cache
from pathlib import Path

from runs import plain_scenario

from fuzzing.dxf_text import fuzzed_dxf
from fuzzing.promises import unclean
from fuzzing.target import Input, Judged
from parser.findings.catalogue import LANGUAGES
from parser.findings.codes import Severity
from parser.findings.errors import DrycutError
from sim.check.file_check import Job, check_file
from sim.check.settings import CheckSettings
from sim.make.cam.maker import MadeProgram, NotMade, unproved
from sim.make.wanted import Wanted
from sim.setup.making import Making
from sim.setup.scenario import Scenario
from sim.show.refusals import why_refused
from sim.show.terminal.program import told_lines
from sim.show.texts import Words

_PASSES_UM: tuple[tuple[float, ...], ...] = ((), (0.0,), (180.0, 120.0, 100.0))
_TABS_UM = (0.0, 0.0, 0.0, 3000.0)
_COLUMNS = 80


def make(rng: random.Random) -> Input:
    """A drawing."""
    return fuzzed_dxf(rng)


def judge(data: Input, number: int, folder: Path) -> Judged:
    """A program that its own check calls sound is made, or lines say why there is none."""
    assert isinstance(data, bytes)
    file = folder / "fuzz.dxf"
    file.write_bytes(data)
    making = Making(passes_um=_PASSES_UM[number % len(_PASSES_UM)], tab_um=_TABS_UM[number % len(_TABS_UM)])
    wanted = Wanted("4b" if number % 5 == 0 else "3b")
    try:
        done = unproved(file, making, wanted, _scenario())
    except DrycutError as error:
        said = str(error).replace(str(folder), "HERE")
        return Judged(said, [] if said.strip() else ["refused without a word"], "not read")
    lines = _lines(done)
    broken = [what for line in lines for what in unclean(line)]
    if isinstance(done, NotMade):
        return Judged("\n".join(lines), broken, f"refused as {done.refusal.why}")
    return Judged("\n".join([*lines, done.data.decode()]), [*broken, *_of_made(done, wanted)], "made")


def _lines(done: MadeProgram | NotMade) -> list[str]:
    """What is said of it in every language."""
    if isinstance(done, NotMade):
        return [
            Words(language)("program.not-written", name="it", why=why_refused(done.refusal)) for language in LANGUAGES
        ]
    return [line for language in LANGUAGES for line in told_lines(done.plan, language, _COLUMNS)]


def _of_made(done: MadeProgram, wanted: Wanted) -> Iterator[str]:
    """The text is what was planned, and a check has nothing to say against it."""
    if done.written.differs:
        yield f"another path than was planned: {done.written.differs}"
    if done.written.off_um > wanted.bound_um:
        yield f"blocks {done.written.off_um} µm off the planned path"
    checked = check_file(Job(f"made.{wanted.language}", done.data, CheckSettings()))
    yield from (f"check: {finding.code}" for finding in checked.findings if finding.severity is Severity.ERROR)


@cache
def _scenario() -> Scenario:
    return plain_scenario()
