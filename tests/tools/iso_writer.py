"""ISO written from docs/iso.md alone, with the truth of what is written: counts, length, box, first and last place.

It shares no code with the product, so that the two prove each other.
"""

import math
from collections.abc import Iterable, Sequence
from typing import Literal, NamedTuple

from drawings import Arc, Line, Place
from sound_cam import Move, drawn_sweep

_SAMPLES = 720


class Habits(NamedTuple):
    """How a family writes.

    Attributes
    ----------
    unit_um
        µm of a number of 1.
    places
        Digits behind the point; 0 for whole numbers without one.
    is_incremental, has_absolute_centers
        Of X and Y, and of I and J.
    leaves_out
        Whether words that stay as they are, and zeros, are left out.
    step
        Of block numbers; 0 for none.
    end, newline
        Of each block, and of each line.
    is_short
        ``G1 X.5`` for ``G01 X0.500``.
    """

    unit_um: float
    places: int
    is_incremental: bool = False
    has_absolute_centers: bool = False
    leaves_out: bool = False
    step: int = 0
    end: str = ""
    newline: str = "\n"
    is_short: bool = False

    @property
    def resolution_um(self) -> float:
        """Least step that is written."""
        return float(self.unit_um / 10**self.places)

    def snapped(self, place: Place) -> Place:
        """The place that is written."""
        step = self.resolution_um
        return round(place[0] / step) * step, round(place[1] / step) * step

    def number(self, um: float) -> str:
        """A length as written."""
        units = round(um / self.resolution_um) / 10**self.places
        if not self.places:
            return f"{units:.0f}"
        text = f"{units + 0.0:.{self.places}f}"
        if not self.is_short:
            return text
        text = text.rstrip("0").replace("0.", ".", 1) if abs(units) < 1.0 else text.rstrip("0")
        return text if text.strip("-.") else "0."


class Stroke(NamedTuple):
    """One move as it runs: its ends as written, and of an arc what was drawn."""

    kind: Literal["line", "arc", "rapid"]
    start: Place
    end: Place
    center: Place = (math.nan, math.nan)
    from_drawn: Place = (math.nan, math.nan)
    sweep: float = 0.0

    @property
    def length_um(self) -> float:
        """Of the line as written, or of the arc as drawn."""
        if self.kind == "arc":
            return math.dist(self.from_drawn, self.center) * abs(self.sweep)
        return math.dist(self.start, self.end)

    def places(self) -> Iterable[Place]:
        """Ends, and of an arc some between."""
        yield from (self.start, self.end)
        if self.kind == "arc":
            x, y = self.from_drawn[0] - self.center[0], self.from_drawn[1] - self.center[1]
            for row in range(_SAMPLES + 1):
                angle = math.atan2(y, x) + self.sweep * row / _SAMPLES
                radius = math.hypot(x, y)
                yield self.center[0] + radius * math.cos(angle), self.center[1] + radius * math.sin(angle)


class IsoProgram(NamedTuple):
    """A program, the profile and unit that it is written for, and the strokes that it runs, in order."""

    family: str
    unit: str
    text: str
    resolution_um: float
    strokes: tuple[Stroke, ...]

    def count(self, kind: str) -> int:
        """How many strokes of a kind run."""
        return sum(stroke.kind == kind for stroke in self.strokes)

    @property
    def cut(self) -> list[Stroke]:
        """Lines and arcs."""
        return [stroke for stroke in self.strokes if stroke.kind != "rapid"]

    @property
    def cut_length_um(self) -> float:
        """Of lines and arcs."""
        return math.fsum(stroke.length_um for stroke in self.cut)

    @property
    def box_um(self) -> list[float]:
        """Lowest X and Y and highest X and Y of lines and arcs."""
        x, y = zip(*(place for stroke in self.cut for place in stroke.places()), strict=True)
        return [min(x), min(y), max(x), max(y)]


class IsoWriter:
    """Writes blocks from a place, and keeps what they run."""

    def __init__(self, habits: Habits, at: Place) -> None:
        self.habits = habits
        self.drawn = at
        self.at = habits.snapped(at)
        self.lines: list[str] = []
        self.strokes: list[Stroke] = []
        self._number = 0
        self._motion = ""

    def line(self, text: str) -> None:
        """A line as it is."""
        self.lines.append(text)

    def block(self, text: str) -> None:
        """A block, numbered and ended as the family does."""
        self._number += self.habits.step
        number = f"N{self._number} " if self.habits.step else ""
        self.lines.append(f"{number}{text}{self.habits.end}")

    def start(self, head: str = "") -> None:
        """G92 with the place."""
        x, y = (self.habits.number(value) for value in self.at)
        self.block(f"{head}G92 X{x} Y{y}")

    def rethread(self, at: Place) -> None:
        """A new start, as by hand behind a stop."""
        self.drawn, self.at = at, self.habits.snapped(at)
        self.start()

    def moves(self, moves: Iterable[Move], head: str = "") -> None:
        """Blocks of moves, `head` in the first of them."""
        for move in moves:
            head = "" if self._move(move, head) else head

    def rapid(self, to: Place) -> None:
        """A block of G00."""
        end = self.habits.snapped(to)
        if end != self.at:
            self.block(self._words("G00", end, ()))
            self._ran(Stroke("rapid", self.at, end), to)

    def call(self, sub: "IsoWriter", number: str) -> None:
        """A call of a subprogram that begins where this one stands."""
        self.block(f"M98 P{number}")
        self.strokes += sub.strokes
        self.at, self.drawn, self._motion = sub.at, sub.drawn, ""

    def text(self) -> str:
        """All lines."""
        return self.habits.newline.join([*self.lines, ""])

    def _move(self, move: Move, head: str) -> bool:
        """Write a move; False where it rounds to nothing."""
        end = self.habits.snapped(move.to)
        if isinstance(move, Line):
            if end == self.at:
                return False
            self.block(head + self._words("G01", end, ()))
            self._ran(Stroke("line", self.at, end), move.to)
            return True
        sweep = drawn_sweep(self.drawn, move) * move.turn
        if end == self.at and abs(sweep) < math.pi:
            return False
        self.block(head + self._words("G03" if move.turn > 0 else "G02", end, self._center(move)))
        self._ran(Stroke("arc", self.at, end, move.center, self.drawn, sweep), move.to)
        return True

    def _ran(self, stroke: Stroke, drawn: Place) -> None:
        self.strokes.append(stroke)
        self.at, self.drawn = stroke.end, drawn

    def _center(self, move: Arc) -> Sequence[tuple[str, float]]:
        since = (0.0, 0.0) if self.habits.has_absolute_centers else self.at
        way = [("I", move.center[0] - since[0]), ("J", move.center[1] - since[1])]
        leaves_out = self.habits.leaves_out and not self.habits.has_absolute_centers
        return [(letter, um) for letter, um in way if not (leaves_out and abs(um) < 0.5 * self.habits.resolution_um)]

    def _words(self, motion: str, end: Place, center: Sequence[tuple[str, float]]) -> str:
        """Words of a motion to a place."""
        words = [] if self.habits.leaves_out and motion == self._motion else [motion]
        for letter, to, at in zip("XY", end, self.at, strict=True):
            if not self.habits.leaves_out or to != at:
                words.append(f"{letter}{self.habits.number(to - at if self.habits.is_incremental else to)}")
        words += [f"{letter}{self.habits.number(um)}" for letter, um in center]
        self._motion = motion
        return " ".join(word.replace("G0", "G", 1) if self.habits.is_short else word for word in words)
