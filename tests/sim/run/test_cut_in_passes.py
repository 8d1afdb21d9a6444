"""Several offsets in one run: the controller runs each contour once for each pass, as it would run that pass alone."""

import math
import random
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
import shapely
from command import run_inside
from drawn_programs import DrawnProgram, drawn_program
from paths import flipped
from places import SCENARIOS
from report_schema import complaints
from rough_and_trim import outline
from runs import codes, plain_scenario, run_text

from controller.motion.limits import row_limits
from controller.motion.planner import plan_rows
from controller.offset.shifted import Side
from parser.findings.catalogue import texts
from parser.findings.errors import ProgramError
from parser.findings.findings import Finding
from parser.geometry.along import places_at
from parser.geometry.curves import CurveKind, Curves, Floats
from parser.program import parse_program
from parser.shape.passes import find_passes
from sim.check.offset import Offsetting
from sim.run.course import findings_of
from sim.run.prepare import Prepared, offsetting, prepare
from sim.run.report import build_report
from sim.setup.part import Direction, Offset, OffsetPass
from sim.show.pictures.cut.marks import places_um
from sim.show.pictures.motion.panels import feed_levels

REACH_UM = 100.0
BRIDGE_UM = 1.0
"""Ends of a contour of whole µm miss each other by less, and are bridged behind the last block: which one that is
depends on the way it is run."""
SQUARE = """B0B2000B2000GYL2 B2000B0B2000GXL1 B0B4000B4000GYL2 B4000B0B4000GXL3 B0B4000B4000GYL4 B2000B0B2000GXL1
B0B2000B2000GYL4 """
ENDS_ELSEWHERE = SQUARE.rsplit("B0B2000", 1)[0] + "B1000B2000B2000GYL4 "


def passes(*by_um: float, turns: int = 0) -> tuple[OffsetPass, ...]:
    """Passes at offsets, `turns` of them, from the second, running back against the one before."""
    directions: list[Direction] = ["back" if 0 < at <= turns else "same" for at in range(len(by_um))]
    return tuple(OffsetPass(by, direction) for by, direction in zip(by_um, directions, strict=True))


def random_case(seed: int) -> tuple[DrawnProgram, Offset]:
    """A drawn program, and falling offsets down to the wire's reach, there and back where there is no other way."""
    rng = random.Random(seed)
    by_um = [REACH_UM]
    for _ in range(rng.randint(1, 4)):
        by_um.insert(0, by_um[0] + rng.choice((8.0, 15.0, 20.0, 40.0)))
    drawn = drawn_program(rng, by_um[0])
    directions: list[Direction] = [rng.choice(("same", "back")) if drawn.returns else "back" for _ in by_um]
    made = tuple(
        OffsetPass(by, way if at else "same") for at, (by, way) in enumerate(zip(by_um, directions, strict=True))
    )
    return drawn, Offset(made, Side.LEFT if drawn.to_left else Side.RIGHT)


def contours_of(made: Offsetting, number: int) -> list[Curves]:
    """Rows of one pass over each contour."""
    curves = made.path.curves
    of = np.cumsum(curves.kind == CurveKind.JUMP)
    return [curves.picked((of == contour) & (made.pass_of_row == number)) for contour in np.unique(of)]


def farthest_um(one: Curves, other: Curves) -> float:
    """How far apart the places and radii of rows are, one by one."""
    columns = [(getattr(one, name), getattr(other, name)) for name in ("start_um", "end_um", "center_um", "radius_um")]
    return max(float(np.nanmax(np.abs(a - b), initial=0.0)) for a, b in columns)


@pytest.mark.alike(3)
@pytest.mark.parametrize("seed", range(10))
def test_a_pass_runs_as_it_would_alone_and_back_as_its_reverse(seed: int) -> None:
    """A pass begins where the one before it ended, some µm from where the first began."""
    drawn, offset = random_case(seed)
    program = parse_program(drawn.text)
    made = offsetting(program, offset)
    assert (np.abs(made.path.curves.start_um[1:] - made.path.curves.end_um[:-1]) <= 1e-9).all()
    for number, (one, is_back) in enumerate(zip(offset.passes, offset.back, strict=True)):
        alone = offsetting(program, Offset((OffsetPass(one.by_um),), offset.side))
        for own, wanted in zip(contours_of(made, number), contours_of(alone, 0), strict=True):
            assert len(own) == len(wanted)
            if not is_back:
                assert farthest_um(own.picked(slice(1, None)), wanted.picked(slice(1, None))) <= 1e-6
                assert np.abs(own.end_um[0] - wanted.end_um[0]).max() <= 1e-6
                continue
            back, turned = (one.picked(one.length_um > BRIDGE_UM) for one in (own, flipped(wanted)))
            assert farthest_um(back.picked(slice(1, -1)), turned.picked(slice(1, -1))) <= 1e-6
            assert np.abs(back.end_um[0] - turned.end_um[0]).max() <= BRIDGE_UM
    found = find_passes(made.program.toolpath).passes
    assert [(one.number, one.is_back) for one in found] == [
        (at, is_back) for _ in drawn.shapes for at, is_back in enumerate(offset.back, start=1)
    ]
    wanted_um = [one.by_um - REACH_UM for one in offset.passes] * len(drawn.shapes)
    assert [one.shift_um for one in found] == pytest.approx(wanted_um, abs=2.0)


