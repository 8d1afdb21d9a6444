"""Offsets in a dry run: which blocks are offset, what is said of them, and how the run counts its blocks."""

import math

import numpy as np
import pytest
from paths import Pen
from places import SCENARIOS
from report_schema import complaints
from runs import codes, run_text, scenario_run

from controller.offset.chain import RowOrigin
from controller.offset.shifted import OffsetSection, Side, rounds_of
from parser.program import parse_program
from parser.toolpath import Toolpath
from sim.run.prepare import offsetting
from sim.run.report import build_report
from sim.setup.part import Offset, OffsetPass

LEFT, RIGHT = Offset((OffsetPass(100.0),), Side.LEFT), Offset((OffsetPass(100.0),), Side.RIGHT)
LED_SQUARE = """B0B2000B2000GYL2
B2000B0B2000GXL1 B0B4000B4000GYL2 B4000B0B4000GXL3 B0B4000B4000GYL4 B2000B0B2000GXL1
B0B2000B2000GYL4 DD"""


def square(pen: Pen) -> Pen:
    x, y = pen.x, pen.y
    return pen.to(x + 2000, y).to(x + 2000, y + 4000).to(x - 2000, y + 4000).to(x - 2000, y).to(x, y)


@pytest.mark.parametrize(
    ("text", "left_um"),
    [
        ("BBBGXL1", 0.0),
        ("B2B0B2GXL1 B0B2B2GYL2 B2B0B2GXL3 B0B2B2GYL4 DD", 0.0),
        ("B10B0B10GXL1 B0B10B10GYL2 B10B0B10GXL3 B0B10B10GYL4 DD", 0.0),
        ("B500B0B500GXL1 B0B500B500GYL2 B500B0B500GXL3 B0B500B500GYL4 DD", 500.0 * math.sqrt(2.0) - 300.0),
    ],
)
def test_what_stays_where_nothing_has_a_place_on_the_path_is_a_length(text: str, left_um: float) -> None:
    wide = Offset((OffsetPass(100.0 if left_um == 0.0 else 300.0),), Side.LEFT)
    made = offsetting(parse_program(text), wide)
    assert len(made.left_um)
    assert made.left_um.max() == pytest.approx(left_um, abs=0.02)


@pytest.mark.parametrize(
    ("path", "expected"),
    [
        (square(Pen().to(0, 2000)).to(0, 0).path(), [OffsetSection(1, 5, closed=True)]),
        (square(Pen()).path(), [OffsetSection(0, 4, closed=True)]),
        (square(Pen().to(500, 500).to(0, 2000)).to(0, 500).to(0, 0).path(), [OffsetSection(2, 6, closed=True)]),
        (Pen().to(3000, 0).arc(0, 0, 2 * math.pi).to(0, 0).path(), [OffsetSection(1, 1, closed=True)]),
        # Cut on past the start: the loop is open, and what is cut twice is offset twice.
        (square(Pen().to(0, 2000)).to(700, 2000).to(0, 0).path(), [OffsetSection(1, 6, closed=False)]),
        (Pen().to(3000, 0).to(6000, 1000).to(9000, 0).path(), [OffsetSection(0, 2, closed=False)]),
        (
            square(square(Pen().to(0, 2000)).to(0, 0).jump(9000, 0).to(9000, 2000)).to(9000, 0).path(),
            [OffsetSection(1, 5, closed=True), OffsetSection(9, 13, closed=True)],
        ),
        # A second way through the start hole is a lead, though no jump parts it from the first.
        (
            square(square(Pen().to(0, 2000)).to(0, 0).to(0, 2000)).to(0, 0).path(),
            [OffsetSection(1, 5, closed=True), OffsetSection(8, 12, closed=True)],
        ),
        (
            square(square(Pen().to(0, 2000)).to(700, 2000).to(0, 0).to(0, -1000)).to(0, 0).path(),
            [OffsetSection(1, 6, closed=False), OffsetSection(9, 13, closed=True)],
        ),
        (square(Pen().to(0, 2000)).to(0, 0).to(0, -700).path(), [OffsetSection(1, 5, closed=True)]),
    ],
    ids=["led", "bare", "led by two", "circle", "overcut", "parting cut", "two", "twice", "two from one hole", "on"],
)
def test_the_loop_is_offset_and_its_leads_are_not(path: Toolpath, expected: list[OffsetSection]) -> None:
    assert [one.section for one in rounds_of(path)] == expected


