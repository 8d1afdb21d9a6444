"""Runs of programs that compensate themselves: the path that runs, its passes, what is left, and what is refused."""

from dataclasses import replace

import numpy as np
import pytest
from compensated_iso import DIE, around, die, head, program
from report_schema import complaints
from runs import codes, lawful, plain_scenario, scenario_run

from controller.offset.chain import RowOrigin
from controller.offset.shifted import Side
from parser.dialect.reader import Choices
from parser.findings.catalogue import texts
from parser.findings.codes import Severity
from parser.findings.errors import ProgramError, SettingsError
from parser.program import Program, parse_program
from sim.base.progress import silent
from sim.run.dryrun import DryRun
from sim.run.prepare import as_run
from sim.run.report import build_report
from sim.run.running import dry_run
from sim.setup.part import Offset, OffsetPass
from sim.show.terminal.run import pass_rows
from sim.show.texts import Words

ASKED = Offset((OffsetPass(100.0),), Side.LEFT)


def read(text: str, **registers: float) -> Program:
    return parse_program(text, choices=Choices(dialect="skd2", registers=tuple(registers.items())))


def run(text: str, **changes: object) -> DryRun:
    return lawful(dry_run(read(text), plain_scenario(**changes), silent))


def test_the_steps_follow_the_compensated_path() -> None:
    ran = run(die())
    assert [code for code in codes(ran) if code != "ISO112"] == []
    assert ran.deviations.steps.max_um <= 1.0
    corners = ran.stepped.corner_um[1:7]
    inner = [(4900, 0), (4900, 4900), (-4900, 4900), (-4900, -4900), (4900, -4900), (4900, 0)]
    assert corners.tolist() == [list(place) for place in inner]
    assert len(ran.stepped) == 2 * 4900 + 8 * 4900


def test_the_report_tells_the_offset_block_by_block() -> None:
    report = build_report(run(die()))
    assert complaints(report) == []
    offset = report["offset"]
    assert (offset["by_um"], offset["side"], offset["closed_paths"]) == (100.0, "left", [1])
    assert [one["made"] for one in offset["blocks"]] == ["lead", *["shifted"] * 5, "lead"]
    assert [one["source_block"] for one in offset["blocks"]] == [1, 2, 3, 4, 5, 6, 7]
    assert [one["pass"] for one in offset["blocks"]] == [None, *[1] * 5, None]
    assert {one["check"]: one["state"] for one in report["coverage"]["checks"]}["compensation"] == "complete"


def test_the_hole_is_as_large_as_the_contour() -> None:
    ran = run(die(), kerf=True)
    assert ran.remains is not None
    (slug,) = ran.remains.pieces.freed
    assert (slug.kind, slug.freed.block) == ("slug", 6)
    assert slug.area_mm2 == pytest.approx(9.6**2 - 0.2 * 4.8, abs=0.1)  # less the lead-in
    assert [box.nominal_um for box in ran.remains.sizes.boxes] == [pytest.approx((10000.0, 10000.0))]


def test_a_path_without_a_cancel_ends_at_the_offset_without_a_lead() -> None:
    ran = run(program(head("H1=100"), around(DIE)[:-1]))
    assert ran.toolpath.end_um[-1].tolist() == pytest.approx([4900.0, 0.0])
    assert ran.offset is not None
    assert ran.offset.path.made[-1] == RowOrigin.SHIFTED
    assert "ISO506" not in codes(ran)


def test_passes_of_the_program_are_those_of_the_report() -> None:
    report = build_report(scenario_run("iso-die"))
    assert [(one["number"], one["direction"], one["offset_um"]) for one in report["passes"]] == [
        (1, "forward", 160.0),
        (2, "back", 100.0),
    ]
    assert {one["pass"] for one in report["offset"]["blocks"]} == {None, 1, 2}


def test_a_pause_stays_between_its_blocks() -> None:
    stopped = program(head("H1=100"), [*around(DIE)[:3], "M00", *around(DIE)[3:]])
    ran = run(stopped)
    (pause,) = [stop for stop in ran.toolpath.stops if stop.kind == "pause"]
    assert ran.toolpath.end_um[pause.after - 1].tolist() == pytest.approx([-4900.0, 4900.0])


def test_a_contour_behind_a_threading_runs_at_its_own_offset() -> None:
    beside = [(x + 20000, y) for x, y in DIE]
    text = program(
        head("H1=100", "H2=150"), around(DIE), ["M00", "G92 X20000 Y0"], around(beside, register="H2", out=(20000, 0))
    )
    ran = run(text)
    assert [code for code in codes(ran) if code != "ISO112"] == []
    jump = int(np.flatnonzero(ran.toolpath.is_jump)[0])
    assert ran.toolpath.start_um[jump + 2].tolist() == pytest.approx([24850.0, 0.0])


