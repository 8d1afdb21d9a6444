"""The interpolator: the array code equals the four beats walked one by one, on every step."""

import numpy as np
import pytest
from chunked import chunks_of
from depth import examples
from hypothesis import example, given, settings
from hypothesis import strategies as st
from long_steps import SEED, run
from places import SCENARIOS
from plain import PlainBlock, plain_steps
from strategies import arcs, blocks, lines, program_text, programs

from controller.stepping.chunks import chunk_of
from controller.stepping.steps import Steps, interpolate
from controller.stepping.strokes import ceil_sqrt
from parser.program import parse_program, read_program


def steps_of(*program: PlainBlock) -> Steps:
    return interpolate(parse_program(program_text(list(program))).toolpath)


def places(steps: Steps, size: int = 1 << 18) -> list[tuple[int, int]]:
    return [
        place
        for chunk in chunks_of(steps, size)
        for place in zip(chunk.x_um.tolist(), chunk.y_um.tolist(), strict=True)
    ]


def test_keyhole_makes_the_published_steps() -> None:
    steps = interpolate(read_program(SCENARIOS / "keyhole" / "program.3b").toolpath)
    assert steps.count.tolist() == [24900, 99600, 56757, 336086, 56758, 24900]
    assert np.hypot(*steps.corner_um[-1]) == pytest.approx(2.24, abs=0.005)  # µm
    ends = [[0, 24900], [0, -24900], [56757, -24900], [56757, 24900], [1, 24902], [1, 2]]  # by the plain walk
    assert steps.corner_um[1:].tolist() == ends


def test_round_hole_closes_to_the_step() -> None:
    steps = interpolate(read_program(SCENARIOS / "round-hole" / "program.3b").toolpath)
    assert steps.corner_um[-1].tolist() == [0, 0]


@settings(max_examples=examples(400))
@given(lines())
@example(PlainBlock(0, 9, 9, "Y", "L", 1))  # the neighbour's label on an axis: one stray step
@example(PlainBlock(7, 7, 7, "Y", "L", 1))
@example(PlainBlock(7, 7, 7, "X", "L", 1))
def test_lines_step_as_the_plain_walk(block: PlainBlock) -> None:
    assert places(steps_of(block)) == plain_steps(block)


@settings(max_examples=examples(400))
@given(arcs())
@example(PlainBlock(1, 1, 40, "X", "NR", 1))
@example(PlainBlock(2, 0, 40, "Y", "SR", 4))
@example(PlainBlock(9900, 0, 39600, "X", "NR", 1))  # the wrong count axis
@example(PlainBlock(9900, 0, 100000, "Y", "SR", 1))  # more than two turns
def test_arcs_step_as_the_plain_walk(block: PlainBlock) -> None:
    assert places(steps_of(block)) == plain_steps(block)


@settings(max_examples=examples(50))
@given(programs, st.integers(20, 200))
def test_programs_step_block_after_block_in_any_chunks(program: list, size: int) -> None:
    expected, x, y = [], 0, 0
    for block in program:
        walked = [(x + dx, y + dy) for dx, dy in plain_steps(block)]
        expected += walked
        x, y = walked[-1]
    steps = steps_of(*program)
    assert places(steps, size) == expected
    assert steps.corner_um[-1].tolist() == [x, y]
    rows = np.concatenate([chunk.row for chunk in chunks_of(steps, size)])
    assert np.array_equal(rows, np.repeat(np.arange(len(program)), steps.count))


def test_random_programs_of_all_sizes_step_as_the_plain_walk() -> None:
    done, wrong = run(300_000, SEED)
    assert done >= 300_000
    assert wrong == []


@given(programs, st.data())
def test_place_after_any_number_of_steps(program: list, data: st.DataObject) -> None:
    steps = steps_of(*program)
    walked = [(0, 0), *places(steps)]
    for count in (0, len(steps), data.draw(st.integers(0, len(steps)))):
        assert steps.place_after(count) == walked[count]


@given(programs)
def test_path_length_never_falls_and_each_step_is_one_axis(program: list) -> None:
    steps = steps_of(*program)
    chunk = chunk_of(steps, 0, len(steps))
    along = np.concatenate([[0.0], chunk.along_um])
    assert np.diff(along).min() >= -1e-9
    assert along[-1] <= steps.along_um[-1] + 1e-6
    moves = np.abs(np.diff(chunk.x_um, prepend=0)) + np.abs(np.diff(chunk.y_um, prepend=0))
    assert set(moves.tolist()) == {1}


