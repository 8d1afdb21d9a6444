"""A text of PMAC motion programs read: its lines, the path that they make, and all that is wrong with it."""

import math
from bisect import bisect_left
from collections.abc import Iterator, Mapping
from itertools import accumulate

from parser.dialect.reader import (
    PATH_IS_ALL,
    BesideThePath,
    BlockCounts,
    Damage,
    Reading,
    ReadText,
    Spelling,
)
from parser.findings.codes import Check, Severity
from parser.findings.errors import ProgramError
from parser.findings.findings import DamagedBlock, Finding, NotSimulated, file_order
from parser.pmac.lines import Buffer, Text, read_lines
from parser.pmac.moves import speed_findings
from parser.pmac.path import Arc, arc_of, path_of
from parser.pmac.running import holds_routines, run
from parser.pmac.state import State
from parser.text.encoding import no_program, printable
from parser.text.source import Span
from parser.toolpath import Stop, Toolpath

_TIME_UNITS = ("I190", "I5190", "COORD[1].FEEDTIME")
_SEGMENTS = ("I13", "I5113", "COORD[1].SEGMOVETIME")
_MOST_SHOWN, _MOST_NAMED = 40, 8


def read_pmac(text: str) -> ReadText:
    """What a text says. ProgramError (PMC100) where no motion program of it moves anything in the plane."""
    read = read_lines(text)
    buffers = {buffer.number: buffer for buffer in read.buffers}
    mains = _mains(read)
    if not mains:
        raise ProgramError(no_program("no-motion-program", language="PMAC"))
    main = next((buffer for buffer in mains if buffer.number == read.started), mains[0])
    state = run(main, buffers, read.values, read.settings)
    besides = _beside_findings(read, state)
    if not state.moves:
        raise ProgramError(*besides or (no_program("no-motion-program", language="PMAC"),))
    arcs = {row: arc_of(move) for row, move in enumerate(state.moves) if move.motion > 1}
    stops = [*state.stops, Stop("end", len(state.moves), main.lines[-1].line)]
    toolpath = path_of(read.lines.text, state.moves, arcs, stops)
    lost = sorted([*read.unread, *_places(state)])
    reached = list(accumulate((move.at.span[0] for move in state.moves), max))  # loops and calls go back in the text
    damages = tuple(Damage(span, bisect_left(reached, span[0])) for span in lost)
    block = toolpath.source.block.tolist()
    findings = [
        *_text_findings(read, mains, main),
        *_line_findings(read, state),
        *_arc_findings(read, state, arcs, block),
        *besides,
    ]
    findings += [
        read.lines.finding(finding.code, state.moves[finding.row].at.span, block[finding.row], **finding.values)
        for finding in speed_findings(toolpath, state.moves, _time_unit_ms(state))
    ]
    reading = _reading(read, state, toolpath, damages)
    return ReadText(read.lines, reading, {}, toolpath, tuple(sorted(findings, key=file_order)))


def _mains(read: Text) -> list[Buffer]:
    """Programs that no other one calls, and that hold no routines of G words; all of them where each is called."""
    calls = (piece for buffer in read.buffers for line in buffer.lines for piece in line.pieces if piece.name == "CALL")
    called = {int(piece.value) for piece in calls if piece.worked is None}
    programs = [buffer for buffer in read.buffers if not holds_routines(buffer.number)]
    return [buffer for buffer in programs if buffer.number not in called] or programs


def _reading(read: Text, state: State, toolpath: Toolpath, damages: tuple[Damage, ...]) -> Reading:
    blocks = int(toolpath.source.block.max())  # each moves once at least, and many times in a loop or a routine
    return Reading(
        dialect="PMAC",
        counts=BlockCounts(blocks + len(damages), blocks, blocks),
        damages=damages,
        spelling=Spelling(clockwise="CIRCLE1", counter_clockwise="CIRCLE2", end="CLOSE", pause="STOP", rapid="RAPID"),
        is_drawing=False,
        not_asked={
            Check.BLOCKS: "reason-no-words",
            Check.PRINTED_ENDS: "reason-no-prints",
            Check.HEADER: "reason-no-header",
        },
        remarks=read.remarks,
        threadings=sum(move.is_threaded for move in state.moves),
        not_simulated=_not_simulated(read, state),
    )


