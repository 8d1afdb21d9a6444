"""Random sound programs as each family writes them: heads, tables, passes, calls, rethreads and ends of its own."""

import random
from collections.abc import Callable
from itertools import pairwise
from typing import NamedTuple

from drawings import Arc, Line, Place, contour, moved, rounded, slot
from iso_writer import Habits, IsoProgram, IsoWriter
from sound_cam import Move

_PITCH_UM = 200_000.0  # from one contour to the next


def program(rng: random.Random, family: str) -> IsoProgram:
    """A program of a family."""
    return FAMILIES[family](rng)


class Figure(NamedTuple):
    """A closed contour and the lead to it, square to its first line: in the waste, where the wire runs beside it.

    Attributes
    ----------
    hole, half, begin
        Where the wire is threaded, a place half-way, and where the contour begins and ends.
    moves
        From `begin` round the contour.
    side
        ``G41`` or ``G42``: on which side of these moves the hole lies.
    """

    hole: Place
    half: Place
    begin: Place
    moves: list[Move]
    side: str

    @property
    def back(self) -> list[Move]:
        """The moves the other way round."""
        ways = pairwise([self.begin, *(move.to for move in self.moves)])
        back = [
            Line(since) if isinstance(move, Line) else Arc(since, move.center, -move.turn)
            for (since, _), move in zip(ways, self.moves, strict=True)
        ]
        return back[::-1]

    @property
    def other_side(self) -> str:
        """The side of the hole beside the moves the other way round."""
        return "G42" if self.side == "G41" else "G41"


def _figures(rng: random.Random, most: int) -> list[Figure]:
    """Figures beside each other."""
    return [_figure(rng, _PITCH_UM * number) for number in range(rng.randint(1, most))]


def _figure(rng: random.Random, x: float) -> Figure:
    start, moves = rng.choice((rounded, slot))(rng)
    (low, y), to = start, moves[0].to[0]
    begin = round(0.5 * (low + to)), y
    is_die = rng.random() < 0.5
    lead = round(rng.uniform(1000.0, 1800.0)) * (1 if is_die else -1)  # the moves go counter-clockwise from below
    hole, half = (begin[0], y + lead), (begin[0], y + round(0.5 * lead))
    by = -x - rng.randrange(-9000, 9000), float(rng.randrange(-9000, 9000))
    round_it = moved([Line(hole), Line(half), Line(begin), *moves, Line(begin)], by)
    (hole, half, begin), moves = (move.to for move in round_it[:3]), round_it[3:]
    return Figure(hole, half, begin, moves, "G41" if is_die else "G42")


def _made(family: str, writer: IsoWriter, unit: str = "") -> IsoProgram:
    return IsoProgram(family, unit, writer.text(), writer.habits.resolution_um, tuple(writer.strokes))


def _plain(rng: random.Random) -> tuple[Place, list[Move]]:
    """Any closed contour with the place where the wire is threaded for it."""
    at = float(rng.randrange(-9000, 9000)), float(rng.randrange(-9000, 9000))
    return at, moved(contour(rng)[1], (-at[0], -at[1]))


def fast_wire(rng: random.Random) -> IsoProgram:
    """Bare words in µm, all of them written, no numbers: G91 and G92 in the head."""
    is_incremental = rng.random() < 0.7
    at, moves = _plain(rng)
    writer = IsoWriter(Habits(1.0, 0, is_incremental), at)
    writer.start("G91" if is_incremental else "G90 ")
    writer.moves(moves)
    writer.line("M02")
    return _made("fast-wire", writer)


def classroom(rng: random.Random) -> IsoProgram:
    """Whole mm from a lead on, numbers by ten."""
    w, h, r = rng.randint(20, 60), rng.randint(20, 60), rng.randint(1, 9)
    writer = IsoWriter(Habits(1000.0, 0, rng.random() < 0.7, step=10), (0.0, 0.0))
    writer.start()
    writer.block("G91" if writer.habits.is_incremental else "G90")
    lead, corner = (5e3, 5e3), ((5e3 + w * 1e3 - r * 1e3, 5e3), (5e3 + w * 1e3, 5e3 + r * 1e3))
    top = 5e3 + h * 1e3
    around = [Line(corner[0]), Arc(corner[1], (corner[0][0], corner[1][1]), 1), Line((corner[1][0], top))]
    writer.moves([Line(lead), *around, Line((5e3, top)), Line(lead), Line((0.0, 0.0))])
    writer.block("M02")
    return _made("classroom", writer)


def skd2(rng: random.Random) -> IsoProgram:
    """Tables of registers in µm, passes as calls of a subprogram behind M02, contours threaded by hand."""
    habits = Habits(1.0, 0)
    figures = _figures(rng, 3)
    writer = IsoWriter(habits, figures[0].hole)
    for line in ("; made for tests", f"; Number : {len(figures)}", "H001=110", "H002=100", "E001=   004 005 006"):
        writer.line(line)
    writer.line("G90")
    subs = []
    for number, figure in enumerate(figures, 1):
        if number > 1:
            writer.line("M00")
        writer.rethread(figure.hole)
        sub = IsoWriter(habits, figure.hole)
        sub.moves([Line(figure.begin), *figure.moves])
        for register in ("H001", "H002")[: rng.randint(1, 2)]:
            writer.line(f"{figure.side} {register}")
            writer.line("E001")
            writer.call(sub, f"{number:04}")
            writer.line("G50 G40")
            writer.moves([Line(figure.hole)])
        subs += [f"N{number:04}", *sub.lines, "M99"]
    writer.line("M02")
    writer.lines += subs
    return _made("skd2", writer)


