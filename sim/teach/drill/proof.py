"""What a fault does to the path, and what gives it away."""

from typing import Final, Literal, NamedTuple, get_args

import numpy as np

from parser.findings.codes import CODES, Check, Severity
from parser.findings.findings import Finding
from parser.geometry.along import places
from parser.geometry.curves import Floats, Ints
from parser.geometry.distance import distance_to_curves
from parser.program import Program
from parser.shape.closing import CLOSED_WITHIN_UM
from parser.toolpath import Toolpath

Level = Literal["words", "picture", "sums"]
"""What gives a fault away: the words of its block by themselves, the picture of the path, or sums alone."""
LEVELS: Final[tuple[Level, ...]] = get_args(Level)
SEEN_FROM: Final = 0.02
"""Share of the part's extent from which on people see in a picture that the path leaves it (assumed)."""
_OF_WORDS: Final = (Check.GRAMMAR, Check.ORDER, Check.BLOCKS)
_FRACTIONS: Final = np.linspace(0.0, 1.0, 17)


class Departure(NamedTuple):
    """How a path differs from the one without the fault.

    Attributes
    ----------
    most_um
        The furthest that a place of it lies from where it should.
    is_cut_otherwise
        Whether it cuts what was a jump, or jumps what was cut.
    """

    most_um: float
    is_cut_otherwise: bool

    @property
    def is_there(self) -> bool:
        """Whether it is more than a path may lie open."""
        return self.is_cut_otherwise or self.most_um > CLOSED_WITHIN_UM


def departure(sound: Toolpath, damaged: Toolpath) -> Departure:
    """How a damaged path differs from the sound one, at 17 places a block.

    Paths of as many blocks are held against each other block by block, others cut by cut, whichever is nearest.
    """
    if len(sound) == len(damaged):
        rows = np.arange(len(sound))
        off = _places(sound, rows) - _places(damaged, rows)
        return Departure(float(np.hypot(*off.T).max()), bool((sound.is_jump != damaged.is_jump).any()))
    most = max(_furthest(sound, damaged), _furthest(damaged, sound))
    return Departure(most, is_cut_otherwise=False)


def level_of(sound: Program, damaged: Program, lines: frozenset[int]) -> Level | None:
    """What gives a fault in these lines away; None where it does nothing."""
    told = {_said(sound, found) for found in sound.findings}
    new = [found for found in damaged.findings if _is_of_words(found) and _said(damaged, found) not in told]
    at_place = [found for found in new if found.line in lines]
    if any(map(_stops_it, at_place)):
        return "words"
    by = departure(sound.toolpath, damaged.toolpath)
    if not by.is_there:
        return None
    if at_place:
        return "words"
    extent = float(np.ptp(np.concatenate([sound.toolpath.start_um, sound.toolpath.end_um]), axis=0).max())
    return "picture" if by.is_cut_otherwise or by.most_um >= SEEN_FROM * extent else "sums"


def _stops_it(found: Finding) -> bool:
    """Whether the machine cannot go on here, or not as the program says, wherever the path leads."""
    return found.severity is Severity.ERROR or CODES[found.code].check is Check.ORDER


def _said(program: Program, found: Finding) -> tuple[str, str]:
    """A finding by its code and the text of its line, whatever the line's number."""
    return found.code, program.excerpt(found.line) if found.line else ""


def _is_of_words(found: Finding) -> bool:
    return CODES[found.code].check in _OF_WORDS


def _places(path: Toolpath, rows: Ints) -> Floats:
    """Places (n × 17, 2) along the blocks of the rows (n,), µm."""
    return places(path, np.repeat(rows, len(_FRACTIONS)), np.tile(_FRACTIONS, len(rows)))


def _furthest(path: Toolpath, other: Toolpath) -> float:
    """The furthest that the cuts of a path go from those of the other, µm; infinite where one of them cuts nothing."""
    cuts, others = np.flatnonzero(~path.is_jump), np.flatnonzero(~other.is_jump)
    if not len(cuts) or not len(others):
        return np.inf
    at = _places(path, cuts)
    nearest = np.full(len(at), np.inf)
    for row in others.tolist():  # at most as many as a drill may have blocks
        nearest = np.minimum(nearest, distance_to_curves(other, np.full(len(at), row), at[:, 0], at[:, 1])[0])
    return float(nearest.max())
