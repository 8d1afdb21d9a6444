"""What was found in all files together, counted, in plain columns."""

from collections import Counter
from collections.abc import Sequence

from parser.findings.catalogue import Language, length, page, term
from parser.text.encoding import printable
from parser.text.excerpt import cells
from sim.show.findings.totals import BLOCKS, Totals
from sim.show.findings.wording import silencers, verdicts
from sim.show.terminal.wrap import wrapped
from sim.show.words import Words

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
