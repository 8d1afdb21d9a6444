"""Random sound programs as each family writes them: heads, tables, passes, calls, rethreads and ends of its own."""

import random
from collections.abc import Callable
from itertools import pairwise

from drawings import Arc, Line, Place, contour, moved
from iso_writer import Habits, IsoProgram, IsoWriter
from sound_cam import Move

_PITCH_UM = 200_000.0  # from one contour to the next


def program(rng: random.Random, family: str) -> IsoProgram:
    """A program of a family."""
    return FAMILIES[family](rng)


def _contours(rng: random.Random, most: int) -> list[tuple[Place, list[Move]]]:
    """Where each contour is threaded, and its moves from there; each begins and ends at one place, or nearly."""
    found = []
    for number in range(rng.randint(1, most)):
        at = _PITCH_UM * number + rng.randrange(-9000, 9000), float(rng.randrange(-9000, 9000))
        found.append((at, moved(contour(rng)[1], (-at[0], -at[1]))))
    return found


def _backwards(at: Place, moves: list[Move]) -> list[Move]:
    """The same moves from their end to `at`."""
    ways = pairwise([at, *(move.to for move in moves)])
    back = [
        Line(since) if isinstance(move, Line) else Arc(since, move.center, -move.turn)
        for (since, _), move in zip(ways, moves, strict=True)
    ]
    return back[::-1]


def _made(family: str, writer: IsoWriter, unit: str = "") -> IsoProgram:
    return IsoProgram(family, unit, writer.text(), writer.habits.resolution_um, tuple(writer.strokes))


def fast_wire(rng: random.Random) -> IsoProgram:
    """Bare words in µm, all of them written, no numbers: G91 and G92 in the head."""
    is_incremental = rng.random() < 0.7
    ((at, moves),) = _contours(rng, 1)
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
    contours = _contours(rng, 3)
    writer = IsoWriter(habits, contours[0][0])
    for line in ("; made for tests", f"; Number : {len(contours)}", "H001=110", "H002=100", "E001=   004 005 006"):
        writer.line(line)
    writer.line("G90")
    subs = []
    for number, (at, moves) in enumerate(contours, 1):
        if number > 1:
            writer.line("M00")
        writer.rethread(at)
        sub = IsoWriter(habits, at)
        sub.moves([*moves, Line(at)])
        for register in ("H001", "H002")[: rng.randint(1, 2)]:
            writer.line(f"G41 {register}")
            writer.line("E001")
            writer.call(sub, f"{number:04}")
            writer.line("G50 G40")
        subs += [f"N{number:04}", *sub.lines, "M99"]
    writer.line("M02")
    writer.lines += subs
    return _made("skd2", writer)


def robofil(rng: random.Random) -> IsoProgram:
    """Absolute centres, numbers by ten, words that stay left out, contours joined by G00."""
    contours = _contours(rng, 3)
    places = rng.choice((0, 3))
    habits = Habits(1000.0 if places else 1.0, places, False, True, True, 10, newline="\r\n")
    writer = IsoWriter(habits, contours[0][0])
    writer.line("% (MEM:F17A15.ISO)")
    writer.start()
    for block in ("G60", "G38", "G41 D0", *(["G90"] * rng.randint(0, 1))):
        writer.block(block)
    for at, moves in contours:
        writer.rapid(at)
        *most, last = moves
        writer.moves(most)
        writer.block("M01")
        writer.moves([last])
    for block in ("G40", "M02"):
        writer.block(block)
    writer.line("%")
    return _made("robofil", writer)


def sodick(rng: random.Random) -> IsoProgram:
    """Tables, decimals in mm, a block closed by a sign, passes back and forth by two subprograms."""
    habits = Habits(1000.0, rng.choice((3, 4)), leaves_out=rng.random() < 0.5, end=";")
    ((at, moves),) = _contours(rng, 1)
    writer = IsoWriter(habits, at)
    writer.lines += ["C000   = 012 014 -01;", "C001   = 010 014 -01;", "H000 = +000000.0100 ;", "H001 = +000000.1690 ;"]
    writer.lines += ["QAIC(2,1,0.1250,3);", "G55;", "G90;"]
    writer.start()
    writer.lines += ["G29;", "T94;", "T84;"]
    lead, ways = Line((at[0] + 500.0, at[1] + 500.0)), []
    there = IsoWriter(habits, lead.to)
    there.moves([Line(at), *moves])
    back = IsoWriter(habits, there.drawn)
    back.moves(_backwards(at, moves))
    for number, sub in ((1, there), (2, back)):
        ways += [f"N{number:04};", *sub.lines, "M99;"]
    writer.moves([lead], "C000 G41 H000 ")
    writer.line("C001 H001;")
    writer.call(there, "0001")
    if rng.random() < 0.5:
        writer.line("G40;")
        writer.line("G42 H001;")
        writer.call(back, "0002")
    writer.moves([lead], "G40 H000 ")
    writer.lines += ["T85;", "M02;", *ways]
    return _made("sodick", writer)


def mitsubishi(rng: random.Random) -> IsoProgram:
    """Inches with points and no zeros before them, registers as sums, passes written out back and forth."""
    habits = Habits(25_400.0, 5, leaves_out=True, is_short=True)
    ((at, moves),) = _contours(rng, 1)
    writer = IsoWriter(habits, at)
    writer.lines += ["%", "L001", " SQUARE PROGRAM ", "H175 = .0002"]
    passes = rng.randint(1, 4)
    writer.lines += [f"H{number} =.00{995 - 100 * number} + H175" for number in range(1, passes + 1)]
    writer.line("G90 M91")
    writer.start()
    writer.lines += ["M20 (THREAD)", "M78 M78", "M80 M82 M84"]
    lead = Line((at[0] + 300.0, at[1] - 2540.0))
    out = [*moved(moves, (at[0] - lead.to[0], at[1] - lead.to[1]))]
    for number in range(passes):
        writer.line(f"E128{number} F.0{number + 1}")
        if number == 0:
            writer.moves([lead, *out], f"G42 H{number + 1} ")
        else:
            way = out if number % 2 == 0 else _backwards(lead.to, out)
            writer.moves(way, f"G4{2 - number % 2} H{number + 1} ")
        writer.line("M01")
    writer.moves([Line(at)], "G40 ")
    writer.lines += ["M85 M83 M81", "M21 M58", "M02", "%"]
    return _made("mitsubishi", writer, "inch")


def fanuc(rng: random.Random) -> IsoProgram:
    """A program number, G91, inches or mm with points, zeros left out."""
    is_inch = rng.random() < 0.5
    habits = Habits(25_400.0 if is_inch else 1000.0, 4 if is_inch else 3, True, leaves_out=True)
    ((at, moves),) = _contours(rng, 1)
    writer = IsoWriter(habits, at)
    writer.lines += ["%", "O0027", "G91 S1 D1"]
    writer.start()
    writer.line("G42 (SIDE)")
    writer.moves(moves)
    writer.lines += ["G40", "M30", "%"]
    return _made("fanuc", writer, "inch" if is_inch else "mm")


def common(rng: random.Random) -> IsoProgram:
    """What any family reads: G90, mm with points."""
    contours = _contours(rng, 2)
    writer = IsoWriter(Habits(1000.0, 3, leaves_out=rng.random() < 0.5, step=rng.choice((0, 5, 10))), contours[0][0])
    writer.block("G21 G90")
    writer.start()
    for at, moves in contours:
        writer.rapid(at)
        writer.moves(moves)
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
