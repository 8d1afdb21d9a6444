"""What a path is made of, and where its fields stand in the text."""

import math
import random

import numpy as np
import pytest
from paths import Pen

from parser.geometry.curves import Ints
from parser.program import parse_program
from parser.shape.contours import contour_rows, corners_at, find_contours, runs
from parser.shape.loops import find_loops, latest_return
from parser.shape.open_edges import Section, find_turns, is_slot
from parser.shape.parallel_runs import Stretches, run_beside
from parser.text.source import Field, Source
from parser.toolpath import Toolpath

TWO_HOLES = "B5B0B5GXL1B5B0B20GYNR1B5B0B5GXL3 D B9B0B9GXL1 D B5B0B5GXL1B5B0B20GYNR1 DD"


def test_jumps_part_the_runs() -> None:
    toolpath = parse_program(TWO_HOLES).toolpath
    assert toolpath.is_jump.tolist() == [False] * 3 + [True] + [False] * 2
    assert runs(toolpath).tolist() == [[0, 3], [4, 6]]
    assert contour_rows(toolpath).tolist() == [0, 0, 0, -1, 1, 1]
    contours = find_contours(toolpath, np.zeros((7, 2), dtype=np.int64))
    assert [(contour.first, contour.last) for contour in contours] == [(1, 3), (5, 6)]


def test_the_length_before_each_row() -> None:
    toolpath = parse_program("B3B4B4GYL1 B0B5B5GYL2 DD").toolpath
    assert toolpath.before_um.tolist() == [0.0, 5.0, 10.0]


@pytest.mark.parametrize("text", ["N1:B30 B0B 30 G X L 1 DD", "Ｎ１：Ｂ３０ B0B 30 ＧＸＬ１ DD"])
def test_a_source_tells_where_a_field_stands(text: str) -> None:
    source = parse_program(text).toolpath.source
    written = {field: source.field(0, field) for field in Field}
    shown = {field: text[slice(*span)] for field, span in written.items() if span}
    assert {field: "".join(said.split()) for field, said in shown.items()} == {
        Field.X: text[4:6],
        Field.Y: "0",
        Field.COUNT: "30",
        Field.AXIS: "GX" if text.isascii() else "ＧＸ",
        Field.SENSE: "L1" if text.isascii() else "Ｌ１",
    }
    assert written[Field.RADIUS] is None


def test_an_empty_field_has_its_place() -> None:
    source = parse_program("BBB40000GXL1 DD").toolpath.source
    assert source.field(0, Field.X) == (1, 1)


def test_nobody_points_at_fields_that_no_reader_finds() -> None:
    none = np.zeros(1, dtype=np.int64)
    source = Source("go", none + 1, np.array([[0, 2]]), none + 1, ("",))
    assert source.field(0, Field.X) is None
    assert source.block_text(0) == "go"


def plain_return(path: Toolpath, contour: Ints, row: int) -> int:
    """The latest row up to this one that starts where it ends, of its contour; only a circle returns to itself."""
    if contour[row] < 0:
        return -1
    near = [
        earlier
        for earlier in range(row + 1)
        if contour[earlier] == contour[row]
        and math.dist(path.start_um[earlier], path.end_um[row]) <= 5.0
        and (earlier < row or abs(path.sweep_rad[row]) > math.pi)
    ]
    return max(near, default=-1)


def test_a_path_comes_back_where_a_plain_search_finds_it() -> None:
    rng = random.Random(5)
    for _ in range(60):
        pen = Pen()
        for _ in range(40):
            x, y = (100.0 * rng.randint(-2, 2) + rng.uniform(-1.7, 1.7) for _ in range(2))
            kind = rng.random()
            if kind < 0.1:
                pen.jump(x, y)
            elif kind < 0.2:
                pen.arc(pen.x + 40.0, pen.y, 2.0 * math.pi)
            else:
                pen.to(x, y)
        path = pen.path()
        contour = contour_rows(path)
        expected = [plain_return(path, contour, row) for row in range(len(path))]
        assert latest_return(path, contour).tolist() == expected


@pytest.mark.parametrize(("off_um", "is_back"), [(4.9, True), (5.1, False)])
@pytest.mark.parametrize("turn", range(8))
def test_a_path_is_back_within_5_um_wherever_it_lies(off_um: float, turn: int, *, is_back: bool) -> None:
    for x in np.linspace(-12.0, 12.0, 9).tolist():
        angle = turn * math.pi / 4.0
        end = x + off_um * math.cos(angle), 3.0 + off_um * math.sin(angle)
        path = Pen(x, 3.0).to(1000.0, 0.0).to(1000.0, 1000.0).to(*end).path()
        assert latest_return(path, contour_rows(path)).tolist() == [-1, -1, 0 if is_back else -1]


@pytest.mark.parametrize(
    ("aside", "blocks", "is_turn"),
    [(399.0, 1, True), (401.0, 1, False), (390.0, 3, True), (396.0, 4, False)],
)
def test_a_path_turns_back_by_three_blocks_of_400_um_at_most(aside: float, blocks: int, *, is_turn: bool) -> None:
    pen = Pen().to(9000, 0)
    for number in range(blocks):
        pen.to(9000, aside * (number + 1) / blocks)
    path = pen.to(0, aside).path()
    turns = find_turns(path, contour_rows(path))
    assert list(zip(turns.arrive.tolist(), turns.leave.tolist(), turns.aside_um.tolist(), strict=True)) == (
        [(1, 1 + blocks, pytest.approx(aside))] * is_turn
    )


