"""A motion program as the card runs it: conditions, loops, jumps, calls and variables, as far as the text gives them.

What a text does not say is asked of nobody: where the way of the wire depends on it, the run halts there (docs/pmac.md
§7).

Routines that G, M, T and D words call: programs of their own, with a label for each word.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field

from parser.findings.findings import Value
from parser.pmac.expressions import UnknownValue, Values, indexed
from parser.pmac.flow import Order, OrderKind, Orders, orders_of
from parser.pmac.lines import NAMED_ELSEWHERE, Buffer, Kind, Line, Piece
from parser.pmac.moves import MovedLine
from parser.pmac.state import Halt, State
from parser.text.source import Span

ROUTINES: Mapping[str, int] = {"G": 1000, "M": 1001, "T": 1002, "D": 1003}
"""Programs that hold the routines of G, M, T and D words, by letter (PMAC User's Manual, p. 204)."""


def holds_routines(number: int) -> bool:
    """Whether a program of this number holds routines: 1000 to 1003, and 1010, 1020 … of words of 100 and more."""
    return 1000 <= number < 1100 and 1000 + number % 10 in ROUTINES.values()


def called_by(piece: Piece) -> tuple[int, int]:
    """The program and the label that a G, M, T or D word calls: G123 is label 23000 of program 1010."""
    hundred, below = divmod(int(abs(piece.value)), 100)
    return ROUTINES[piece.name] + 10 * hundred, below * 1000


_MOST_ORDERS = 1_000_000  # loops of a few lines may stand for more than anyone waits for
_DEEPEST = 15  # calls in one another (Turbo PMAC Software Reference Manual, CALL)
_IDLE = frozenset({"DWELL", "DELAY"})
_PER_UNIT = 100_000  # labels of a program in the fraction of CALL


def run(main: Buffer, buffers: Mapping[int, Buffer], values: Values, settings: Mapping[str, float]) -> State:
    """What a program makes of the values and settings that are in force at its start; it may call those of `buffers`.

    The run changes `values`.
    """
    runner = _Runner(buffers, State(values, dict(settings)))
    runner.enter(main, 0, None)
    while runner.frames and runner.state.halt is None:
        runner.step()
    return runner.state


@dataclass
class _Frame:
    """A program that runs, or is called.

    Attributes
    ----------
    buffer, orders, at
        What runs, and the order that comes next.
    called
        Program and label that were called; None of the main program.
    called_at
        The line, and the place of its word, that calls a routine by a G, M, T or D word; None of others.
    modes
        Those that this line has set.
    line, running
        What the line that runs makes, None between lines; and the line of the text.
    seen
        By each order that was jumped to, how often the values had changed by then.
    """

    buffer: Buffer
    orders: Orders
    at: int
    called: tuple[int, int] | None
    called_at: tuple[Line, Span] | None = None
    modes: dict[str, Piece] | None = None
    line: MovedLine | None = None
    running: Line | None = None
    seen: dict[int, int] = field(default_factory=dict)


class _Runner:
    def __init__(self, buffers: Mapping[int, Buffer], state: State) -> None:
        self.buffers, self.state = buffers, state
        self.frames: list[_Frame] = []
        self.done = 0
        self._orders: dict[int, Orders] = {}

    def enter(self, buffer: Buffer, at: int, called: tuple[int, int] | None) -> None:
        """Begins a buffer that runs by itself, at one of its orders."""
        self.frames.append(_Frame(buffer, self.orders(buffer), at, called))

    def orders(self, buffer: Buffer) -> Orders:
        """The orders of a buffer, made once."""
        known = self._orders.get(id(buffer))
        if known is None:
            known = self._orders[id(buffer)] = orders_of(buffer)
        return known

    def step(self) -> None:
        """One order of the program that runs."""
        frame = self.frames[-1]
        if frame.at >= len(frame.orders.orders):
            self._leave(frame)
            return
        order = frame.orders.orders[frame.at]
        frame.at += 1
        self.done += 1
        if self.done > _MOST_ORDERS:
            self._halt(order, "pmac-too-long")
        elif order.kind is OrderKind.PIECE and order.piece:
            self._piece(frame, order, order.piece)
        elif order.kind is OrderKind.LINE_END:
            self._end_line(frame)
        elif order.kind is OrderKind.TEST:
            self._test(frame, order)
        elif order.kind is OrderKind.GO:
            self._go(frame, order, order.target)
        else:
            self._halt(order, "pmac-branch")

    def _piece(self, frame: _Frame, order: Order, piece: Piece) -> None:
        try:
            if piece.kind is Kind.ASSIGN:
                self._assign(piece)
            elif piece.kind is Kind.CALL:
                self._call(frame, order, piece)
            elif piece.kind is Kind.READ:
                self._read(piece)
            elif piece.kind is Kind.BESIDE:
                self._note_beside(order, piece)
            elif piece.name in {"RET", "RETURN"}:
                self._leave(frame)
            elif piece.kind is Kind.WORD and piece.name in ROUTINES and not self._line(frame, order.line).is_normal:
                self._call_word(frame, order, piece)
            else:
                self._line(frame, order.line).take(piece)
        except UnknownValue as unknown:
            self._halt(order, f"pmac-{unknown.why}", unknown.what)

    def _line(self, frame: _Frame, line: Line) -> MovedLine:
        """The line that runs; another one begins where the order stands in it."""
        if frame.line is None or frame.running is not line:
            self._end_line(frame)
            frame.running = line
            if frame.called_at:
                at, span = frame.called_at
                frame.line = MovedLine(self.state, at, called_at=span, modes=frame.modes)
            else:
                frame.line = MovedLine(self.state, line)
        return frame.line

    def _end_line(self, frame: _Frame) -> None:
        if frame.line is not None:
            frame.line.finish()
            frame.line = None

    def _leave(self, frame: _Frame) -> None:
        """The return of a program, or its end."""
        self._end_line(frame)
        self.frames.pop()

    def _assign(self, piece: Piece) -> None:
        """A variable gets a value; one that nobody knows where the sum is not known."""
        values = self.state.values
        try:
            name = indexed(piece.name, piece.numbered(values)) if piece.numbered else piece.name
        except UnknownValue:
            values.forget_all(piece.name)
            return
        try:
            values.set(name, piece.worked(values) if piece.worked else 0.0)
        except UnknownValue:
            values.forget(name)
        else:
            if name[0] == "I" and not self.state.moves:
                self.state.settings[name] = values.value(name)

    def _test(self, frame: _Frame, order: Order) -> None:
        """Goes on behind a condition, or elsewhere; past all of it where it is not known and moves nothing."""
        holds = 0.0
        try:
            holds = order.worked(self.state.values) if order.worked else 0.0
        except UnknownValue as unknown:
            inside = frame.orders.orders[frame.at : order.past]
            if not all(map(_moves_nothing, inside)):
                self._halt(order, f"pmac-{unknown.why}", unknown.what)
                return
            self._forget(inside)
            frame.at = order.past
            return
        if not holds:
            frame.at = order.target

    def _forget(self, orders: tuple[Order, ...]) -> None:
        for order in orders:
            if order.piece and order.piece.kind is Kind.ASSIGN:
                if order.piece.numbered:
                    self.state.values.forget_all(order.piece.name)
                else:
                    self.state.values.forget(order.piece.name)

    def _go(self, frame: _Frame, order: Order, target: int) -> None:
        """Goes on elsewhere; a loop in which no value changes never ends."""
        if frame.seen.get(target) == self.state.values.changes:
            self._halt(order, "pmac-endless")
        frame.seen[target] = self.state.values.changes
        frame.at = target

    def _call(self, frame: _Frame, order: Order, piece: Piece) -> None:
        """GOTO and GOSUB in the program itself, CALL of another; one that is not there halts the run."""
        number = piece.worked(self.state.values) if piece.worked else piece.value
        if piece.name == "CALL":
            program = int(number)
            label = round((number - program) * _PER_UNIT)
            buffer = self.buffers.get(program)
        else:
            program, label, buffer = frame.buffer.number, round(number), frame.buffer
        at = self._at(buffer, label)
        if buffer is None:
            self._halt(order, "pmac-no-program", f"PROG {program}")
        elif at is None:
            self._halt(order, "pmac-no-label", f"N{label}")
        elif piece.name == "GOTO":
            self._end_line(frame)
            self._go(frame, order, at)
        elif len(self.frames) > _DEEPEST:
            self._halt(order, "call-recursive")
        else:
            self.enter(buffer, at, (program, label))

    def _at(self, buffer: Buffer | None, label: int) -> int | None:
        """The order at a label; label 0 is at the top where none is written."""
        return None if buffer is None else self.orders(buffer).labels.get(label, 0 if label == 0 else None)

    def _call_word(self, frame: _Frame, order: Order, piece: Piece) -> None:
        """The routine of a G, M, T or D word; PMC102 where it cannot be run, which the card leaves out in silence."""
        piece = piece._replace(value=piece.worked(self.state.values)) if piece.worked else piece
        program, label = called_by(piece)
        buffer = self.buffers.get(program)
        at = self._at(buffer, label)
        line = self._line(frame, order.line)
        why = "call-recursive" if any(other.called == (program, label) for other in self.frames) else ""
        if buffer is None or at is None or why:
            word, base = f"{piece.name}{piece.value:02g}", ROUTINES[piece.name]
            values: dict[str, Value] = {
                "word": word,
                "program": base,
                "label": f"N{label}",
                "what": why or "call-without-routine",
            }
            self.state.finding("PMC102", line.called_at or piece.span, values)
            return
        at_line, span = frame.called_at or (order.line, piece.span)
        routine = _Frame(buffer, self.orders(buffer), at, (program, label), (at_line, span), line.modes)
        self.frames.append(routine)

    def _read(self, piece: Piece) -> None:
        """READ: the words of the calling line that follow go to Q101 for A up to Q126 for Z, and are done."""
        letters, values, found = piece.name[5:-1].split(","), self.state.values, 0
        caller = self.frames[-2] if len(self.frames) > 1 else None
        while caller and (word := _following(caller)) and word.name in letters:
            place = ord(word.name) - ord("A")
            found |= 1 << place
            try:
                values.set(f"Q{101 + place}", word.worked(values) if word.worked else word.value)
            except UnknownValue:
                values.forget(f"Q{101 + place}")
            caller.at += 1
        values.set("Q100", float(found))

    def _note_beside(self, order: Order, piece: Piece) -> None:
        if piece.name == NAMED_ELSEWHERE:
            self._halt(order, "pmac-included")
        else:
            self.state.besides.append(piece)

    def _halt(self, order: Order, why: str, what: str = "") -> None:
        self.frames[-1].line = None  # what the line moves is not known
        self.state.halt = Halt(order.piece.span if order.piece else order.line.span, why, what)


def _following(frame: _Frame) -> Piece | None:
    """The word that comes next in the line of a frame; None where none does."""
    order = frame.orders.orders[frame.at] if frame.at < len(frame.orders.orders) else None
    return order.piece if order and order.piece and order.piece.kind is Kind.WORD else None


def _moves_nothing(order: Order) -> bool:
    """Whether an order changes variables at most: what follows is the same whether it is done or not, but for these."""
    piece = order.piece
    if order.kind is OrderKind.STUCK:
        return False
    if order.kind is not OrderKind.PIECE or piece is None:
        return True
    return piece.kind in {Kind.ASSIGN, Kind.MUTE} or piece.name in _IDLE
