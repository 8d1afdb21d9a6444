"""Short tables on the terminal: of a shop, of a circular test, of a program for the card.

The summary of a shop on the terminal.

A program for the card on the terminal: its calls, where the axes stand, what it did not look at, how it ended.
"""

import math
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any, Final

from controller.card.log import LONGEST_S
from parser.findings.catalogue import Language
from parser.text.encoding import printable
from parser.units import mm
from sim.clients.run import ClientRun, card_document
from sim.clients.session import Ended, Questions
from sim.run.ballbar.circle import Ballbar
from sim.run.ballbar.figures import NAMES
from sim.show.ballbar_rows import Row, figure_rows, loss_text, part_rows, setup_rows, um
from sim.show.index_page.page import counts_shown, outcome_of
from sim.show.terminal.finding import finding_lines
from sim.show.terminal.layout import paragraph, show, table
from sim.show.terminal.printer import COLOURS, painted, say, styled
from sim.show.terminal.streams import outlet
from sim.show.terminal.wrap import width_of, wrapped
from sim.show.texts import Words

_MOST: Final = 20
_COUNTED: Final = ("pass", "to_check", "fail", "refused", "fault", "from_cache")


def print_batch(index: Mapping[str, Any], output: Path, language: Language) -> None:
    """Print what came of a shop: the programs that did not pass, counts, and where the index is."""
    tell = Words(language)
    bad = [program for program in index["programs"] if outcome_of(program) != "pass"]
    for program in bad[:_MOST]:
        outcome = outcome_of(program)
        verdict = tell(f"batch.verdict-{outcome}")
        told_text = tell("batch.bad", file=program["file"], verdict=verdict, why=_why(program))
        for line in wrapped(told_text, indent="    "):
            say(styled(line, COLOURS.get(outcome, COLOURS["fail"])))
    if len(bad) > _MOST:
        say(tell("batch.more", n=f"{len(bad) - _MOST:,}"))
    counts = counts_shown(index["counts"])
    told_text = tell("phrases.comma").join(
        tell(f"batch.count-{name}", n=f"{counts[name]:,}") for name in _COUNTED if counts[name]
    )
    say(tell("batch.one" if counts["programs"] == 1 else "batch.some", n=f"{counts['programs']:,}", counts=told_text))
    say(tell("batch.written", output=output))


def _why(program: Mapping[str, Any]) -> str:
    """Why a program does not pass, or is to be checked: the message, or its errors or warnings by code."""
    return program["message"] or ", ".join(_codes(program, "warning" if program["to_check"] else "error"))


def _codes(program: Mapping[str, Any], severity: str) -> Iterator[str]:
    for found in program["findings"]:
        if found["severity"] == severity:
            yield found["code"] if found["count"] == 1 else f"{found['code']} ×{found['count']:,}"


def print_ballbar(ballbar: Ballbar, tolerance_um: float | None, language: Language) -> None:
    """Print what was run, its figures and parts, what was lost, and the verdict to stdout."""
    tell = Words(language)
    shown_table = table(tell("ballbar.title-table"))
    for group in _groups(ballbar, tell):
        for row in group:
            shown_table.add_row(row.name, row.value)
        shown_table.add_section()
    show(shown_table)
    for loss in ballbar.losses:
        paragraph(tell("ballbar.loss", loss=loss_text(*loss, tell)), "red")
    no_turn = _no_turn(ballbar, tell)
    if no_turn:
        paragraph(no_turn)
    passed = ballbar.passes(tolerance_um)
    verdict = tell("ballbar.pass" if passed else "ballbar.fail") + _against(ballbar, tolerance_um, tell)
    paragraph(verdict, "bold green" if passed else "bold red")


def _groups(ballbar: Ballbar, tell: Words) -> list[list[Row]]:
    groups = [setup_rows(ballbar, tell)]
    if ballbar.measured is not None:
        figures, parts, interpolation_um = ballbar.measured
        groups.append([Row(tell("ballbar.figures"), ""), *figure_rows(figures, tell)])
        groups.append([Row(tell("ballbar.parts"), ""), *part_rows(parts, interpolation_um, tell)])
    return groups


def _no_turn(ballbar: Ballbar, tell: Words) -> str:
    """Why there are no figures, where there are none."""
    stopped = [tell(f"ballbar.{NAMES[turn.sense]}") for turn in ballbar.turns if not turn.goes_round]
    return tell("ballbar.no-figures", directions=tell("ballbar.and").join(stopped)) if stopped else ""


def _against(ballbar: Ballbar, tolerance_um: float | None, tell: Words) -> str:
    """Circularity against its tolerance, where there are both."""
    if tolerance_um is None or ballbar.measured is None:
        return ""
    found = um(ballbar.measured.figures.circularity_um)
    return tell("ballbar.allowed", found=found, allowed=um(tolerance_um))


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
