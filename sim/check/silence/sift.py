"""Findings sifted: those that are shown, and how many are not, by what silences them."""

from collections import Counter
from collections.abc import Iterable
from dataclasses import replace
from typing import NamedTuple

from parser.findings.findings import Finding, file_order
from parser.program import Program
from sim.check.fingerprint import fingerprints
from sim.check.result import CheckResult, CheckState, Silenced
from sim.check.settings import CheckSettings
from sim.check.silence.directives import heed


class Sifted(NamedTuple):
    """Findings that are shown, in file order, and how many are not."""

    shown: tuple[Finding, ...]
    silenced: Silenced


def sifted(
    program: Program, findings: tuple[Finding, ...], states: Iterable[CheckState], settings: CheckSettings
) -> Sifted:
    """All findings of a program but those that its settings and remarks silence; with notes on the remarks.

    `states` are those of the checks. What settings silence counts as theirs, whether a remark does it too or not.
    """
    heeded = heed(program, findings, states)
    if not heeded.silenced and not heeded.told:
        return chosen(findings, settings)
    remarked = [finding for at, finding in enumerate(findings) if at in heeded.silenced]
    others = [finding for at, finding in enumerate(findings) if at not in heeded.silenced]
    shown, silenced = chosen(sorted([*others, *heeded.told], key=file_order), settings)
    by_remarks, by_settings = chosen(remarked, settings)
    options, settings_ = silenced.options + by_settings.options, silenced.settings + by_settings.settings
    return Sifted(shown, Silenced(options, settings_, remarks=len(by_remarks)))


def chosen(findings: Iterable[Finding], settings: CheckSettings) -> Sifted:
    """Those findings that the settings show."""
    shown: list[Finding] = []
    counts = Counter[str]()
    for finding in findings:
        by = settings.silencer(finding.code)
        if by:
            counts[by] += 1
        else:
            shown.append(finding)
    return Sifted(tuple(shown), Silenced(options=counts["options"], settings=counts["settings"]))


def without_known(result: CheckResult, known: frozenset[str]) -> CheckResult:
    """A result without the findings whose fingerprints are known, which then count as silenced.

    A file that is no program keeps all of them.
    """
    if not known or result.unreadable:
        return result
    marks = fingerprints(result)
    shown = tuple(finding for finding, mark in zip(result.findings, marks, strict=True) if mark not in known)
    count = len(result.findings) - len(shown)
    return replace(result, findings=shown, silenced=result.silenced._replace(baseline=count))
