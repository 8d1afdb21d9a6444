"""The Archimedean spiral of the PMAC paper as G-code: r = 0.5 + 3 φ / 2π mm, three turns, in lines of one degree."""

import math

TURNS = 3
START_MM, PER_TURN_MM = 0.5, 3.0
STEPS = 360
"""Lines a turn."""


def radius_mm(angle: float) -> float:
    """Radius at an angle, rad."""
    return START_MM + PER_TURN_MM * angle / math.tau


def length_mm(turns: float = TURNS) -> float:
    """Closed form of the length: with r = a + b φ, ∫ √(r² + b²) dφ."""
    b = PER_TURN_MM / math.tau

    def primitive(r: float) -> float:
        return (r * math.hypot(r, b) + b * b * math.asinh(r / b)) / (2.0 * b)

    return primitive(START_MM + PER_TURN_MM * turns) - primitive(START_MM)


def chord_error_um(samples: int = 20) -> float:
    """How far the lines are from the spiral at most, µm, without the rounding of places."""
    worst = 0.0
    for row in range(TURNS * STEPS):
        first, past = math.tau * row / STEPS, math.tau * (row + 1) / STEPS
        (x0, y0), (x1, y1) = place_mm(first), place_mm(past)
        chord = math.hypot(x1 - x0, y1 - y0)
        for at in range(1, samples):
            x, y = place_mm(first + (past - first) * at / samples)
            worst = max(worst, abs((x1 - x0) * (y - y0) - (y1 - y0) * (x - x0)) / chord)
    return 1000.0 * worst


def place_mm(angle: float) -> tuple[float, float]:
    """Place at an angle."""
    return radius_mm(angle) * math.cos(angle), radius_mm(angle) * math.sin(angle)


def spiral_iso(digits: int = 3) -> str:
    """The program, in mm: with three digits its places are whole steps of a machine, and up to 0.71 µm off."""
    lines = ["(Archimedean spiral, r = 0.5 + 3 phi/2pi mm, chord error 0.36 um)", "G90 G00 X0.5 Y0"]
    for row in range(1, TURNS * STEPS + 1):
        x, y = (f"{value:.{digits}f}" for value in place_mm(math.tau * row / STEPS))
        first = "G01 " if row == 1 else ""
        feed = " F60" if row == 1 else ""
        lines.append(f"{first}X{_plain(x)} Y{_plain(y)}{feed}")
    return "\n".join([*lines, "M02", ""])


def spiral_arcs_iso() -> str:
    """The same in quarters, each an arc about the middle: no arc of a G-code, as start and end differ in radius."""
    lines, (x, y) = ["G90 G00 X0.5 Y0"], place_mm(0.0)
    for quarter in range(1, 4 * TURNS + 1):
        angle = math.tau * quarter / 4.0
        x1, y1 = (round(value, 4) for value in place_mm(angle))
        lines.append(f"G03 X{x1:g} Y{y1:g} I{0.0 - x:g} J{0.0 - y:g}{' F60' if quarter == 1 else ''}")
        x, y = x1, y1
    return "\n".join([*lines, "M02", ""])


def _plain(number: str) -> str:
    return number.removeprefix("-") if float(number) == 0.0 else number