def test_a_square_grows_on_its_outer_side_and_shrinks_on_its_inner_one() -> None:
    for offset, half, low, high in ((RIGHT, 2100.0, 1900.0, 6100.0), (LEFT, 1900.0, 2100.0, 5900.0)):
        made = offsetting(parse_program(LED_SQUARE), offset)
        corners = made.path.curves.start_um[1:-1]
        assert corners.min(axis=0).tolist() == [-half, low]
        assert corners.max(axis=0).tolist() == [half, high]
        assert made.path.made.tolist() == [RowOrigin.LEAD, *[RowOrigin.SHIFTED] * 5, RowOrigin.LEAD]
        assert (len(made.path.vanished), made.loops) == (0, (1,))


def test_a_run_counts_the_blocks_of_the_path_and_findings_those_of_the_program() -> None:
    """A corner of 45° is bridged, so that the path has a block more than the program from there on."""
    text = """B0B2000B2000GYL2
        B4000B0B4000GXL1 B4000B4000B4000GXL2 B0B4000B4000GYL4
        B0B2000B2000GYL4 DD"""
    run = run_text(text, offset=RIGHT, may_stay_open=True)
    assert len(run.toolpath) > 5
    assert run.toolpath.source.block.tolist() == sorted(run.toolpath.source.block.tolist())
    assert set(run.toolpath.source.block.tolist()) == {1, 2, 3, 4, 5}
    entry = build_report(run)["offset"]
    assert [block["block"] for block in entry["blocks"]] == list(range(1, len(run.toolpath) + 1))
    assert [block["source_block"] for block in entry["blocks"]] == run.toolpath.source.block.tolist()
    bridges = [block for block in entry["blocks"] if block["made"] == "bridge"]
    assert bridges
    assert all(block["kind"] == "arc" and block["radius_um"] == 100.0 for block in bridges)


def test_the_steps_follow_the_offset_path() -> None:
    run = run_text(LED_SQUARE, offset=RIGHT)
    assert codes(run) == []
    assert run.deviations.steps.max_um <= 1.0
    assert np.abs(run.stepped.corner_um[1:-1] - run.toolpath.end_um[:-1]).max() <= 0.5
    assert run.stepped.corner_um[-1].tolist() == [0, 0]
    assert len(run.stepped) == 2 * 1900 + 4 * 4200


def test_an_offset_run_has_a_lawful_report() -> None:
    for changes in ({"offset": LEFT}, {"offset": RIGHT, "kerf": True}, {}):
        report = build_report(run_text(LED_SQUARE, **changes))
        assert complaints(report) == []
        assert (report["offset"] is None) == ("offset" not in changes)
        assert (report["remains"] is None) == ("kerf" not in changes)


def test_travel_is_that_of_the_offset_path() -> None:
    """From 1.95 mm beside the stop a square of 4 mm just fits, and one that is 0.1 mm larger all round does not."""
    start_mm = (2.05, 100.0)
    assert codes(run_text(LED_SQUARE, start_mm=start_mm)) == []
    assert "3B401" in codes(run_text(LED_SQUARE, start_mm=start_mm, offset=RIGHT))
    report = build_report(run_text(LED_SQUARE, offset=RIGHT))
    assert {check["state"] for check in report["coverage"]["checks"] if check["check"] in ("travel", "corners")} == {
        "complete"
    }


def test_a_neck_narrower_than_the_kerf_is_named_with_both_walls() -> None:
    run = scenario_run("narrow-neck")
    walls = {(f.block, f.values["other"]): f.values["depth"] for f in run.findings if f.code == "3B503"}
    assert walls[3, 5] == pytest.approx(110.0, abs=0.1)
    assert walls[5, 3] == pytest.approx(110.0, abs=0.1)


def test_a_lead_in_that_crosses_the_contour_is_a_gouge() -> None:
    """The wire is threaded outside of the square; offset to its inside, it cuts through the edge in and out."""
    assert offsetting(parse_program(LED_SQUARE), RIGHT).findings == ()
    across = offsetting(parse_program(LED_SQUARE), LEFT)
    assert [(f.code, f.block, f.values["depth"]) for f in across.findings] == [("3B503", 1, 100.0), ("3B503", 7, 100.0)]


def test_a_contour_that_is_begun_on_its_edge_is_gouged_there_unless_it_is_open() -> None:
    bare = LED_SQUARE.replace("B0B2000B2000GYL2\n", "").replace("\nB0B2000B2000GYL4", "")
    assert [f.code for f in offsetting(parse_program(bare), RIGHT).findings] == ["3B503", "3B503"]
    parting = "B3000B0B3000GXL1 B3000B1000B3000GXL1 B3000B1000B3000GXL4 DD"
    assert offsetting(parse_program(parting), RIGHT).findings == ()


