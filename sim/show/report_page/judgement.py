"""The verdict in a sentence, and what else has to be known first."""

from collections import Counter

from parser.findings.catalogue import LANGUAGES, texts
from parser.findings.codes import Severity
from parser.findings.findings import Finding
from sim.run.dryrun import DryRun, verdict
from sim.setup.quiz import Said
from sim.show.words.report import catalogued, lasting, listed, numbered, said


def why(run: DryRun) -> list[Said]:
    """Sentences on the verdict, the first of them why it is so."""
    return [_first(run), *_tripped(run), *_incomplete(run)]


def _first(run: DryRun) -> Said:
    if not run.findings:
        return said("nothing-found")
    if verdict(run.findings) == "pass":
        return said("no-error", counts=_counts(run.findings))
    first = next(finding for finding in run.findings if finding.severity is Severity.ERROR)
    title = Said(*(texts(first, language).title for language in LANGUAGES))
    key = "why-failed-in" if first.block else "why-failed"
    return said(key, counts=_counts(run.findings), code=first.code, title=title, block=first.block)


def _counts(findings: tuple[Finding, ...]) -> Said:
    number = Counter(finding.severity for finding in findings)
    return numbered({f"{severity}s": number[severity] for severity in Severity})


def _tripped(run: DryRun) -> list[Said]:
    trip = run.tripped
    return [said("tripped", block=trip.row + 1, time=lasting(trip.t_s))] if trip else []


def _incomplete(run: DryRun) -> list[Said]:
    names = [check.name for check in run.coverage.checks if check.state == "incomplete"]
    return [said("incomplete", checks=listed(map(catalogued, names)))] if names else []
