"""Certain mends of findings, as edits of the program's text; and possible mends, for a person to choose from."""

from bisect import bisect_right
from collections import Counter
from itertools import islice
from typing import NamedTuple

from controller.stepping.steps import words_of
from parser.controller_words import Axis
from parser.dialect.mender import Mend, Mender
from parser.findings.findings import (
    CountedElsewhere,
    DoubtfulEnd,
    Edit,
    Finding,
    NoEnd,
    PrintedElsewhere,
    WrongLabel,
    telling,
)
from parser.program import Program
from parser.shape.contours import Contour
from parser.shape.loops import is_circle
from parser.text.encoding import written_end
from parser.text.source import LINE_END, Field
from sim.check.blame.settle import MOST_PRINTED, WrongWord
from sim.check.closures import OpenContour, Suspected, WrongAxis
from sim.check.path_checks import Checked


class Choice(NamedTuple):
    """A possible mend: the block, and what its fields would say, for people."""

    block: int
    text: str


def with_edits(program: Program, checked: Checked) -> tuple[Finding, ...]:
    """All findings of a program, each with the edits that certainly mend it; other findings may make them uncertain."""
    if program.mender is None:
        return checked.findings
    mends = _Mends(program, program.mender, checked)
    return tuple(finding._replace(edits=mends.of(finding)) for finding in checked.findings)


def choices(program: Program, finding: Finding, findings: tuple[Finding, ...]) -> tuple[Choice, ...]:
    """Possible mends of a finding, each enough alone; there is a choice only where there are two or more."""
    mender = program.mender
    if mender is None:
        return ()
    possible = _possible(program, mender, finding, findings)
    return tuple(Choice(block, mender.mends_text(mends)) for block, mends in possible)


def _possible(
    program: Program, mender: Mender, finding: Finding, findings: tuple[Finding, ...]
) -> list[tuple[int, tuple[Mend, ...]]]:
    """Blocks from 1, each with mends of its fields that together are enough."""
    block = finding.block
    match finding.fact:
        case PrintedElsewhere():
            if next(islice(telling(findings, PrintedElsewhere), MOST_PRINTED, None), None):
                return []
            return [(block, (mend,)) for mend in mender.printed_mends(program.toolpath, block - 1)]
        case WrongLabel(ruled, slips) if not finding.edits:
            here = [
                each_suspect
                for at, fact in telling(findings, Suspected)
                if at.block == block
                for each_suspect in fact.suspects
            ]
            others = [suspect.mend for suspect in here if suspect.field is Field.SENSE]
            others += [Mend(Field.SENSE, other) for other in slips]
            return [(block, (mend,)) for mend in dict.fromkeys((Mend(Field.SENSE, ruled), *others))]
        case WrongAxis(ruled, count_um) if not finding.edits:
            axis, count = mender.counted_on(ruled), mender.counting(count_um)
            is_other = count_um != words_of(program.toolpath).count_um[block - 1]
            return [(block, (axis,)), *([(block, (axis, count))] if is_other else [])]
        case OpenContour(first):
            suspected = telling(findings, Suspected)
            of = [(at.block, fact.suspects) for at, fact in suspected if fact.first == first]
            return [(at, (each_suspect.mend,)) for at, suspects in of for each_suspect in suspects]
    return []