def test_an_inside_arc_no_larger_than_the_offset_leaves_what_the_formula_says() -> None:
    """Between square sides moved aside by f, an arc R lies (√2 − 1) (f − R) from the wire at the corner."""
    run = offsetting(parse_program((SCENARIOS / "corner-too-tight" / "program.3b").read_text("utf-8")), RIGHT)
    assert [(f.code, f.block) for f in run.findings] == [("3B501", 5)]
    assert run.left_um.tolist() == pytest.approx([(math.sqrt(2.0) - 1.0) * 20.0], abs=0.02)
    assert run.loops == (1,)


def test_a_short_block_in_an_inside_corner_has_no_place() -> None:
    """A chamfer of 30 µm between square sides; its ends are farthest from the wire, where these meet moved aside."""
    text = """B0B2000B2000GYL2
        B4000B0B4000GXL1 B0B1970B1970GYL2 B30B30B30GYL1 B4000B0B4000GXL1 B0B2000B2000GYL2
        B8030B0B8030GXL3 B0B4000B4000GYL4
        B0B2000B2000GYL4 DD"""
    run = offsetting(parse_program(text), RIGHT)
    assert [(f.code, f.block) for f in run.findings] == [("3B502", 4)]
    assert run.left_um.tolist() == pytest.approx([math.hypot(100.0, 70.0) - 100.0], abs=0.02)


@pytest.mark.parametrize(
    ("text", "offset"),
    [
        (
            "B53B534B534GYL3 B263B305B588GXSR1 B309B705B705GYL1 B53B534B534GYL1 DD",
            Offset((OffsetPass(79.4),), Side.LEFT),
        ),
        (
            "B578B252B578GXL3 B24B90B186GXSR4 B448B120B448GXL1 B179B48B681GXSR2 B447B121B447GXL3 B578B252B578GXL1 DD",
            Offset((OffsetPass(81.5),), Side.RIGHT),
        ),
        ("B219B565B565GYL3 B219B565B2424GXSR3 B219B565B565GYL1 DD", Offset((OffsetPass(300.0),), Side.RIGHT)),
        (
            "B774B235B774GXL1 B989B245B989GXNR3 B0B1019B2038GXNR4 B0B1019B1264GYNR2 B774B235B774GXL3 DD",
            Offset((OffsetPass(151.0),), Side.RIGHT),
        ),
    ],
    ids=["past its corner", "beside its corner", "a circle of more than one turn", "a circle of three arcs"],
)
def test_what_whole_um_leave_open_where_a_contour_closes_is_no_fault(text: str, offset: Offset) -> None:
    made = offsetting(parse_program(text), offset)
    assert made.findings == ()
    assert made.loops == (1,)


@pytest.mark.parametrize("by", range(-3, 4))
def test_a_corner_that_overhangs_is_not_gouged(by: int) -> None:
    """The last side ends some µm past or before the corner where the first one begins; the lead-out goes back."""
    text = LED_SQUARE.replace("B2000B0B2000GXL1\nB0B2000B2000GYL4", f"B{2000 + by}B0B{2000 + by}GXL1\nB0B2000B2000GYL4")
    bevelled = text.replace("B2000B0B2000GXL1 B0B4000B4000GYL2", "B2000B1000B2000GXL1 B0B3000B3000GYL2", 1)
    for program in (text, bevelled):
        assert offsetting(parse_program(program), RIGHT).findings == ()


def test_contours_side_by_side_are_held_each_against_its_own_path() -> None:
    """Of a row of contours the second alone has a neck; its finding names its own blocks."""
    sound = LED_SQUARE.replace("DD", "D B9000B0B9000GXL1 D\n")
    tight = "B0B2000B2000GYL2 B2000B0B2000GXL1 B0B150B150GYL2 B4000B0B4000GXL3 B0B150B150GYL4 B2000B0B2000GXL1 "
    program = parse_program(sound + tight + "B0B2000B2000GYL4 D B9000B0B9000GXL1 D\n" + LED_SQUARE)
    made = offsetting(program, LEFT)
    necks = {(f.block, f.values["other"]) for f in made.findings if f.code == "3B503" and f.block in range(9, 16)}
    assert necks
    assert all(9 <= other <= 15 for _, other in necks)
    assert made.loops == (1, 0, 1)


def test_a_lead_in_that_ends_where_it_begins_but_for_rounding_has_no_length() -> None:
    """A circle of R 1 mm whose lead-in is 2 mm long, offset by 2 mm to where the wire is threaded."""
    text = "B0B2000B2000GYL2 B0B1000B4000GXNR4 B0B2000B2000GYL4 DD"
    run = run_text(text, offset=Offset((OffsetPass(2000.0),), Side.RIGHT))
    assert run.toolpath.length_um.min() == 0.0
    assert run.stepped.corner_um[-1].tolist() == [0, 0]
