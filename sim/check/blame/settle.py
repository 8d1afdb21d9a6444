"""Which of the words that the checks suggest explains what is wrong, and what the findings say once it is known.

Cases: what may be wrong by one word, with the words that may be why, as the checks suggest them.

What the findings say when the words that explain them are known.

Trials: each word of a case is written into the program, and what is then left to find speaks against it.
"""

from bisect import bisect_right
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from enum import Enum
from itertools import islice
from typing import NamedTuple

from parser.dialect.mender import Mend, Mender
from parser.dialect.reader import at_block
from parser.findings.codes import Severity
from parser.findings.findings import DoubtfulEnd, Finding, PrintedElsewhere, WrongLabel, edited, file_order, telling
from parser.program import Program
from parser.shape.contours import Contour
from parser.text.source import Field
from sim.check.closures import OpenContour, Suspected, WrongAxis, suspect_finding
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


MOST_BLOCKS = 20_000
"""Blocks of a program that is checked again with other words; a longer one keeps all that its checks suspect."""

_ADVICE = (WrongLabel, WrongAxis, ReversedArc, Suspected)
"""Facts of findings that name a word to write."""


@dataclass(frozen=True, slots=True)
class WrongWord(DoubtfulEnd):
    """The printed end proves that one field of the block is written wrong; `mend` is what it would say."""

    mend: Mend


def settled(
    program: Program, findings: tuple[Finding, ...], judged: tuple[Contour, ...], again: Again
) -> tuple[Finding, ...]:
    """The findings, with the one word that explains each case where there is one, and without hints against it.

    A block whose printed end proves one word wrong gets finding 3B217 in place of its others. Of the suspects of a
    contour those stay with which least is left to find. A label that may be a slip of another one says so.
    """
    if program.mender is None or len(program.toolpath) > MOST_BLOCKS:
        return findings
    cases = cases_of(program, program.mender, findings, judged)
    if not cases:
        return findings
    found = list(findings)
    if all(_is_beyond_doubt(case, findings) for case in cases):
        verdicts = [Verdict(case, case.words, frozenset()) for case in cases]
    else:
        verdicts = tried(program, program.mender, findings, cases, again)
    for verdict in verdicts:
        match verdict.case.proof:
            case Proof.PRINT:
                found = list(_by_print(program, found, verdict))
            case Proof.CLOSURE:
                found = list(_by_closure(program, found, verdict))
            case Proof.LABEL:
                found = list(_by_label(found, verdict))
    return tuple(sorted(found, key=file_order))


def _is_beyond_doubt(case: Case, findings: tuple[Finding, ...]) -> bool:
    """Whether there is one word alone, and nothing else is found that it might explain: then no trial is needed."""
    if len(case.words) > 1:
        return False
    block = case.words[0].block
    if case.proof is Proof.PRINT:
        return not any(
            _is_side(finding, block) and not (isinstance(finding.fact, PrintedElsewhere) and finding.block == block)
            for finding in findings
        )
    return not any(
        finding.block == block
        and isinstance(finding.fact, _ADVICE)
        and not (isinstance(finding.fact, Suspected) and finding.fact.first == case.at)
        for finding in findings
    )


def _by_print(program: Program, findings: list[Finding], verdict: Verdict) -> Iterator[Finding]:
    """A wrong word in place of all that it explains; the open contour stays, which is what comes of it."""
    block = verdict.case.at
    suspected = [word for finding, fact in telling(findings, Suspected) for word in words_of(finding.block, fact)]
    word = _only_word(verdict.words, suspected)
    for finding in findings:
        is_explained = told_of(finding) in verdict.explains
        if word is None:
            is_named = finding.block == block and isinstance(finding.fact, _ADVICE)
            if not (is_named and is_explained):
                yield finding
        elif isinstance(finding.fact, PrintedElsewhere) and finding.block == block:
            yield _wrong_word(program, word, finding)
        elif not (is_explained and _is_side(finding, block)):
            yield finding


def _is_side(finding: Finding, block: int) -> bool:
    """Whether a finding is about the block alone, or about how an arc beside it meets it."""
    if finding.block == block:
        return not isinstance(finding.fact, OpenContour)
    return abs(finding.block - block) == 1 and isinstance(finding.fact, ReversedArc)


def _only_word(words: tuple[Word, ...], suspected: Iterable[Word]) -> Word | None:
    """The only word, or the only one with which the contour closes as well as the printed end asks for."""
    if len(words) > 1:
        words = tuple(word for word in suspected if word in words)
    return words[0] if len(words) == 1 else None


def _wrong_word(program: Program, word: Word, printed: Finding) -> Finding:
    row, field = word.block - 1, word.mend.field
    span = program.toolpath.source.field(row, field)
    values = {
        "field": field.term,
        "written": "".join(program.text[slice(*span)].split()) if span else "",
        "other": word.mend.text,
        **{name: printed.values[name] for name in ("px", "py", "off")},
    }
    return at_block(program.toolpath, program.lines, "3B217", row, field, **values).with_fact(WrongWord(word.mend))


def _by_closure(program: Program, findings: list[Finding], verdict: Verdict) -> Iterator[Finding]:
    """The suspects with which least is left; what they explain at their blocks is not told to be mended otherwise."""
    blocks = {word.block for word in verdict.words}
    labels = {word.block: word.mend.text for word in verdict.words if word.mend.field is Field.SENSE}
    mislabelled = {told_of(finding) for finding, _ in telling(findings, WrongLabel) if finding.block in labels}
    is_proved = len(verdict.words) == 1 and bool(mislabelled & verdict.explains)
    for finding in findings:
        fact = finding.fact
        if isinstance(fact, Suspected) and fact.first == verdict.case.at:
            suspects = tuple(suspect for suspect in fact.suspects if Word(finding.block, suspect.mend) in verdict.words)
            if suspects:
                suspected = suspect_finding(program, verdict.case.first, verdict.case.last, suspects)
                yield suspected.with_fact(Suspected(fact.first, suspects, is_proved))
        elif finding.block in blocks and isinstance(fact, _ADVICE) and told_of(finding) in verdict.explains:
            continue
        elif isinstance(fact, WrongLabel) and finding.block in labels:
            yield _or(finding, fact, labels[finding.block])
        else:
            yield finding


def _by_label(findings: list[Finding], verdict: Verdict) -> Iterator[Finding]:
    """The ruled label alone, or the sense alone; where others will do as well, the label with all of them."""
    block, kept_words = verdict.case.at, [word.mend.text for word in verdict.words]
    for finding in findings:
        fact = finding.fact
        if finding.block == block and isinstance(fact, WrongLabel):
            if fact.ruled in kept_words:
                yield _or(finding, fact, *kept_words)
        elif finding.block == block and isinstance(fact, ReversedArc) and told_of(finding) in verdict.explains:
            if fact.word in kept_words:
                yield finding
        else:
            yield finding


def _or(finding: Finding, fact: WrongLabel, *labels: str) -> Finding:
    """A wrong label that may be a slip of other ones than the rule names."""
    others = tuple(label for label in labels if label != fact.ruled)
    either = finding._replace(values={**finding.values, "others": " / ".join(others)})
    return either.with_fact(WrongLabel(fact.ruled, others))
