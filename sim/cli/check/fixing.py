"""Certain mends written into a program file: nothing else in it changes."""

import difflib
from collections import Counter
from pathlib import Path
from typing import NamedTuple

from parser.files.reading import read_bytes
from parser.findings.catalogue import Language
from parser.findings.codes import Severity
from parser.findings.errors import ProgramError
from parser.findings.findings import Finding, edited
from parser.program import Program, load_program
from parser.text.encoding import encode_text, printable
from parser.text.excerpt import place
from parser.text.lines import LINE_END
from sim.check.engine import run_checks
from sim.check.fixes import Choice, choices, with_edits
from sim.check.settings import CheckSettings
from sim.files import replace_file
from sim.show.words import Words


class Unmended(NamedTuple):
    """A finding with several possible mends, none of which was made; as they would stand in the program."""

    finding: Finding
    choices: tuple[Choice, ...]


class Fixing(NamedTuple):
    """What `fix_file` did: a unified diff, empty where it changed nothing; and what it left for a person to decide."""

    diff: str
    unmended: tuple[Unmended, ...]


def fix_file(path: Path, name: str, settings: CheckSettings) -> Fixing:
    """Mend in the file what is certain, keeping encoding, line ends and all else.

    A file that cannot be read stays as it is, and so does one in which a mend would bring a new error. Raises
    FileUnreadableError where the file cannot be written; then it is as it was.
    """
    try:
        program = load_program(read_bytes(path), name, settings.marks)
    except (ProgramError, OSError):
        return Fixing("", ())
    findings = with_edits(program, run_checks(program, settings.demands))
    shown = tuple(finding for finding in findings if settings.shows(finding.code))
    left = tuple(Unmended(f, possible) for f in shown if len(possible := choices(program, f, findings)) > 1)
    text = edited(program.text, [edit for finding in shown for edit in finding.edits])
    mended = encode_text(text, program.encoding)
    if text == program.text or _errors(load_program(mended, name, settings.marks), settings) - _errors(
        program, settings
    ):
        return Fixing("", left)
    replace_file(path, mended)
    return Fixing(_diff(program, text), left)


def told(fixing: Fixing, name: str, language: Language) -> str:
    """What was done, for people."""
    say = Words(language)
    left = "".join(
        say(
            "findings.left",
            place=place(printable(name), unmended.finding.line, unmended.finding.column),
            code=unmended.finding.code,
            choices=say("findings.or").join(
                say("findings.choice", block=choice.block, text=choice.text) for choice in unmended.choices
            ),
        )
        + "\n"
        for unmended in fixing.unmended
    )
    return fixing.diff + left


def _errors(program: Program, settings: CheckSettings) -> Counter[tuple[str, int]]:
    """Errors by code and line; mends neither add lines before others nor take any away."""
    findings = run_checks(program, settings.demands).findings
    return Counter((finding.code, finding.line) for finding in findings if finding.severity is Severity.ERROR)


def _diff(program: Program, text: str) -> str:
    """Unified diff for people: line ends of any kind as newlines, other control characters as U+FFFD."""
    before, after = ([printable(line) + "\n" for line in LINE_END.split(version)] for version in (program.text, text))
    return "".join(difflib.unified_diff(before, after, f"{program.name}", f"{program.name} (mended)", n=1))
