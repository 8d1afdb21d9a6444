"""The shop's own cuts: rows ``program,length_mm,height_mm,passes,minutes`` of a CSV file, and what they say.

A row has a program or a length. Rows without minutes are not cut yet. A program is looked for beside the log.
"""

import math
from dataclasses import replace
from pathlib import Path
from typing import Final, NamedTuple

import numpy as np

from parser.files import read_bytes
from parser.findings.errors import Message, ProgramError, SettingsError
from parser.geometry.curves import Floats
from parser.program import load_program
from parser.text.encoding import printable
from sim.measure.factor import PRIOR_SD
from sim.run.times.predicted import predicted, predicted_way
from sim.setup.part import THICKNESS_MM
from sim.setup.rows import Row, read_rows
from sim.setup.scenario import Scenario
from sim.setup.shop import Shop
from sim.setup.toml.reader import Bound

COLUMNS: Final = ("program", "length_mm", "height_mm", "passes", "minutes")
_LENGTH: Final = Bound(1e-3, 1e9)
_PASSES: Final = Bound(1.0, 100.0)
_MINUTES: Final = Bound(1e-3, 1e7)
_UNLIKE_PASSES_SD: Final = 0.3
"""Seven passes took 5.5 times as long as one where a public rule says 4.0: ln 5.5/4.0 (additive.tools' calculator)."""
_FAR: Final = 5.0  # times the usual distance from the median: a row so far off is looked at


class Cut(NamedTuple):
    """One logged cut: its row, height and passes, and what it took over what was predicted."""

    line: int
    height_mm: float
    passes: int
    ratio: float


class Log(NamedTuple):
    """A shop's cuts, and how many rows of its file are not cut yet."""

    file: str = ""
    cuts: tuple[Cut, ...] = ()
    not_cut: int = 0

    @property
    def log_ratios(self) -> Floats:
        """(n,) logarithms of measured over predicted times."""
        return np.log(np.array([cut.ratio for cut in self.cuts], dtype=np.float64))

    @property
    def heights_mm(self) -> tuple[float, float]:
        """The least and the greatest height of work that was cut."""
        heights = [cut.height_mm for cut in self.cuts]
        return min(heights), max(heights)

    @property
    def odd(self) -> tuple[Cut, ...]:
        """Cuts that lie far off the others: a slip of the pen, maybe."""
        if len(self.cuts) < 4:
            return ()
        off = np.abs(self.log_ratios - np.median(self.log_ratios))
        usual = max(1.4826 * float(np.median(off)), 0.02)
        return tuple(cut for cut, far in zip(self.cuts, (off > _FAR * usual).tolist(), strict=True) if far)

    def unlike_sd(self, height_mm: float, passes: int) -> float:
        """What is added to the spread of a cut, as its logarithm, for what no logged one was like.

        A constant rate was 46 % off where a table was extrapolated to half its least height: the prior's standard
        deviation for each factor of two beyond the heights of the log.
        """
        if not self.cuts:
            return 0.0
        least, most = self.heights_mm
        beyond = max(math.log2(least / height_mm), math.log2(height_mm / most), 0.0)
        unlike = _UNLIKE_PASSES_SD if passes not in {cut.passes for cut in self.cuts} else 0.0
        return math.hypot(PRIOR_SD * beyond, unlike)


def read_log(path: Path, usual: Scenario, shop: Shop) -> Log:
    """A log, its times held against those predicted on a scenario's machine, in its work where a row has no height.

    Raises FileUnreadableError, and SettingsError with file, line and column.
    """
    cuts, not_cut = list[Cut](), 0
    for row in read_rows(path, COLUMNS, ("minutes",)):
        minutes = row.number("minutes", _MINUTES)
        if minutes is None:
            not_cut += 1
            continue
        height_mm = row.number("height_mm", THICKNESS_MM)
        scenario = usual if height_mm is None else replace(usual, thickness_mm=height_mm)
        predicted_min, passes = _predicted(row, path.parent, scenario, shop)
        cuts.append(Cut(row.line, scenario.thickness_mm, passes, minutes / predicted_min))
    return Log(printable(str(path)), tuple(cuts), not_cut)


def _predicted(row: Row, folder: Path, scenario: Scenario, shop: Shop) -> tuple[float, int]:
    """Minutes that are predicted of the program of a row, else of its length, and the passes; SettingsError for none.

    A program of the contour alone is run once for each pass of the row.
    """
    passes = row.number("passes", _PASSES)
    if passes is not None and not passes.is_integer():
        raise row.refused("passes", "1, 2, 3, …")
    name, length_mm = row.text("program"), row.number("length_mm", _LENGTH)
    file = folder / name
    if name and (length_mm is None or file.exists()):
        if not file.exists():
            raise row.refused("program", Message("log-program-expected"))
        try:
            program = load_program(read_bytes(file), printable(file.name), scenario.choices)
            found = predicted(program, replace(scenario, offset=None), shop)
        except ProgramError:
            raise SettingsError("log-program-faulty", file=row.file, line=row.line, program=printable(name)) from None
        times = int(passes or 1) if found.passes == 1 else 1
        return times * found.minutes, int(passes or found.passes)
    if length_mm is None:
        raise SettingsError("log-without-way", file=row.file, line=row.line)
    return predicted_way(length_mm, int(passes or 1), scenario), int(passes or 1)
