"""What a check of one program says: its findings, how far the check came, and what is programmed.

What a program says that is to be cut, before any offset: counts of its blocks, length, box, first and last place.

Fingerprints: by what a finding is known again when its program was changed elsewhere.
"""

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Literal, NamedTuple

import numpy as np

from parser.dialect.reader import Assumption
from parser.findings.catalogue import Language, term
from parser.findings.codes import Severity
from parser.findings.findings import Finding
from parser.geometry.curves import CurveKind, extents
from parser.text.encoding import narrow
from parser.toolpath import Point, Toolpath


class Programmed(NamedTuple):
    """What a program runs as it is written, in the order in which it runs: subprograms as often as they are called.

    Attributes
    ----------
    lines, arcs, rapids
        Blocks of each kind; a new place of the wire, threaded by hand, is no rapid.
    cut_length_um
        Length of lines and arcs, leads included, rapids not.
    box_um
        Lowest X and Y and highest X and Y of lines and arcs; None where nothing is cut.
    first_um, last_um
        Where the path begins and ends; None where there is none.
    """

    lines: int = 0
    arcs: int = 0
    rapids: int = 0
    cut_length_um: float = 0.0
    box_um: tuple[float, float, float, float] | None = None
    first_um: Point | None = None
    last_um: Point | None = None


def programmed_of(toolpath: Toolpath, threadings: int = 0) -> Programmed:
    """What a toolpath runs, of which some jumps are threadings."""
    if not len(toolpath):
        return Programmed()
    cut = ~toolpath.is_jump
    return Programmed(
        lines=int((toolpath.kind == CurveKind.LINE).sum()),
        arcs=int((toolpath.kind == CurveKind.ARC).sum()),
        rapids=int(toolpath.is_jump.sum()) - threadings,
        cut_length_um=float(toolpath.length_um[cut].sum()),
        box_um=_box(toolpath) if cut.any() else None,
        first_um=Point(*toolpath.start_um[0].tolist()),
        last_um=Point(*toolpath.end_um[-1].tolist()),
    )


def _box(toolpath: Toolpath) -> tuple[float, float, float, float]:
    low, high = extents(toolpath.picked(~toolpath.is_jump))
    x0, y0, x1, y1 = np.concatenate([low.min(axis=0), high.max(axis=0)]).tolist()
    return x0, y0, x1, y1


Verdict = Literal["pass", "fail", "incomplete"]
Outcome = Literal["pass", "to-check", "fail", "incomplete"]
"""A verdict as people are told it: a file that passes is to be checked by one where a finding may spoil the part."""
FailOn = Literal["error", "incomplete", "warning"]
"""The mildest that fails a file: errors; also checks that did not come to their end; also warnings."""
State = Literal["complete", "incomplete", "known", "not asked"]


class CheckState(NamedTuple):
    """How far one check came.

    Attributes
    ----------
    name
        Name of the check, a term of the catalogue: ``check-crossings``.
    state
        ``not asked`` where a setting that it needs was not given; ``incomplete`` where it could not look at everything;
        ``known`` where it could not, and the baseline has that.
    reason
        Term of the catalogue that says why it is not complete; empty where it is.
    words
        Words of the program that the reason is about, where it is about words.
    """

    name: str
    state: State = "complete"
    reason: str = ""
    words: tuple[str, ...] = ()

    def because(self, language: Language) -> str:
        """Its reason for people, with the words that it is about; empty where it is complete."""
        reason = term(self.reason, language) if self.reason else ""
        words = ", ".join(self.words)
        return term("reason-by-words", language).format(reason=reason, words=words) if words else reason


class Coverage(NamedTuple):
    """How much of a program was looked at.

    Attributes
    ----------
    found, read, decoded, stepped
        Blocks that stand in the file, damaged ones included; that could be read; that have an exact geometry; whose
        steps were worked out. Start nodes are none of them, though findings number them as rows of the path.
    checks
        Every check there is, with its state.
    """

    found: int
    read: int
    decoded: int
    stepped: int
    checks: tuple[CheckState, ...]

    @property
    def is_complete(self) -> bool:
        """Whether every check that was asked for came to its end."""
        return all(check.state in ("complete", "not asked") for check in self.checks)

    @property
    def is_as_known(self) -> bool:
        """Whether every check that was asked for came to its end, but for those that the baseline has."""
        return all(check.state != "incomplete" for check in self.checks)


class Silenced(NamedTuple):
    """How many findings of a file are not shown, by what silences them; and the checks that count as known.

    Attributes
    ----------
    options, settings
        Those that options of the command line, or keys of the settings file, do not select or ignore.
    remarks
        Those that a remark in the program silences.
    baseline
        Those that the baseline has.
    checks
        Checks that did not come to their end, as the baseline has it.
    """

    options: int = 0
    settings: int = 0
    remarks: int = 0
    baseline: int = 0
    checks: int = 0

    @property
    def findings(self) -> int:
        """How many findings are not shown."""
        return self.options + self.settings + self.remarks + self.baseline


