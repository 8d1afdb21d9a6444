"""Trials: each word of a case is written into the program, and what is then left to find speaks against it."""

from collections import Counter
from collections.abc import Callable, Sequence
from typing import NamedTuple

from parser.dialect.mender import Mender
from parser.findings.codes import Severity
from parser.findings.facts import telling
from parser.findings.findings import Finding, edited
from parser.program import Program
from sim.check.blame.cases import Case, Word
from sim.check.closures import Suspected

Again = Callable[[str], tuple[Finding, ...]]
"""Findings of a text, checked as the program was."""
Told = tuple[str, int]
"""A code and a block."""


class Verdict(NamedTuple):
    """The words of a case with which least is left to find, and what goes away with any of them."""

    case: Case
    words: tuple[Word, ...]
    explains: frozenset[Told]


def tried(
    program: Program, mender: Mender, findings: tuple[Finding, ...], cases: Sequence[Case], again: Again
) -> list[Verdict]:
    """A verdict for each case. In each trial one word of every case is written, so that there are as few as can be."""
    left: list[list[Counter[Told]]] = [[] for _ in cases]
    for trial in range(max(len(case.words) for case in cases)):
        written = [case.words[trial if trial < len(case.words) else 0] for case in cases]
        edits = [mender.edit(program.toolpath, word.block - 1, word.mend) for word in written]
        found = again(edited(program.text, edits))
        for case, of in zip(cases, left, strict=True):
            if trial < len(case.words):
                of.append(_about(case, found))
    return [_verdict(case, _about(case, findings), of) for case, of in zip(cases, left, strict=True)]


def told_of(finding: Finding) -> Told:
    """What a finding says, and of which block: by this it is known again in another trial."""
    return finding.code, finding.block


def _verdict(case: Case, before: Counter[Told], left: list[Counter[Told]]) -> Verdict:
    weight = [of.total() for of in left]
    best = [at for at, n in enumerate(weight) if n == min(weight)]
    explained = set(before).difference(*(left[at] for at in best))
    return Verdict(case, tuple(case.words[at] for at in best), frozenset(explained))


def _about(case: Case, findings: tuple[Finding, ...]) -> Counter[Told]:
    """Errors, warnings and suspects in the blocks of a case."""
    suspects = {id(finding) for finding, _ in telling(findings, Suspected)}
    return Counter(
        told_of(finding)
        for finding in findings
        if case.holds(finding) and (finding.severity is not Severity.NOTE or id(finding) in suspects)
    )
