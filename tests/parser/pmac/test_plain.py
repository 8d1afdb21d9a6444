"""A slow plain interpreter of motion programs, by small steps, beside the reader."""

import math

import numpy as np
import pytest

from parser.program import parse_program

PROGRAMS = (
    "ABS\nRAPID X1 Y2\nLINEAR X11 F120\nY12\nINC\nX-3 Y-4\nCIRCLE1 X2 Y-2 I0 J-2\nX-2 Y2 I-2 J0",
    "LINEAR X10 Y0\nCIRCLE2 X0 Y10 I-10 J0\nCIRCLE1 X10 Y0 I0 J-10",
    "CIRCLE2 X6 Y0 R-4\nCIRCLE1 X0 Y0 R5\nINC\nCIRCLE2 X3 Y3 R3\nLINEAR X1",
    "CIRCLE1 X0 Y0 I5 J5\nLINEAR X1 Y1\nINC X1\nABS Y9",
)
STEPS = 20_000


def plain(text: str) -> list[tuple[float, float, float]]:
    """End and length of each move, mm: arcs are walked in small chords."""
    x = y = 0.0
    mode, absolute, moves = "LINEAR", True, []
    for line in text.splitlines():
        words = {}
        for word in line.split():
            if word in {"ABS", "INC"}:
                absolute = word == "ABS"
            elif word in {"RAPID", "LINEAR", "CIRCLE1", "CIRCLE2"}:
                mode = word
            else:
                words[word[0]] = float(word[1:])
        if not words:
            continue
        ox, oy = (0.0, 0.0) if absolute else (x, y)
        x1, y1 = ox + words.get("X", x - ox), oy + words.get("Y", y - oy)
        length = math.hypot(x1 - x, y1 - y) if mode in {"RAPID", "LINEAR"} else walked(mode, (x, y), (x1, y1), words)
        moves.append((x1, y1, length))
        x, y = x1, y1
    return moves


def walked(mode: str, start_mm: tuple[float, float], end: tuple[float, float], words: dict[str, float]) -> float:
    (x, y), (x1, y1) = start_mm, end
    turn = 1 if mode == "CIRCLE2" else -1
    if "R" in words:
        # The one of both centres, by trying, whose arc is minor for R > 0 and major for R < 0.
        radius, chord = abs(words["R"]), math.hypot(x1 - x, y1 - y)
        height = math.sqrt(radius * radius - chord * chord / 4)
        for side in (-1, 1):
            cx = (x + x1) / 2 - side * height * (y1 - y) / chord
            cy = (y + y1) / 2 + side * height * (x1 - x) / chord
            angle = swept(x - cx, y - cy, x1 - cx, y1 - cy, turn)
            if (angle <= math.pi) == (words["R"] > 0):
                break
    else:
        cx, cy = x + words.get("I", 0.0), y + words.get("J", 0.0)
        angle = swept(x - cx, y - cy, x1 - cx, y1 - cy, turn)
    radius, start = math.hypot(x - cx, y - cy), math.atan2(y - cy, x - cx)
    along = start + turn * np.linspace(0.0, angle, STEPS)
    path = np.column_stack([cx + radius * np.cos(along), cy + radius * np.sin(along)])
    assert math.dist(path[-1], (x1, y1)) < 1e-9
    return float(np.hypot(*np.diff(path, axis=0).T).sum())


def swept(ax: float, ay: float, bx: float, by: float, turn: int) -> float:
    return (turn * (math.atan2(by, bx) - math.atan2(ay, ax))) % math.tau or math.tau


@pytest.mark.parametrize("body", PROGRAMS)
def test_the_reader_moves_as_the_plain_interpreter(body: str) -> None:
    path = parse_program(f"I5113=10\nOPEN PROG 1\nCLEAR\n{body}\nCLOSE\n", "part.pmc").toolpath
    wanted = np.array(plain(body))
    assert np.abs(path.end_um - 1000.0 * wanted[:, :2]).max() < 0.01
    assert np.abs(path.length_um - 1000.0 * wanted[:, 2]).max() < 0.01