def test_a_jump_is_no_turn_and_a_slit_turns_with_no_step() -> None:
    slit = Pen().to(9000, 0).to(0, 0).jump(0, 100).to(9000, 100).path()
    turns = find_turns(slit, contour_rows(slit))
    assert (turns.arrive.tolist(), turns.leave.tolist(), turns.aside_um.tolist()) == ([1], [1], [0.0])


@pytest.mark.parametrize(("arcs", "within"), [(0, 5.0), (5, 5.0), (6, 6.0), (20, 20.0), (30, 20.0)])
def test_a_figure_ends_at_a_corner_within_1_um_an_arc(arcs: int, within: float) -> None:
    pen = Pen()
    for _ in range(arcs):
        pen.arc(pen.x, pen.y + 50.0, 2.0 * math.pi)
    path = pen.to(1000, 0).to(1000, 1000).to(0, 1000).path()
    first = np.arange(arcs + 1)
    for off, expected in ((within - 0.1, first), (within + 0.1, first[:0])):
        assert corners_at(path, 0, len(path), np.array([-off, 0.0])).tolist() == expected.tolist()


@pytest.mark.parametrize(
    ("sections", "begin", "loop", "slot"),
    [
        ([(2, 3, False), (5, 6, False)], 0, None, False),  # nothing closes
        ([(2, 3, False), (5, 6, False)], 0, (1, 7), True),
        ([(2, 3, False), (5, 6, True)], 0, (1, 7), False),  # the tab is cut
        ([(1, 3, False), (5, 7, False)], 0, (1, 7), True),
        ([(1, 3, False), (5, 8, False)], 0, (1, 7), False),
        ([(0, 3, False), (5, 7, False)], 0, (1, 7), False),
        ([(1, 3, False), (5, 6, False)], 0, (0, 7), False),  # out of the hole and back into it
        ([(0, 3, False), (5, 6, False)], 0, (0, 7), True),
    ],
)
def test_the_sides_of_a_slot_lie_in_its_loop(
    sections: list[tuple[int, int, bool]], begin: int, loop: tuple[int, int] | None, *, slot: bool
) -> None:
    assert is_slot([Section(*section) for section in sections], begin, loop) == slot


@pytest.mark.parametrize("back", [False, True])
@pytest.mark.parametrize(("aside", "share"), [(10.0, 1.0), (399.0, 1.0), (401.0, 0.0), (-250.0, 1.0)])
def test_stretches_run_beside_one_another_up_to_400_um(aside: float, share: float, *, back: bool) -> None:
    ends = [(9000.0, aside), (0.0, aside)] if back else [(0.0, aside), (9000.0, aside)]
    path = Pen().to(9000, 0).jump(*ends[0]).to(*ends[1]).path()
    stretches = Stretches(np.array([0, 2]), np.array([0, 2]))
    beside = run_beside(path, stretches, np.array([1]), np.array([0]))
    told = (beside.share[0], beside.sense[0], beside.aside_um[0])
    assert told == pytest.approx((share, (-1.0 if back else 1.0) * share, aside * share))


def test_half_a_stretch_has_half_its_places_beside_another() -> None:
    path = Pen().to(8000, 0).jump(0, 100).to(4000, 100).path()
    beside = run_beside(path, Stretches(np.array([0, 2]), np.array([0, 2])), np.array([1, 0]), np.array([0, 1]))
    # A foot may lie ahead by half of what it lies aside, and 5 µm.
    assert beside.share.tolist() == [0.5, 1.0]


@pytest.mark.parametrize("short_um", [1.0, 3.0, 4.9])
def test_a_loop_does_not_end_at_the_short_block_that_it_begins_with(short_um: float) -> None:
    pen = Pen().to(short_um, 0).to(9000, 0).to(9000, 9000).to(0, 9000).to(0, 0).to(-500, -500)
    path = pen.path()
    loops = find_loops(path, contour_rows(path), np.array([0]))
    assert (loops.first.tolist(), loops.last.tolist(), loops.part_side.tolist()) == ([0], [4], [0])


def test_a_short_block_comes_back_as_the_one_before_it_does() -> None:
    path = Pen().to(9000, 0).to(9000, 9000).to(3, 0).to(0, 0).path()
    assert latest_return(path, contour_rows(path)).tolist() == [-1, -1, 0, 0]


@pytest.mark.parametrize(
    ("lead", "arcs", "part_side"),
    [
        ("B1000B0B1000GXL1", "B1000B0B2000GYNR1 B1000B0B2000GYNR3", -1),
        ("B1000B0B1000GXL1", "B1000B0B2000GYSR4 B1000B0B2000GYSR2", 1),
        ("B1000B0B1000GXL3", "B1000B0B2000GYNR3 B1000B0B2000GYNR1", -1),
        ("B1000B0B1000GXL3", "B1000B0B2000GYSR2 B1000B0B2000GYSR4", 1),
        ("B0B1000B1000GYL2", "B0B1000B2000GXNR2 B0B1000B2000GXNR4", -1),
        ("B0B1000B1000GYL2", "B0B1000B2000GXSR1 B0B1000B2000GXSR3", 1),
        ("B0B1000B1000GYL4", "B0B1000B2000GXNR4 B0B1000B2000GXNR2", -1),
        ("B0B1000B1000GYL4", "B0B1000B2000GXSR3 B0B1000B2000GXSR1", 1),
    ],
)
def test_the_middle_of_a_circle_by_its_halves_lies_within_it(lead: str, arcs: str, part_side: int) -> None:
    path = parse_program(f"{lead} {arcs} DD").toolpath
    assert find_loops(path, contour_rows(path), np.array([0])).part_side.tolist() == [part_side]
