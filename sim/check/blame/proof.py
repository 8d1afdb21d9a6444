"""Advice by proof: a word is named where writing it leaves nothing to find, and no word where none does."""

import math
from collections.abc import Iterator
from typing import NamedTuple

from controller.stepping.steps import words_of
from parser.dialect.mender import Mend, Mender
from parser.dialect.reader import at_block
from parser.findings.errors import ProgramError
from parser.findings.findings import (
    CountedElsewhere,
    Finding,
    OddOrder,
    OddShape,
    Value,
    WrongBlock,
    WrongLabel,
    edited,
    file_order,
)
from parser.geometry.along import directions
from parser.geometry.curves import Curves
from parser.program import Program
from parser.shape.contours import CLOSED_WITHIN_UM, Contour
from parser.text.source import Field
from sim.check.blame.settle import Again, WrongWord
from sim.check.closures import OpenContour, Suspected, WrongAxis, suspect_finding
from sim.check.geometry import ReversedArc

MOST_TRIALS = 24
MOST_BLOCKS = 4_000
"""Blocks of all trials for one contour together: a trial of 100 blocks takes some 5 ms."""
_MOST_NAMED = 3
_JOINT_RAD = math.radians(0.2)  # besides what whole µm leave open of the angles of two blocks
_MOST_CONTOURS = 4
_OF_A_WORD = (OpenContour, ReversedArc, WrongAxis, WrongBlock, OddShape)
"""Facts of findings that one wrong word may be why."""


class Change(NamedTuple):
    """A block, from 1, and what its fields would say."""

    block: int
    mends: tuple[Mend, ...]

    @property
    def is_number(self) -> bool:
        """Whether it is one field, a number."""
        return len(self.mends) == 1 and self.mends[0].field not in {Field.AXIS, Field.SENSE}


