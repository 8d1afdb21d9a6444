"""Walls: by how much the gap at them is wider where sparks had more time than usual."""

import math

from controller.compiled.loops import compiled
from parser.geometry.curves import Floats
from sim.process.ticks.state import Walls


@compiled("f8(f8)")
def side_gap_ratio(time_ratio: float) -> float:
    """By how much the gap at a wall grows where sparks have so many times the usual time for it: the cube root of that.

    At a gap g far above the closest one the delay of a spark grows as g², so that a wall recedes at a rate of 1 / g²:
    g³ grows with the time. Derived, and measured by nobody.
    """
    return math.exp(math.log(time_ratio) / 3.0)


@compiled("void(Walls, f8[::1], f8[::1], f8[::1])", Walls)
def widen(walls: Walls, along_um: Floats, lit_s: Floats, wider_um: Floats) -> None:
    """Fill in (m,) by how much the gap is wider in each stretch of path, µm; 0 where nothing was cut.

    What is not cut counts for nothing: a stretch beside it has the time of its other neighbours. `along_um` (n + 1,) is
    the path before each row, `lit_s` (m,) the time with sparks in each stretch.
    """
    count, row, last = len(lit_s), 0, len(walls.usual_s) - 1
    for at in range(count):
        while row < last and at * walls.stretch_um >= along_um[row + 1]:
            row += 1
        low, high = max(at - walls.half, 0), min(at + walls.half + 1, count)
        seconds, cut = 0.0, 0
        for near in range(low, high):
            if lit_s[near] > 0.0:
                seconds += lit_s[near]
                cut += 1
        wider_um[at] = 0.0
        if walls.usual_s[row] > 0.0 and cut > 0 and at * walls.stretch_um >= walls.start_um[row]:
            times = seconds / cut / walls.usual_s[row]
            wider_um[at] = max(walls.gap_um[row], 0.0) * (side_gap_ratio(times) - 1.0)