class _Mends:
    """Certain mends of one program, by what its findings say: which ends are doubtful, and which blocks are suspected.

    Blocks are numbered from 1.
    """

    def __init__(self, program: Program, mender: Mender, checked: Checked) -> None:
        self._program, self._mender, self._toolpath = program, mender, program.toolpath
        self._words = words_of(program.toolpath)
        self._circle = is_circle(program.toolpath)
        self._judged = checked.judged
        # Contours do not overlap and come in order: one search finds the one that a block may be in.
        self._firsts = [contour.first for contour in checked.judged]
        found = checked.findings
        self._doubtful = {finding.block for finding, _ in telling(found, DoubtfulEnd)}
        self._open = {contour.first for _, contour in telling(found, OpenContour)}
        suspected = [
            (finding.block, fact.first, suspect)
            for finding, fact in telling(found, Suspected)
            for suspect in fact.suspects
        ]
        self._suspects = Counter(first for _, first, _ in suspected)
        self._other_sense = {block for block, _, each in suspected if each.field is Field.SENSE}
        self._other_word = {block for block, _, each in suspected if each.field is not Field.AXIS}

    def of(self, finding: Finding) -> tuple[Edit, ...]:
        """The edits that certainly mend a finding, all together."""
        edits: tuple[Edit, ...] = ()
        if finding.is_uncertain:
            return edits
        match finding.fact:
            case NoEnd():
                edits = self._end_code()
            case WrongLabel(ruled, ()):
                edits = self._label(finding.block, ruled)
            case WrongAxis() as wrong:
                edits = self._count_axis(finding.block, wrong)
            case WrongWord(mend):
                edits = (self._edit(finding.block, mend),)
            case CountedElsewhere():
                edits = self._swapped_axis(finding.block)
            case Suspected() as suspected:
                edits = self._suspect(finding.block, suspected)
        return edits

    def _end_code(self) -> tuple[Edit, ...]:
        """The end code on a line of its own behind all that is written, with the line end that the first line has.

        Nothing where something unreadable stands behind the last whole block: the program may go on there.
        """
        text, reading = self._program.text, self._program.reading
        if any(damage.after >= reading.counts.run for damage in reading.damages):
            return ()
        at = written_end(text)
        match = LINE_END.search(text)
        newline, end = match[0] if match else "\n", reading.spelling.end
        return (Edit(at, at, f"{end}{newline}" if text[:at].endswith(("\r", "\n")) else f"{newline}{end}"),)

    def _label(self, block: int, ruled: str) -> tuple[Edit, ...]:
        """The label that the rule names: the path stays the same. Nothing where that path is in doubt."""
        return (self._edit(block, Mend(Field.SENSE, ruled)),) if self._way_is_certain(block) else ()

    def _count_axis(self, block: int, wrong: WrongAxis) -> tuple[Edit, ...]:
        """The other axis, with the count that ends the block where it ends; nothing where that end is not proved."""
        if not self._end_is_proved(block):
            return ()
        mends = [self._mender.counted_on(wrong.ruled)]
        if wrong.count_um != self._words.count_um[block - 1]:
            mends.append(self._mender.counting(wrong.count_um))
        return tuple(self._edit(block, mend) for mend in mends)

    def _swapped_axis(self, block: int) -> tuple[Edit, ...]:
        """The other axis, where the count is the line's length on that one to the micrometre."""
        row, words = block - 1, self._words
        x, y, count = int(words.x_um[row]), int(words.y_um[row]), int(words.count_um[row])
        other = Axis.Y if words.count_axis[row] == Axis.X else Axis.X
        swapped = count == max(x, y) == (x if other == Axis.X else y) and block not in self._other_word
        return (self._edit(block, self._mender.counted_on(other)),) if swapped else ()

    def _suspect(self, block: int, suspected: Suspected) -> tuple[Edit, ...]:
        """The count axis of the only suspect of an open contour, or its label, which then also keeps the rule."""
        alone = self._suspects[suspected.first] == 1 and suspected.first in self._open
        if not alone or not (suspected.is_proved or suspected.suspects[0].field is Field.AXIS):
            return ()
        return (self._edit(block, suspected.suspects[0].mend),)

    def _edit(self, block: int, mend: Mend) -> Edit:
        return self._mender.edit(self._toolpath, block - 1, mend)

    def _end_is_proved(self, block: int) -> bool:
        """Whether a full turn, a closed contour or a printed end says that the block ends where it is read to end."""
        if block in self._doubtful:
            return False
        contour = self._contour(block)
        closed = contour is not None and contour.encloses and contour.returns
        return closed or bool(self._circle[block - 1]) or self._mender.ends_as_printed(self._toolpath, block - 1)

    def _way_is_certain(self, block: int) -> bool:
        """Whether nothing suggests that the block was to go another way than its label is read."""
        if block in self._doubtful or block in self._other_sense:
            return False
        contour = self._contour(block)
        return bool(self._toolpath.is_jump[block - 1]) or (contour is not None and not contour.is_open)

    def _contour(self, block: int) -> Contour | None:
        """The judged contour that the block is in."""
        at = bisect_right(self._firsts, block) - 1
        return self._judged[at] if at >= 0 and block <= self._judged[at].last else None