def proved(
    program: Program, findings: tuple[Finding, ...], judged: tuple[Contour, ...], again: Again
) -> tuple[Finding, ...]:
    """The findings, with the words that trials in their contours prove, and with no advice that none proves.

    Every slip of one word is tried, by which a contour ends where it was to end, and every word that a finding advises:
    written, it must leave nothing to find in the contour, and no more in the others. Where a printed end names the word
    of a contour, that is enough, and nothing is tried; nor where more than `_MOST_CONTOURS` ask for it.
    """
    mender, rows = program.mender, len(program.toolpath)
    most = min(MOST_TRIALS, MOST_BLOCKS // max(rows, 1))
    asking = [contour for contour in judged if _asks(findings, contour)]
    if mender is None or not most or len(asking) > _MOST_CONTOURS:
        return findings
    checked = findings
    for contour in asking:
        elsewhere = sum(not contour.first <= finding.block <= contour.last for finding in checked)
        findings = tuple(_judged(_Trials(program, mender, contour, findings, again, most, elsewhere)))
    return tuple(sorted(findings, key=file_order))


def _asks(findings: tuple[Finding, ...], contour: Contour) -> bool:
    """Whether a wrong word may be why something is wrong in a contour, and no printed end names it."""
    facts = [finding.fact for finding in findings if contour.first <= finding.block <= contour.last]
    otherwise = any(isinstance(fact, (WrongWord, OddOrder)) for fact in facts)
    return not otherwise and any(isinstance(fact, _OF_A_WORD) for fact in facts)


class _Trials:
    """What is found in a contour, and what is left of it when words are written otherwise."""

    def __init__(  # noqa: PLR0913, PLR0917 - all that a trial needs, handed on once
        self,
        program: Program,
        mender: Mender,
        contour: Contour,
        findings: tuple[Finding, ...],
        again: Again,
        most: int,
        elsewhere: int,
    ) -> None:
        self.program, self.mender, self.contour, self.findings, self.most = program, mender, contour, findings, most
        self._again, self._elsewhere = again, elsewhere
        inside = [finding for finding in findings if self.holds(finding)]
        self.loose = {id(finding) for finding in inside if self._is_loose(finding)}
        self.advised = {id(each): _advised(program, each) for each in inside if id(each) not in self.loose}

    def holds(self, finding: Finding) -> bool:
        """Whether a finding is about the contour."""
        return self.contour.first <= finding.block <= self.contour.last

    def _is_loose(self, finding: Finding) -> bool:
        """Whether a block counts on the wrong axis, and X or Y may as well be wrong.

        A digit too many in X makes Y the shorter side of a line as well; where the contour ends elsewhere than it
        began, nothing tells where the line was to end. So it is with an arc that begins at an odd angle.
        """
        if not isinstance(finding.fact, WrongAxis) or finding.block < 1:
            return False
        if self.program.toolpath.is_arc[finding.block - 1]:
            return self._begins_oddly(finding.block - 1)
        return self.contour.closure_exact_um > CLOSED_WITHIN_UM

    def _begins_oddly(self, row: int) -> bool:
        """Whether an arc goes on from the block before it neither smoothly nor at a right angle."""
        if row < self.contour.first:
            return False
        both = self.program.toolpath.picked(slice(row - 1, row + 1))
        way = directions(both)
        (ax, ay), (bx, by) = way.arriving[0].tolist(), way.leaving[1].tolist()
        angle = abs(math.atan2(ax * by - ay * bx, ax * bx + ay * by))
        slack = _JOINT_RAD + sum(1.0 / max(size, 1.0) for size in (both.radius_um[1], _size_um(both)))
        return min(angle, abs(angle - 0.5 * math.pi)) > slack

    @property
    def may_be_turned(self) -> bool:
        """Whether an arc may run the other way round."""
        return any(self.holds(finding) and isinstance(finding.fact, ReversedArc) for finding in self.findings)

    @property
    def wrong_axes(self) -> int:
        """How many blocks count on the wrong axis."""
        return sum(self.holds(finding) and isinstance(finding.fact, WrongAxis) for finding in self.findings)

    def is_silent(self, *changes: Change) -> bool:
        """Whether nothing is left to find in the contour with some changes, and no more in the others.

        A change may make a word of what was the only block: such a text is no program, and proves nothing.
        """
        toolpath = self.program.toolpath
        edits = [self.mender.edit(toolpath, change.block - 1, mend) for change in changes for mend in change.mends]
        try:
            found = self._again(edited(self.program.text, edits))
        except ProgramError:
            return False
        return not any(self.holds(finding) for finding in found) and len(found) <= self._elsewhere

    def proved(self) -> list[Change]:
        """The changes that leave nothing, likeliest first: those that end the contour where it began, if there are any.

        Else what findings advise, with the other labels of an arc that may run the other way round: nothing tells
        these apart then.
        """
        rows = self.contour.first - 1, self.contour.last
        slips = self.mender.one_slips(self.program.toolpath, *rows, self.most)
        advised = [change for of in self.advised.values() for change in of]
        fields = {(change.block, *(mend.field for mend in change.mends)): change for change in advised}
        # Of numbers that close a contour as well, the advised one was found by its joints too.
        changes = [Change(slip.row + 1, (slip.mend,)) for slip in slips]
        numbers = {
            each_change: fields.get((each_change.block, each_change.mends[0].field), each_change)
            for each_change in changes
            if each_change.is_number
        }
        silent = self._silent([numbers.get(change, change) for change in changes])
        if not silent:
            silent = self._silent([*advised, *self._other_labels()])
        elif any(change in advised for change in silent):
            silent = [change for change in silent if change in advised]
        return silent if len(silent) <= _MOST_NAMED else []

    def _silent(self, changes: list[Change]) -> list[Change]:
        return [change for change in list(dict.fromkeys(changes))[: self.most] if self.is_silent(change)]

    def _other_labels(self) -> Iterator[Change]:
        """The other labels of arcs that may run the other way round: that is not the only slip there is."""
        for finding in self.findings:
            if self.holds(finding) and isinstance(finding.fact, ReversedArc):
                for mend in self.mender.other_labels(self.program.toolpath, finding.block - 1):
                    yield Change(finding.block, (mend,))


def _size_um(both: Curves) -> float:
    """The radius of the first of two blocks, the length of a line: whole µm turn it by 1 µm in so many."""
    return float(both.radius_um[0] if both.is_arc[0] else both.length_um[0])


def _advised(program: Program, finding: Finding) -> tuple[Change, ...]:
    """The changes that a finding advises, each enough alone."""
    block = finding.block
    match finding.fact:
        case Suspected() as suspected:
            return tuple(Change(block, (suspect.mend,)) for suspect in suspected.suspects)
        case ReversedArc(word):
            return (Change(block, (Mend(Field.SENSE, word),)),)
        case WrongLabel(ruled):
            return (Change(block, (Mend(Field.SENSE, ruled),)),)
        case WrongAxis(ruled, count_um) if program.mender is not None:
            axis, count = program.mender.counted_on(ruled), program.mender.counting(count_um)
            is_other = count_um != words_of(program.toolpath).count_um[block - 1]
            return (Change(block, (axis, count) if is_other else (axis,)),)
    return ()


def _judged(trials: _Trials) -> Iterator[Finding]:
    """The findings of a program as the trials in one contour leave them.

    Where the advice of all findings together leaves nothing, it stands, if it has no other word for the same.
    """
    advice = [changes for changes in trials.advised.values() if changes]
    is_one_each = all(len(changes) == 1 for changes in advice) and not (trials.may_be_turned or trials.loose)
    if advice and is_one_each and trials.is_silent(*dict.fromkeys(changes[0] for changes in advice)):
        yield from trials.findings
        return
    named = trials.proved()
    covered: set[Change] = set()
    for finding in trials.findings:
        advised = trials.advised.get(id(finding), ())
        confirmed = tuple(change for change in advised if change in named)
        covered.update(confirmed)
        if isinstance(finding.fact, Suspected) and advised and named:
            yield from _suspected(trials, finding, finding.fact, confirmed)
        elif _is_doubted(trials, finding, named) or (advised and not confirmed and not _stays(trials, finding, named)):
            yield finding._replace(is_uncertain=True)
        else:
            yield finding
    by_block: dict[int, list[Change]] = {}
    for change in named:
        if change not in covered:
            by_block.setdefault(change.block, []).append(change)
    for block, changes in by_block.items():
        yield _only(trials, block, changes)


def _is_doubted(trials: _Trials, finding: Finding, named: list[Change]) -> bool:
    """Whether nothing proves what a finding asks for: of a loose line; of a count, where another word is named."""
    others = any(change.block == finding.block and change.mends[0].field is not Field.AXIS for change in named)
    return id(finding) in trials.loose or (others and isinstance(finding.fact, CountedElsewhere))


def _stays(trials: _Trials, finding: Finding, named: list[Change]) -> bool:
    """Whether the advice of a finding stands, whatever is left: it is the trade's rule, and no trial speaks against it.

    A label keeps the path, and is doubted at a block with a word that is named alone. The count axis hangs on the words
    of its block: where no word is named, several wrong axes are a habit of whoever wrote the program.
    """
    if isinstance(finding.fact, WrongLabel):
        return not any(change.block == finding.block for change in named)
    return isinstance(finding.fact, WrongAxis) and not named and trials.wrong_axes > 1


def _suspected(trials: _Trials, finding: Finding, fact: Suspected, confirmed: tuple[Change, ...]) -> Iterator[Finding]:
    """The suspects that are proved; none where others are."""
    suspects = tuple(suspect for suspect in fact.suspects if Change(finding.block, (suspect.mend,)) in confirmed)
    if suspects == fact.suspects:
        yield finding
    elif suspects:
        found = suspect_finding(trials.program, trials.contour.first, trials.contour.last, suspects)
        yield found.with_fact(Suspected(fact.first, suspects, fact.is_proved))


def _only(trials: _Trials, block: int, changes: list[Change]) -> Finding:
    """Finding 3B322 at a block: the words of it with which nothing is left to find."""
    toolpath, row, field = trials.program.toolpath, block - 1, changes[0].mends[0].field
    span = toolpath.source.field(row, field)
    written = "".join(trials.program.text[slice(*span)].split()) if span else ""
    others = " / ".join(trials.mender.mends_text(change.mends) for change in changes[1:])
    values: dict[str, Value] = {"first": trials.contour.first, "last": trials.contour.last, "written": written}
    values |= {"field": field.term, "other": changes[0].mends[0].text, "others": others}
    return at_block(toolpath, trials.program.lines, "3B322", row, field, **values)