def _time_unit_ms(state: State) -> float | None:
    """The time unit of F; None where none is given, or one that is none."""
    given = _setting(state, _TIME_UNITS)
    return given if given is not None and given > 0.0 else None


def _setting(state: State, names: tuple[str, ...]) -> float | None:
    return next((state.settings[name] for name in names if name in state.settings), None)


def _text_findings(read: Text, mains: list[Buffer], main: Buffer) -> Iterator[Finding]:
    """PMC101 and PMC103: what is nothing of the language, and buffers that hold more than is written."""
    for span in read.unread:
        excerpt = printable(read.lines.text[slice(*span)])[:_MOST_SHOWN]
        yield read.lines.finding("PMC101", span, text=excerpt).with_fact(DamagedBlock())
    for buffer in read.buffers:
        if not buffer.is_cleared and not read.is_power:
            yield read.lines.finding("PMC103", buffer.span, number=buffer.number, what="buffer-not-cleared")
        if not buffer.is_closed:
            yield read.lines.finding("PMC103", buffer.span, number=buffer.number, what="buffer-not-closed")
    for other in mains:
        if other is not main:
            yield read.lines.finding("PMC105", other.span, number=other.number, first=main.number)


def _beside_findings(read: Text, state: State) -> tuple[Finding, ...]:
    """PMC107 where nobody knows how the program goes on; else at the first piece with a curve of its own."""
    if state.halt is not None:
        at, why, what, more = state.halt.span, state.halt.why, state.halt.what, 0
    elif state.besides:
        at, why, what, more = state.besides[0].span, "pmac-beside", "", len(_places(state)) - 1
    else:
        return ()
    found = read.lines.finding("PMC107", at, text=_excerpt(read, at), why=why, what=what, more=more)
    return (found.with_fact(NotSimulated(otherwise=True)),)


def _places(state: State) -> tuple[Span, ...]:
    """Where pieces stand that are not simulated, each once however often it runs."""
    halted = (state.halt.span,) if state.halt else ()
    return tuple(dict.fromkeys((*(piece.span for piece in state.besides), *halted)))


def _excerpt(read: Text, span: Span) -> str:
    return printable(read.lines.text[slice(*span)]).strip()[:_MOST_SHOWN]


def _not_simulated(read: Text, state: State) -> BesideThePath:
    names = tuple(dict.fromkeys(_excerpt(read, span) for span in _places(state)))
    if not names:
        return PATH_IS_ALL
    return BesideThePath("reason-at-run", names[:_MOST_NAMED] + ("…",) * (len(names) > _MOST_NAMED))


def _line_findings(read: Text, state: State) -> Iterator[Finding]:
    """What the lines themselves have wrong, and PMC106 for axes beside the plane."""
    for each in state.faults_by_span.values():
        found = read.lines.finding(each.code, each.span, 0, **each.values)
        yield found.with_fact(each.fact) if each.fact else found
    others = list(state.others.values())
    for axis in others[:1]:
        word = axis.name if math.isnan(axis.value) else f"{axis.name}{axis.value:g}"
        yield read.lines.finding("PMC106", axis.span, word=word, more=len(others) - 1)


def _wrong_arc(read: Text, span: Span, block: int, arc: Arc) -> Finding:
    """PMC201 to PMC203."""
    if arc.wrong == "spiral":
        off = abs(arc.end_um - arc.start_um)
        return read.lines.finding("PMC201", span, block, start=arc.start_um, end=arc.end_um, off=off)
    by_radius = arc.wrong.startswith("radius")
    return read.lines.finding("PMC203" if by_radius else "PMC202", span, block, what=f"pmac-{arc.wrong}")


def _arc_findings(read: Text, state: State, arcs: Mapping[int, Arc], block: list[int]) -> Iterator[Finding]:
    """PMC201 to PMC203 at each arc that is none, once a block, and PMC207 where none is run as such."""
    wrong = {block[row]: (row, arc) for row, arc in reversed(list(arcs.items())) if arc.wrong}
    for number, (row, arc) in wrong.items():
        yield _wrong_arc(read, state.moves[row].at.span, number, arc)
    segment_ms = _setting(state, _SEGMENTS)
    if arcs and not segment_ms:
        row = next(iter(arcs))
        found = read.lines.finding("PMC207", state.moves[row].at.span, block[row], more=len(arcs) - 1)
        yield found if segment_ms is None else found._replace(graver=Severity.ERROR)