def robofil(rng: random.Random) -> IsoProgram:
    """Absolute centres, numbers by ten, words that stay left out, a stop before the last block, G00 between figures."""
    figures = _figures(rng, 3)
    places = rng.choice((0, 3))
    habits = Habits(1000.0 if places else 1.0, places, False, True, True, 10, newline="\r\n")
    writer = IsoWriter(habits, figures[0].hole)
    writer.line("% (MEM:F17A15.ISO)")
    writer.start()
    for block in ("G60", "G38", *(["G90"] * rng.randint(0, 1))):
        writer.block(block)
    for figure in figures:
        writer.rapid(figure.hole)
        writer.block(f"{figure.side} D0")
        *most, last = figure.moves
        writer.moves([Line(figure.begin), *most])
        writer.block("M01")
        writer.moves([last])
        writer.block("G40")
        writer.moves([Line(figure.hole)])
        writer.block("M00")
    writer.block("M02")
    writer.line("%")
    return _made("robofil", writer)


def sodick(rng: random.Random) -> IsoProgram:
    """Tables, decimals in mm, a block closed by a sign, approach by H000, passes back and forth by two subprograms."""
    habits = Habits(1000.0, 3, leaves_out=rng.random() < 0.5, end=";")
    figure = _figure(rng, 0.0)
    writer = IsoWriter(habits, figure.hole)
    writer.lines += ["C000   = 012 014 -01;", "C001   = 010 014 -01;", "H000 = +000000.0100 ;"]
    writer.lines += ["H001 = +000000.1690 ;", "H002 = +000000.1330 ;", "QAIC(2,1,0.1250,3);", "G55;", "G90;"]
    writer.start()
    writer.lines += ["G29;", "T94;", "T84;"]
    there, back = IsoWriter(habits, figure.half), IsoWriter(habits, figure.half)
    there.moves([Line(figure.begin), *figure.moves])
    back.moves([Line(figure.begin), *figure.back])
    ways = [(there, figure.side, "0001"), (back, figure.other_side, "0002")]
    for number, (sub, side, label) in enumerate(ways, 1):
        writer.moves([Line(figure.half)], f"{side} H000 ")
        writer.line(f"C001 H00{number};")
        writer.call(sub, label)
        writer.moves([Line(figure.hole)], "G40 H000 ")
    writer.lines += ["T85;", "M02;"]
    for sub, _, label in ways:
        writer.lines += [f"N{label};", *sub.lines, "M99;"]
    return _made("sodick", writer)


def mitsubishi(rng: random.Random) -> IsoProgram:
    """Inches with points and no zeros before them, registers as sums, passes written out back and forth."""
    habits = Habits(25_400.0, 5, leaves_out=True, is_short=True)
    figure = _figure(rng, 0.0)
    passes = rng.randint(1, 4)
    writer = IsoWriter(habits, figure.hole)
    writer.lines += ["%", "L001", " SQUARE PROGRAM ", "H175 = .0002"]
    writer.lines += [f"H{number} =.00{895 - 100 * number} + H175" for number in range(1, passes + 1)]
    writer.line("G90 M91")
    writer.start()
    writer.lines += ["M20 (THREAD)", "M78 M78", "M80 M82 M84"]
    for number in range(1, passes + 1):
        side, moves = (figure.side, figure.moves) if number % 2 else (figure.other_side, figure.back)
        writer.line(f"E128{number} F.0{number}")
        writer.moves([Line(figure.begin), *moves], f"{side} H{number} ")
        writer.moves([Line(figure.hole)], "G40 ")
        writer.line("M01")
    writer.lines += ["M85 M83 M81", "M21 M58", "M02", "%"]
    return _made("mitsubishi", writer, "inch")


def fanuc(rng: random.Random) -> IsoProgram:
    """A program number, G91, inches or mm with points, zeros left out."""
    is_inch = rng.random() < 0.5
    habits = Habits(25_400.0 if is_inch else 1000.0, 4 if is_inch else 3, True, leaves_out=True)
    figure = _figure(rng, 0.0)
    writer = IsoWriter(habits, figure.hole)
    writer.lines += ["%", "O0027", "G91 S1 D1"]
    writer.start()
    writer.line(f"{figure.side} (SIDE)")
    writer.moves([Line(figure.begin), *figure.moves])
    writer.moves([Line(figure.hole)], "G40 ")
    writer.lines += ["M30", "%"]
    return _made("fanuc", writer, "inch" if is_inch else "mm")


def common(rng: random.Random) -> IsoProgram:
    """What any family reads: G90, mm with points, a stop before each G00."""
    at, moves = _plain(rng)
    away = at[0] + _PITCH_UM, at[1]
    writer = IsoWriter(Habits(1000.0, 3, leaves_out=rng.random() < 0.5, step=rng.choice((0, 5, 10))), at)
    writer.block("G21 G90")
    writer.start()
    writer.moves(moves)
    writer.block("M00")
    writer.rapid(away)
    writer.moves(moved(moves, (-_PITCH_UM, 0.0)))
    writer.block("M02")
    return _made("common", writer)


FAMILIES: dict[str, Callable[[random.Random], IsoProgram]] = {
    "fast-wire": fast_wire,
    "classroom": classroom,
    "skd2": skd2,
    "robofil": robofil,
    "sodick": sodick,
    "mitsubishi": mitsubishi,
    "fanuc": fanuc,
    "common": common,
}
