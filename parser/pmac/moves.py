"""Lines to moves: the modes that are in force, and what the moves of the program are told.

What the card makes of speeds: blocks shorter than the acceleration time, corners that it rounds, F and its unit.

Sources: PMAC User's Manual on TA, TS and blending (docs/pmac.md §5).
"""

from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple

import numpy as np

from parser.findings.findings import TooLarge, Value
from parser.geometry.curves import Bools, CurveKind, Floats, Ints
from parser.pmac.expressions import UnknownValue
from parser.pmac.lines import Kind, Line, Piece
from parser.pmac.state import Move, State
from parser.text.source import Span
from parser.toolpath import Stop, Toolpath
from parser.units import from_mm, mm

DEFAULT_UNIT_MS = 1000.0
"""Time unit of F where nothing sets it (Isx90)."""
ROUNDING_UM = 10.0
"""Corners that are rounded by less are not told: the wire's own lag rounds as much."""
_SAME = 0.99  # a block of just the acceleration time runs at its speed


class Slow(NamedTuple):
    """Something about speeds at a row: the code of its finding and its values."""

    code: str
    row: int
    values: dict[str, Value]


def speed_findings(toolpath: Toolpath, moves: Sequence[Move], unit_ms: float | None) -> Iterator[Slow]:
    """PMC204 to PMC206 and PMC208, each once for the whole program."""
    cut = toolpath.kind != CurveKind.JUMP
    if not cut.any():
        return
    feed = np.array([np.nan if move.feed is None else move.feed for move in moves])
    ramp = np.array([move.ramp_ms for move in moves])
    known = cut & ~np.isnan(feed) & ~np.isnan(ramp)
    told_rows = np.flatnonzero(known)
    silent = np.flatnonzero(cut & np.array([move.feed is None for move in moves]))
    if len(silent):
        yield _at("PMC208", int(silent[0]), {})
    if not len(told_rows):
        return
    if unit_ms is None:
        yield _at("PMC206", int(told_rows[0]), {"feed": float(feed[told_rows[0]])})
    speed = from_mm(feed) / (unit_ms or DEFAULT_UNIT_MS)
    yield from _too_short(toolpath, told_rows, speed, ramp, feed)
    yield from _rounded(toolpath, moves, known, _reached(toolpath, speed, ramp), ramp)


def _too_short(toolpath: Toolpath, told_rows: Ints, speed: Floats, ramp: Floats, feed: Floats) -> Iterator[Slow]:
    """PMC204 at the block that runs slowest of its F."""
    share = toolpath.length_um[told_rows] / (speed[told_rows] * np.where(ramp[told_rows] > 0.0, ramp[told_rows], 1e-9))
    short = np.flatnonzero((share < _SAME) & (share > 0.0))
    if not len(short):
        return
    worst = short[int(np.argmin(share[short]))]
    row = int(told_rows[worst])
    values: dict[str, Value] = {
        "time": float(toolpath.length_um[row] / speed[row]),
        "ramp": float(ramp[row]),
        "feed": float(feed[row]),
        "runs": float(feed[row] * share[worst]),
        "more": len(short) - 1,
    }
    yield _at("PMC204", row, values)


def _reached(toolpath: Toolpath, speed: Floats, ramp: Floats) -> Floats:
    """(n,) speeds that the blocks reach, µm/ms: a block takes the acceleration time at least."""
    return np.where(ramp > 0.0, np.minimum(speed, toolpath.length_um / np.where(ramp > 0.0, ramp, 1.0)), speed)


def _rounded(toolpath: Toolpath, moves: Sequence[Move], known: Bools, speed: Floats, ramp: Floats) -> Iterator[Slow]:
    """PMC205 at the corner that is rounded most.

    The velocity changes evenly from one block to the next: its change times TA, by 8, is how far the path passes the
    corner. At a right angle this is v · TA · √2 / 8.
    """
    blends = np.array([move.blends for move in moves])
    corner = np.flatnonzero(known[1:] & known[:-1] & blends[1:]) + 1
    if not len(corner):
        return
    before = speed[corner - 1, None] * _heading(toolpath, corner - 1, at_end=True)
    behind = speed[corner, None] * _heading(toolpath, corner, at_end=False)
    passed = np.hypot(*(behind - before).T) * ramp[corner] / 8.0
    worst = int(np.argmax(passed))
    if passed[worst] > ROUNDING_UM:
        more = int((passed > ROUNDING_UM).sum()) - 1
        values: dict[str, Value] = {"off": float(passed[worst]), "ramp": float(ramp[corner[worst]]), "more": more}
        yield _at("PMC205", int(corner[worst]), values)


def _at(code: str, row: int, values: dict[str, Value]) -> Slow:
    return Slow(code, row, values)


def _heading(toolpath: Toolpath, row: Ints, *, at_end: bool) -> Floats:
    """(k, 2) unit vectors along the curves at their start or end."""
    by = toolpath.end_um[row] - toolpath.start_um[row]
    angle = toolpath.start_angle_rad[row] + (toolpath.sweep_rad[row] if at_end else 0.0)
    angle = np.where(toolpath.is_arc[row], angle + np.sign(toolpath.sweep_rad[row]) * np.pi / 2.0, 0.0)
    straight = np.arctan2(by[:, 1], by[:, 0])
    turned = np.where(toolpath.is_arc[row], angle, straight)
    return np.column_stack([np.cos(turned), np.sin(turned)])


