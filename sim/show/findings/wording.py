"""Sentences of the formats in English and Chinese; names of checks and reasons are terms of the catalogue."""

from collections.abc import Iterable, Mapping

from parser.findings.catalogue import Language, term
from parser.findings.codes import Severity
from parser.findings.findings import Finding
from sim.check.result import CheckResult, CheckState, State
from sim.show.findings.totals import Totals
from sim.show.terminal.finding import hint, message
from sim.show.words import Words

_STATES: tuple[State, ...] = ("complete", "incomplete", "not asked")


def with_hint(finding: Finding, language: Language) -> str:
    """What a finding says, and in a second line how to mend it."""
    return "\n".join(line for line in (message(finding, language), hint(finding, language)) if line)


def reason(check: CheckState, language: Language) -> str:
    """Name of a check, and why it is not complete."""
    return _because(term(check.name, language), check.reason, language)


def findings(counts: Mapping[Severity, int], language: Language) -> str:
    """``2 errors, 1 warning``; empty where there is none."""
    say = Words(language)
    parts = [
        say(f"findings.{'one' if count == 1 else 'some'}-{severity}", n=count)
        for severity, count in counts.items()
        if count
    ]
    return say("findings.comma").join(parts)


def coverage(result: CheckResult, language: Language) -> str:
    """``fail: 2 errors, 1 warning; 6 of 7 blocks read, …; checks: 9 complete, …``."""
    say = Words(language)
    found = findings({severity: result.count(severity) for severity in Severity}, language)
    verdict, read = say(f"findings.{result.verdict}"), result.coverage
    parts = (
        f"{verdict}{say('findings.colon')}{found}" if found else verdict,
        say("findings.blocks", read=read.read, found=read.found, decoded=read.decoded, stepped=read.stepped),
        say("findings.checks", states=_states(read.checks, language)),
    )
    return say("findings.stop").join(parts)


def summary(totals: Totals, language: Language) -> str:
    """``3 files: 1 pass, 2 fail; 2 errors``."""
    say = Words(language)
    return say(
        "findings.files",
        n=totals.files.total(),
        verdicts=verdicts(totals, language),
        findings=findings(totals.by_severity(), language) or say("findings.no-findings"),
    )


def verdicts(totals: Totals, language: Language) -> str:
    """``1 pass, 2 fail``: files by verdict, those there are."""
    say = Words(language)
    parts = (f"{count} {say(f'findings.{verdict}')}" for verdict, count in totals.by_verdict().items() if count)
    return say("findings.comma").join(parts)


def _states(checks: tuple[CheckState, ...], language: Language) -> str:
    by_state = {state: [check for check in checks if check.state == state] for state in _STATES}
    parts = (_state(state, of, language) for state, of in by_state.items() if of or state == "complete")
    return Words(language)("findings.comma").join(parts)


def _state(state: State, checks: list[CheckState], language: Language) -> str:
    say, key = Words(language), state.replace(" ", "-")
    text = say(f"findings.{key}-checks", n=len(checks))
    if state == "complete":
        return text
    if state == "incomplete":
        why = say("findings.stop").join(reasons(checks, language))
    else:  # what was not asked for, its name says why
        why = say("findings.comma").join(term(check.name, language) for check in checks)
    return text + say("findings.why", reasons=why)


def reasons(checks: Iterable[CheckState], language: Language) -> list[str]:
    """Why checks are incomplete: their names before the reason that they share."""
    names: dict[str, list[str]] = {}
    for check in checks:
        if check.state == "incomplete":
            names.setdefault(check.reason, []).append(term(check.name, language))
    comma = Words(language)("findings.comma")
    return [_because(comma.join(of), why, language) for why, of in names.items()]


def _because(checks: str, reason: str, language: Language) -> str:
    return Words(language)("findings.reason", check=checks, reason=term(reason, language))