def along(curves: Curves) -> Floats:
    """Places along curves, on arcs so near to each other that their chords lie 0.01 µm off at most."""
    parts = [curves.start_um[:1]]
    for row in range(len(curves)):
        radius = np.nan_to_num(curves.radius_um[row])
        number = 2 + int(curves.length_um[row] / math.sqrt(0.08 * radius)) if radius else 2
        rows = np.full(number, row)
        parts.append(places_at(curves, rows, np.linspace(0.0, curves.length_um[row], number)))
    return np.concatenate(parts)


@pytest.mark.parametrize("seed", range(3))
def test_the_part_that_is_left_is_that_of_the_last_pass(seed: int) -> None:
    """A disc rolled round a punch leaves the drawing closed by it, and in a die the drawing opened by it."""
    drawn, offset = random_case(100 + seed)
    made = offsetting(parse_program(drawn.text), offset)
    assert made.findings == ()
    curves = made.path.curves
    for at, (shape, kind) in enumerate(zip(drawn.shapes, drawn.kinds, strict=True)):
        row = np.flatnonzero((np.cumsum(curves.kind == CurveKind.JUMP) == at) & (curves.kind != CurveKind.JUMP))
        kerf = shapely.LineString(along(curves.picked(row))).buffer(REACH_UM, quad_segs=64)
        whole = shapely.Polygon(outline(shape))
        by_um = REACH_UM if kind == "punch" else -REACH_UM
        wanted = whole.buffer(by_um, quad_segs=64).buffer(-by_um, quad_segs=64)
        rings = kerf.interiors if kind == "punch" else [kerf.exterior]
        left = max((shapely.Polygon(ring) for ring in rings), key=lambda polygon: polygon.area)
        # Blocks of whole µm lie some µm off the drawing; what the pass before would leave is 8 µm and more.
        assert left.symmetric_difference(wanted).area / wanted.length < 1.0


def test_times_add_up_and_each_pass_has_its_feed() -> None:
    """Of a pass at 3 mm/min, one at 60 mm²/min in 40 mm, and one that asks for more than the controller steps."""
    asked = (
        OffsetPass(180.0, feed_um_s=50.0),
        OffsetPass(120.0, "back", area_rate_mm2_min=60.0),
        OffsetPass(100.0, "back", feed_um_s=1000.0),
    )
    feeds = plain_scenario(offset=Offset(asked, Side.RIGHT)).pass_feeds_um_s
    assert feeds == (50.0, 25.0, 180.0)
    whole, *alone = (
        prepare(parse_program(SQUARE + "DD"), plain_scenario(offset=Offset(tuple(of), Side.RIGHT)))
        for of in (asked, *([one._replace(direction="same")] for one in asked))
    )
    assert planned_s(whole) == pytest.approx(sum(map(planned_s, alone)), abs=0.01)
    lengths = np.array([float(one.program.toolpath.length_um.sum()) for one in alone])
    assert planned_s(whole) == pytest.approx(float((lengths / feeds).sum()), abs=0.01)
    assert len(whole.steps) == sum(len(one.steps) for one in alone)


def planned_s(ready: Prepared) -> float:
    limits = plain_scenario().machine.controller.limits
    return plan_rows(row_limits(ready.program.toolpath, ready.feeds, limits)).duration_s


def test_the_report_of_passes_is_lawful_and_names_the_pass_of_each_block() -> None:
    slow, *trims = passes(180.0, 120.0, 100.0, turns=1)
    run = run_text(SQUARE + "DD", offset=Offset((slow._replace(feed_um_s=25.0), *trims), Side.RIGHT))
    assert codes(run) == []
    assert [level.value for level in feed_levels(run)] == [0.025, 0.04375]
    report = build_report(run)
    assert complaints(report) == []
    entry = report["offset"]
    assert entry["by_um"] == 100.0
    assert [(one["by_um"], one["direction"]) for one in entry["passes"]] == [
        (180.0, "forward"),
        (120.0, "back"),
        (100.0, "back"),
    ]
    assert [block["pass"] for block in entry["blocks"]] == [1] * 7 + [2] * 7 + [3] * 7
    there, back = [1, 2, 3, 4, 5, 6, 7], [7, 6, 5, 4, 3, 2, 1]
    assert [block["source_block"] for block in entry["blocks"]] == there + back + back
    assert entry["closed_paths"] == [1]