@settings(max_examples=examples(60))
@given(st.integers(2_000, 20_000), st.floats(0.0, 6.28), st.floats(0.05, 6.2), st.sampled_from([1, -1]))
def test_step_deviates_no_more_than_a_micrometre_from_its_circle(
    radius: int, start: float, sweep: float, turn: int
) -> None:
    x0, y0 = round(radius * np.cos(start)), round(radius * np.sin(start))
    quadrant = next(
        q for q, (sx, sy) in {1: (1, 1), 2: (-1, 1), 3: (-1, -1), 4: (1, -1)}.items() if sx * x0 >= 0 and sy * y0 >= 0
    )
    exact = np.hypot(x0, y0)
    count = max(1, int(exact * sweep * 2 / np.pi))
    block = PlainBlock(abs(x0), abs(y0), count, "X", "NR" if turn > 0 else "SR", quadrant)
    steps = steps_of(block)
    chunk = chunk_of(steps, 0, len(steps))
    off = np.hypot(chunk.x_um + x0, chunk.y_um + y0) - exact
    assert np.abs(off).max() <= 1.0  # µm


def test_a_large_circle_is_exact_where_floats_are_not() -> None:
    radius = 800_000_000  # µm; 2R² is past 2⁵², where a float root is no longer sure
    steps = steps_of(PlainBlock(radius, 0, 3_000_000, "Y", "NR", 1))
    x, y = steps.corner_um[-1].tolist()
    assert y == 3_000_000
    # F < 0 before the last step, F ≥ 0 before the last step toward the centre.
    assert (radius + x) ** 2 + (y - 1) ** 2 < radius**2 <= (radius + x + 1) ** 2 + y**2


@given(st.lists(st.integers(0, 2**62), min_size=1))
def test_ceil_sqrt_is_exact(squares: list[int]) -> None:
    roots = ceil_sqrt(np.array(squares, dtype=np.int64)).tolist()
    for root, square in zip(roots, squares, strict=True):
        assert root * root >= square
        assert root == 0 or (root - 1) ** 2 < square


@pytest.mark.parametrize("root", [2, 2**25, 2**26 - 1, 2**26, 2**26 + 1, 2**30, 2**31 - 1])
def test_ceil_sqrt_beside_squares(root: int) -> None:
    squares = np.array([root * root - 1, root * root, root * root + 1], dtype=np.int64)
    assert ceil_sqrt(squares).tolist() == [root, root, root + 1]


def test_many_turns_cost_no_more_than_the_steps_asked_for() -> None:
    steps = steps_of(PlainBlock(1, 1, 999_999_999, "X", "NR", 1))
    assert len(steps) > 1_000_000_000
    last = chunk_of(steps, len(steps) - 1000, len(steps))
    assert len(last.x_um) == 1000
    assert np.abs(last.x_um).max() <= 4


def test_wrong_count_axis_stops_a_circle_140_micrometres_early() -> None:
    steps = steps_of(PlainBlock(9900, 0, 39600, "X", "NR", 1))
    assert np.hypot(*steps.corner_um[-1]) == pytest.approx(140, abs=2)  # µm, docs/3b.md §1


@given(blocks)
def test_chunks_out_of_range_are_refused(block: PlainBlock) -> None:
    steps = steps_of(block)
    with pytest.raises(ValueError, match="steps"):
        chunk_of(steps, 0, len(steps) + 1)


def test_blocks_that_never_end_make_no_step() -> None:
    program = parse_program("B0B0B10GXNR1 B0B5B5GXL2 B5B0B5GXL1 DD")
    assert interpolate(program.toolpath).count.tolist() == [0, 0, 5]


def walked_one_by_one(program: list[PlainBlock]) -> list[tuple[int, int]]:
    expected, x, y = [], 0, 0
    for block in program:
        steps = [(x + dx, y + dy) for dx, dy in plain_steps(block)]
        expected += steps
        x, y = steps[-1]
    return expected


@pytest.mark.alike(1)
@pytest.mark.parametrize("sense", ["L", "NR", "SR"])
def test_every_small_block_steps_as_the_plain_walk(sense: str) -> None:
    """All directions, starts and axes up to 4 µm: roots of squares and of numbers beside them are among the radii."""
    program = [
        PlainBlock(x, y, count, axis, sense, quadrant)
        for x in range(5)
        for y in range(5)
        for quadrant in (1, 2, 3, 4)
        for axis in "XY"
        for count in (1, 17)
        if (x * x + y * y > 1 if sense != "L" else (x if axis == "X" else y))
    ]
    steps = steps_of(*program)
    assert places(steps) == walked_one_by_one(program)
    assert len(steps) == len(places(steps, 7))
    for since, until in ((0, 1), (5, 6), (17, 40), (len(steps) - 1, len(steps)), (9, 9)):
        assert places(steps)[since:until] == [
            (int(x), int(y)) for x, y in zip(*chunk_of(steps, since, until)[:2], strict=True)
        ]
