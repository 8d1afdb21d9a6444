"""The text of a program with all that is certain mended; nothing else in it changes."""

from collections import Counter
from typing import NamedTuple

from parser.findings.codes import Severity
from parser.findings.findings import Edit, Finding, compatible, edited
from parser.program import Program, load_program
from parser.text.encoding import encode_text
from sim.check.file_check import result_of
from sim.check.fixes import with_edits
from sim.check.path_checks import Checked, run_checks
from sim.check.settings import CheckSettings
from sim.check.silence import without_known


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
