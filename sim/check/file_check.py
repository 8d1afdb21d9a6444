"""The check of a file, whatever it holds, and its text with all that is certain mended.

A text as it is typed, read and checked with the settings that count for its file; it may hold no program yet.

The text of a program with all that is certain mended; nothing else in it changes.
"""

import traceback
from collections import Counter
from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Final, NamedTuple

import numpy as np

from parser.files import read_bytes
from parser.findings.codes import Severity
from parser.findings.errors import DrycutError, FileUnreadableError, ProgramError
from parser.findings.findings import DamagedBlock, Edit, Finding, compatible, edited, telling
from parser.program import Program, load_program, none_there
from parser.text.encoding import decode_text, encode_text
from parser.text.source import LineIndex, Source
from sim.check.fixes import with_edits
from sim.check.own_checks import with_own_checks
from sim.check.path_checks import PARSER_CHECKS, PATH_CHECKS, Checked, run_checks
from sim.check.result import CheckResult, CheckState, Coverage, Programmed, programmed_of
from sim.check.settings import CheckSettings
from sim.check.settings.read import NO_SETTINGS
from sim.check.settings.search import SettingsSearch
from sim.check.silence import chosen, sifted, without_known

if TYPE_CHECKING:  # most checks know no machine
    from sim.setup.machine.machine import Machine


PARALLEL_FROM: Final = 200


"""Files from which on they are checked in parallel; below, starting processes takes longer than checking."""


_DEFAULTS = CheckSettings()


class Job(NamedTuple):
    """One file to check.

    Attributes
    ----------
    name
        As shown.
    source
        Its path, or its content.
    settings
        What it is checked with.
    known
        Fingerprints of what its baseline has: findings that are not shown, and checks that need not end.
    """

    name: str
    source: Path | bytes
    settings: CheckSettings
    known: frozenset[str] = frozenset()


def check_any(job: Job) -> CheckResult:
    """Check one file; where drycut itself fails, the result has the traceback as its `fault`.

    Raises DrycutError for settings that cannot be.
    """
    try:
        return check_file(job)
    except DrycutError:
        raise
    except Exception:
        return not_checked(job, traceback.format_exc())


def check_file(job: Job) -> CheckResult:
    """Check one file; whatever it holds, the answer is a result."""
    try:
        data = job.source if isinstance(job.source, bytes) else read_bytes(job.source)
    except FileUnreadableError as error:
        return _unreadable(job, b"", none_there(error.what, job.name, job.settings.choices, error.detail), ())
    try:
        program = _with_upper(load_program(data, job.name, job.settings.choices), job.settings)
    except ProgramError as error:
        return _unreadable(job, data, error.finding, error.others)
    return without_known(check_program(program, job.settings), job.known)


def _with_upper(program: Program, settings: CheckSettings) -> Program:
    """The program with the upper contour that settings tell. Raises what `with_upper` does."""
    if settings.taper is None or settings.taper.upper is None:
        return program
    from sim.check.lean import with_upper  # noqa: PLC0415 - most programs are upright, and start sooner without

    return with_upper(program, settings.taper)


def check_program(program: Program, settings: CheckSettings = _DEFAULTS) -> CheckResult:
    """Check a program that was read. SettingsError where wire and gap of the settings leave no kerf."""
    checked = with_own_checks(program, run_checks(program, settings.demands))
    return result_of(program, checked._replace(findings=_mendable(program, checked)), settings)


def result_of(program: Program, checked: Checked, settings: CheckSettings) -> CheckResult:
    """Result of a program of which the checks are done: what settings and its remarks silence is left out."""
    listed, silenced = sifted(program, checked.findings, checked.coverage.checks, settings)
    return CheckResult(
        name=program.name,
        encoding=program.encoding,
        dialect=program.reading.dialect,
        findings=listed,
        excerpts=_excerpts(program.lines, program.text, listed),
        coverage=checked.coverage,
        length_um=float(program.toolpath.length_um.sum()),
        steps=len(checked.steps) if checked.steps is not None else 0,
        fail_on=settings.fail_on,
        settings_file=settings.file,
        silenced=silenced,
        blocks=_blocks(program.toolpath.source, listed),
        assumptions=program.reading.assumptions,
        programmed=_programmed(program) if checked.steps is not None else None,
    )


def _programmed(program: Program) -> Programmed:
    return programmed_of(program.toolpath, program.reading.threadings)


def _mendable(program: Program, checked: Checked) -> tuple[Finding, ...]:
    """All findings with their edits, also those that are not shown: they may speak against a mend."""
    if not checked.findings:
        return ()
    from sim.check.fixes import with_edits  # noqa: PLC0415 - a sound program needs no mend, and starts sooner

    return with_edits(program, checked)


def _excerpts(lines: LineIndex, text: str, findings: Iterable[Finding]) -> dict[int, str]:
    """Source lines, as written, that findings point at."""
    numbers = sorted({finding.line for finding in findings if finding.line})
    return {line: text[slice(*lines.bounds(line))] for line in numbers}


def _blocks(source: Source, findings: Iterable[Finding]) -> dict[int, str]:
    """Texts of the blocks, as written, that findings are in."""
    numbers = sorted({finding.block for finding in findings if finding.block})
    rows = np.searchsorted(source.block, numbers).tolist()
    return {number: source.block_text(row) for number, row in zip(numbers, rows, strict=True)}


