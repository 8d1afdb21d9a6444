"""Promises that hold for any input at all, tried on many: ``PYTHONPATH=. python tests/tools/fuzz.py``, `make fuzz`.

Every input is made from its own number and the seed, so that one that breaks a promise is made again by its number.
"""

import argparse
import os
import random
import sys
import time
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from itertools import chain

from fuzz_inputs import fuzzed
from hostile import HOSTILE

from parser.findings.catalogue import LANGUAGES, texts
from parser.findings.codes import CODES, Severity
from parser.findings.findings import Finding, edited
from parser.text.encoding import decode_text, encode_text
from parser.text.lines import LineIndex
from sim.check.batch import Job, check_file
from sim.check.result import CheckResult
from sim.check.settings import CheckSettings
from sim.show.findings import FORMATS, render
from sim.show.findings.options import Options

SEED = 20260101
MOST_S = 2.0
"""Time that an input of a few kB may take."""
MOST_HOSTILE_S = 15.0
"""Time that a hostile program of some MB may take; on an idle core none takes 5 s."""
_SETTINGS = (CheckSettings(), CheckSettings(wire_diameter_um=180.0))
_RENDERED = 20  # one in so many inputs is written in all formats
_CHUNK = 500


def main() -> None:
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("--inputs", type=int, default=200_000)
    options.add_argument("--seed", type=int, default=SEED)
    asked = options.parse_args()
    begin, done, worst, broken = time.perf_counter(), 0, (0.0, 0), 0
    chunks = [(asked.seed, low, min(low + _CHUNK, asked.inputs)) for low in range(0, asked.inputs, _CHUNK)]
    with ProcessPoolExecutor(os.cpu_count()) as pool:
        for number, slowest, failures in pool.map(_run, chunks):
            done, worst, broken = done + number, max(worst, slowest), broken + len(failures)
            for failure in failures:
                print(failure)
            rate = done / (time.perf_counter() - begin)
            end = "\n" if done == asked.inputs or (not sys.stdout.isatty() and done % 20_000 == 0) else "\r"
            if end == "\n" or sys.stdout.isatty():
                print(f"{done:,} inputs, {rate:,.0f}/s, {broken} broke a promise, slowest {worst[0]:.3f} s", end=end)
    broken += _hostile()
    print(f"slowest: number {worst[1]}, {worst[0]:.3f} s")
    sys.exit(bool(broken))


def _hostile() -> int:
    """Time of each hostile program, and how many took too long."""
    late = 0
    for name, program in HOSTILE.items():
        data = program(10**5).encode()
        begin = time.perf_counter()
        check_file(Job("hostile.3b", data, CheckSettings()))
        taken = time.perf_counter() - begin
        late += taken > MOST_HOSTILE_S
        print(f"{name:40}{len(data) / 1e6:6.2f} MB{taken:8.2f} s")
    return late


def fuzz_input(seed: int, number: int) -> bytes:
    """The input of a number."""
    return fuzzed(random.Random(f"{seed}:{number}"))


def broken_promises(data: bytes, number: int = 0) -> list[str]:
    """Promises that the check does not keep for an input; `number` picks its settings and whether it is rendered."""
    settings = _SETTINGS[number % len(_SETTINGS)]
    begin = time.perf_counter()
    result = check_file(Job("fuzz.3b", data, settings))
    late = time.perf_counter() - begin
    promises = chain(_of_findings(result, data), _of_verdict(result), _of_edits(result, data, settings))
    found = [f"took {late:.2f} s"] if late > MOST_S else []
    return [*found, *promises, *(_of_formats(result) if number % _RENDERED == 0 else ())]


def _run(chunk: tuple[int, int, int]) -> tuple[int, tuple[float, int], list[str]]:
    seed, low, past = chunk
    slowest, failures = (0.0, 0), []
    for number in range(low, past):
        data = fuzz_input(seed, number)
        begin = time.perf_counter()
        try:
            broken = broken_promises(data, number)
        except Exception as error:
            broken = [f"{type(error).__name__}: {error}"]
        slowest = max(slowest, (time.perf_counter() - begin, number))
        failures += [f"{number}: {promise}: {data[:300]!r}" for promise in broken]
    return past - low, slowest, failures


def _of_findings(result: CheckResult, data: bytes) -> Iterator[str]:
    """Every finding has a known code, a place inside the text, and texts in every language."""
    try:
        lines = LineIndex(decode_text(data)[0])
    except ValueError:
        lines = None
    for finding in result.findings:
        if finding.code not in CODES:
            yield f"{finding.code} is no code"
            continue
        for language in LANGUAGES:
            if "\n" in texts(finding, language).message or not texts(finding, language).message:
                yield f"{finding.code} has no line of text in {language}"
        yield from _of_place(finding, lines)
        if finding.line and finding.line not in result.excerpts:
            yield f"{finding.code} points at line {finding.line} without an excerpt"


def _of_place(finding: Finding, lines: LineIndex | None) -> Iterator[str]:
    first, past = finding.span
    if not finding.line:
        if finding.span != (0, 0):
            yield f"{finding.code} has a span and no line"
        return
    if lines is None or not 0 <= first <= past <= len(lines.text):
        yield f"{finding.code} points beyond the text at {finding.span}"
    elif (finding.line, finding.column) != (lines.line(first), lines.column(first)):
        yield f"{finding.code} at {finding.span} names {finding.line}:{finding.column}"


def _of_verdict(result: CheckResult) -> Iterator[str]:
    """The verdict follows from findings and coverage, and no count is larger than one it is part of."""
    cover = result.coverage
    if not 0 <= cover.stepped <= cover.decoded <= cover.read <= cover.found:
        yield f"coverage {cover[:4]}"
    errors = any(finding.severity is Severity.ERROR for finding in result.findings)
    incomplete = any(check.state == "incomplete" for check in cover.checks)
    if result.verdict != ("fail" if errors else "incomplete" if incomplete else "pass"):
        yield f"verdict {result.verdict}"
    if result.verdict == "pass" and cover.read < cover.found:
        yield "passes with blocks that were not read"


def _of_edits(result: CheckResult, data: bytes, settings: CheckSettings) -> Iterator[str]:
    """With all edits made the program loads, and has no more errors than before."""
    edits = [edit for finding in result.findings for edit in finding.edits]
    if not edits:
        return
    text, encoding = decode_text(data)
    if any(not 0 <= edit.first <= edit.past <= len(text) for edit in edits):
        yield "an edit lies beyond the text"
        return
    again = check_file(Job("fuzz.3b", encode_text(edited(text, edits), encoding), settings))
    if again.unreadable:
        yield "does not load after its edits"
    if again.count(Severity.ERROR) > result.count(Severity.ERROR):
        before, after = (" ".join(finding.code for finding in one.findings) for one in (result, again))
        yield f"has more errors after its edits: {before} became {after}"


def _of_formats(result: CheckResult) -> Iterator[str]:
    for name in FORMATS:
        for language in LANGUAGES:
            if not "".join(render(name, [result], Options(language=language, stats=True))):
                yield f"nothing in the format {name}"


if __name__ == "__main__":
    main()
