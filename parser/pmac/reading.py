"""A text of PMAC motion programs, read: text to lines, the path that they make, and all that is wrong with it."""

from bisect import bisect_left
from collections.abc import Iterator, Mapping

from parser.dialect.reader import PATH_IS_ALL, Beside, BlockCounts, Damage, Reading, ReadText, Spelling
from parser.findings.codes import Check, Severity
from parser.findings.errors import ProgramError
from parser.findings.facts import DamagedBlock, NotSimulated, TooLarge
from parser.findings.findings import Finding, file_order
from parser.pmac.arcs import Arc, arc_of
from parser.pmac.lines import Buffer, Kind, Text, read_lines
from parser.pmac.moves import run
from parser.pmac.path import path_of
from parser.pmac.routines import holds_routines
from parser.pmac.speed import speed_findings
from parser.pmac.state import State
from parser.text.encoding import no_program, printable
from parser.text.source import Span
from parser.toolpath import Stop, Toolpath
from parser.units import from_mm, mm

_TIME_UNITS = ("I190", "I5190", "COORD[1].FEEDTIME")
_SEGMENTS = ("I13", "I5113", "COORD[1].SEGMOVETIME")
_MOST_SHOWN, _MOST_NAMED = 40, 8
_MOST_UM = {**dict.fromkeys("XYIJ", 1e7), "R": 1e9}
"""Greatest lengths either way, as those of ISO: 10 m of coordinates, 1 km of radii."""


def read_pmac(text: str) -> ReadText:
    """What a text says. ProgramError (3B100) where no motion program of it moves anything in the plane."""
    read = read_lines(text)
    mains = [buffer for buffer in read.buffers if not holds_routines(buffer.number)]
    if not mains:
        raise ProgramError(no_program("no-block"))
    main = mains[0]
    state = run(main, {buffer.number: buffer for buffer in read.buffers if holds_routines(buffer.number)})
    if not state.moves:
        raise ProgramError(*_beside_findings(read)) if read.beside else ProgramError(no_program("no-block"))
    arcs = {row: arc_of(move) for row, move in enumerate(state.moves) if move.motion > 1}
    stops = [*state.stops, Stop("end", len(state.moves), main.lines[-1].line)]
    toolpath = path_of(read.lines.text, state.moves, arcs, stops)
    starts = [move.at.span[0] for move in state.moves]
    lost = sorted([*read.unread, *(piece.span for piece in read.beside)])
    damages = tuple(Damage(span, bisect_left(starts, span[0])) for span in lost)
    findings = [*_text_findings(read, mains), *_told(read, state), *_arc_findings(read, state, arcs)]
    findings += [*_beside_findings(read), *_out_of_range(read, main)]
    findings += [
        read.lines.finding(one.code, state.moves[one.row].at.span, one.row + 1, **one.values)
        for one in speed_findings(toolpath, state.moves, _time_unit_ms(read))
    ]
    reading = _reading(read, state, toolpath, damages)
    return ReadText(read.lines, reading, {}, toolpath, tuple(sorted(findings, key=file_order)))


def _reading(read: Text, state: State, toolpath: Toolpath, damages: tuple[Damage, ...]) -> Reading:
    n = len(toolpath)
    return Reading(
        dialect="PMAC",
        counts=BlockCounts(n + len(damages), n, n),
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
        not_simulated=_not_simulated(read),
    )


def _time_unit_ms(read: Text) -> float | None:
    """The time unit of F; None where none is told, or one that is none."""
    told = _setting(read, _TIME_UNITS)
    return told if told is not None and told > 0.0 else None


def _setting(read: Text, names: tuple[str, ...]) -> float | None:
    return next((read.settings[name] for name in names if name in read.settings), None)


def _text_findings(read: Text, mains: list[Buffer]) -> Iterator[Finding]:
    """PMC101 and PMC103: what is nothing of the language, and buffers that hold more than is written."""
    for span in read.unread:
        shown = printable(read.lines.text[slice(*span)])[:_MOST_SHOWN]
        yield read.lines.finding("PMC101", span, text=shown).with_fact(DamagedBlock())
    for buffer in read.buffers:
        if not buffer.is_cleared and not read.is_power:
            yield read.lines.finding("PMC103", buffer.span, number=buffer.number, what="buffer-not-cleared")
        if not buffer.is_closed:
            yield read.lines.finding("PMC103", buffer.span, number=buffer.number, what="buffer-not-closed")
    for other in mains[1:]:
        yield read.lines.finding("PMC105", other.span, number=other.number, first=mains[0].number)


def _beside_findings(read: Text) -> tuple[Finding, ...]:
    """PMC107 at the first of the pieces that are not simulated."""
    if not read.beside:
        return ()
    text, more = _names(read)[0], len(read.beside) - 1
    found = read.lines.finding("PMC107", read.beside[0].span, text=text, more=more)
    return (found.with_fact(NotSimulated(otherwise=True)),)


def _names(read: Text) -> tuple[str, ...]:
    """What is not simulated, as it is written, each once."""
    shown = (printable(read.lines.text[slice(*piece.span)]).strip()[:_MOST_SHOWN] for piece in read.beside)
    return tuple(dict.fromkeys(shown))


def _not_simulated(read: Text) -> Beside:
    if not read.beside:
        return PATH_IS_ALL
    names = _names(read)
    return Beside("reason-macros", names[:_MOST_NAMED] + ("…",) * (len(names) > _MOST_NAMED))


def _out_of_range(read: Text, main: Buffer) -> Iterator[Finding]:
    """PMC108 at lengths beyond any table, and radii beyond any arc that is meant."""
    words = (piece for line in main.lines for piece in line.pieces if piece.kind is Kind.WORD)
    for piece in words:
        most_um = _MOST_UM.get(piece.name)
        if most_um is not None and abs(from_mm(piece.value)) > most_um:
            limits = f"±{mm(most_um) / 1000.0:g} m"
            found = read.lines.finding("PMC108", piece.span, word=f"{piece.name}{piece.value:g}", limits=limits)
            yield found.with_fact(TooLarge())


def _told(read: Text, state: State) -> Iterator[Finding]:
    """What the lines themselves have wrong, and PMC106 for axes beside the plane."""
    for one in state.told:
        yield read.lines.finding(one.code, one.span, 0, **one.values)
    for axis in state.others[:1]:
        yield read.lines.finding("PMC106", axis.span, word=f"{axis.name}{axis.value:g}", more=len(state.others) - 1)


def _wrong_arc(read: Text, span: Span, row: int, arc: Arc) -> Finding:
    """PMC201 to PMC203."""
    if arc.wrong == "spiral":
        off = abs(arc.end_um - arc.start_um)
        return read.lines.finding("PMC201", span, row + 1, start=arc.start_um, end=arc.end_um, off=off)
    by_radius = arc.wrong.startswith("radius")
    return read.lines.finding("PMC203" if by_radius else "PMC202", span, row + 1, what=f"pmac-{arc.wrong}")


def _arc_findings(read: Text, state: State, arcs: Mapping[int, Arc]) -> Iterator[Finding]:
    """PMC201 to PMC203 at each arc that is none, and PMC207 where none is run as such."""
    for row, arc in arcs.items():
        if arc.wrong:
            yield _wrong_arc(read, state.moves[row].at.span, row, arc)
    segment_ms = _setting(read, _SEGMENTS)
    if arcs and not segment_ms:
        row = next(iter(arcs))
        found = read.lines.finding("PMC207", state.moves[row].at.span, row + 1, more=len(arcs) - 1)
        yield found if segment_ms is None else found._replace(graver=Severity.ERROR)
