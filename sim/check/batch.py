"""Checks of many files: each on its own, over all cores where there are many."""

import os
from collections.abc import Callable, Iterable, Iterator, Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np

from parser.files.reading import read_bytes
from parser.findings.errors import FileUnreadableError, ProgramError
from parser.findings.facts import DamagedBlock, telling
from parser.findings.findings import Finding
from parser.program import Program, load_program
from parser.text.encoding import decode_text, no_program
from parser.text.lines import LineIndex
from parser.text.source import Source
from sim.check.engine import PARSER_CHECKS, PATH_CHECKS, Checked, run_checks
from sim.check.result import CheckResult, CheckState, Coverage
from sim.check.settings import CheckSettings

PARALLEL_FROM = 200
"""Files from which on they are checked in parallel; below, starting processes takes longer than checking."""
_FILES_A_TASK = 32
_DEFAULTS = CheckSettings()


class Job(NamedTuple):
    """One file to check: its name as shown, its path or its content, and the settings."""

    name: str
    source: Path | bytes
    settings: CheckSettings


def check_file(job: Job) -> CheckResult:
    """Check one file; whatever it holds, the answer is a result."""
    try:
        data = job.source if isinstance(job.source, bytes) else read_bytes(job.source)
    except FileUnreadableError as error:
        return _unreadable(job, b"", no_program(error.what, error.detail), ())
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


def check_files(jobs: Sequence[Job], progress: Callable[[int, int], None]) -> Iterator[CheckResult]:
    """Results in the order of the jobs, over all cores; `progress` is told how many of how many are done."""
    from concurrent.futures import ProcessPoolExecutor  # noqa: PLC0415 - a few files need no processes

    with ProcessPoolExecutor(os.cpu_count()) as pool:
        for done, result in enumerate(pool.map(check_file, jobs, chunksize=_FILES_A_TASK), start=1):
            progress(done, len(jobs))
            yield result


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
    states = tuple(CheckState(name, "incomplete", "reason-unreadable") for name in (*PARSER_CHECKS, *PATH_CHECKS))
    damaged = len(list(telling(others, DamagedBlock)))
    shown = (why, *(other for other in others if job.settings.shows(other.code)))
    coverage = Coverage(damaged, 0, 0, 0, states)
    return CheckResult(job.name, "", "", shown, excerpts, coverage, 0.0, 0, unreadable=True)
