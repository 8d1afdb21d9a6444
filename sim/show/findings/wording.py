"""Sentences of the formats in English and Chinese, and the choices that formats share.

Sentences of the formats in English and Chinese; names of checks and reasons are terms of the catalogue.
"""

from collections.abc import Iterable, Mapping, Sequence
from typing import NamedTuple

from parser.findings.catalogue import Language, term
from parser.findings.codes import Severity
from parser.findings.findings import Finding, ReadAs, telling
from sim.check.result import CheckResult, CheckState, Coverage, Silenced, State
from sim.show.findings.totals import Totals
from sim.show.terminal.finding import hint, message
from sim.show.terminal.wrap import WIDTH
from sim.show.texts import Words
from sim.show.texts.phrases import as_read

_STATES: tuple[State, ...] = ("complete", "incomplete", "known", "not asked")
_MOST_FILES = 3  # settings files that one line names


def with_hint(finding: Finding, language: Language) -> str:
    """What a finding says, and in a second line how to mend it."""
    return "\n".join(line for line in (message(finding, language), hint(finding, language)) if line)


def reason(check: CheckState, language: Language) -> str:
    """Name of a check, and why it is not complete."""
    return _because(term(check.name, language), check.because(language), language)


def verdict(result: CheckResult, language: Language) -> str:
    """``fail: 2 errors, 1 not shown``."""
    say = Words(language)
    found = _findings({severity: result.count(severity) for severity in Severity}, result.silenced, language)
    return say("findings.colon").join(filter(None, (say(f"findings.{result.outcome}"), found)))


def reach(result: CheckResult, language: Language) -> str:
    """How far the check of a file came: ``3 blocks; checks: 9 complete, 3 not asked; settings: drycut.toml``."""
    say, read = Words(language), result.coverage
    came = (_blocks(read, language), say("findings.checks", states=_states(read.checks, language)))
    parts = (
        *((say("findings.nothing-checked"),) if result.unreadable else came),
        settings(result.silenced, (result.settings_file,), language),
    )
    return say("findings.stop").join(filter(None, parts))


def read_as(result: CheckResult, language: Language) -> str:
    """``read as (ISO112): unit 0.001 mm (…), …``: what the text leaves open; empty where it leaves nothing."""
    if not result.assumptions:
        return ""
    found = next((finding for finding, _ in telling(result.findings, ReadAs)), None)
    key = "findings.read-as-finding" if found else "findings.read-as"
    return Words(language)(key, code=found and found.code, parts=as_read(result.assumptions))


def summary(totals: Totals, language: Language) -> str:
    """``3 files: 1 pass, 2 fail; 2 errors, 1 not shown``."""
    say = Words(language)
    return say(
        "findings.one-file" if totals.files.total() == 1 else "findings.some-files",
        n=totals.files.total(),
        verdicts=verdicts(totals, language),
        findings=_findings(totals.by_severity(), totals.silenced, language) or say("findings.no-findings"),
    )


def counted(totals: Totals, language: Language) -> list[str]:
    """The settings files that counted, and what is not shown, each a line; none where there is nothing to say."""
    hidden, files = totals.silenced, totals.settings_files
    return [line for line in (settings(hidden, files, language), silenced(hidden, files, language)) if line]


def silenced(counts: Silenced, settings_files: Sequence[str], language: Language) -> str:
    """``not shown: 1 by settings (drycut.toml), 1 by remarks in the program``; empty where nothing is silenced."""
    parts = silencers(counts, settings_files, language)
    return Words(language)("findings.silenced", parts=parts) if parts else ""


def silencers(counts: Silenced, settings_files: Sequence[str], language: Language) -> str:
    """What silences how many findings; empty where nothing does."""
    say = Words(language)
    names = _listed(settings_files, language)
    parts = [say(f"findings.by-{by}", n=n, files=names) for by, n in counts._asdict().items() if n]
    return say("findings.comma").join(parts)


def settings(counts: Silenced, settings_files: Sequence[str], language: Language) -> str:
    """``settings: drycut.toml``; empty where there are none, or `silenced` names them."""
    names = _listed(settings_files, language)
    return Words(language)("findings.settings", files=names) if names and not counts.settings else ""


def _listed(files: Sequence[str], language: Language) -> str:
    """Names of settings files, the first of many."""
    named = [name for name in files if name]
    more = [Words(language)("findings.more", n=len(named) - _MOST_FILES)] if len(named) > _MOST_FILES else []
    return Words(language)("findings.comma").join([*named[:_MOST_FILES], *more])


def _findings(counts: Mapping[Severity, int], hidden: Silenced, language: Language) -> str:
    """``2 errors, 1 warning, 1 not shown``; empty where there is none."""
    say = Words(language)
    parts = [
        say(f"findings.{'one' if count == 1 else 'some'}-{severity}", n=count)
        for severity, count in counts.items()
        if count
    ]
    return say("findings.comma").join(
        [*parts, *([say("findings.hidden", n=hidden.findings)] if hidden.findings else [])]
    )


def _blocks(read: Coverage, language: Language) -> str:
    """How many blocks there are; and how far each came, where it is not all the way."""
    say = Words(language)
    if read.found == read.read == read.decoded == read.stepped:
        return say("findings.one-block" if read.found == 1 else "findings.some-blocks", n=read.found)
    return say("findings.blocks", read=read.read, found=read.found, decoded=read.decoded, stepped=read.stepped)


def verdicts(totals: Totals, language: Language) -> str:
    """``1 pass, 2 fail``: files by verdict, those there are."""
    say = Words(language)
    parts = (f"{count} {say(f'findings.{outcome}')}" for outcome, count in totals.by_outcome().items() if count)
    return say("findings.comma").join(parts)


def _states(checks: tuple[CheckState, ...], language: Language) -> str:
    counts = {state: sum(check.state == state for check in checks) for state in _STATES}
    parts = (_state(state, n, language) for state, n in counts.items() if n or state == "complete")
    return Words(language)("findings.comma").join(parts)


def _state(state: State, n: int, language: Language) -> str:
    key = state.replace(" ", "-")
    return Words(language)(f"findings.{key}-checks", n=n)


def reasons(checks: Iterable[CheckState], language: Language) -> list[str]:
    """Why checks are incomplete: their names before the reason that they share."""
    names: dict[str, list[str]] = {}
    for check in checks:
        if check.state == "incomplete":
            names.setdefault(check.because(language), []).append(term(check.name, language))
    comma = Words(language)("findings.comma")
    return [_because(comma.join(of), why, language) for why, of in names.items()]


def _because(checks: str, reason: str, language: Language) -> str:
    return Words(language)("findings.reason", check=checks, reason=reason)


class Options(NamedTuple):
    """How to write results.

    Attributes
    ----------
    language
        Language of all texts.
    colour, quiet, statistics
        Of the text format: with colours; no line for files without a finding and no summary; with a table of counts.
    width
        Of the text format: cells of a line.
    help_uri
        Of SARIF: address of the page of a finding, with ``{code}`` for its code; empty where there are no such pages.
    """

    language: Language = "en"
    colour: bool = False
    quiet: bool = False
    statistics: bool = False
    width: int = WIDTH
    help_uri: str = ""
