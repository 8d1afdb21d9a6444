"""What keeps a finding from being shown: settings, remarks in the program, a baseline; all of it is counted.

Directives: remarks in a program that silence codes, ``// drycut: ignore 3B204`` (docs/check.md).

Where remarks stand, the reader of the dialect knows; what they say to drycut stands here.

Findings sifted: those that are shown, and how many are not, by what silences them.

Baselines: what is known of files, findings and checks that do not end, in a file, so that only what is new fails.
"""

import json
import os
import re
import unicodedata
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import NamedTuple

import numpy as np

from parser.files import read_text
from parser.findings.codes import CODES
from parser.findings.errors import SettingsError
from parser.findings.findings import Finding, file_order
from parser.program import Program
from parser.text.source import Span
from sim.check.own_checks import load_own_checks
from sim.check.result import CheckResult, CheckState, Silenced, fingerprints, gap_marks
from sim.check.settings import CheckSettings

_WHOLE_FILE = 0
"""In place of a line; a finding that means the whole program has no line either."""
_NO_LINE = -1
_NAMED = re.compile(r"drycut[ \t]*:", re.IGNORECASE)
_BEGIN = re.compile(rf"\W*+{_NAMED.pattern}[ \t]*", re.IGNORECASE)
_KIND = re.compile(r"(ignore-file|ignore)(?![\w-])[ \t]*:?[ \t]*", re.IGNORECASE)
# A reason may stand behind the codes: a list of codes goes on behind a comma, or with what looks like a code.
_COMMA = rf"[ \t]*+[,{unicodedata.lookup('IDEOGRAPHIC COMMA')}][ \t]*+"
_CODES = re.compile(rf"[A-Z0-9]++(?:{_COMMA}[A-Z0-9]++|[ \t]++\d[A-Z][A-Z0-9]*+)*+", re.IGNORECASE | re.ASCII)
_CODE = re.compile(r"[A-Z0-9]+", re.IGNORECASE | re.ASCII)
_LONGEST_SHOWN = 40


class Directive(NamedTuple):
    """A code, or its beginning, that a remark asks to silence: on a line from 1, in the whole file, or nowhere."""

    silenced: str
    line: int
    span: Span


class Heeded(NamedTuple):
    """What the directives of a program do.

    Attributes
    ----------
    silenced
        Places of the findings that they silence, among all findings.
    findings
        Notes on directives that cannot be read (3B113), and on those that silence nothing (3B114).
    """

    silenced: frozenset[int] = frozenset()
    findings: tuple[Finding, ...] = ()


def heed(program: Program, findings: Sequence[Finding], states: Iterable[CheckState]) -> Heeded:
    """What the directives of a program do to its findings; `states` are those of the checks that gave them.

    A code that a check did not look for to the end may be silenced in vain without a note: the finding may be there.
    """
    directives = list(_directives(program))
    if not directives:
        return Heeded()
    valid = [directive for directive in directives if isinstance(directive, Directive)]
    wanted = {(each.line, each.silenced) for each in valid}
    hits = [[place for place in _places(finding) if place in wanted] for finding in findings]
    used = {place for hit in hits for place in hit}
    unfinished = {state.name for state in states if state.state != "complete"}
    idle = (
        each for each in valid if (each.line, each.silenced) not in used and not _checks_of(each.silenced) & unfinished
    )
    return Heeded(
        frozenset(at for at, hit in enumerate(hits) if hit),
        (
            *(directive for directive in directives if isinstance(directive, Finding)),
            *(program.lines.finding("3B114", each.span, silenced=each.silenced) for each in idle),
        ),
    )


def _places(finding: Finding) -> Iterator[tuple[int, str]]:
    """Where a directive may ask for a finding: its line or the file, its code or a beginning of that."""
    for line in (finding.line, _WHOLE_FILE):
        for length in range(2, len(finding.code) + 1):
            yield line, finding.code[:length]


def _checks_of(beginning: str) -> set[str]:
    return {str(of.check) for code, of in CODES.items() if of.check and code.startswith(beginning)}


def _directives(program: Program) -> Iterator[Directive | Finding]:
    """What each directive asks for, and a finding for each that cannot be read, in their order."""
    text, remarks = program.lines.text, program.reading.remarks
    if not len(remarks):
        return
    named = np.array([match.start() for match in _NAMED.finditer(text)], dtype=np.int64)
    at = np.searchsorted(remarks[:, 0], named, side="right") - 1
    rows = np.flatnonzero(np.bincount(at[(at >= 0) & (named < remarks[at, 1])]))
    inked = program.lines.inked_lines(remarks)
    for first, past in remarks[rows].tolist():
        begin = _BEGIN.match(text, first, past)
        if begin:
            below = inked[np.searchsorted(inked, program.lines.line(first)) :][:1].tolist()
            yield from _read(program, (begin.end(), past), *(below or [_NO_LINE]))


def _read(program: Program, span: Span, line: int) -> Iterator[Directive | Finding]:
    """What one directive asks for; it stands at `span`, and counts for a line or the whole file."""
    text = program.lines.text
    kind = _KIND.match(text, *span)
    codes = _CODES.match(text, kind.end(), span[1]) if kind else None
    if not kind or not codes:
        yield _unreadable(program, span, "directive-without-code" if kind else "directive-unknown")
        return
    for code in _CODE.finditer(text, *codes.span()):
        if len(code[0]) < 2 or not any(known.startswith(code[0].upper()) for known in CODES):
            yield _unreadable(program, code.span(), "directive-unknown-code")
        else:
            yield Directive(code[0].upper(), _WHOLE_FILE if kind[1].lower() == "ignore-file" else line, code.span())


