"""The true offset beside shapely's buffer with eight chords to a quarter turn, on the same contour in one run.

The contour is a wavy ring of lines and arcs, each about 0.1 mm long, with corners between them. The offset of a
controller on it is timed too: one that the user asks for, and one that the program tells of.
"""

import time
from collections.abc import Callable
from typing import NamedTuple, TypeVar

import numpy as np
import shapely
from compensating import told
from paths import toolpath_of

from controller.offset.compensate import compensate
from controller.offset.gouges import gouges
from controller.offset.programmed import compensated
from controller.offset.reach import reach
from controller.offset.shifted import OffsetSection, Side
from parser.geometry.along import places_at
from parser.geometry.curves import Curves, Floats, curves_between
from parser.geometry.near import nearest_um

F_UM = 100.0
BLOCK_UM = 100.0
_ROUNDS = 3
T = TypeVar("T")


class Comparison(NamedTuple):
    """µs a vertex, and the largest error µm of the distance from the contour; and µs a vertex to look for gouges.

    `asked_us` and `told_us` are those of a controller, for an offset that the user asks for, or the program tells of.
    """

    ours_us: float
    ours_off_um: float
    chords_us: float
    chords_off_um: float
    gouges_us: float
    asked_us: float
    told_us: float


def wavy_ring(blocks: int) -> Curves:
    """A closed contour, counter-clockwise, every third block an arc."""
    rng = np.random.default_rng(20260101)
    angle = np.linspace(0.0, 2.0 * np.pi, blocks, endpoint=False)
    radius = BLOCK_UM * blocks / (2.0 * np.pi) * (1.0 + 0.3 * np.sin(7.0 * angle)) + rng.normal(0.0, 5.0, blocks)
    start = radius[:, None] * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    end = np.roll(start, -1, axis=0)
    sweep = np.where(np.arange(blocks) % 3 == 2, rng.choice([-1.0, 1.0], blocks) * rng.uniform(0.1, 0.8, blocks), 0.0)
    by = end - start
    off = 0.5 / np.tan(0.5 * np.where(sweep == 0.0, 1.0, sweep))
    center = 0.5 * (start + end) + off[:, None] * np.stack([-by[:, 1], by[:, 0]], axis=1)
    return curves_between(start, end, center, sweep)


def compare(blocks: int) -> Comparison:
    """Time both, the fastest of three."""
    contour = wavy_ring(blocks)
    ours_s, reached = _timed(lambda: reach(contour, F_UM, Side.LEFT))
    loops = [loop.curves for loop in reached.loops]
    rows = (np.arange(len(loop)) for loop in loops)
    ours = np.concatenate([places_at(loop, row, 0.3 * loop.length_um) for loop, row in zip(loops, rows, strict=True)])
    polygon = shapely.Polygon(_chords(contour))
    chords_s, buffer = _timed(lambda: polygon.buffer(-F_UM, quad_segs=8))
    theirs = shapely.get_coordinates(buffer)
    gouges_s, _ = _timed(lambda: [gouges(contour, loop, F_UM, Side.LEFT) for loop in loops])
    asked_s, _ = _timed(lambda: compensate(contour, [OffsetSection(0, blocks - 1, closed=True)], F_UM, Side.LEFT))
    program = told(toolpath_of(contour), Side.LEFT, F_UM)
    told_s, _ = _timed(lambda: compensated(program))
    per = 1e6 / blocks
    return Comparison(
        ours_us=ours_s * per,
        ours_off_um=_off(contour, ours),
        chords_us=chords_s * per,
        chords_off_um=_off(contour, theirs),
        gouges_us=gouges_s * per,
        asked_us=asked_s * per,
        told_us=told_s * per,
    )


def offset_lines(blocks: int) -> list[str]:
    """What to print of it."""
    made = compare(blocks)
    return [
        f"true offset         {made.ours_us:.1f} µs per vertex, off by {made.ours_off_um:.1g} µm",
        f"offset of chords    {made.chords_us:.1f} µs per vertex by shapely, off by {made.chords_off_um:.1g} µm",
        f"gouges              {made.gouges_us:.1f} µs per vertex",
        f"controller's offset {made.asked_us:.1f} µs per block asked for by a user, {made.told_us:.1f} by the program",
    ]


def _chords(contour: Curves) -> Floats:
    """Vertices of the contour, eight chords to a quarter turn of its arcs."""
    number = np.where(contour.is_arc, np.ceil(np.abs(contour.sweep_rad) / (np.pi / 16.0)), 1).astype(np.int64)
    row = np.repeat(np.arange(len(contour)), number)
    at = np.arange(len(row)) - np.repeat(np.cumsum(number) - number, number)
    return places_at(contour, row, at / number[row] * contour.length_um[row])


def _off(contour: Curves, place_um: Floats) -> float:
    return float(np.abs(nearest_um(contour, place_um, 2.0 * F_UM) - F_UM).max())


def _timed(run: Callable[[], T]) -> tuple[float, T]:
    times = []
    for _ in range(_ROUNDS):
        began = time.perf_counter()
        result = run()
        times.append(time.perf_counter() - began)
    return min(times), result


if __name__ == "__main__":
    print("\n".join(offset_lines(10_000)))
