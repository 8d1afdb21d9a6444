"""Table of what was found in all files together, in plain columns."""

from collections.abc import Sequence

from parser.findings.catalogue import Language, length, page
from parser.findings.findings import SEVERITIES
from parser.text.excerpt import cells
from sim.show.findings.totals import Totals
from sim.show.findings.wording import verdicts
from sim.show.words import Words

_GAP = "  "


def table(totals: Totals, language: Language) -> str:
    """Counts by code with titles, then files, blocks, steps and path; the lines end with a line feed."""
    lines = [*_codes(totals, language), *_sums(totals, language)]
    return "".join(f"{line}\n" for line in lines)


def _codes(totals: Totals, language: Language) -> list[str]:
    say = Words(language)
    rows = [
        (code, say(f"findings.{SEVERITIES[code]}"), str(count), page(code, language).title)
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
