"""Targets `program` and `iso`: 3B and 4B text, and ISO, checked. Targets `fix`, `iso-fix`: mended in their files."""

import random
from collections.abc import Iterator
from itertools import chain
from pathlib import Path
from subprocess import CompletedProcess

from fuzzing.iso_text import fuzzed_iso
from fuzzing.pmac_text import fuzzed_pmac
from fuzzing.program_text import fuzzed_program
from fuzzing.promises import of_document, of_place, of_texts, unclean
from fuzzing.ran import answer_of, broken_by, ran
from fuzzing.target import Input, Judged
from parser.findings.catalogue import LANGUAGES
from parser.findings.codes import Severity
from parser.findings.errors import ProgramError
from parser.findings.findings import edited
from parser.text.encoding import decode_text, encode_text
from parser.text.source import LineIndex
from sim.check.file_check import Job, check_file
from sim.check.result import CheckResult
from sim.check.settings import CheckSettings
from sim.show.findings import FORMATS, render
from sim.show.findings.wording import Options

_SETTINGS = (CheckSettings(), CheckSettings(wire_diameter_um=180.0), CheckSettings(may_stay_open=True))
_FILE = "fuzz.3b"
_RENDERED = 20  # one in so many inputs is written in all formats


def make(rng: random.Random) -> Input:
    """A program."""
    return fuzzed_program(rng)


def make_iso(rng: random.Random) -> Input:
    """A program of ISO."""
    return fuzzed_iso(rng)


def make_pmac(rng: random.Random) -> Input:
    """A motion program of PMAC."""
    return fuzzed_pmac(rng)


def judge(data: Input, number: int, _: Path) -> Judged:
    """The promises of a check; `number` picks its settings and whether it is rendered."""
    assert isinstance(data, bytes)
    settings = _SETTINGS[number % len(_SETTINGS)]
    result = check_file(Job("fuzz.3b", data, settings))
    promises = chain(
        _of_encoding(data), _of_findings(result, data), _of_verdict(result), _of_edits(result, data, settings)
    )
    formats = _of_formats(result) if number % _RENDERED == 0 else ()
    return Judged(repr(result), [*promises, *formats], result.verdict)


def judge_fix(data: Input, number: int, folder: Path) -> Judged:
    """The promises of `--fix`: no new errors, nothing left to do the second time, and a diff of what was changed."""
    assert isinstance(data, bytes)
    (folder / _FILE).write_bytes(data)
    before = check_file(Job(_FILE, data, CheckSettings()))
    once, mended = _fixed(folder)
    twice, again = _fixed(folder)
    after = check_file(Job(_FILE, mended, CheckSettings()))
    broken = [*broken_by(once, folder), *broken_by(twice, folder)]
    if again != mended:
        broken.append("changes more the second time")
    if after.count(Severity.ERROR) > before.count(Severity.ERROR) or after.unreadable > before.unreadable:
        broken.append(f"brings errors: {_codes(before)} became {_codes(after)}")
    if [file.name for file in folder.iterdir()] != [_FILE]:
        broken.append("leaves files behind")
    if (mended != data) != (b"+++ " in once.stderr):
        broken.append("changes without a diff, or shows one without a change")
    return Judged(repr((mended, answer_of(once, folder))), broken, "left" if mended == data else "mended")


def _fixed(folder: Path) -> tuple["CompletedProcess[bytes]", bytes]:
    """What the command says, and what it makes of the file."""
    done = ran(("check", "--fix", "--quiet", _FILE), folder)
    return done, (folder / _FILE).read_bytes()


def _codes(result: CheckResult) -> str:
    return " ".join(finding.code for finding in result.findings if finding.severity is Severity.ERROR)


def _of_encoding(data: bytes) -> Iterator[str]:
    """What is read as text is written back to the same bytes."""
    try:
        text, encoding = decode_text(data)
    except ProgramError:
        return
    if encode_text(text, encoding) != data:
        yield f"{encoding} is not written back as it was"


def _of_findings(result: CheckResult, data: bytes) -> Iterator[str]:
    """Every finding has a known code, a place inside the text, and texts in every language."""
    try:
        lines = LineIndex(decode_text(data)[0])
    except ValueError:
        lines = None
    for finding in result.findings:
        yield from of_texts(finding)
        yield from of_place(finding, lines)
        if finding.line and finding.line not in result.excerpts:
            yield f"{finding.code} points at line {finding.line} without an excerpt"


def _of_verdict(result: CheckResult) -> Iterator[str]:
    """The verdict follows from findings and coverage, and no count is larger than one it is part of."""
    cover = result.coverage
    if not 0 <= cover.stepped <= cover.decoded <= cover.read <= cover.found:
        yield f"coverage {cover[:4]}"
    errors = any(finding.severity is Severity.ERROR for finding in result.findings)
    incomplete = any(check.state == "incomplete" for check in cover.checks)
    if result.verdict != ("fail" if errors else "incomplete" if incomplete else "pass"):
        yield f"verdict {result.verdict}"
    if result.verdict == "pass" and cover.read < cover.found and not result.silenced.remarks:
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
        yield f"has more errors after its edits: {_codes(result)} became {_codes(again)}"


def _of_formats(result: CheckResult) -> Iterator[str]:
    """Every format is well-formed, in every language."""
    for name in FORMATS:
        for language in LANGUAGES:
            text = "".join(render(name, [result], Options(language=language, statistics=True)))
            yield from (f"format {name}: {what}" for what in (*of_document(name, text), *unclean(text)))
