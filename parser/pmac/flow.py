"""Lines of a buffer to orders: pieces one by one, the ends of lines, and where conditions and loops go on.

``IF``, ``ELSE`` and ``WHILE`` with commands behind them in their line end with the line; else ``ENDIF`` and
``ENDWHILE`` end them, or braces on Power PMAC. ``AND`` and ``OR`` behind them, also in lines of their own, are of their
condition (Turbo PMAC Software Reference Manual, program commands).
"""

from enum import IntEnum
from typing import NamedTuple

from parser.pmac.expressions import Worked, every, some
from parser.pmac.lines import Buffer, Kind, Line, Piece

OrderKind = IntEnum("OrderKind", ["PIECE", "LINE_END", "TEST", "GO", "STUCK"])
"""An order does a piece, ends a line, goes elsewhere where a condition does not hold, goes elsewhere, or is a branch
that nobody can follow: its beginning or its end is missing, or there are two ways to read it."""

_MOST_NESTED = 32  # branches in one another
_IF_ENDS = frozenset({"ELSE", "ENDIF", "ENDI"})
_WHILE_ENDS = frozenset({"ENDWHILE", "ENDW"})
_BRACE = frozenset({"}"})
_NOTHING = frozenset[str]()


class Order(NamedTuple):
    """One thing to do.

    Attributes
    ----------
    kind
        What it is.
    line
        Line that it stands in.
    piece
        The piece to do; IF, WHILE, or what cannot be followed. None at the end of a line.
    worked
        The condition, with its AND and OR; None of others.
    target
        Where it goes on: of a condition, where it does not hold.
    past
        Of a condition, the order behind all that depends on it.
    """

    kind: OrderKind
    line: Line
    piece: Piece | None = None
    worked: Worked | None = None
    target: int = 0
    past: int = 0


class Orders(NamedTuple):
    """A buffer as it runs: its orders, and the order at each label; the first of two alike."""

    orders: tuple[Order, ...]
    labels: dict[int, int]


def orders_of(buffer: Buffer) -> Orders:
    """The orders of a buffer."""
    work = _Work(buffer)
    work.statements(_NOTHING)
    return Orders(tuple(work.orders), work.labels)


