"""A session as a text to read, a line for each event, and as a program whose blocks are the calls that moved."""

from dataclasses import fields, replace
from typing import Final

import numpy as np

from parser.dialect.reader import BlockCounts, Reading, Spelling
from parser.findings.codes import Check
from parser.findings.findings import Finding
from parser.geometry.curves import Bools, CurveKind, Curves
from parser.program import Program
from parser.text.lines import LineIndex
from parser.text.source import Source
from parser.toolpath import Toolpath
from sim.clients.repeated import Again
from sim.clients.session import Event, Questions, Session

NAME: Final = "calls.txt"
"""Of the text, as a file."""
_DIALECT: Final = "GE card"
_NOT_ASKED: Final = (
    Check.GRAMMAR,
    Check.ORDER,
    Check.HEADER,
    Check.BLOCKS,
    Check.PRINTED_ENDS,
    Check.CONTOURS,
    Check.SENSES,
    Check.CROSSINGS,
    Check.PASSES,
    Check.CORNERS,
)


def listing_of(session: Session) -> str:
    """The events of a session, one a line: time, s, and the call with its answer, or what was asked and how often."""
    return "".join(f"{_line(event)}\n" for event in session.events)


def _line(event: Event) -> str:
    if isinstance(event, Questions):
        questions_text = ", ".join(
            f"{text} ×{times.often}" if times.often > 1 else text for text, times in event.calls.items()
        )
        return f"{event.t_s:12.6f}  ? {questions_text}"
    call = event.call
    arguments = ", ".join(map(repr, call.arguments))
    answer = f" = {call.answer!r}" if call.answer is not None else ""
    return f"{call.t_s:12.6f}  {call.name}({arguments}){answer}"


def program_of(session: Session, again: Again, findings: tuple[Finding, ...] = ()) -> Program:
    """The session as a program: its text is the listing, and each row of its path came from a call."""
    text = listing_of(session)
    lines = LineIndex(text)
    toolpath = _toolpath(text, lines, session, again)
    n = len(toolpath)
    return Program(
        name=NAME,
        encoding="utf-8",
        text=text,
        lines=lines,
        reading=Reading(
            dialect=_DIALECT,
            counts=BlockCounts(n, n, n),
            damages=(),
            spelling=Spelling(
                clockwise="GT_ArcXY", counter_clockwise="GT_ArcXY", end="GT_Close", pause="GT_StpMtn", rapid="GT_LnXYG0"
            ),
            is_drawing=False,
            not_asked=dict.fromkeys(_NOT_ASKED, "reason-calls"),
        ),
        header={},
        toolpath=toolpath,
        findings=findings,
        mender=None,
    )


def _toolpath(text: str, lines: LineIndex, session: Session, again: Again) -> Toolpath:
    way, n = again.way, len(again.way.call)
    line_of = {id(event): number for number, event in enumerate(session.events, start=1)}
    made = [again.limit_calls[call - 1] for call in way.call.tolist()]
    line = np.array([line_of[id(each)] for each in made], dtype=np.int64)
    spans = np.array([_span(text, lines, int(number)) for number in line], dtype=np.int64).reshape(-1, 2)
    names = [each.call.name for each in made]
    positions = np.array([name.startswith("GT_Mv") or "G0" in name for name in names], dtype=np.bool_)
    curves = _with_jumps(way.curves, positions)
    return Toolpath(
        **{field.name: getattr(curves, field.name) for field in fields(Curves)},
        printed_end_um=np.full((n, 2), np.nan),
        words=None,
        source=Source(text, np.arange(1, n + 1), spans, line, ("",) * n),
        stops=(),
    )


def _with_jumps(curves: Curves, positions: Bools) -> Curves:
    """Positioning moves and rapid lines as jumps: there nothing is cut."""
    return replace(curves, kind=np.where(positions & ~curves.is_arc, CurveKind.JUMP, curves.kind).astype(np.int64))


def _span(text: str, lines: LineIndex, number: int) -> tuple[int, int]:
    """The call of a line, without its time."""
    first, past = lines.bounds(number)
    return first + text[first:past].index("GT_"), past
