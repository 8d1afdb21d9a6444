"""Routines that G, M, T and D words call: programs of their own, with a label for each word."""

from collections.abc import Iterator, Mapping

from parser.pmac.lines import Buffer, Kind, Piece

ROUTINES: Mapping[str, int] = {"G": 1000, "M": 1001, "T": 1002, "D": 1003}
"""Programs that hold the routines of G, M, T and D words, by letter (PMAC User's Manual, p. 204)."""


def holds_routines(number: int) -> bool:
    """Whether a program of this number holds routines: 1000 to 1003, and 1010, 1020 … of words of 100 and more."""
    return 1000 <= number < 1100 and 1000 + number % 10 in ROUTINES.values()


def called_by(piece: Piece) -> tuple[int, int]:
    """The program and the label that a G, M, T or D word calls: G123 is label 23000 of program 1010."""
    hundred, below = divmod(int(abs(piece.value)), 100)
    return ROUTINES[piece.name] + 10 * hundred, below * 1000


class Routines:
    """The routines of a text, each looked up once.

    Parameters
    ----------
    buffers
        Programs that hold routines, by their numbers.
    """

    def __init__(self, buffers: Mapping[int, Buffer]) -> None:
        self._buffers = buffers
        self._bodies: dict[tuple[int, int], list[Piece] | None] = {}

    def body(self, program: int, label: int) -> list[Piece] | None:
        """The commands from a label up to the return; None where the text holds none. Label 0 is at the top."""
        if (program, label) not in self._bodies:
            buffer = self._buffers.get(program)
            self._bodies[program, label] = _body(buffer, label) if buffer else None
        return self._bodies[program, label]


def _body(buffer: Buffer, label: int) -> list[Piece] | None:
    body: list[Piece] = []
    inside = label == 0
    for piece in _pieces(buffer):
        if piece.kind is Kind.LABEL:
            inside = inside or piece.value == label
        elif inside and piece.name in {"RET", "RETURN"}:
            return body
        elif inside:
            body.append(piece)
    return body if inside else None


def _pieces(buffer: Buffer) -> Iterator[Piece]:
    return (piece for line in buffer.lines for piece in line.pieces)
