"""The tape of a replay: curves, every step with its time, the samples of table and wire, packed for the page.

Columns of curves alone, exact: pages draw by them what was run, and what never was.

Each step is one byte: which way it goes. A staircase repeats itself, so a step takes about as long as the last step of
the same way did: the tape has the difference, in ticks. Times are rounded to ticks since the start, so nothing adds
up. The table is told by where it lies from its command, and the wire by where it lies from the table. For the deviation
of the wire the tape has the block that each sample is measured from: the page looks for no block itself.

A column of numbers is text, as `sim.show.html.packed` packs it.
"""

from collections.abc import Iterator
from itertools import pairwise
from typing import NamedTuple, cast

import numpy as np

from controller.stepping.pulses import Pulses
from parser.drawing.model import Drawing
from parser.geometry.curves import CurveKind, Curves, Floats, Ints, joined, jump_between
from sim.base.units import column
from sim.measure.compare.starts import Placement, laid_loops
from sim.show.html.packed import Packer
from sim.show.replay.model import CurvesEntry, TapeEntry
from sim.table.trace import Trace

_ANGLE_DIGITS = 12
"""On a radius of a metre they tell a place to 10⁻⁶ µm, as its own digits do."""


def exact_columns(path: Curves) -> CurvesEntry:
    """Columns of n curves, each from the end of the last one, that pages draw a path by; `place_*` have n + 1."""
    place_um = np.concatenate([path.start_um[:1], path.end_um])
    columns = {
        "kind": [CurveKind(kind).name.lower() for kind in path.kind.tolist()],
        "place_x_um": column(place_um[:, 0]),
        "place_y_um": column(place_um[:, 1]),
        "center_x_um": column(path.center_um[:, 0]),
        "center_y_um": column(path.center_um[:, 1]),
        "radius_um": column(path.radius_um),
        "start_angle_rad": column(path.start_angle_rad, _ANGLE_DIGITS),
        "sweep_rad": column(path.sweep_rad, _ANGLE_DIGITS),
        "length_um": column(path.length_um),
    }
    return cast(CurvesEntry, columns)  # what an arc alone has is None elsewhere


def drawing_columns(drawing: Drawing, placement: Placement) -> CurvesEntry:
    """Columns that pages draw a drawing by as it is laid: its loops one behind the other, with jumps between them."""
    return exact_columns(joined(list(_with_jumps(laid_loops(drawing, placement)))))


def _with_jumps(loops: list[Curves]) -> Iterator[Curves]:
    """Each loop, and before it the jump from the end of the last."""
    yield from loops[:1]
    for before, behind in pairwise(loops):
        yield jump_between(before.end_um[-1], behind.start_um[0])
        yield behind


TICK_S = 1e-5
"""Times are rounded to it."""
GRAIN_UM = 0.01
"""Places of table and wire are rounded to it."""
_AT_ONCE = 1 << 18
"""Steps worked on at once, in little memory."""
_WAYS = 9
"""Ways of a step: by −1, 0 or +1 in X and in Y."""


class _Before(NamedTuple):
    """What the coding of steps goes on from: place, ticks, and the ticks (9,) that the last step of each way took."""

    x_um: int
    y_um: int
    ticks: int
    took: Ints


def tape(steps: Pulses, origin_um: tuple[int, int], trace: Trace, foot_row: Ints) -> TapeEntry:
    """Steps from an origin and samples as a page reads them, texts in base64 and numbers.

    `foot_row` (m,) is the row of the block that the wire's deviation is measured from at each of the m samples.
    The columns of `steps` may be mapped from files; they are gone through once, in bounded memory.
    """
    moves, times = Packer(), Packer()
    sampled = np.rint(trace.t_s / TICK_S).astype(np.int64)
    done = np.zeros(len(sampled), dtype=np.int64)
    before = _Before(*origin_um, 0, np.zeros(_WAYS, dtype=np.int64))
    for since in range(0, len(steps.t_s), _AT_ONCE):
        part = steps.part(since, since + _AT_ONCE)
        ticks = np.rint(part.t_s / TICK_S).astype(np.int64)
        before = _pack(part, ticks, before, moves, times)
        first, past = np.searchsorted(sampled, ticks[[0, -1]])
        done[first:past] += np.searchsorted(ticks, sampled[first:past], side="right")
        done[past:] += len(ticks)
    table_x, table_y, wire_x, wire_y = _places(trace, _commanded(steps, origin_um, done))
    return {
        "tick_s": TICK_S,
        "grain_um": GRAIN_UM,
        "origin_um": list(origin_um),
        "steps": len(steps.t_s),
        "moves": moves.text(),
        "step_ticks": times.text(),
        "samples": len(sampled),
        "sample_ticks": _packed(np.diff(sampled, n=2, prepend=[0, 0])),
        "table_x": table_x,
        "table_y": table_y,
        "wire_x": wire_x,
        "wire_y": wire_y,
        "foot_row": _changes(foot_row),
    }


def _pack(part: Pulses, ticks: Ints, before: _Before, moves: Packer, times: Packer) -> _Before:
    """Pack some steps behind those before. ValueError where one of them moves an axis by more than a pulse."""
    dx = np.diff(part.x_um, prepend=np.int32(before.x_um))
    dy = np.diff(part.y_um, prepend=np.int32(before.y_um))
    longest = max(np.abs(dx).max(), np.abs(dy).max())
    if longest > 1:
        raise ValueError(f"a step moves an axis by 1 µm at most, not by {longest}")
    way = (3 * (dx + 1) + dy + 1).astype(np.uint8)
    took = np.diff(ticks, prepend=before.ticks)
    more, latest = np.empty_like(took), before.took.copy()
    for each in range(_WAYS):
        of = np.flatnonzero(way == each)
        if len(of):
            more[of] = np.diff(took[of], prepend=latest[each])
            latest[each] = took[of[-1]]
    moves.bytes(way)
    times.numbers(more)
    return _Before(int(part.x_um[-1]), int(part.y_um[-1]), int(ticks[-1]), latest)


def _commanded(steps: Pulses, origin_um: tuple[int, int], done: Ints) -> Floats:
    """Places (m, 2) µm commanded once so many steps are done."""
    begun = np.flatnonzero(done)
    places = np.tile(np.array(origin_um, dtype=np.float64), (len(done), 1))
    places[begun, 0], places[begun, 1] = steps.x_um[done[begun] - 1], steps.y_um[done[begun] - 1]
    return places


def _places(trace: Trace, commanded_um: Floats) -> tuple[str, str, str | None, str | None]:
    """X and Y of the table, then of the wire; None for a wire that stays with the table."""
    table = np.rint((trace.table_um - commanded_um) / GRAIN_UM).astype(np.int64)
    placed = commanded_um + table * GRAIN_UM
    wire = np.rint((trace.wire_um - placed) / GRAIN_UM).astype(np.int64)
    bows = trace.wire_um is not trace.table_um
    x, y = (_changes(wire[:, 0]), _changes(wire[:, 1])) if bows else (None, None)
    return _changes(table[:, 0]), _changes(table[:, 1]), x, y


def _changes(column: Ints) -> str:
    return _packed(np.diff(column, prepend=0))


def _packed(column: Ints) -> str:
    packer = Packer()
    packer.numbers(column)
    return packer.text()
