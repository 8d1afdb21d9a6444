"""A program for the card on the terminal: its calls, where the axes stand, what it did not look at, how it ended."""

import math
from collections.abc import Iterator

from controller.card.log import LONGEST_S
from parser.findings.catalogue import Language
from parser.text.encoding import printable
from parser.units import mm
from sim.clients.run import ClientRun
from sim.clients.session import Questions
from sim.clients.started import Ended
from sim.clients.table import card_document
from sim.show.terminal.colours import painted, styled
from sim.show.terminal.finding import finding_lines
from sim.show.terminal.layout import paragraph, show, table
from sim.show.terminal.printer import say
from sim.show.terminal.streams import outlet
from sim.show.terminal.wrap import width_of
from sim.show.texts import Words

_MOST_FINDINGS = 20
_DAY_S = 86_400.0


def print_client(done: ClientRun, title: str, longest_s: float, language: Language) -> None:
    """Print what came of a program."""
    words = Words(language)
    shown_table = table(printable(title))
    for row in _rows(done, words):
        shown_table.add_row(*row)
    show(shown_table)
    findings = done.run.findings if done.run else done.read.program.findings
    for finding in findings[:_MOST_FINDINGS]:
        excerpt = done.read.program.excerpt(finding.line) if finding.column else None
        for line in finding_lines(done.read.program.name, finding, excerpt, language, width_of(outlet())):
            say(painted(line, finding.severity))
    if len(findings) > _MOST_FINDINGS:
        paragraph(words("client.more", more=f"{len(findings) - _MOST_FINDINGS:,}"))
    say(styled(_ended(done.ended, printable(title), longest_s, words), "bold"))
    last = done.read.session.events[-1]
    if done.ended.is_stopped and isinstance(last, Questions):
        paragraph(words("client.asking", what=", ".join(last.calls), count=f"{last.count:,}"))


def _ended(ended: Ended, name: str, longest_s: float, words: Words) -> str:
    """How the program ended."""
    if ended.is_stopped:
        return words("client.stopped", name=name, longest=f"{longest_s:g}")
    if ended.signal:
        return words("client.killed", name=name, signal=ended.signal)
    return words("client.ended", name=name, code=str(ended.exit_code))


def _rows(done: ClientRun, words: Words) -> Iterator[tuple[str, str]]:
    card, again, unseen = card_document(done.read, done.ended), done.read.again, done.read.unseen
    counts = {"calls": f"{card['calls']:,}", "time": f"{card['time_s']:.3f}", "asked": f"{card['asked']:,}"}
    yield words("client.calls"), words("client.calls-of", **counts)
    if unseen.refused:
        count, kind = _counted(unseen.refused, len(unseen.refusals))
        yield words("client.refused"), words(f"client.refused-{kind}", **count)
    if again.limits:
        count, kind = _counted(len(again.limits), len(unseen.on_limit))
        yield words("client.limits"), words(f"client.limits-{kind}", **count)
    places = "; ".join(", ".join(f"{place:,}" for place in axes) for axes in again.places)
    yield words("client.axes"), words("client.axes-of", places=places, status=card["status"])
    if not math.isfinite(again.went_on_s):
        yield "", words("client.never-rests", time=f"{LONGEST_S / _DAY_S:.0f}")
    elif again.went_on_s:
        yield "", words("client.went-on", time=f"{again.went_on_s:.3f}")
    if done.run is None:
        yield words("client.path"), words("client.path-none")
        return
    length = f"{mm(done.run.ran_um):,.3f}"
    yield words("client.path"), words("client.path-of", length=length, rows=f"{len(done.run.toolpath):,}")
    off = done.run.deviations.table.max_um
    yield words("client.off"), words("client.off-of", off=f"{off:,.2f}")


def _counted(count: int, unread: int) -> tuple[dict[str, str], str]:
    """How many there were, and how many of them the program did not look at, with the word for it."""
    counts = {"count": f"{count:,}"}
    return (counts | {"unread": f"{unread:,}"}, "unread") if unread else (counts, "of")
