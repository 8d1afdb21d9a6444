"""What a motion program has in force and has made so far: its moves, its stops, and what is wrong with its lines."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import NamedTuple

from parser.findings.findings import Fact, Value
from parser.pmac.expressions import Values
from parser.pmac.lines import Line, Piece
from parser.text.source import Span
from parser.toolpath import Stop


class LineFault(NamedTuple):
    """Something wrong with a line: the code of its finding, its place, its values, and its fact."""

    code: str
    span: Span
    values: Mapping[str, Value]
    fact: Fact | None = None


class Move(NamedTuple):
    """One move in the plane, µm.

    Attributes
    ----------
    motion
        0 rapid, 1 straight, 2 clockwise, 3 counter-clockwise.
    start, end
        Places.
    center
        As told by I and J; None without.
    radius
        As told by R, signed; None without.
    feed
        F, in user units per time unit; None where none was told, NaN where its value is not known, or TM gives a time.
    ramp_ms
        Acceleration time: the greater of TA and twice TS. NaN where it is not known.
    blends
        Whether it runs into this move from the one before without coming to rest.
    at
        Line of the program that it stands in.
    label
        ``N10``, or empty.
    is_threaded
        Whether no block moves there: the place is named behind a stop.
    """

    motion: int
    start: tuple[float, float]
    end: tuple[float, float]
    center: tuple[float, float] | None
    radius: float | None
    feed: float | None
    ramp_ms: float
    blends: bool
    at: Line
    label: str
    is_threaded: bool = False


class Halt(NamedTuple):
    """Where nobody knows how the program goes on.

    Attributes
    ----------
    span
        The piece.
    why
        Term of the catalogue that says why.
    what
        The variable, program or label in question, as people write it; empty where there is none.
    """

    span: Span
    why: str
    what: str = ""


@dataclass(slots=True)
class State:
    """What is in force, and what the program has made so far; places in µm."""

    values: Values
    settings: dict[str, float] = field(default_factory=dict)
    motion: int = 1
    absolute: dict[str, bool] = field(default_factory=lambda: {"X": True, "Y": True, "R": False})
    place: tuple[float, float] = (0.0, 0.0)
    shift: tuple[float, float] = (0.0, 0.0)
    feed: float | None = None
    ramp: float | None = None
    half_s: float | None = None
    blends: bool = False
    stopped: bool = False
    others: dict[tuple[str, Span], Piece] = field(default_factory=dict)
    moves: list[Move] = field(default_factory=list)
    stops: list[Stop] = field(default_factory=list)
    faults_by_span: dict[tuple[str, Span], LineFault] = field(default_factory=dict)
    besides: list[Piece] = field(default_factory=list)
    halt: Halt | None = None
    is_steep_told: bool = False

    def finding(self, code: str, span: Span, values: Mapping[str, Value], fact: Fact | None = None) -> None:
        """What is wrong with a line, once a place however often a loop runs it."""
        self.faults_by_span.setdefault((code, span), LineFault(code, span, values, fact))

    @property
    def ramp_ms(self) -> float:
        """Acceleration time in force: TA 0 and TS 50 ms where the program tells none (defaults of Turbo PMAC).

        NaN where one of them is not known.
        """
        ramp, half = self.ramp or 0.0, 50.0 if self.half_s is None else self.half_s
        return math.nan if math.isnan(ramp + half) else max(ramp, 2.0 * half)