def test_a_pause_behind_a_figure_waits_for_its_last_pass_and_one_within_stops_each_pass() -> None:
    two = SQUARE + "D B9000B0B9000GXL1 D " + SQUARE + "DD"
    stops = offsetting(parse_program(two), Offset(passes(120.0, 100.0), Side.RIGHT)).program.toolpath.stops
    assert [(stop.kind, stop.after) for stop in stops] == [("pause", 14), ("pause", 15), ("end", 29)]
    within = SQUARE.replace("B4000B0B4000GXL3 ", "B4000B0B4000GXL3 D ") + "DD"
    made = offsetting(parse_program(within), Offset(passes(120.0, 100.0, turns=1), Side.RIGHT)).program.toolpath
    assert [stop.after for stop in made.stops] == [4, 10, 14]
    assert [sorted(made.source.block[stop.after - 1 : stop.after + 1]) for stop in made.stops[:2]] == [[4, 5], [4, 5]]


def test_a_pass_that_cannot_begin_where_the_wire_is_is_refused_and_may_run_back() -> None:
    program = parse_program(ENDS_ELSEWHERE + "D B9000B0B9000GXL1 D " + SQUARE + "DD")
    with pytest.raises(
        ProgramError, match=r"pass 1 ends behind block 7, 1\.000 mm from where pass 2 is to begin"
    ) as told:
        offsetting(program, Offset(passes(120.0, 100.0), Side.RIGHT))
    assert (told.value.finding.code, told.value.finding.block) == ("3B505", 7)
    assert 'direction = "back"' in texts(told.value.finding).hint
    offsetting(program, Offset(passes(100.0), Side.RIGHT))
    made = offsetting(program, Offset(passes(120.0, 100.0, turns=1), Side.RIGHT))
    jump = int(np.flatnonzero(made.path.curves.kind == CurveKind.JUMP)[0])
    # The second pass has led the wire back to where the program begins: the jump sets off from there.
    assert made.path.curves.start_um[jump].tolist() == [0.0, 0.0]
    assert made.path.curves.end_um[jump].tolist() == program.toolpath.end_um[7].tolist()


def test_commands_point_at_the_block_behind_which_a_pass_cannot_begin(tmp_path: Path) -> None:
    (tmp_path / "program.3b").write_text(ENDS_ELSEWHERE + "DD", "ascii")
    passes_toml = "[offset]\nside = 'right'\n[[pass]]\nby_mm = 0.12\n[[pass]]\nby_mm = 0.1\n"
    (tmp_path / "scenario.toml").write_text(passes_toml, "utf-8")
    drawing = SCENARIOS / "die" / "drawing.dxf"
    for done in (run_inside("run", tmp_path), run_inside("compare", tmp_path, drawing)):
        assert (done.returncode, done.stdout) == (2, b"")
        first, _, carets, found, *_ = done.stderr.decode().splitlines()
        assert first.endswith("program.3b:2:1: error[3B505]: pass cannot begin where the wire is")
        assert carets.strip(" |^") == ""
        assert "pass 1 ends behind block 7, 1.000 mm from where" in found


def test_a_parting_cut_goes_there_and_back_on_one_side_of_the_material() -> None:
    cut = "B0B5000B5000GYL2 B3000B4000B4000GYL1 DD"
    made = offsetting(parse_program(cut), Offset(passes(120.0, 100.0, turns=1), Side.LEFT))
    beside = made.path.curves.start_um[made.pass_of_row == 1]
    assert made.program.toolpath.end_um[-1].tolist() == [0.0, 0.0]
    assert (beside[1:, 0] - 0.75 * np.maximum(beside[1:, 1] - 5000.0, 0.0) < 0.0).all()
    with pytest.raises(ProgramError, match="pass 2 is to begin"):
        offsetting(parse_program(cut), Offset(passes(120.0, 100.0), Side.LEFT))


def test_what_a_trim_takes_is_no_fault_of_the_rough_cut() -> None:
    """An inside arc of R 0.15 has no place at 0.18 and 0.16 mm, and none at all where the last pass is at 0.15."""
    die = """B0B1000B1000GYL4 B1850B0B1850GXL1 B0B150B150GYNR4 B0B3850B3850GYL2 B4000B0B4000GXL3 B0B4000B4000GYL4
        B2000B0B2000GXL1 B0B1000B1000GYL2 DD"""
    assert offsetting(parse_program(die), Offset(passes(180.0, 160.0, 100.0), Side.LEFT)).findings == ()
    found = offsetting(parse_program(die), Offset(passes(180.0, 150.0, 150.0, turns=1), Side.LEFT)).findings
    assert [(one.code, one.block) for one in found] == [("3B501", 3)]


