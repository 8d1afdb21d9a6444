"""Workflow commands of GitHub Actions, which become annotations of the lines: ``::error file=…,line=…::message``."""

from collections.abc import Iterable, Iterator, Mapping

from parser.findings.catalogue import Language, page
from parser.findings.codes import Severity
from parser.findings.findings import Finding
from parser.text.encoding import printable
from sim.check.result import CheckResult
from sim.show.findings.totals import Totals, posix, spot
from sim.show.findings.wording import Options, reasons, settings, silenced, summary, with_hint
from sim.show.texts import Words

_LEVELS: Mapping[Severity, str] = {Severity.ERROR: "error", Severity.WARNING: "warning", Severity.NOTE: "notice"}


def render(results: Iterable[CheckResult], options: Options) -> Iterator[str]:
    """A command for each finding and each reason why checks did not come to their end, then what sums up.

    That findings are not shown is a command too, since the page of a commit shows commands alone.
    """
    totals = Totals()
    for result in totals.over(results):
        yield "".join(f"{line}\n" for line in _file(result, options.language))
    yield "".join(f"{line}\n" for line in _sums(totals, options.language))


def _file(result: CheckResult, language: Language) -> Iterator[str]:
    for finding in result.findings:
        properties = _properties(result, finding, language)
        yield _command(_LEVELS[finding.severity], properties, with_hint(finding, language))
    for reason in reasons(result.coverage.checks, language):
        yield _command("warning", {"file": _name(result), "title": Words(language)("findings.incomplete")}, reason)


def _sums(totals: Totals, language: Language) -> Iterator[str]:
    hidden, files, say = totals.silenced, totals.settings_files, Words(language)
    if any(hidden):
        properties = {"title": say("findings.hidden", n=hidden.findings)}
        yield _command("notice", properties, silenced(hidden, files, language))
    yield from filter(None, [printable(settings(hidden, files, language)), summary(totals, language)])


def _properties(result: CheckResult, finding: Finding, language: Language) -> dict[str, str]:
    at = spot(finding, result.excerpts)
    places = {"line": at.line, "endLine": at.line, "col": at.column, "endColumn": at.end_column}
    title = f"{finding.code} {page(finding.code, language).title}"
    return {"file": _name(result)} | {key: str(n) for key, n in places.items() if n} | {"title": title}


def _name(result: CheckResult) -> str:
    return posix(result.name)


def _command(level: str, properties: Mapping[str, str], text: str) -> str:
    listed = ",".join(f"{key}={_property(value)}" for key, value in properties.items())
    return f"::{level} {listed}::{_data(text)}"


def _data(text: str) -> str:
    # As actions/toolkit does it (packages/core/src/command.ts), the percent sign first; printable() lets no CR through.
    shown_text = "\n".join(map(printable, text.split("\n")))
    return shown_text.replace("%", "%25").replace("\n", "%0A")


def _property(text: str) -> str:
    return _data(text).replace(":", "%3A").replace(",", "%2C")
