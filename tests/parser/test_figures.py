"""Several figures: pauses, jumps in the air and start nodes."""

import pytest

from parser.geometry.curves import CurveKind
from parser.program import parse_program

SQUARE = "B10B0B10GXL1 B0B10B10GYL2 B10B0B10GXL3 B0B10B10GYL4\n"
CIRCLE = "B5B0B5GXL1 B5B0B20GYNR1 B5B0B5GXL3\n"


def jumps(text: str) -> list[int]:
    return [block.number for block in parse_program(text).toolpath if block.kind is CurveKind.JUMP]


def test_lines_between_two_pauses_are_jumps() -> None:
    assert jumps(f"{CIRCLE} D B100B0B100GXL1 B0B50B50GYL2 D {SQUARE} DD") == [4, 5]


WAY = "B100B0B100GXL1 B0B50B50GYL2 B100B0B100GXL1 B0B50B50GYL2 B70B0B70GXL1"


def test_a_way_of_many_lines_is_a_jump_where_a_closed_figure_begins_at_its_end() -> None:
    assert jumps(f"{CIRCLE} D {WAY} D {CIRCLE} DD") == [4, 5, 6, 7, 8]
    assert jumps(f"{CIRCLE} D {WAY} D {SQUARE} D {WAY} D {CIRCLE} DD") == [4, 5, 6, 7, 8, 13, 14, 15, 16, 17]
    # A jump with a figure of lines behind it, which may be paused at its end.
    assert jumps(f"{CIRCLE} D B100B0B100GXL1 {SQUARE} D B100B0B100GXL1 D {CIRCLE} DD") == [4, 9]


def test_lines_that_may_be_a_way_or_a_cut_are_told() -> None:
    found = parse_program(f"{CIRCLE} D {WAY} D B0B50B50GYL2 B100B0B100GXL1 DD").findings
    assert [(f.code, f.block, f.values["length"]) for f in found] == [("3B320", 5, 270.0)]


def test_after_one_pause_the_first_line_is_the_jump() -> None:
    assert jumps(f"{SQUARE} D B100B0B100GXL1 {SQUARE} DD") == [5]
    assert jumps(f"{SQUARE} D B100B0B100GXL1 {SQUARE} D B100B0B100GXL1 {SQUARE} DD") == [5, 10]


def test_a_figure_left_at_the_end_of_its_lead_in_is_closed_too() -> None:
    assert jumps(f"B50B0B50GXL1 {SQUARE} D B100B0B100GXL1 {CIRCLE} DD") == [6]


def test_lines_between_two_pauses_are_jumps_though_the_figure_before_is_open() -> None:
    assert jumps("B10B0B10GXL1 B0B10B10GYL2 B10B0B10GXL3 D B100B0B100GXL1 D B5B0B5GXL1 B5B0B20GYNR1 DD") == [4]


def test_a_pause_inside_a_figure_makes_no_jump() -> None:
    assert jumps("B10B0B10GXL1 B0B10B10GYL2 D B10B0B10GXL3 B0B10B10GYL4 DD") == []


def test_lines_between_two_pauses_that_close_the_figure_are_its_last_cut() -> None:
    tab = "B10B0B10GXL1 B0B10B10GYL2 B10B0B10GXL3 D B0B10B10GYL4 B0B50B50GYL4 D B100B0B100GXL1 D"
    assert jumps(f"B0B50B50GYL2 {tab} {SQUARE} DD") == [7]


def test_a_figure_that_ends_in_an_overcut_is_closed() -> None:
    wide = SQUARE.replace("10", "100")
    assert jumps(f"B0B50B50GYL2 {wide} B30B0B30GXL1 D B100B0B100GXL1 {CIRCLE} DD") == [7]
    assert jumps(f"B0B50B50GYL2 {wide} B30B0B30GXL3 D B100B0B100GXL1 {CIRCLE} DD") == []


def test_pauses_and_end_stand_between_blocks() -> None:
    toolpath = parse_program(f"{CIRCLE} D\nB100B0B100GXL1\nD\n{SQUARE}\nDD").toolpath
    assert [(stop.kind, stop.after) for stop in toolpath.stops] == [("pause", 3), ("pause", 4), ("end", 8)]


def test_first_start_node_is_the_origin() -> None:
    toolpath = parse_program("Start Point = 1.5 , -2.25 ; Length = 3\nB10B0B10GXL1\nDD").toolpath
    assert toolpath.start_um[0].tolist() == [1500.0, -2250.0]
    assert toolpath.end_um[0].tolist() == [1510.0, -2250.0]


def test_later_start_node_is_a_jump_to_its_place() -> None:
    toolpath = parse_program(f"{CIRCLE} D\nStart Point = 0.2 , 0.1\n{CIRCLE} DD").toolpath
    node = toolpath.block(3)
    assert node.kind is CurveKind.JUMP
    assert node.end_um == (200.0, 100.0)
    assert node.line == 3
    assert node.text.startswith("Start Point")
    assert (toolpath.words.x_um[3], toolpath.words.y_um[3], toolpath.words.count_um[3]) == (200, 100, 200)
    assert toolpath.end_um[-1].tolist() == [200.0, 100.0]


def test_a_lead_in_right_behind_a_pause_is_no_jump() -> None:
    hole = "B5000B0B5000GXL1 B5000B0B20000GYNR1 B5000B0B5000GXL3"
    program = parse_program(f"{hole} D {hole} D {hole} DD")
    assert not program.toolpath.is_jump.any()
    assert [finding.code for finding in program.findings] == ["3B308", "3B308"]


@pytest.mark.parametrize(("side", "kerf"), [(10000, 400), (1000, 200)])
def test_no_wire_is_threaded_within_a_kerf_of_a_corner_that_was_cut(side: int, kerf: int) -> None:
    # No kerf is wider than 400 µm, nor than a twentieth of the way round a small figure.
    square = SQUARE.replace("10", str(side))
    for way in (f"B{kerf}B0B{kerf}GXL3", f"B0B{kerf}B{kerf}GYL4"):
        assert jumps(f"{square} D {way} {square} DD") == []
        assert jumps(f"{square} D {way.replace(str(kerf), str(kerf + 1))} {square} DD") == [5]


def test_lines_between_two_pauses_are_cut_where_the_rest_closes_the_figure_they_left_open() -> None:
    """Two tabs of one contour, each behind a pause; else such lines are the way to the next figure."""
    left = "B10000B0B10000GXL1 B0B20000B20000GYL2 B10000B10000B10000GYL1 D B20000B0B20000GXL1 D "
    tabs = parse_program(left + "B0B30000B30000GYL4 B30000B0B30000GXL3 B10000B0B10000GXL3 DD").toolpath
    assert not tabs.is_jump.any()
    three = left + "B0B10000B10000GYL4 D B0B20000B20000GYL4 B30000B0B30000GXL3 B10000B0B10000GXL3 DD"
    assert not parse_program(three).toolpath.is_jump.any()
    ring = "B4900B0B4900GXL1 B4900B0B19600GYNR1 B4900B0B4900GXL3 DD"
    assert parse_program(left + ring).toolpath.is_jump.tolist() == [False, False, False, True, False, False, False]
