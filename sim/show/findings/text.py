"""Text for people, as a good compiler writes it: place, code, message, the source line with a caret, a hint.

A table counts what was found in all files together, in plain columns.
"""

from collections.abc import Iterable, Iterator, Sequence

import click

from parser.findings.catalogue import Language, length, page
from parser.findings.codes import CODES
from parser.findings.findings import Finding
from parser.text.encoding import printable
from parser.text.excerpt import caret_lines, cells, place
from sim.check.result import CheckResult
from sim.show.findings.options import Options
from sim.show.findings.tidy import spot
from sim.show.findings.totals import Totals
from sim.show.findings.wording import coverage, summary, verdicts
from sim.show.terminal.colours import COLOURS
from sim.show.terminal.finding import hint, message
from sim.show.words import Words

_GAP = "  "  # between the columns of the table


def render(results: Iterable[CheckResult], options: Options) -> Iterator[str]:
    """Text of the results, file by file; a summary where there are several; a table of counts where asked for."""
    totals = Totals()
    for result in totals.over(results):
        yield "".join(f"{line}\n" for line in _file(result, options))
    if totals.files.total() > 1 and not options.quiet:
        yield _styled(summary(totals, options.language), options, bold=True) + "\n"
    if options.stats:
        yield _table(totals, options.language)


def _file(result: CheckResult, options: Options) -> Iterator[str]:
    for finding in result.findings:
        yield from _finding(result, finding, options)
    if result.findings or result.verdict != "pass" or not options.quiet:
        line = f"{printable(result.name)}: {coverage(result, options.language)}"
        yield _styled(line, options, fg=COLOURS[result.verdict])


def _finding(result: CheckResult, finding: Finding, options: Options) -> Iterator[str]:
    where = _styled(place(printable(result.name), finding.line, finding.column), options, bold=True)
    severity = Words(options.language)(f"findings.{finding.severity}")
    label = _styled(f"{severity}[{finding.code}]", options, fg=COLOURS[finding.severity], bold=True)
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
        yield f"  {gutter} | {_styled(carets, options, fg=COLOURS[finding.severity], bold=True)}"


def _hint(finding: Finding, gutter: str, language: Language) -> Iterator[str]:
    told = hint(finding, language)
    if told:
        yield f"  {gutter} = {printable(told)}"


def _styled(text: str, options: Options, fg: str | None = None, bold: bool | None = None) -> str:
    return click.style(text, fg=fg, bold=bold) if options.colour else text


def _table(totals: Totals, language: Language) -> str:
    """Counts by code with titles, then files, blocks, steps and path; the lines end with a line feed."""
    lines = [*_codes(totals, language), *_sums(totals, language)]
    return "".join(f"{line}\n" for line in lines)


def _codes(totals: Totals, language: Language) -> list[str]:
    say = Words(language)
    rows = [
        (code, say(f"findings.{CODES[code].severity}"), str(count), page(code, language).title)
        for code, count in sorted(totals.codes.items())
    ]
    head = (say("findings.code"), say("findings.severity"), say("findings.count"), say("findings.title"))
    return _columns([head, *rows], right=(2,)) if rows else []


def _sums(totals: Totals, language: Language) -> list[str]:
    say = Words(language)
    files, by_verdict = totals.files.total(), verdicts(totals, language)
    rows = [
        (say("findings.total-files"), f"{files:,} ({by_verdict})" if by_verdict else f"{files:,}"),
        (say("findings.total-blocks"), say("findings.blocks", **_numbers(totals))),
        (say("findings.total-steps"), f"{totals.steps:,}"),
        (say("findings.total-length"), length(totals.length_um)),
    ]
    return _columns(rows)


def _numbers(totals: Totals) -> dict[str, str]:
    return {name: f"{totals.blocks[name]:,}" for name in ("found", "read", "decoded", "stepped")}


def _columns(rows: Sequence[tuple[str, ...]], right: tuple[int, ...] = ()) -> list[str]:
    widths = [max(map(cells, column)) for column in zip(*rows, strict=True)]
    return [
        _GAP.join(
            _padded(text, width, index in right) for index, (text, width) in enumerate(zip(row, widths, strict=True))
        ).rstrip()
        for row in rows
    ]


def _padded(text: str, width: int, right: bool) -> str:
    blanks = " " * (width - cells(text))
    return blanks + text if right else text + blanks
