"""Routines that G, M, T and D words call: programs of their own, with a label for each word."""

from collections.abc import Mapping

from parser.pmac.lines import Piece

ROUTINES: Mapping[str, int] = {"G": 1000, "M": 1001, "T": 1002, "D": 1003}
"""Programs that hold the routines of G, M, T and D words, by letter (PMAC User's Manual, p. 204)."""


def holds_routines(number: int) -> bool:
    """Whether a program of this number holds routines: 1000 to 1003, and 1010, 1020 … of words of 100 and more."""
    return 1000 <= number < 1100 and 1000 + number % 10 in ROUTINES.values()


def called_by(piece: Piece) -> tuple[int, int]:
    """The program and the label that a G, M, T or D word calls: G123 is label 23000 of program 1010."""
    hundred, below = divmod(int(abs(piece.value)), 100)
    return ROUTINES[piece.name] + 10 * hundred, below * 1000
