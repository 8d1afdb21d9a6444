"""``drycut dialect``."""

from collections import Counter
from collections.abc import Iterator
from typing import TYPE_CHECKING, Final, NamedTuple

import click

from parser.findings.codes import CODES, Check, Severity
from parser.findings.errors import Message
from sim.cli.options import OwnOrNamed
from sim.cli.spoken import SpokenGroup, spoken
from sim.cli.spoken.values import offer_files
from sim.show.terminal.printer import say

if TYPE_CHECKING:
    from parser.dialect.reader import ChosenDialect
    from parser.findings.findings import Finding
    from sim.check.file_check import Job
    from sim.check.result import CheckResult

_READING: Final = (Check.GRAMMAR, Check.ORDER, Check.BLOCKS)
"""Checks whose errors and warnings say that a text does not mean to the dialect what its author wrote."""
_MOST: Final = 20
"""Places that are shown of a file."""


@click.group(cls=SpokenGroup)
def dialect() -> None:
    """Work with dialects of ISO of one's own."""


@dialect.command()
@click.argument("samples", nargs=-1, required=True, metavar="FILE|DIR|GLOB...", shell_complete=offer_files)
@click.option("--dialect", "chosen", type=OwnOrNamed(is_any=True))
def test(samples: tuple[str, ...], chosen: "ChosenDialect | None") -> None:
    """Read samples in a dialect, and show what it could not read of them.

    \b
    drycut dialect test samples/ --dialect makino.toml
    """  # noqa: D301 - click keeps the lines of a paragraph that begins with a backspace
    from sim.check.file_check import check_file
    from sim.cli.check.jobs import NO_OPTIONS, STDIN, jobs_of

    if STDIN in samples:
        raise click.UsageError(Message("tests-no-stdin"))
    jobs = jobs_of(samples, NO_OPTIONS._replace(dialect=chosen)).jobs
    unread = [_unread(job, check_file(_all_shown(job))) for job in jobs]
    for sample in unread:
        for line in sample.lines():
            say(line)
    for line in _sums(unread):
        say(line)
    raise click.exceptions.Exit(int(any(sample.findings for sample in unread)))


def _all_shown(job: "Job") -> "Job":
    """The job with nothing silenced by settings or a baseline: what could not be read is to be seen."""
    from dataclasses import replace

    return job._replace(settings=replace(job.settings, select=(), ignore=(), ignore_here=()), known=frozenset())


class _Sample(NamedTuple):
    """A sample, the findings that say what was not read, and the words that they stand at."""

    result: "CheckResult"
    findings: tuple["Finding", ...]
    words: tuple[str, ...]

    def lines(self) -> Iterator[str]:
        """Its places for people."""
        from parser.findings.catalogue import page, texts
        from parser.text.encoding import printable
        from parser.text.places import place
        from sim.show.texts import Words

        language = spoken()
        for finding, word in list(zip(self.findings, self.words, strict=True))[:_MOST]:
            where = place(printable(self.result.name), finding.line, finding.column)
            found = printable(texts(finding, language).found)
            yield f"{where}: {finding.code}: {page(finding.code, language).title}: {printable(word) or found}"
        if len(self.findings) > _MOST:
            more = Words(language)("findings.more", n=len(self.findings) - _MOST)
            yield f"{printable(self.result.name)}: {more}"


def _unread(job: "Job", result: "CheckResult") -> _Sample:
    found = tuple(
        finding
        for finding in result.findings
        if CODES[finding.code].check in _READING and finding.severity is not Severity.NOTE
    )
    return _Sample(result, found, tuple(_word(result, finding) for finding in found))


def _word(result: "CheckResult", finding: "Finding") -> str:
    """The word that a finding stands at, as written; empty where it stands at none."""
    first = max(0, finding.column - 1)
    return result.excerpts.get(finding.line, "")[first : first + finding.span[1] - finding.span[0]].strip()


def _sums(samples: list[_Sample]) -> Iterator[str]:
    """How often each word was not read, and how many samples were read whole."""
    from parser.text.encoding import printable
    from sim.show.texts import Words

    words = Words(spoken())
    counts = Counter(word for sample in samples for word in sample.words if word)
    files = Counter(word for sample in samples for word in set(sample.words) if word)
    for word, n in sorted(counts.items(), key=lambda pair: (-pair[1], pair[0])):
        yield words("findings.word-unread", word=printable(word), n=n, files=files[word])
    dialects = words("findings.comma").join(sorted({sample.result.dialect for sample in samples} - {""}))
    whole = sum(not sample.findings for sample in samples)
    key = "findings.samples" if len(samples) > 1 else "findings.one-sample"
    yield words(key, n=len(samples), whole=whole, dialects=dialects or "–")
