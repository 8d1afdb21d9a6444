"""Fingerprints: by what a finding is known again when its program was changed elsewhere."""

from collections import Counter

from parser.findings.findings import Finding
from parser.text.encoding import narrow
from sim.check.result import CheckResult

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
    import hashlib  # noqa: PLC0415 - a sound program needs none, and starts sooner

    key = f"{finding.code}\n{meant}"
    seen[key] += 1
    return hashlib.sha256(f"{key}\n{seen[key]}".encode(errors="replace")).hexdigest()[:32]


def _meant(result: CheckResult, finding: Finding) -> str:
    """Text of the block that a finding is in, without its label; where it is in none, of its line."""
    text = result.blocks.get(finding.block)
    if text is None:
        first = max(0, finding.column - 1)
        past = first + finding.span[1] - finding.span[0]
        text = result.excerpts.get(finding.line, "")[max(0, first - _NEAR) : past + _NEAR]
    return "".join(narrow(text).split()).upper()
