"""ISO programs that compensate themselves, written out for tests; coordinates in µm, in G90."""

from collections.abc import Iterable, Sequence

Place = tuple[int, int]


def head(*registers: str) -> list[str]:
    """The registers of a program, such as ``H1=100``, and its first place, at 0, 0."""
    return [*registers, "G92 X0 Y0", "G90"]


def around(places: Sequence[Place], side: str = "G41", register: str = "H1", out: Place | None = None) -> list[str]:
    """One way along places, the first of which the set-up leads to; the cancel leads `out`, at 0, 0 where left out."""
    (x, y), rest, (out_x, out_y) = places[0], places[1:], out or (0, 0)
    return [f"{side} G01 X{x} Y{y} {register}", *lines(rest), f"G40 X{out_x} Y{out_y}"]


def lines(places: Iterable[Place]) -> list[str]:
    """Lines to places."""
    return [f"G01 X{x} Y{y}" for x, y in places]


def program(*blocks: Sequence[str]) -> str:
    """A program of such blocks, with its end."""
    return "\n".join([block for part in blocks for block in part] + ["M02", ""])


DIE: tuple[Place, ...] = ((5000, 0), (5000, 5000), (-5000, 5000), (-5000, -5000), (5000, -5000), (5000, 0))
"""A square hole of 10 mm about the start, counter-clockwise from the middle of its right side."""


def die(side: str = "G41", by: str = "H1=100") -> str:
    """The square hole, cut once."""
    return program(head(by), around(DIE, side))
