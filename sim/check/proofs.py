"""What proves where a block ends, so that it may be written otherwise without moving that end."""

from bisect import bisect_right

from parser.dialect.mender import Mender
from parser.program import Program
from parser.shape.contours import Contour
from parser.shape.loops import is_circle
from sim.check.engine import Checked

_DOUBT = ("3B207", "3B208")


class Proofs:
    """What is known of the ends of a program's blocks, numbered from 1."""

    def __init__(self, program: Program, mender: Mender, checked: Checked) -> None:
        self._toolpath, self._mender = program.toolpath, mender
        self._circle = is_circle(program.toolpath)
        self._judged = checked.judged
        # Contours do not overlap and come in order: one search finds the one that a block may be in.
        self._firsts = [contour.first for contour in checked.judged]
        self._doubtful = {finding.block for finding in checked.findings if finding.code in _DOUBT}
        self._opens = {finding.values["first"] for finding in checked.findings if finding.code == "3B301"}
        self._suspected = {
            (finding.block, finding.values["field"]) for finding in checked.findings if finding.code == "3B304"
        }

    def is_open(self, block: int) -> bool:
        """Whether its contour is found open (3B301)."""
        contour = self._contour(block)
        return contour is not None and contour.first in self._opens

    def end_is_proved(self, block: int) -> bool:
        """Whether a full turn, a closed contour or a printed end says that the block ends where it is read to end."""
        if block in self._doubtful:
            return False
        contour = self._contour(block)
        closed = contour is not None and contour.encloses and contour.returns
        return closed or bool(self._circle[block - 1]) or self._mender.ends_as_printed(self._toolpath, block - 1)

    def label_is_certain(self, block: int) -> bool:
        """Whether nothing suggests that the block was to go another way than its label is read."""
        if block in self._doubtful or (block, "field-sense") in self._suspected:
            return False
        contour = self._contour(block)
        return bool(self._toolpath.is_jump[block - 1]) or (contour is not None and not contour.is_open)

    def _contour(self, block: int) -> Contour | None:
        """The judged contour that the block is in."""
        at = bisect_right(self._firsts, block) - 1
        return self._judged[at] if at >= 0 and block <= self._judged[at].last else None