@dataclass(frozen=True, slots=True)
class CheckResult:
    """What was found in one file.

    Attributes
    ----------
    name
        File as the user named it; ``<stdin>`` for the standard input.
    encoding, dialect
        Of the file; empty where it could not be read. The dialect is named as its reader names it, such as ``3B+4B``
        or ``fast-wire``.
    assumptions
        What its text leaves open, and was taken.
    programmed
        What it says that is to be cut; None where no path was worked out.
    findings
        In file order, those that were selected.
    excerpts
        Source lines that findings point at, by their number from 1.
    coverage
        How far the check came.
    length_um, steps
        Length of the exact path, jumps included, and its steps of 1 µm.
    fail_on
        The mildest that fails the file.
    unreadable
        Whether there was no program to check.
    settings_file
        Settings file that counts for it, as it is named to people; empty where there is none.
    silenced
        Findings that are not shown.
    fault
        Traceback of a fault of drycut itself, because of which nothing is said of the file; empty where there was none.
    blocks
        Texts of the blocks that findings are in, as written and without labels, by their number from 1.
    """

    name: str
    encoding: str
    dialect: str
    findings: tuple[Finding, ...]
    excerpts: Mapping[int, str]
    coverage: Coverage
    length_um: float
    steps: int
    fail_on: FailOn = "incomplete"
    unreadable: bool = False
    settings_file: str = ""
    silenced: Silenced = Silenced()  # noqa: RUF009 - frozen
    fault: str = ""
    blocks: Mapping[int, str] = field(default_factory=dict)
    assumptions: tuple[Assumption, ...] = ()
    programmed: Programmed | None = None

    def count(self, severity: Severity) -> int:
        """How many findings are of a severity."""
        return sum(finding.severity is severity for finding in self.findings)

    def fails(self, severity: Severity) -> bool:
        """Whether a finding of this severity fails the file."""
        return severity is Severity.ERROR or (severity is Severity.WARNING and self.fail_on == "warning")

    @property
    def failed(self) -> bool:
        """Whether the file is not good enough: a finding fails it, or that a check did not come to its end."""
        return self.verdict == "fail" or (self.verdict == "incomplete" and self.fail_on != "error")

    @property
    def verdict(self) -> Verdict:
        """``fail`` where a finding fails it; ``incomplete`` where a check did not end that is to, or else ``pass``."""
        if any(self.fails(finding.severity) for finding in self.findings):
            return "fail"
        return "pass" if self.coverage.is_as_known else "incomplete"

    @property
    def to_check(self) -> bool:
        """Whether it passes, and someone has to look at a finding before the cut."""
        return self.verdict == "pass" and any(finding.spoils for finding in self.findings)

    @property
    def outcome(self) -> Outcome:
        """Its verdict as people are told it."""
        return "to-check" if self.to_check else self.verdict


_NEAR = 40
"""Characters of a line that count on either side of what is meant: a whole program may stand in one line."""


def fingerprints(result: CheckResult) -> tuple[str, ...]:
    """Fingerprint of each finding of a file, in their order: 32 hexadecimal digits, no two alike.

    It is of the code, of the text that is meant, and of how many alike stand before it. Neither lines that come or go
    elsewhere change it, nor labels that count them, nor blanks and the case of letters. The name of the file is no
    part of it: what joins the findings of several files has to add that.
    """
    seen: Counter[str] = Counter()
    return tuple(_fingerprint(finding, _meant(result, finding), seen) for finding in result.findings)


def _fingerprint(finding: Finding, meant: str, seen: Counter[str]) -> str:
    key = f"{finding.code}\n{meant}"
    seen[key] += 1
    return _digest(f"{key}\n{seen[key]}")


def gap_marks(check: CheckState) -> tuple[str, ...]:
    """Fingerprints of why a check did not come to its end: one for each word that its reason is about, or one."""
    return tuple(_digest(f"{check.name}\n{check.reason}\n{word}") for word in check.words or ("",))


def _digest(text: str) -> str:
    import hashlib  # noqa: PLC0415 - a sound program needs none, and starts sooner

    return hashlib.sha256(text.encode(errors="replace")).hexdigest()[:32]


def _meant(result: CheckResult, finding: Finding) -> str:
    """Text of the block that a finding is in, without its label; where it is in none, of its line."""
    text = result.blocks.get(finding.block)
    if text is None:
        first = max(0, finding.column - 1)
        past = first + finding.span[1] - finding.span[0]
        text = result.excerpts.get(finding.line, "")[max(0, first - _NEAR) : past + _NEAR]
    return "".join(narrow(text).split()).upper()
