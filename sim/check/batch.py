"""The check of a file, whatever it holds."""

import traceback
from collections.abc import Iterable
from pathlib import Path
from typing import Final, NamedTuple

import numpy as np

from parser.findings.errors import DrycutError, ProgramError
from parser.findings.facts import DamagedBlock, telling
from parser.findings.findings import Finding
from parser.program import Program, load_program
from parser.text.encoding import decode_text, no_program
from parser.text.lines import LineIndex
from parser.text.source import Source
from sim.check.engine import PARSER_CHECKS, PATH_CHECKS, Checked, run_checks
from sim.check.result import CheckResult, CheckState, Coverage
from sim.check.settings import CheckSettings

PARALLEL_FROM: Final = 200
"""Files from which on they are checked in parallel; below, starting processes takes longer than checking."""
_DEFAULTS = CheckSettings()


class Job(NamedTuple):
    """One file to check: its name as shown, its path or its content, and the settings."""

    name: str
    source: Path | bytes
    settings: CheckSettings


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
        data = job.source if isinstance(job.source, bytes) else job.source.read_bytes()
    except OSError as error:
        return _unreadable(job, b"", no_program("unreadable-file", error.strerror or str(error)), ())
    try:
        program = load_program(data, job.name, job.settings.marks)
    except ProgramError as error:
        return _unreadable(job, data, error.finding, error.others)
    return check_program(program, job.settings)


def check_program(program: Program, settings: CheckSettings = _DEFAULTS) -> CheckResult:
    """Check a program that was read. SettingsError where wire and gap of the settings leave no kerf."""
    checked = run_checks(program, settings.demands)
    shown = tuple(finding for finding in _mendable(program, checked) if settings.shows(finding.code))
    return CheckResult(
        name=program.name,
        encoding=program.encoding,
        dialect=program.reading.dialect,
        findings=shown,
        excerpts=_excerpts(program.lines, program.text, shown),
        coverage=checked.coverage,
        length_um=float(program.toolpath.length_um.sum()),
        steps=len(checked.steps) if checked.steps is not None else 0,
        fail_on=settings.fail_on,
        blocks=_blocks(program.toolpath.source, shown),
    )


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
    shown = (why, *(other for other in others if job.settings.shows(other.code)))
    coverage = Coverage(damaged, 0, 0, 0, _none_made("reason-unreadable"))
    return CheckResult(job.name, "", "", shown, excerpts, coverage, 0.0, 0, unreadable=True)


def not_checked(job: Job, fault: str) -> CheckResult:
    """Result of a file at which drycut itself failed: nothing is said of it."""
    coverage = Coverage(0, 0, 0, 0, _none_made("reason-fault"))
    return CheckResult(job.name, "", "", (), {}, coverage, 0.0, 0, fault=fault)


def _none_made(reason: str) -> tuple[CheckState, ...]:
    return tuple(CheckState(name, "incomplete", reason) for name in (*PARSER_CHECKS, *PATH_CHECKS))
