"""Chunks: any stretch of a program's steps, made one after the other as a 3B controller makes them (docs/3b.md §3).

Where a stroke is entered in its middle, its closed form tells how far it is; from there on F leads, in a compiled loop.
"""

from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from controller.compiled.loops import compiled
from controller.stepping.steps import Steps
from controller.stepping.strokes import Strokes, firsts_among, lengths_of_arcs, lengths_of_lines
from parser.geometry.curves import Floats, Ints

CHUNK_STEPS = 1 << 18
"""Steps worked out at once: their arrays stay in a processor's cache, and the cost of an array call is spread thin."""

Whole = NDArray[np.int32]

# Columns of strokes for the loop, as they are where it begins to walk them.
ROW: Final = 0
PLACE_X: Final = 1
PLACE_Y: Final = 2
FIRST_X: Final = 3  # a step on the first axis
FIRST_Y: Final = 4
SECOND_X: Final = 5  # a step on the second axis
SECOND_Y: Final = 6
A: Final = 7  # of lines the extent on the first axis, of arcs u
B: Final = 8  # of lines the extent on the second axis, of arcs v
RADIUS_SQ: Final = 9  # 0 on lines
MADE: Final = 10  # steps made before
MADE_ON_FIRST: Final = 11  # and how many of them on the first axis
TAKEN: Final = 12  # steps to make


class StepChunk(NamedTuple):
    """m steps in order.

    Attributes
    ----------
    x_um, y_um
        (m,) int32, where the table stands after each step, from where it stood at the program's start.
    row
        (m,) int32, row of the toolpath that made the step.
    along_um
        (m,) float64, length of the ideal path covered by then, never falling: that of the step's foot on it. Along a
        line that is its share in the direction, along an arc the angle seen from the centre.
    """

    x_um: Whole
    y_um: Whole
    row: Whole
    along_um: Floats


def chunk_of(steps: Steps, since: int, until: int) -> StepChunk:
    """Steps number since + 1 to until. ValueError unless 0 ≤ since ≤ until ≤ len."""
    if not 0 <= since <= until <= len(steps):
        raise ValueError(f"steps {since} to {until} of {len(steps)}")
    strokes = steps.strokes_of(since, until)
    before = steps.before[strokes.row] + strokes.base
    made = np.maximum(since - before, 0)
    taken = np.minimum(until - before, strokes.steps) - made
    x, y, row = (np.empty(until - since, dtype=np.int32) for _ in range(3))
    along, toward = np.empty(until - since), np.empty(until - since)
    _walk(_begun(strokes, made, taken), lengths_of_lines(strokes), x, y, row, along, toward)
    if strokes.is_arc.any():
        arc, turned = np.repeat(strokes.is_arc, taken), strokes.picked(strokes.is_arc)
        lead, radius = (np.repeat(column, taken[strokes.is_arc]) for column in lengths_of_arcs(turned))
        along[arc] = lead + radius * np.arctan2(along[arc], toward[arc])
    return StepChunk(x, y, row, along)


def _begun(strokes: Strokes, made: Ints, taken: Ints) -> Ints:
    """Columns (m, 13) of strokes of which some steps (m,) are made, and some (m,) are to be made."""
    on_first = firsts_among(strokes, made)
    on_second = made - on_first
    place = strokes.origin + strokes.first * on_first[:, None] + strokes.second * on_second[:, None]
    a = np.where(strokes.is_arc, strokes.a - on_first, strokes.a)
    b = np.where(strokes.is_arc, strokes.b + on_second, strokes.b)
    numbers = a, b, strokes.radius_sq, made, on_first, taken
    return np.column_stack([strokes.row, place, strokes.first, strokes.second, *numbers])


@compiled("void(i8[:, ::1], f8[:, ::1], i4[::1], i4[::1], i4[::1], f8[::1], f8[::1])")
def _walk(  # noqa: PLR0913, PLR0917 - a compiled loop fills columns one by one
    strokes: Ints, lines: Floats, x_um: Whole, y_um: Whole, row: Whole, along_um: Floats, toward_um: Floats
) -> None:
    """Walk strokes (m, 13), lengths of lines (m, 3) beside them: while F ≥ 0 the first axis steps, else the second.

    Of arcs `along_um` gets v, and `toward_um` u, of which the angle is made afterwards.
    """
    end = 0
    for stroke in range(len(strokes)):
        x, y, a, b = strokes[stroke, PLACE_X], strokes[stroke, PLACE_Y], strokes[stroke, A], strokes[stroke, B]
        first_x, first_y = strokes[stroke, FIRST_X], strokes[stroke, FIRST_Y]
        second_x, second_y = strokes[stroke, SECOND_X], strokes[stroke, SECOND_Y]
        made, on_first = strokes[stroke, MADE], strokes[stroke, MADE_ON_FIRST]
        is_arc = strokes[stroke, RADIUS_SQ] > 0
        f = a * a + b * b - strokes[stroke, RADIUS_SQ] if is_arc else a * (made - on_first) - b * on_first
        by_first, by_step, lead = lines[stroke]
        begin, end = end, end + strokes[stroke, TAKEN]
        for i in range(begin, end):
            goes_first = f >= 0
            if goes_first:
                x, y = x + first_x, y + first_y
            else:
                x, y = x + second_x, y + second_y
            if is_arc:  # u falls by the first axis, v rises by the second: F = u² + v² − R²
                if goes_first:
                    f, a = f - 2 * a + 1, a - 1
                else:
                    f, b = f + 2 * b + 1, b + 1
                along_um[i], toward_um[i] = b, a
            else:  # F = a · steps on the second axis − b · steps on the first
                f = f - b if goes_first else f + a
                made, on_first = made + 1, on_first + goes_first
                along_um[i] = by_first * on_first + by_step * made + lead
            x_um[i], y_um[i], row[i] = x, y, strokes[stroke, ROW]