_PLANE = frozenset("XY")
_OTHER_AXES = frozenset("ZUVWABC")
_CENTER = "IJK"
_DIGITS = 6  # of a µm: sums of decimals are as exact as decimals
_UNKNOWN = float("nan")
_MOST_UM = {**dict.fromkeys("XYIJ", 1e7), "R": 1e9}
"""Greatest lengths either way, as those of ISO: 10 m of coordinates, 1 km of radii."""


class MovedLine:
    """One line as it runs: modes at once, its letters together at its end.

    Parameters
    ----------
    state
        Of the program; the line changes it.
    line
        Where its moves stand. That of a routine called by a G word is the line with the word.
    called_at
        Place of that word; None in other lines.
    modes
        The modes that the line with that word has set already.
    """

    def __init__(
        self, state: State, line: Line, *, called_at: Span | None = None, modes: dict[str, Piece] | None = None
    ) -> None:
        self.state, self.line, self.called_at = state, line, called_at
        self.words: dict[str, Piece] = {}
        self.label = ""
        self.names_place = self.is_normal = False
        self.modes: dict[str, Piece] = {} if modes is None else modes

    def finish(self) -> None:
        """The end of the line: its move."""
        if self.names_place:
            self._name_place()
        elif self.words.keys() & (_PLANE | _OTHER_AXES | set("IJR")):
            self._move()

    def take(self, piece: Piece) -> None:
        """One piece. UnknownValue where nobody knows where it moves."""
        if self.called_at is not None:
            piece = piece._replace(span=self.called_at)
        if piece.kind is Kind.WORD:
            self._word(self._in_range(self._with_value(piece)))
        elif piece.kind is Kind.LABEL:
            self.label = f"N{piece.value:.0f}"
        elif piece.kind is Kind.TIMED:
            self._timed(self._with_value(piece))
        elif piece.kind is Kind.NORMAL:
            self.is_normal = True
        elif piece.kind in {Kind.MODE, Kind.AXES}:
            self._mode(piece)

    def _with_value(self, piece: Piece) -> Piece:
        """A piece with what its sum is; NaN of one that moves nothing in the plane and is not known."""
        if piece.worked is None:
            return piece
        try:
            return piece._replace(value=piece.worked(self.state.values))
        except UnknownValue:
            if piece.kind is Kind.WORD and piece.name in set("XYIJKR"):
                raise
            return piece._replace(value=_UNKNOWN)

    def _in_range(self, piece: Piece) -> Piece:
        """A word; PMC108 where it is a length beyond any table, or a radius beyond any arc that is meant."""
        most_um = _MOST_UM.get(piece.name)
        if most_um is not None and abs(from_mm(piece.value)) > most_um:
            limits = f"±{mm(most_um) / 1000.0:g} m"
            self.state.finding("PMC108", piece.span, {"word": _excerpt(piece), "limits": limits}, TooLarge())
        return piece

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
            self._at("PMC209", piece, word=_excerpt(piece))
        elif piece.name == "TA":
            state.ramp = piece.value
        elif piece.name == "TS":
            state.half_s = piece.value
        elif piece.name == "TM":
            state.feed = _UNKNOWN  # the time of each move is told, whatever its length
        else:
            state.blends = False

    def _word(self, piece: Piece) -> None:
        name = piece.name
        if self.is_normal and name in _CENTER:
            if name != "K" or piece.value >= 0.0:
                self._at("PMC101", piece, text=f"NORMAL {_excerpt(piece)}")
            return
        if name == "F":
            if piece.value <= 0.0:
                self._at("PMC209", piece, word=_excerpt(piece))
            else:
                self.state.feed = piece.value
        elif name in _PLANE | _OTHER_AXES | set("IJKR"):
            if name in self.words:
                self._at("PMC104", piece, word=_excerpt(piece), other=_excerpt(self.words[name]))
            self.words[name] = piece
            if name in _OTHER_AXES:
                self.state.others.setdefault((piece.name, piece.span), piece)
        elif name != "S":
            self._at("PMC101", piece, text=_excerpt(piece))

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
        if state.ramp_ms == 0.0 and not state.is_steep_told:
            state.is_steep_told = True
            self._at("PMC209", self.line.pieces[0], word="TA0 TS0")
        row = (center, radius, state.feed, state.ramp_ms, state.blends and motion > 0)
        state.moves.append(Move(motion, state.place, end, *row, self.line, self.label, is_threaded))
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
        state, offsets = self.state, []
        for letter, place, shift in zip("IJ", state.place, state.shift, strict=True):
            word = self.words.get(letter)
            offsets.append(_exact((from_mm(word.value) if word else 0.0) + (shift if state.absolute["R"] else place)))
        return offsets[0], offsets[1]

    def _at(self, code: str, piece: Piece, **values: Value) -> None:
        self.state.finding(code, piece.span, values)


_MOTIONS: Mapping[str, int] = {"RAPID": 0, "LINEAR": 1, "CIRCLE1": 2, "CIRCLE2": 3}


def _excerpt(piece: Piece) -> str:
    return f"{piece.name}{piece.value:g}"


def _exact(um: float) -> float:
    return round(um, _DIGITS)