def _unreadable(program: Program, span: Span, what: str) -> Finding:
    said = program.text[slice(*span)].strip()
    excerpt = said if len(said) <= _LONGEST_SHOWN else said[:_LONGEST_SHOWN] + "…"
    return program.lines.finding("3B113", span, what=what, text=excerpt)


class Sifted(NamedTuple):
    """Findings that are shown, in file order, and how many are not."""

    listed: tuple[Finding, ...]
    silenced: Silenced


def sifted(
    program: Program, findings: tuple[Finding, ...], states: Iterable[CheckState], settings: CheckSettings
) -> Sifted:
    """All findings of a program but those that its settings and remarks silence; with notes on the remarks.

    `states` are those of the checks. What settings silence counts as theirs, whether a remark does it too or not.
    """
    heeded = heed(program, findings, states)
    if not heeded.silenced and not heeded.findings:
        return chosen(findings, settings)
    remarked = [finding for at, finding in enumerate(findings) if at in heeded.silenced]
    others = [finding for at, finding in enumerate(findings) if at not in heeded.silenced]
    listed, silenced = chosen(sorted([*others, *heeded.findings], key=file_order), settings)
    by_remarks, by_settings = chosen(remarked, settings)
    options, settings_ = silenced.options + by_settings.options, silenced.settings + by_settings.settings
    return Sifted(listed, Silenced(options, settings_, remarks=len(by_remarks)))


def chosen(findings: Iterable[Finding], settings: CheckSettings) -> Sifted:
    """Those findings that the settings show."""
    shown_findings: list[Finding] = []
    counts = Counter[str]()
    for finding in findings:
        by = settings.silencer(finding.code)
        if by:
            counts[by] += 1
        else:
            shown_findings.append(finding)
    return Sifted(tuple(shown_findings), Silenced(options=counts["options"], settings=counts["settings"]))


def without_known(result: CheckResult, known: frozenset[str]) -> CheckResult:
    """A result without the findings whose fingerprints are known; checks that did not end for known reasons count so.

    Both are counted. A file that is no program keeps all of them.
    """
    if not known or result.unreadable:
        return result
    marks = fingerprints(result)
    unknown = tuple(finding for finding, mark in zip(result.findings, marks, strict=True) if mark not in known)
    checks = tuple(_with_known(check, known) for check in result.coverage.checks)
    hidden = result.silenced._replace(
        baseline=len(result.findings) - len(unknown), checks=sum(check.state == "known" for check in checks)
    )
    coverage = result.coverage._replace(checks=checks)
    return replace(result, findings=unknown, silenced=hidden, coverage=coverage)


def _with_known(check: CheckState, known: frozenset[str]) -> CheckState:
    is_known = check.state == "incomplete" and known.issuperset(gap_marks(check))
    return check._replace(state="known") if is_known else check


SCHEMA = "drycut.baseline/2"
_READ = ("drycut.baseline/1", SCHEMA)
"""Schemas that are read; the first has findings alone."""
_CHECK = "check-"
"""Begins the name of a check."""
_Known = Mapping[str, str]
"""Codes of findings, and names of checks that did not come to their end, by fingerprints."""


@dataclass(frozen=True, slots=True)
class Baseline:
    """What is known of files.

    Attributes
    ----------
    path
        Its own file. Files of programs are named in it from its folder, so that both can move together.
    known
        Codes and names of checks by fingerprints, by the names of files.
    """

    path: Path
    known: Mapping[str, _Known] = field(default_factory=dict)

    def of(self, file: Path) -> _Known:
        """What is known of a file, whose path has no link in it but for its last part."""
        return self.known.get(self.key(file), {})

    def key(self, file: Path) -> str:
        """Name of a file in the baseline: from its folder, with slashes; the whole path on another drive."""
        try:
            return Path(os.path.relpath(file, self.path.parent)).as_posix()
        except ValueError:
            return file.as_posix()


def known_of(result: CheckResult) -> _Known:
    """Findings and checks without an end of a result, as a baseline has them; none of a file that is no program."""
    if result.unreadable or result.fault:
        return {}
    codes = (finding.code for finding in result.findings)
    gaps = [check for check in result.coverage.checks if check.state == "incomplete"]
    return {
        **dict(zip(fingerprints(result), codes, strict=True)),
        **{mark: check.name for check in gaps for mark in gap_marks(check)},
    }


def baseline_text(known: Mapping[str, _Known]) -> str:
    """A baseline as its file holds it: ASCII, sorted, one finding or check a line; the same give the same text."""
    files = {name: dict(sorted(of.items())) for name, of in sorted(known.items()) if of}
    return json.dumps({"schema": SCHEMA, "files": files}, indent=1) + "\n"


def read_baseline(path: Path) -> Baseline:
    """Baseline of a file, whose path has no link in it.

    Raises FileUnreadableError where it cannot be read, SettingsError where it is no baseline.
    """
    load_own_checks()  # it may hold codes of theirs
    try:
        content = json.loads(read_text(path))
    except (ValueError, RecursionError) as error:  # no JSON, no UTF-8, or nested without end
        raise SettingsError("baseline-damaged", path=path, why=str(error)) from None
    if not isinstance(content, dict) or not isinstance(content.get("files"), dict):
        raise SettingsError("no-baseline", path=path)
    if content.get("schema") not in _READ:
        raise SettingsError("baseline-of-another-schema", path=path, found=content.get("schema"), schema=SCHEMA)
    for name, known in content["files"].items():
        if not isinstance(known, dict) or not _are_codes(known.values()):
            raise SettingsError("baseline-without-codes", path=path, name=name)
    return Baseline(path, content["files"])


def _are_codes(values: Iterable[object]) -> bool:
    return all(isinstance(code, str) and (code in CODES or code.startswith(_CHECK)) for code in values)
