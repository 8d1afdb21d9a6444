"""Cases: what may be wrong by one word, with the words that may be why, as the checks suggest them."""

from bisect import bisect_right
from collections.abc import Iterator, Mapping
from enum import Enum
from itertools import islice
from typing import NamedTuple

from parser.dialect.mender import Mend, Mender
from parser.findings.findings import Finding, PrintedElsewhere, WrongLabel, telling
from parser.program import Program
from parser.shape.contours import Contour
from parser.text.source import Field
from sim.check.closures import OpenContour, Suspected
from sim.check.geometry import ReversedArc

MOST_PRINTED = 50
"""Printed ends that are looked at one by one; where more are wrong, it is not by slips in single blocks."""

MOST_LABELS = 100
"""Labels that are looked at; where more break the rule, the program was written by another one."""


class Proof(Enum):
    """What a case rests on: the printed end of a block, a contour's closure, or the label and joints of a block."""

    PRINT = "print"
    CLOSURE = "closure"
    LABEL = "label"


class Word(NamedTuple):
    """A block, and what one of its fields would say."""

    block: int
    mend: Mend


class Case(NamedTuple):
    """Something wrong in the blocks from `first` to `last`, which are judged, with the words that may be why.

    `at` is the block that is in doubt, or the first block of the contour.
    """

    proof: Proof
    at: int
    first: int
    last: int
    words: tuple[Word, ...]

    def holds(self, finding: Finding) -> bool:
        """Whether a finding is about these blocks."""
        return self.first <= finding.block <= self.last


def words_of(block: int, fact: Suspected) -> list[Word]:
    """The words with which a suspected block would close its contour."""
    return [Word(block, suspect.mend) for suspect in fact.suspects]


def cases_of(
    program: Program, mender: Mender, findings: tuple[Finding, ...], judged: tuple[Contour, ...]
) -> tuple[Case, ...]:
    """The cases of a program; no block is in doubt in two of them."""
    opened = {contour.first for _, contour in telling(findings, OpenContour)}
    spans = dict(_contours_of(findings, judged))
    in_open = {block for block, contour in spans.items() if contour.first in opened}
    printed = list(_printed(program, mender, findings, in_open))
    proved = {spans[case.at].first for case in printed if case.at in spans}
    closures = [case for case in _closures(findings, judged) if case.at not in proved]
    doubted = {case.at for case in closures}
    taken = {case.at for case in printed} | {block for block, contour in spans.items() if contour.first in doubted}
    labels = list(islice(_labels(program, mender, findings, taken, spans), MOST_LABELS + 1))
    return (*printed, *closures, *(labels if len(labels) <= MOST_LABELS else ()))


def _contours_of(findings: tuple[Finding, ...], judged: tuple[Contour, ...]) -> Iterator[tuple[int, Contour]]:
    """Blocks that findings are about, each with its contour."""
    firsts = [contour.first for contour in judged]
    for block in {finding.block for finding in findings}:
        at = bisect_right(firsts, block) - 1
        if at >= 0 and block <= judged[at].last:
            yield block, judged[at]


def _printed(program: Program, mender: Mender, findings: tuple[Finding, ...], in_open: set[int]) -> Iterator[Case]:
    """Blocks that end elsewhere than printed, where the next printed ends say so too, or a contour that stays open."""
    elsewhere = [finding.block for finding, _ in islice(telling(findings, PrintedElsewhere), MOST_PRINTED + 1)]
    if len(elsewhere) > MOST_PRINTED:
        return
    for block in elsewhere:
        misprint = mender.is_misprint(program.toolpath, block - 1)
        if misprint or (misprint is None and block not in in_open):
            continue
        words = tuple(Word(block, mend) for mend in mender.printed_mends(program.toolpath, block - 1))
        if words:
            yield Case(Proof.PRINT, block, block - 1, block + 1, words)


def _closures(findings: tuple[Finding, ...], judged: tuple[Contour, ...]) -> Iterator[Case]:
    """Contours that one word would close."""
    suspected: dict[int, list[Word]] = {}
    for finding, fact in telling(findings, Suspected):
        suspected.setdefault(fact.first, []).extend(words_of(finding.block, fact))
    for contour in judged:
        if contour.first in suspected:
            words = tuple(suspected[contour.first])
            yield Case(Proof.CLOSURE, contour.first, contour.first, contour.last, words)


def _labels(
    program: Program, mender: Mender, findings: tuple[Finding, ...], taken: set[int], spans: Mapping[int, Contour]
) -> Iterator[Case]:
    """Blocks with a label that does not fit their way, and arcs with a sense that does not fit their neighbours."""
    words: dict[int, list[str]] = {}
    for finding, fact in telling(findings, WrongLabel):
        slips = mender.label_slips(program.toolpath, finding.block - 1)
        words[finding.block] = [fact.ruled, *(slip.text for slip in slips)]
    for finding, reversed_arc in telling(findings, ReversedArc):
        words.setdefault(finding.block, []).append(reversed_arc.word)
    for block in sorted(words.keys() - taken):
        texts = tuple(dict.fromkeys(words[block]))
        if len(texts) > 1:
            within = spans.get(block)
            first, last = (within.first, within.last) if within else (block, block)
            yield Case(Proof.LABEL, block, first, last, tuple(Word(block, Mend(Field.SENSE, text)) for text in texts))