def test_a_register_that_nobody_tells_is_asked_for_and_nothing_runs() -> None:
    text = program(head(), around(DIE, register="H9"))
    with pytest.raises(ProgramError, match="H9") as refused:
        dry_run(read(text), plain_scenario(), silent)
    assert refused.value.finding.code == "ISO500"
    assert "--offset H9=" in texts(refused.value.finding).hint
    told = dry_run(read(text, H9=100.0), plain_scenario(), silent)
    assert told.offset is not None
    assert told.offset.by_um == 100.0


def test_an_offset_besides_the_program_s_own_is_refused() -> None:
    with pytest.raises(SettingsError, match="compensates itself"):
        dry_run(read(die()), plain_scenario(offset=ASKED), silent)
    with pytest.raises(SettingsError, match="compensates itself"):
        as_run(read(die()), ASKED)


def test_what_is_compared_is_the_path_that_runs() -> None:
    compensated = as_run(read(die()), None).toolpath
    assert compensated.end_um[0].tolist() == pytest.approx([4900.0, 0.0])
    plain = read("G92 X0 Y0\nG90\nG01 X5000\nY5000\nX0\nY0\nM02\n")
    assert as_run(plain, None) is plain
    offset = as_run(plain, ASKED).toolpath
    assert len(offset) >= len(plain.toolpath)
    with pytest.raises(ProgramError):
        as_run(read(program(head(), around(DIE, register="D0"))), None)


def test_the_travel_is_that_of_the_wire_and_not_of_the_contour() -> None:
    """The hole would fit the table with its offset, and would not without; a punch the other way round."""
    scenario = plain_scenario()
    machine = scenario.machine
    table = machine.table._replace(travel_x_mm=9.9, travel_y_mm=9.9)
    small = replace(scenario, machine=machine._replace(table=table), start_mm=None)
    assert "ISO304" not in codes(dry_run(read(die()), small, silent))
    wide = die(by="H1=20")
    assert {"ISO304", "3B401"} & set(codes(dry_run(read(wide), small, silent)))


def test_a_chamfer_of_a_sharp_corner_is_a_bridge_of_the_program_s_rules() -> None:
    wedge = [(5000, 0), (5000, 3000), (15000, 0), (5000, -3000), (5000, 0)]
    ran = run(program(head("H1=100"), around(wedge)))
    assert ran.offset is not None
    assert (ran.offset.path.made == RowOrigin.BRIDGE).any()
    assert [code for code in codes(ran) if code != "ISO112"] == []


def test_a_contour_at_nothing_runs_as_written() -> None:
    ran = run(program(head("H1=0"), around(DIE)))
    assert ran.toolpath.end_um.tolist() == read(die()).toolpath.end_um.tolist()


@pytest.mark.parametrize(
    "blocks",
    [
        ["G41 G01 X0 Y0 H1"],
        ["G41 G01 X1000 Y0 H1"],
        ["G41 G01 X1000 Y0 H1", "G40 X2000"],
        ["G41 G00 X1000 Y0 H1", "G01 X2000", "G00 X3000", "G40 G01 X0"],
        ["G01 X1000", "G41 X1000 H1", "X1000", "G40 X1000"],
    ],
    ids=["nothing moves", "set-up alone", "set-up and cancel", "jumps", "no length"],
)
def test_odd_programs_run_and_have_a_lawful_report(blocks: list[str]) -> None:
    report = build_report(run(program(head("H1=100"), blocks), kerf=True))
    assert complaints(report) == []


@pytest.mark.parametrize(("line", "code"), [("G26", "ISO204"), ("#100 = 5", "ISO402")])
def test_a_run_fails_where_the_machine_would_take_another_path(line: str, code: str) -> None:
    ran = dry_run(read(die().replace("G90", f"G90\n{line}\n", 1)), plain_scenario(), silent)
    assert [one.code for one in ran.findings if one.severity is Severity.ERROR] == [code]
    assert build_report(ran)["verdict"] == "fail"


def test_passes_have_the_offsets_of_their_registers_and_not_the_reach_of_the_wire() -> None:
    registers = {"H1": 252.73, "H2": 184.15, "H3": 132.08}
    back = tuple(reversed(DIE))
    ways = [around(DIE, "G41", "H1"), around(back, "G42", "H2"), around(DIE, "G41", "H3")]
    ran = run(program(head(*(f"{name}={um / 1000:.5f}" for name, um in registers.items())), *ways), kerf=True)
    assert ran.scenario.wire.reach_um == 100.0
    report = build_report(ran)
    wanted = list(registers.values())
    assert [one["offset_um"] for one in report["passes"]] == pytest.approx(wanted)
    assert [one["by_um"] for one in report["offset"]["passes"]] == pytest.approx(wanted)
    told = [figures.split(",")[1] for _, figures in pass_rows(ran, Words("en"))]
    assert told == [f" offset {um:.0f} µm" for um in wanted]
    assert [one["stock_um"]["mean"] for one in report["passes"]] == pytest.approx([200.0, 68.58, 52.07], abs=1.0)
