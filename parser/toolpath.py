"""The toolpath: every block of a program in absolute µm, as columns, one row a block.

This is the one type that leaves the parser. Readers of any dialect fill it; nothing behind it knows how they spell.
"""

from collections.abc import Iterator
from dataclasses import dataclass, fields
from typing import Literal, NamedTuple

import numpy as np

from parser.controller_words import Compensation, StepWords, Taper
from parser.geometry.curves import Bools, CurveKind, Curves, Floats, Ints
from parser.text.source import Source

_NO_COLUMNS = ("words", "source", "stops", "compensation", "told_center_um", "taper", "upper")


class Stop(NamedTuple):
    """A pause or the end between blocks.

    Attributes
    ----------
    kind
        ``pause`` or ``end``.
    after
        How many blocks run before it.
    line
        Source line, from 1.
    """

    kind: Literal["pause", "end"]
    after: int
    line: int


class Point(NamedTuple):
    """A place in µm."""

    x: float
    y: float


class Block(NamedTuple):
    """One row of the toolpath, for reading code; loops over many blocks use the columns.

    Lengths are µm, angles rad; `sweep_rad` is positive counter-clockwise; centre, radius and angles are None on lines.
    """

    number: int
    kind: CurveKind
    start_um: Point
    end_um: Point
    length_um: float
    center_um: Point | None
    radius_um: float | None
    start_angle_rad: float | None
    end_angle_rad: float | None
    sweep_rad: float | None
    is_major: bool
    printed_end_um: Point | None
    line: int
    label: str
    text: str


@dataclass(frozen=True, slots=True, eq=False)
class Toolpath(Curves):
    """Geometry of a program: n curves, `start_um[i]` equal to `end_um[i - 1]`.

    Attributes
    ----------
    printed_end_um
        (n, 2) float64, the end that the program prints beside the block; NaN where it prints none.
    words, source, stops
        What the program tells a controller that counts steps, None where its dialect has no such words; where it is
        written; pauses and the end, in order.
    compensation
        What the program tells a controller that compensates; None where it tells nothing of it.
    told_center_um
        (n, 2) float64, centres as the program names them, NaN where it names none; None where it cannot. The exact
        ones are moved until start and end are equally far.
    taper
        By which angles the program leans the wire; None where it does not.
    upper
        n curves, the contour of the upper plane, each run in the time of its own row; None where the program has one
        contour.
    """

    printed_end_um: Floats
    words: StepWords | None
    source: Source
    stops: tuple[Stop, ...]
    compensation: Compensation | None = None
    told_center_um: Floats | None = None
    taper: Taper | None = None
    upper: Curves | None = None

    def __post_init__(self) -> None:
        """Freeze the columns, and raise ValueError with their lengths where they are not all the same."""
        columns = {f.name: getattr(self, f.name) for f in fields(self) if f.name not in _NO_COLUMNS}
        if self.words is not None:
            columns |= {f"words.{f.name}": getattr(self.words, f.name) for f in fields(self.words)}
        if self.compensation is not None:
            columns |= {
                f"compensation.{name}": getattr(self.compensation, name) for name in ("side", "by_um", "register")
            }
        if self.told_center_um is not None:
            columns["told_center_um"] = self.told_center_um
        if self.taper is not None:
            columns |= {"taper.side": self.taper.side, "taper.angle_rad": self.taper.angle_rad}
        if self.upper is not None:
            columns["upper"] = self.upper.kind
        columns |= {f"source.{name}": getattr(self.source, name) for name in ("block", "span", "line", "label")}
        rows = {name: len(column) for name, column in columns.items()}
        if len(set(rows.values())) > 1:
            raise ValueError(f"columns of a toolpath have one length, not {rows}")
        for column in columns.values():
            if isinstance(column, np.ndarray):
                column.setflags(write=False)

    def __iter__(self) -> Iterator[Block]:
        return (self.block(row) for row in range(len(self)))

    @property
    def leans(self) -> bool:
        """Whether the program leans the wire."""
        return self.taper is not None or self.upper is not None

    @property
    def is_jump(self) -> Bools:
        """(n,) True on jumps."""
        jump: Bools = self.kind == CurveKind.JUMP
        return jump

    @property
    def is_major(self) -> Bools:
        """(n,) True on arcs of more than a half turn."""
        return np.abs(self.sweep_rad) > np.pi

    @property
    def is_endless(self) -> Bools:
        """(n,) True on blocks whose words no controller would count out: they stay where they start."""
        return np.zeros(len(self), dtype=np.bool_) if self.words is None else self.words.is_endless

    @property
    def turn(self) -> Ints:
        """(n,) +1 counter-clockwise, −1 clockwise, 0 line: as the words say, which know it of an arc without length."""
        return np.sign(self.sweep_rad).astype(np.int64) if self.words is None else self.words.turn

    @property
    def end_angle_rad(self) -> Floats:
        """(n,) start angle plus sweep; NaN on lines."""
        return self.start_angle_rad + self.sweep_rad

    def block(self, row: int) -> Block:
        """Row `row` (from 0) as a light view, numbered `row + 1` as it runs. IndexError beyond the last row."""
        arc = bool(self.is_arc[row])
        return Block(
            number=row + 1,
            kind=CurveKind(int(self.kind[row])),
            start_um=_point(self.start_um[row]),
            end_um=_point(self.end_um[row]),
            length_um=float(self.length_um[row]),
            center_um=_point(self.center_um[row]) if arc else None,
            radius_um=float(self.radius_um[row]) if arc else None,
            start_angle_rad=float(self.start_angle_rad[row]) if arc else None,
            end_angle_rad=float(self.start_angle_rad[row] + self.sweep_rad[row]) if arc else None,
            sweep_rad=float(self.sweep_rad[row]) if arc else None,
            is_major=bool(abs(self.sweep_rad[row]) > np.pi),
            printed_end_um=None if np.isnan(self.printed_end_um[row, 0]) else _point(self.printed_end_um[row]),
            line=int(self.source.line[row]),
            label=self.source.label[row],
            text=self.source.block_text(row),
        )


def _point(pair: Floats) -> Point:
    return Point(float(pair[0]), float(pair[1]))
