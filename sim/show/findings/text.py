"""Text for people, as a good compiler writes it: each finding in lines of its own, then how far its file came.

What is not shown is said: findings that something silences, checks that did not come to their end.

What was found in all files together, counted, in plain columns.
"""

from collections import Counter
from collections.abc import Iterable, Iterator, Sequence

from parser.findings.catalogue import Language, length, page, term
from parser.findings.findings import ReadAs
from parser.text.encoding import printable
from parser.text.places import cells
from sim.check.result import CheckResult
from sim.show.findings.totals import BLOCKS, Totals
from sim.show.findings.wording import (
    Options,
    counted,
    reach,
    read_as,
    reasons,
    silenced,
    silencers,
    summary,
    verdict,
    verdicts,
)
from sim.show.terminal.finding import finding_lines
from sim.show.terminal.printer import COLOURS, painted, styled
from sim.show.terminal.wrap import wrapped
from sim.show.texts import Words

_GAP = "  "  # between the columns


def table(totals: Totals, language: Language, width: int) -> list[str]:
    """Counts by code and severity, then files, checks, blocks, steps and path, in lines of `width` cells."""
    return [*_columns(_codes(totals, language), width, right=(2,)), *_columns(_sums(totals, language), width)]


def _codes(totals: Totals, language: Language) -> list[tuple[str, ...]]:
    say = Words(language)
    rows = [
        (code, say(f"findings.{severity}"), f"{count:,}", page(code, language).title)
        for (code, severity), count in sorted(totals.counts.items())
    ]
    head = (say("findings.code"), say("findings.severity"), say("findings.count"), say("findings.title"))
    return [head, *rows] if rows else []


def _sums(totals: Totals, language: Language) -> list[tuple[str, str]]:
    say = Words(language)
    files, by_verdict = totals.files.total(), verdicts(totals, language)
    blocks = {name: f"{totals.blocks[name]:,}" for name in BLOCKS}
    return [
        (say("findings.total-files"), f"{files:,} ({by_verdict})" if by_verdict else f"{files:,}"),
        *_checks(totals, "incomplete", say("findings.total-incomplete"), language),
        *_checks(totals, "known", say("findings.total-known"), language),
        *_checks(totals, "not asked", say("findings.total-not-asked"), language),
        *_silenced(totals, language),
        (say("findings.total-blocks"), say("findings.blocks", **blocks)),
        (say("findings.total-steps"), f"{totals.steps:,}"),
        (say("findings.total-length"), length(totals.length_um)),
    ]


def _checks(totals: Totals, state: str, name: str, language: Language) -> list[tuple[str, str]]:
    """In how many files each check is in a state; no row where none is."""
    counts: Counter[str] = totals.checks[state]
    parts = [f"{term(check, language)} {count:,}" for check, count in counts.items()]
    return [(name, Words(language)("findings.comma").join(parts))] if parts else []


def _silenced(totals: Totals, language: Language) -> list[tuple[str, str]]:
    parts = silencers(totals.silenced, totals.settings_files, language)
    return [(Words(language)("findings.total-silenced"), parts)] if parts else []


def _columns(rows: Sequence[tuple[str, ...]], width: int, right: tuple[int, ...] = ()) -> list[str]:
    """Rows in columns; the last one is wrapped."""
    widths = [max(map(cells, column)) for column in zip(*rows, strict=True)]
    lines = []
    for *leading, last in rows:
        padded = [_padded(text, widths[at], at in right) + _GAP for at, text in enumerate(leading)]
        lines += wrapped(printable(last), width, "".join(padded))
    return lines


def _padded(text: str, width: int, right: bool) -> str:
    blanks = " " * (width - cells(text))
    return blanks + text if right else text + blanks


_INDENT = "    "


def render(results: Iterable[CheckResult], options: Options) -> Iterator[str]:
    """Text of the results, file by file; a summary where there are several; a table of counts where asked for.

    A file that passes without a finding has a line of its own where it is the only one.
    """
    totals, only = Totals(), ""
    for result in totals.over(results):
        is_silent = not result.findings and result.verdict == "pass"
        if not is_silent:
            yield _lines(_file(result, options))
        elif totals.files.total() == 1:
            only = _lines(_file(result, options))
    if totals.files.total() == 1 and not options.quiet:
        yield only
    if totals.files.total() > 1 and not options.quiet:
        yield _lines(_styled(line, "bold", options) for line in _wrapped(summary(totals, options.language), options))
    if options.quiet or totals.files.total() > 1:  # files that pass have no lines to say it
        for line in counted(totals, options.language):
            yield _lines(_wrapped(line, options))
    if options.statistics:
        yield _lines(table(totals, options.language, options.width))


def _file(result: CheckResult, options: Options) -> Iterator[str]:
    for finding in result.findings:
        if isinstance(finding.fact, ReadAs):
            continue  # told behind the verdict
        excerpt = result.excerpts.get(finding.line)
        for line in finding_lines(result.name, finding, excerpt, options.language, options.width):
            yield painted(line, finding.severity) if options.colour else "".join(part.text for part in line)
    yield from _outcome(result, options)


def _outcome(result: CheckResult, options: Options) -> Iterator[str]:
    """Verdict and how far the check came; then how its text was read, why checks did not end, what silences findings.

    Name and verdict are never parted, however long the name is.
    """
    head = f"{printable(result.name)}: {verdict(result, options.language)}{Words(options.language)('findings.stop')}"
    for line in wrapped(printable(reach(result, options.language)), options.width, head, _INDENT):
        yield _styled(line, COLOURS[result.outcome], options)
    reasons_lines = [] if result.unreadable else reasons(result.coverage.checks, options.language)
    hidden = silenced(result.silenced, (result.settings_file,), options.language)
    for text in filter(None, [read_as(result, options.language), *reasons_lines, hidden]):
        yield from wrapped(printable(text), options.width, _INDENT, _INDENT * 2)


def _wrapped(text: str, options: Options) -> list[str]:
    return wrapped(printable(text), options.width, indent=_INDENT) if text else []


def _styled(text: str, style: str, options: Options) -> str:
    return styled(text, style) if options.colour else text


def _lines(lines: Iterable[str]) -> str:
    return "".join(f"{line}\n" for line in lines)