def test_a_neck_is_gouged_where_the_last_wire_does_not_fit_and_told_once() -> None:
    """A neck of 0.09 mm: each pass cuts its offset and 10 µm more behind the wall, held against a kerf of 0.1 mm."""
    text = (SCENARIOS / "narrow-neck" / "program.3b").read_text("utf-8")
    alone = offsetting(parse_program(text), Offset(passes(100.0), Side.LEFT)).findings
    thrice = offsetting(parse_program(text), Offset(passes(100.0, 100.0, 100.0), Side.LEFT)).findings
    assert [(one.code, one.block) for one in thrice] == [(one.code, one.block) for one in alone]
    assert "in pass 1" in texts(next(one for one in thrice if one.code == "3B503")).found


def test_a_neck_in_which_only_the_last_pass_keeps_to_its_side_is_sound() -> None:
    """Two rooms joined by a slot of 0.3 mm: at 0.18 mm the wire runs past the middle, 0.12 mm off the other wall."""
    corners = [(0, 0), (0, -2000), (2000, -2000), (2000, -150), (4000, -150), (4000, -2000), (8000, -2000)]
    corners += [(8000, 2000), (4000, 2000), (4000, 150), (2000, 150), (2000, 2000), (-2000, 2000), (-2000, -2000)]
    program = parse_program(lines([*corners, (0, -2000), (0, 0)]))
    assert offsetting(program, Offset(passes(180.0, 100.0), Side.LEFT)).findings == ()
    found = offsetting(program, Offset(passes(180.0, 140.0), Side.LEFT)).findings
    assert {(one.code, one.values["pass"], round(float(one.values["depth"]))) for one in found} == {("3B503", 1, 20)}


def lines(places: list[tuple[int, int]]) -> str:
    """A program of lines between places, none of them slanted."""
    words = []
    for (x0, y0), (x1, y1) in pairwise(places):
        x, y = abs(x1 - x0), abs(y1 - y0)
        words.append(f"B{x}B{y}B{x + y}G{'XL' if x else 'YL'}{(1 if x1 > x0 else 3) if x else (2 if y1 > y0 else 4)}")
    return " ".join([*words, "DD"])


def test_passes_in_the_wrong_order_and_trims_wider_than_a_kerf_are_told() -> None:
    """A kerf is 0.2 mm wide; a trim may take 0.12 mm, and not 0.25 mm; its side is never in doubt."""
    for by_um, told in (
        ((220.0, 100.0), []),
        ((100.0, 100.0), []),
        ((100.0, 120.0), ["3B312"]),
        ((350.0, 100.0), ["3B313"]),
    ):
        for turns in (0, 1):
            asked = plain_scenario(offset=Offset(passes(*by_um, turns=turns), Side.RIGHT))
            found = prepare(parse_program(SQUARE + "DD"), asked).findings
            assert [one.code for one in found] == told, (by_um, turns)


def test_a_finding_about_a_pass_is_shown_when_that_pass_runs() -> None:
    """Of offsets that grow, the second pass cuts deepest past the middle of a slot of 0.3 mm."""
    slot = [(0, 0), (0, -150), (3000, -150), (3000, 150), (-3000, 150), (-3000, -150), (0, -150), (0, 0)]
    run = run_text(lines(slot), offset=Offset(passes(140.0, 180.0), Side.LEFT))
    deepest = [one for one in findings_of(run) if one.what.code == "3B503"]
    assert deepest
    assert run.offset is not None
    assert (
        {int(run.offset.pass_of_row[one.row]) + 1 for one in deepest}
        == {one.what.values["pass"] for one in deepest}
        == {2}
    )


def test_the_note_on_4b_says_whether_its_path_has_the_offset() -> None:
    text = "B0B2000B2000B0GYL2 B0B1000B4000B1000GXDNR4 B0B2000B2000B0GYL4 DD"
    for offset, told in (
        (None, "the path here is without it"),
        (Offset(passes(100.0), Side.RIGHT), "none is to be added"),
    ):
        run = run_text(text, offset=offset)
        assert codes(run) == ["3B110"]
        assert told in texts(run.findings[0]).machine


def test_a_finding_on_a_block_has_its_place_there_whatever_way_the_passes_run() -> None:
    """In the last pass block 7 comes first; a finding of block 2 lies beside the first half of the lower side."""
    run = run_text(SQUARE + "DD", offset=Offset(passes(120.0, 100.0, turns=1), Side.RIGHT))
    x, y = places_um(run.toolpath, [Finding("3B203", block=2)], 0.0)[0].tolist()
    assert 0.0 < x < 2120.0
    assert 1880.0 <= y <= 1900.0