def _unreadable(job: Job, data: bytes, why: Finding, others: tuple[Finding, ...]) -> CheckResult:
    """Result of a file that holds no program: the finding `why` always shows, the others as the settings ask."""
    excerpts: dict[int, str] = {}
    findings = (why, *others)
    if any(finding.line for finding in findings):
        text, _ = decode_text(data)
        excerpts = _excerpts(LineIndex(text), text, findings)
    damaged = len(list(telling(others, DamagedBlock)))
    listed, silenced = chosen(others, job.settings)
    return CheckResult(
        name=job.name,
        encoding="",
        dialect="",
        findings=(why, *listed),
        excerpts=excerpts,
        coverage=Coverage(damaged, 0, 0, 0, _none_made("reason-unreadable")),
        length_um=0.0,
        steps=0,
        unreadable=True,
        settings_file=job.settings.file,
        silenced=silenced,
    )


def not_checked(job: Job, fault: str) -> CheckResult:
    """Result of a file at which drycut itself failed: nothing is said of it."""
    return CheckResult(
        name=job.name,
        encoding="",
        dialect="",
        findings=(),
        excerpts={},
        coverage=Coverage(0, 0, 0, 0, _none_made("reason-fault")),
        length_um=0.0,
        steps=0,
        settings_file=job.settings.file,
        fault=fault,
    )


def _none_made(reason: str) -> tuple[CheckState, ...]:
    return tuple(CheckState(name, "incomplete", reason) for name in (*PARSER_CHECKS, *PATH_CHECKS))


_BOM: Final = "\ufeff"


class AsTyped(NamedTuple):
    """A text, read and checked.

    Attributes
    ----------
    lines
        Of the text as it is typed; each of its characters has its place in what was read of it.
    settings
        With which it was checked.
    program
        None where the text holds none.
    result
        What its check says.
    wrong_settings
        Why the settings near its file do not count; empty where they do, or there are none.
    """

    lines: LineIndex
    settings: CheckSettings
    program: Program | None
    result: CheckResult
    wrong_settings: str


def as_typed(name: str, file: Path | None, text: str, machine: "Machine | None" = None) -> AsTyped:
    """Read and check a text under a name; `file` is where it stands, None where it stands nowhere yet.

    A `machine` counts in place of that of the settings near the file.
    """
    settings, wrong = settings_near(name, file)
    if machine is not None:
        settings = replace(settings, machine=machine)
    # Characters keep their places: a mark of the byte order is a blank, half a pair a question mark.
    plain = f" {text[1:]}" if text.startswith(_BOM) else text
    data = plain.encode("utf-8", "replace")
    try:
        program = load_program(data, name, settings.choices)
    except ProgramError:
        return AsTyped(LineIndex(text), settings, None, check_file(Job(name, data, settings)), wrong)
    # Not the lines of the program: its reader folds full-width signs, which are shorter then in UTF-8.
    return AsTyped(LineIndex(text), settings, program, check_program(program, settings), wrong)


def settings_near(name: str, file: Path | None) -> tuple[CheckSettings, str]:
    """The settings that count for a text under a name; why those near its file do not, empty where they do.

    `file` is where it stands; None where it stands nowhere yet: no settings count for it.
    """
    search = SettingsSearch()
    if file is None:
        return NO_SETTINGS.settings_of(search.working / name), ""
    placed = search.placed(file)
    try:
        settings = search.near(placed.parent).settings_of(placed)
        _ = settings.demands  # settings that contradict each other are told here
    except DrycutError as error:
        return NO_SETTINGS.settings_of(placed), error.message
    return settings, ""


class MendedText(NamedTuple):
    """A mended text.

    Attributes
    ----------
    text, data
        The text and its bytes; as they were where nothing is certain, or a mend would bring a new error.
    edits
        What makes the text of the program as read, none of them touching another.
    findings, listed
        All findings of the program as it was, with their edits, and those of them that nothing silences.
    """

    text: str
    data: bytes
    edits: tuple[Edit, ...]
    findings: tuple[Finding, ...]
    listed: tuple[Finding, ...]


def mended_text(program: Program, settings: CheckSettings, known: frozenset[str] = frozenset()) -> MendedText:
    """Mend what is certain, keeping encoding, line ends and all else.

    What settings, remarks or the baseline, of which the fingerprints are `known`, silence is not mended.
    """
    checked = run_checks(program, settings.demands)
    findings = with_edits(program, checked)
    shown_findings = without_known(result_of(program, checked._replace(findings=findings), settings), known).findings
    edits = compatible(edit for finding in shown_findings for edit in finding.edits)
    text = edited(program.text, edits)
    data = encode_text(text, program.encoding)
    if text != program.text and _brings_errors(load_program(data, program.name, settings.choices), settings, checked):
        text, data, edits = program.text, encode_text(program.text, program.encoding), ()
    return MendedText(text, data, edits, findings, shown_findings)


def _brings_errors(program: Program, settings: CheckSettings, before: Checked) -> bool:
    """Whether a mended program has an error that was not there before."""
    return bool(_errors(run_checks(program, settings.demands)) - _errors(before))


def _errors(checked: Checked) -> Counter[tuple[str, int]]:
    """Errors by code and line; mends neither add lines before others nor take any away."""
    errors = (finding for finding in checked.findings if finding.severity is Severity.ERROR)
    return Counter((finding.code, finding.line) for finding in errors)
