"""A cut under sparks in words for people: its rows on the terminal, and what happened in it."""

from collections import Counter
from collections.abc import Iterator
from typing import get_args

from parser.findings.catalogue import Bilingual
from parser.text.source import BlockNames
from parser.units import mm, mm_text
from sim.base.units import in_figures
from sim.process.cut import ProcessRun
from sim.process.spread import LEVEL
from sim.setup.key_words import value_word
from sim.setup.spark import EventKind
from sim.show.texts import Words, bilingual
from sim.show.texts.phrases import catalogued, lasting


def spark_rows(process: ProcessRun | None, names: BlockNames, tell: Words) -> list[tuple[str, str]]:
    """Names and figures of a cut; none without one."""
    if process is None:
        return []
    mean = process.mean
    figures = tell(
        "sparks.figures",
        gap=f"{mean.gap_um:.1f}",
        share=f"{100.0 * mean.voltage_share:.0f}",
        open=f"{process.spark.open_v:g}",
        feed=f"{mm(mean.feed_um_s) * 60.0:.3g}",
        rate=f"{mean.area_rate_mm2_min:.3g}",
    )
    time = getattr(lasting(process.time_s), tell.language)
    if process.within is not None:
        least, most = map(lasting, process.within)
        time = tell("sparks.time-within", time=time, least=least, most=most, level=round(100.0 * LEVEL))
    if process.lost_s:
        time = tell("sparks.time-lost", time=time, lost=lasting(process.lost_s))
    return [
        (tell("sparks.cut"), figures),
        (tell("sparks.time"), time),
        *_happened(process, tell),
        *_marks(process, names, tell),
        *_elsewhere(process, tell),
        *_stopped(process, names, tell),
    ]


def _happened(process: ProcessRun, tell: Words) -> Iterator[tuple[str, str]]:
    """Shorts, breaks, and the other events that are listed, each with how often it came."""
    if process.shorts:
        back = f"{mm(process.retreated_um):.3f}"
        yield tell("sparks.shorts"), tell("sparks.shorts-of", count=process.shorts, back=back)
    if process.breaks:
        yield tell("sparks.breaks"), tell("sparks.breaks-of", count=process.breaks)
    others = Counter(each.kind for each in process.moments if each.kind not in {"short", "cleared", "break"})
    if others:
        parts = [tell("sparks.events-of", what=event_words(kind), count=count) for kind, count in others.items()]
        yield tell("sparks.events"), "; ".join(parts)


def _marks(process: ProcessRun, names: BlockNames, tell: Words) -> list[tuple[str, str]]:
    if not process.marks:
        return []
    deepest = max(process.marks, key=lambda mark: mark.depth_um)
    depth, within = in_figures(deepest.depth_um), in_figures(deepest.within_um)
    block, count = names.of_row(deepest.row), len(process.marks)
    return [(tell("sparks.marks"), tell("sparks.marks-of", count=count, depth=depth, within=within, block=block))]


def _elsewhere(process: ProcessRun, tell: Words) -> list[tuple[str, str]]:
    """Where the path lies after skipped blocks, and what the wire ran into on its way to the origin."""
    rows = []
    if process.displaced_um is not None:
        x, y = map(mm_text, process.displaced_um)
        rows.append((tell("sparks.displaced"), tell("sparks.displaced-of", x=x, y=y)))
    if process.collided_um is not None:
        rows.append((tell("sparks.collided"), tell("sparks.collided-of", length=f"{mm(process.collided_um):.2f}")))
    return rows


def _stopped(process: ProcessRun, names: BlockNames, tell: Words) -> list[tuple[str, str]]:
    stopped = process.stopped
    if stopped is None:
        return []
    where = {
        "block": names.of_row(stopped.row),
        "time": lasting(stopped.t_s),
        "why": catalogued(f"stop-{stopped.kind}"),
    }
    return [(tell("sparks.stopped"), tell("sparks.stopped-of", **where))]


def event_words(kind: str) -> Bilingual:
    """What happened, or why the control stopped: kinds of events by the words of settings."""
    if kind in get_args(EventKind):
        return value_word(kind)
    return bilingual("sparks.cleared") if kind == "cleared" else catalogued(f"stop-{kind}")
