"""One line a finding, for grep and for editors: ``part.3b:2:14: error[3B204]: [*] block 2: what was found``.

It begins as a finding of the text format does, so that what finds the one finds the other; ``[*]`` is what ``--fix``
mends.
"""

from collections.abc import Iterable, Iterator

from parser.findings.catalogue import Language, texts
from parser.findings.findings import Finding
from parser.text.encoding import printable
from parser.text.places import place
from sim.check.result import CheckResult
from sim.show.findings.totals import Totals
from sim.show.findings.wording import Options, counted, reasons, summary
from sim.show.terminal.finding import with_block
from sim.show.texts import Words


def render(results: Iterable[CheckResult], options: Options) -> Iterator[str]:
    """A line for each finding and each reason why checks did not come to their end; then what sums up."""
    totals = Totals()
    for result in totals.over(results):
        yield "".join(f"{printable(line)}\n" for line in _file(result, options.language))
    yield "".join(f"{printable(line)}\n" for line in _sums(totals, options.language))


def _file(result: CheckResult, language: Language) -> Iterator[str]:
    for finding in result.findings:
        yield _line(result.name, finding, language)
    for reason in reasons(result.coverage.checks, language):
        say = Words(language)
        yield f"{result.name}: {say('findings.incomplete')}{say('findings.colon')}{reason}"


def _line(name: str, finding: Finding, language: Language) -> str:
    where = place(name, finding.line, finding.column)
    severity = Words(language)(f"findings.{finding.severity}")
    found = with_block(finding, texts(finding, language).found, language)
    return f"{where}: {severity}[{finding.code}]: {'[*] ' if finding.edits else ''}{found}"


def _sums(totals: Totals, language: Language) -> Iterator[str]:
    yield summary(totals, language)
    if totals.fixable:
        yield Words(language)("findings.fixable", n=totals.fixable)
    yield from counted(totals, language)
