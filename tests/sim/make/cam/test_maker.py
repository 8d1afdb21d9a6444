"""What `made` gives and tells: stages in their order, refusals, proofs, and remarks at the head of what is forced."""

from pathlib import Path

import numpy as np
import pytest
from drawings_dxf import drawn
from ezdxf.layouts import Modelspace
from made_programs import plate_file
from runs import plain_scenario

from parser.write.iso import iso_choices
from sim.check.path_checks import Demands, run_checks
from sim.make.cam.document import figure_sums
from sim.make.cam.maker import MadeProgram, NotMade, made_program, remarked, unproved
from sim.make.wanted import Wanted
from sim.setup.making import LayerWish, Making
from sim.setup.technology import Cut, Technology

TO_3B = Wanted("3b")
TO_ISO = Wanted("iso", iso_choices("fast-wire"))
HOSTILE = (
    "one\nline ) (and) another",
    "drycut: ignore-file 3B",
    "B100B0B100GXL1",
    "Offset F= 3.5 , Length= 2 mm",
    "Start Point = 5 , 5",
    "DD",
    "; G01 X500 M02 %",
    "\x1b[31m 钼丝 µm",
    "x" * 500,
)


@pytest.fixture(name="path", scope="module")
def plate_path(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return plate_file(tmp_path_factory.mktemp("plate"))


def program(path: Path, wanted: Wanted = TO_3B) -> MadeProgram:
    done = unproved(path, Making(), wanted, plain_scenario())
    assert isinstance(done, MadeProgram)
    return done


def test_stages_are_told_in_their_order(path: Path) -> None:
    stages: list[str] = []

    def told(stage: str, done: int, total: int) -> None:
        if stage not in stages:
            stages.append(stage)

    done = made_program(path, Making(), TO_3B, plain_scenario(), told)
    assert isinstance(done, MadeProgram)
    assert done.proof is not None
    assert done.proof.verdict == "pass"
    assert stages == ["drawing", "figures", "write", "checks", "plan", "run", "kerf", "comparison"]


@pytest.mark.parametrize("asked", [0.0, 12.0])
def test_the_lag_of_the_technology_is_corrected_where_no_other_is_named(path: Path, asked: float) -> None:
    """The lag is that of the pass that makes the edge; a straight wire's program would be cut off at each corner."""
    row = Cut("steel", 180.0, 40.0, 1, 12.0, None, 2.0, None, None, 25.0, None, None, None, None, None)
    knows = Technology("test", "measured", "here", (row, row._replace(number=2, gap_um=8.0, lag_um=18.0)))
    scenario = plain_scenario(technology=knows)
    for passes_um, lag_um in (((), 25.0), ((130.0, 98.0), 18.0)):
        making = Making(passes_um=passes_um, lag_um=asked, tab_um=2500.0)
        done = made_program(path, making, TO_3B, scenario)
        assert isinstance(done, MadeProgram)
        assert done.plan.making.lag_um == (asked or lag_um)
        assert done.is_proved


def test_the_same_drawing_gives_the_same_bytes(path: Path) -> None:
    assert program(path).data == program(path).data


def test_a_circle_of_a_turned_block_begins_on_an_axis_and_closes_exactly(tmp_path: Path) -> None:
    """There it begins whole µm from its centre: its count cannot end beside where it began."""

    def turned(space: Modelspace) -> None:
        assert space.doc is not None
        space.doc.blocks.new("RING").add_circle((0, 0), 0.60558)
        space.add_blockref("RING", (3.36492, 0.32456), {"rotation": 37.0})

    done = program(drawn(tmp_path, turned))
    path = done.program.toolpath
    (arc,) = np.flatnonzero(path.is_arc)
    assert np.array_equal(path.start_um[arc], path.end_um[arc])
    assert np.min(np.abs(path.start_um[arc] - path.center_um[arc])) == 0.0


def test_what_cannot_be_cut_is_refused_before_anything_is_written(tmp_path: Path) -> None:
    narrow = drawn(tmp_path, lambda space: space.add_circle((10, 10), 0.06))
    stages: list[str] = []
    making = Making(side="inside")
    done = made_program(narrow, making, TO_3B, plain_scenario(), lambda stage, done, total: stages.append(stage))
    assert isinstance(done, NotMade)
    assert done.refusal.why == "too-small"
    assert stages == ["drawing", "figures"]


def test_what_the_wire_cannot_cut_stays_uncut_and_the_others_are_proved(tmp_path: Path) -> None:
    """A hole that is too small, and one with a slot of 0.1 mm, narrower than the kerf of 0.2 mm."""

    def draw(space: Modelspace) -> None:
        slotted = [(8, 2), (12, 2), (12, 6), (10.05, 6), (10.05, 7), (9.95, 7), (9.95, 6), (8, 6)]
        space.add_lwpolyline([(0, 0), (16, 0), (16, 8), (0, 8)], close=True)
        space.add_circle((2, 2), 0.06)
        space.add_circle((4, 6), 1.0)
        space.add_lwpolyline(slotted, close=True)

    done = made_program(drawn(tmp_path, draw), Making(), TO_3B, plain_scenario())
    assert isinstance(done, MadeProgram)
    assert done.is_proved
    assert [cut.figure.kind for cut in done.plan.cuts] == ["hole", "outline"]
    assert [left.why for left in done.plan.to_check] == ["too-small", "narrow-slot"]
    assert dict(done.plan.to_check[1].values)["width_mm"] == "0.1"


def test_a_figure_that_fails_its_proof_stays_uncut_where_the_others_pass(tmp_path: Path) -> None:
    """The lead of a hole that touches its outline from within is read as another pass."""

    def draw(space: Modelspace) -> None:
        space.add_lwpolyline([(0, 0), (10, 0), (10, 10), (0, 10)], close=True)
        space.add_circle((5, 5), 5.0)

    done = made_program(drawn(tmp_path, draw), Making(), TO_3B, plain_scenario())
    assert isinstance(done, MadeProgram)
    assert done.is_proved
    assert [left.why for left in done.plan.to_check] == ["not-proved"]


def test_sums_of_figures_are_those_of_the_program_and_its_run(path: Path) -> None:
    done = made_program(path, Making(), TO_3B, plain_scenario())
    assert isinstance(done, MadeProgram)
    assert done.proof is not None
    run = done.proof.run
    assert run is not None
    sums = figure_sums(done)
    jumps = done.program.toolpath.is_jump
    assert sum(one.blocks for one in sums) == int(np.count_nonzero(~jumps))
    assert sum(one.length_um for one in sums) == pytest.approx(float(done.program.toolpath.length_um[~jumps].sum()))
    assert sum(one.time_s or 0.0 for one in sums) == pytest.approx(float(run.block_time_s[~run.toolpath.is_jump].sum()))
    assert all(len(one.pass_s) == 1 and 0.0 < one.pass_s[0] < (one.time_s or 0.0) for one in sums)


@pytest.mark.parametrize("wanted", [TO_3B, Wanted("3b", form="detailed", newline="\r\n"), Wanted("4b"), TO_ISO])
def test_remarks_leave_the_program_as_it_is(path: Path, wanted: Wanted) -> None:
    done = program(path, wanted)
    told = remarked(done, HOSTILE, wanted)
    before, after = done.program.toolpath, told.program.toolpath
    assert len(told.program.text.splitlines()) == len(done.program.text.splitlines()) + len(HOSTILE)
    assert told.program.header == done.program.header
    for column in ("kind", "start_um", "end_um", "sweep_rad"):
        assert np.array_equal(getattr(before, column), getattr(after, column))
    assert [(one.kind, one.after) for one in before.stops] == [(one.kind, one.after) for one in after.stops]
    codes = [[one.code for one in run_checks(each.program, Demands()).findings] for each in (done, told)]
    assert codes[0] == codes[1]
    assert b"\x1b" not in told.data


def test_leads_are_longer_than_the_offsets_of_layers(path: Path) -> None:
    wish = LayerWish("0", passes_um=(300.0, 100.0))
    done = unproved(path, Making(passes_um=(100.0,), lead_um=200.0, layers=(wish,)), TO_3B, plain_scenario())
    assert isinstance(done, NotMade)
    assert done.refusal.why == "short-lead"
    assert isinstance(unproved(path, Making(passes_um=(100.0,), lead_um=200.0), TO_3B, plain_scenario()), MadeProgram)


def test_a_part_in_a_frame_is_proved_with_the_wire_outside(tmp_path: Path) -> None:
    """A5 upright is no sheet of a frame; A4 is, drawn by four lines, with a word in it."""

    def draw(space: Modelspace) -> None:
        corners = [(0, 0), (297, 0), (297, 210), (0, 210)]
        for this, after in zip(corners, [*corners[1:], corners[0]], strict=True):
            space.add_line(this, after)
        space.add_text("PLATE", height=3.0).set_placement((250, 10))
        space.add_lwpolyline([(100, 100), (110, 100), (110, 106), (100, 106)], close=True)

    done = made_program(drawn(tmp_path, draw), Making(), TO_3B, plain_scenario())
    assert isinstance(done, MadeProgram)
    assert done.is_proved
    (cut,) = done.plan.cuts
    assert (cut.figure.kind, cut.figure.runs_inside) == ("outline", False)
    assert [left.why for left in done.plan.to_check] == ["frame"]


def test_a_wish_for_a_layer_holds_though_all_its_figures_stay_uncut(tmp_path: Path) -> None:
    """A hole of R 0.06 is too small for the wire; its layer is no slip."""

    def draw(space: Modelspace) -> None:
        space.add_lwpolyline([(0, 0), (6, 0), (6, 4), (0, 4)], close=True)
        space.add_circle((2, 2), 0.06, {"layer": "PINS"})

    making = Making(layers=(LayerWish("PINS", rank=1),))
    done = made_program(drawn(tmp_path, draw), making, TO_3B, plain_scenario())
    assert isinstance(done, MadeProgram)
    assert done.is_proved
    assert [left.why for left in done.plan.to_check] == ["too-small"]