class _Work:
    """Reads by recursive descent; pieces one by one, None at the end of each line."""

    def __init__(self, buffer: Buffer) -> None:
        self.tokens = [(line, piece) for line in buffer.lines for piece in (*line.pieces, None)]
        self.at = 0
        self.orders: list[Order] = []
        self.labels: dict[int, int] = {}
        self.open_ifs = self.depth = 0

    def statements(self, ends: frozenset[str], *, in_line: bool = False) -> str:
        """Orders up to a piece of these names, which it returns, or up to the end of the line; empty at the end."""
        while self.at < len(self.tokens):
            line, piece = self.tokens[self.at]
            if piece is None and in_line:
                return ""
            if piece is not None and piece.kind is Kind.FLOW and piece.name in ends:
                return piece.name
            if piece is not None and piece.kind is Kind.TEST and piece.name in {"IF", "WHILE"}:
                self._branch()
            else:
                self._plain(line, piece)
        return ""

    def _plain(self, line: Line, piece: Piece | None) -> None:
        self.at += 1
        if piece is None:
            self.orders.append(Order(OrderKind.LINE_END, line))
        elif piece.kind in {Kind.FLOW, Kind.TEST}:
            self.orders.append(Order(OrderKind.STUCK, line, piece))
        else:
            if piece.kind is Kind.LABEL:
                self.labels.setdefault(int(piece.value), len(self.orders))
            self.orders.append(Order(OrderKind.PIECE, line, piece))

    def _branch(self) -> None:
        line, piece = self.tokens[self.at]
        if piece is None or self.depth == _MOST_NESTED:
            self._plain(line, piece)
            return
        self.depth += 1
        test = len(self.orders)
        self.at += 1
        condition = self._condition(piece)
        self.orders.append(Order(OrderKind.TEST, line, piece, condition))
        is_whole = self._loop(test) if piece.name == "WHILE" else self._if(test)
        if is_whole:
            self._set(test, past=len(self.orders))
        else:
            self.orders[test] = Order(OrderKind.STUCK, line, piece)
        self.depth -= 1

    def _condition(self, first: Piece) -> Worked:
        """The condition with the AND and OR that follow, AND before OR."""
        groups = [[_worked(first)]]
        while (piece := self._next()) and piece.kind is Kind.TEST and piece.name in {"AND", "OR"}:
            self._skip_ends()
            self.at += 1
            if piece.name == "OR":
                groups.append([])
            groups[-1].append(_worked(piece))
        return some([every(group) for group in groups])

    def _loop(self, test: int) -> bool:
        """The body of a WHILE; whether it has an end."""
        if self._body(_WHILE_ENDS) is None:
            return False
        self._end_line()
        self._go(test)
        self._set(test, target=len(self.orders))
        return True

    def _if(self, test: int) -> bool:
        """The branches of an IF; whether they have an end that can be told."""
        end = self._body(_IF_ENDS)
        if end is None:
            return False
        following = self._next()
        is_else = following is not None and following.kind is Kind.FLOW and following.name == "ELSE"
        if end == "ELSE" or (is_else and end in {"line", "}"}):
            if end == "line" and self.open_ifs:
                return False  # of this IF or of that around it
            self._end_line()
            return self._else(test)
        self._set(test, target=len(self.orders))
        return True

    def _else(self, test: int) -> bool:
        self._skip_ends()
        line, _ = self.tokens[self.at]
        self.at += 1
        go = len(self.orders)
        self._go(go)
        self._set(test, target=len(self.orders))
        self.orders.append(Order(OrderKind.LINE_END, line))
        end = self._body(frozenset({"ENDIF", "ENDI"}))
        if end is None:
            return False
        following = self._next()
        if end == "line" and following is not None and following.name in {"ENDIF", "ENDI"}:
            if self.open_ifs:
                return False  # of this ELSE or of the IF around it
            self._end_line()
            self.at += 1
        self._set(go, target=len(self.orders))
        return True

    def _body(self, ends: frozenset[str]) -> str | None:
        """The orders of a branch; by what it ends: ``line``, a brace, or one of `ends`, taken unless it is ELSE."""
        following = self._next()
        if following is not None and following.name == "{":
            self._skip_ends()
            self.at += 1
            return self._closed(self.statements(_BRACE))
        if self.at < len(self.tokens) and self.tokens[self.at][1] is not None:
            self.statements(_NOTHING, in_line=True)
            return "line"
        is_if = "ENDIF" in ends
        self.open_ifs += is_if
        end = self.statements(ends)
        self.open_ifs -= is_if
        return self._closed(end)

    def _closed(self, end: str) -> str | None:
        self.at += bool(end) and end != "ELSE"
        return end or None

    def _next(self) -> Piece | None:
        """The piece that follows, in this line or a later one."""
        return next((piece for _, piece in self.tokens[self.at : self.at + 2] if piece is not None), None)

    def _skip_ends(self) -> None:
        while self.tokens[self.at][1] is None:
            self.at += 1

    def _end_line(self) -> None:
        """An end of the line in front of where it goes on elsewhere: what it moves, it moves first."""
        line, _ = self.tokens[min(self.at, len(self.tokens) - 1)]
        self.orders.append(Order(OrderKind.LINE_END, line))

    def _go(self, target: int) -> None:
        line, _ = self.tokens[min(self.at, len(self.tokens) - 1)]
        self.orders.append(Order(OrderKind.GO, line, target=target))

    def _set(self, at: int, *, target: int | None = None, past: int | None = None) -> None:
        order = self.orders[at]
        self.orders[at] = order._replace(
            target=order.target if target is None else target, past=order.past if past is None else past
        )


def _worked(piece: Piece) -> Worked:
    """The condition of IF, WHILE, AND or OR; these are read with one."""
    return piece.worked or (lambda _: 0.0)
