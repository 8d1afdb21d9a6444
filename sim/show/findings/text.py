"""Text for people, as a good compiler writes it: place, code, message, the source line with a caret, a hint."""

from collections.abc import Iterable, Iterator, Mapping

import click

from parser.findings.catalogue import Language, texts
from parser.findings.findings import Finding, Severity
from parser.text.encoding import printable
from parser.text.excerpt import caret_lines, place
from sim.check.result import CheckResult
from sim.show.findings.options import Options
from sim.show.findings.tidy import spot
from sim.show.findings.totals import Totals
from sim.show.findings.wording import coverage, message, summary
from sim.show.words import Words

_COLOURS: Mapping[str, str] = {
    Severity.ERROR: "red",
    Severity.WARNING: "yellow",
    Severity.NOTE: "cyan",
    "pass": "green",
    "fail": "red",
    "incomplete": "yellow",
}


def render(results: Iterable[CheckResult], options: Options) -> Iterator[str]:
    """Text of the results, file by file; a summary where there are several; a table of counts where asked for."""
    totals = Totals()
    for result in totals.over(results):
        yield "".join(f"{line}\n" for line in _file(result, options))
    if totals.files.total() > 1 and not options.quiet:
        yield _styled(summary(totals, options.language), options, bold=True) + "\n"
    if options.stats:
        from sim.show.findings.stats import table  # noqa: PLC0415 - few ask for it

        yield table(totals, options.language)


def _file(result: CheckResult, options: Options) -> Iterator[str]:
    for finding in result.findings:
        yield from _finding(result, finding, options)
    if result.findings or result.verdict != "pass" or not options.quiet:
        line = f"{printable(result.name)}: {coverage(result, options.language)}"
        yield _styled(line, options, fg=_COLOURS[result.verdict])


def _finding(result: CheckResult, finding: Finding, options: Options) -> Iterator[str]:
    where = _styled(place(printable(result.name), finding.line, finding.column), options, bold=True)
    severity = Words(options.language)(f"findings.{finding.severity}")
    label = _styled(f"{severity}[{finding.code}]", options, fg=_COLOURS[finding.severity], bold=True)
    yield f"{where}: {label}: {printable(message(finding, options.language))}"
    gutter = " " * len(str(finding.line))
    yield from _source(result, finding, gutter, options)
    yield from _hint(finding, gutter, options.language)


def _source(result: CheckResult, finding: Finding, gutter: str, options: Options) -> Iterator[str]:
    # The line's number before it keeps a build server from taking the line of a program for a command to itself.
    if finding.line not in result.excerpts:
        return
    at = spot(finding, result.excerpts)
    shown, carets = caret_lines(result.excerpts[finding.line], max(at.column, 1), at.end_column - at.column)
    yield f"  {finding.line} | {shown}".rstrip()
    if at.column:
        yield f"  {gutter} | {_styled(carets, options, fg=_COLOURS[finding.severity], bold=True)}"


def _hint(finding: Finding, gutter: str, language: Language) -> Iterator[str]:
    hint, say = texts(finding, language).hint, Words(language)
    if hint:
        yield f"  {gutter} = {say('findings.hint')}{say('findings.colon')}{printable(hint)}"


def _styled(text: str, options: Options, fg: str | None = None, bold: bool | None = None) -> str:
    return click.style(text, fg=fg, bold=bold) if options.colour else text
