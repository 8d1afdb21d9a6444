"""What a motion program has in force and has made so far: its moves, its stops, and what is wrong with its lines."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import NamedTuple

from parser.findings.findings import Value
from parser.pmac.lines import Line, Piece
from parser.text.source import Span
from parser.toolpath import Stop


class Told(NamedTuple):
    """Something wrong with a line: the code of its finding, its place, and its values."""

    code: str
    span: Span
    values: Mapping[str, Value]


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
        F, in user units per time unit; None where none was told.
    ramp_ms
        Acceleration time: the greater of TA and twice TS.
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


@dataclass(slots=True)
class State:
    """What is in force, and what the program has made so far; places in µm."""

    motion: int = 1
    absolute: dict[str, bool] = field(default_factory=lambda: {"X": True, "Y": True, "R": False})
    place: tuple[float, float] = (0.0, 0.0)
    shift: tuple[float, float] = (0.0, 0.0)
    feed: float | None = None
    ramp: float | None = None
    half_s: float | None = None
    blends: bool = False
    stopped: bool = False
    others: list[Piece] = field(default_factory=list)
    moves: list[Move] = field(default_factory=list)
    stops: list[Stop] = field(default_factory=list)
    told: list[Told] = field(default_factory=list)
    pieces_called: int = 0
    is_steep_told: bool = False

    @property
    def ramp_ms(self) -> float:
        """Acceleration time in force: TA 0 and TS 50 ms where the program tells none (defaults of Turbo PMAC)."""
        return max(self.ramp or 0.0, 2.0 * (50.0 if self.half_s is None else self.half_s))
