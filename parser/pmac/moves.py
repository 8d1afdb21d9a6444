"""Lines to moves: the modes that are in force, calls of G and M words, and what the moves of the program are told."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import NamedTuple

from parser.findings.findings import Value
from parser.pmac.lines import Buffer, Kind, Line, Piece
from parser.text.source import Span
from parser.toolpath import Stop
from parser.units import from_mm

_ROUTINES: Mapping[str, int] = {"G": 1000, "M": 1001, "T": 1002, "D": 1003}
SUBPROGRAMS = frozenset(_ROUTINES.values())
"""Programs that hold the routines of G, M, T and D words (PMAC User's Manual, p. 204)."""
_PLANE = frozenset("XY")
_OTHER_AXES = frozenset("ZUVWABC")
_CENTER = "IJK"
_MOST_CALLS = 8
_DIGITS = 6  # of a µm: sums of decimals are as exact as decimals


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

    @property
    def ramp_ms(self) -> float:
        """Acceleration time in force: TA 0 and TS 50 ms where the program tells none (defaults of Turbo PMAC)."""
        return max(self.ramp or 0.0, 2.0 * (50.0 if self.half_s is None else self.half_s))


def run(main: Buffer, routines: Mapping[int, Buffer]) -> State:
    """What a program makes that calls the routines of other buffers, by their numbers."""
    state = State()
    for line in main.lines:
        _Line(state, line, routines).run()
    return state


class _Line:
    """One line as it runs: modes at once, its letters together at its end."""

    def __init__(self, state: State, line: Line, routines: Mapping[int, Buffer]) -> None:
        self.state, self.line, self.routines = state, line, routines
        self.words: dict[str, Piece] = {}
        self.label = ""
        self.names_place = self.is_normal = False
        self.modes: dict[str, Piece] = {}

    def run(self) -> None:
        for piece in self.line.pieces:
            self._take(piece, 0)
        if self.names_place:
            self._name_place()
        elif self.words.keys() & (_PLANE | _OTHER_AXES | set("IJR")):
            self._move()

    def _take(self, piece: Piece, depth: int) -> None:
        if piece.kind is Kind.WORD:
            self._word(piece, depth)
        elif piece.kind is Kind.LABEL:
            self.label = f"N{piece.value:.0f}"
        elif piece.kind is Kind.TIMED:
            self._timed(piece)
        elif piece.kind is Kind.NORMAL:
            self.is_normal = True
        else:
            self._mode(piece)

    def _mode(self, piece: Piece) -> None:
        name, state = piece.name, self.state
        if name in _MOTIONS:
            self._once("motion", piece)
            state.motion = _MOTIONS[name]
        elif name.startswith(("ABS", "INC")):
            axes = name[4:-1].split(",") if "(" in name else ["X", "Y"]
            if "(" not in name:
                self._once("distance", piece)
            state.absolute |= {axis: name.startswith("ABS") for axis in axes if axis in state.absolute}
        elif name == "PSET":
            self.names_place = True
        elif name == "STOP":
            state.stops.append(Stop("pause", len(state.moves), self.line.line))
            state.stopped, state.blends = True, False

    def _once(self, group: str, piece: Piece) -> None:
        """PMC104 at the second of two modes of a group in one line."""
        other = self.modes.setdefault(group, piece)
        if other.name != piece.name:
            self._at("PMC104", piece, word=piece.name, other=other.name)

    def _timed(self, piece: Piece) -> None:
        state = self.state
        if piece.value < 0.0:
            self._at("PMC209", piece, word=_shown(piece))
        elif piece.name == "TA":
            state.ramp = piece.value
        elif piece.name == "TS":
            state.half_s = piece.value
        elif piece.name in {"DWELL", "DELAY"}:
            state.blends = False
        else:
            self._at("PMC101", piece, text=_shown(piece))
        if piece.name in {"TA", "TS"} and state.ramp == 0.0 and state.half_s == 0.0:
            self._at("PMC209", piece, word="TA0 TS0")

    def _word(self, piece: Piece, depth: int) -> None:
        name = piece.name
        if self.is_normal and name in _CENTER:
            if name != "K" or piece.value >= 0.0:
                self._at("PMC101", piece, text=f"NORMAL {_shown(piece)}")
            return
        if name in _ROUTINES:
            self._call(piece, depth)
        elif name == "F":
            if piece.value <= 0.0:
                self._at("PMC209", piece, word=_shown(piece))
            else:
                self.state.feed = piece.value
        elif name in _PLANE | _OTHER_AXES | set("IJKR"):
            if name in self.words:
                self._at("PMC104", piece, word=_shown(piece), other=_shown(self.words[name]))
            self.words[name] = piece
            if name in _OTHER_AXES:
                self.state.others.append(piece)
        elif name != "S":
            self._at("PMC101", piece, text=_shown(piece))

    def _call(self, piece: Piece, depth: int) -> None:
        """The routine of a G, M, T or D word, up to its return; PMC102 where the text holds none."""
        hundred, below = divmod(int(abs(piece.value)), 100)
        buffer = self.routines.get(_ROUTINES[piece.name] + 10 * hundred)
        body = routine(buffer, below * 1000) if buffer else None
        if body is None or depth >= _MOST_CALLS:
            word = f"{piece.name}{piece.value:02g}"
            self._at("PMC102", piece, word=word, program=_ROUTINES[piece.name], label=f"N{below * 1000}")
            return
        for one in body:
            self._take(one._replace(span=piece.span), depth + 1)
        self.is_normal = False  # its words stand in the routine

    def _name_place(self) -> None:
        """PSET: the place has another name from here; behind a stop the wire is threaded there."""
        state = self.state
        named = self._ends(absolute=True)
        if not state.moves:
            state.place = named
        elif state.stopped:
            self._add(0, named, None, is_threaded=True)
        else:
            state.shift = (
                _exact(state.shift[0] + state.place[0] - named[0]),
                _exact(state.shift[1] + state.place[1] - named[1]),
            )

    def _move(self) -> None:
        state = self.state
        moves = self.words.keys() & (_PLANE | set("IJR"))
        if not moves:
            state.blends = False
            return
        end, motion = self._ends(absolute=False), state.motion
        center = self._center() if motion > 1 and self.words.keys() & set("IJ") else None
        if motion < 2 and end == state.place:
            return
        self._add(motion, end, center)
        state.blends, state.stopped = motion > 0, False

    def _add(
        self, motion: int, end: tuple[float, float], center: tuple[float, float] | None, *, is_threaded: bool = False
    ) -> None:
        state, turn = self.state, self.words.get("R")
        radius = from_mm(turn.value) if turn and motion > 1 and center is None else None
        told = (center, radius, state.feed, state.ramp_ms, state.blends and motion > 0)
        state.moves.append(Move(motion, state.place, end, *told, self.line, self.label, is_threaded))
        state.place = end

    def _ends(self, *, absolute: bool) -> tuple[float, float]:
        """Where the line ends: an axis without a word stays."""
        state, ends = self.state, []
        for axis, place, shift in zip("XY", state.place, state.shift, strict=True):
            word = self.words.get(axis)
            if word is None:
                ends.append(place)
            else:
                is_place = absolute or state.absolute[axis]
                ends.append(_exact(from_mm(word.value) + (shift if is_place else place)))
        return ends[0], ends[1]

    def _center(self) -> tuple[float, float]:
        state, told = self.state, []
        for letter, place, shift in zip("IJ", state.place, state.shift, strict=True):
            word = self.words.get(letter)
            told.append(_exact((from_mm(word.value) if word else 0.0) + (shift if state.absolute["R"] else place)))
        return told[0], told[1]

    def _at(self, code: str, piece: Piece, **values: Value) -> None:
        self.state.told.append(Told(code, piece.span, values))


_MOTIONS: Mapping[str, int] = {"RAPID": 0, "LINEAR": 1, "CIRCLE1": 2, "CIRCLE2": 3}


def routine(buffer: Buffer, label: int) -> list[Piece] | None:
    """The commands from a label of a buffer up to the return; None without the label. Label 0 is at the top."""
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


def _shown(piece: Piece) -> str:
    return f"{piece.name}{piece.value:g}"


def _exact(um: float) -> float:
    return round(um, _DIGITS)
