"""Runs of a wire that leans: what the report says, what is wrong, and what of an upright run stays as it is."""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import ezdxf
import numpy as np
import pytest

from parser.findings.errors import ProgramError, SettingsError
from parser.program import load_program
from sim.base.progress import silent
from sim.run.dryrun import DryRun
from sim.run.prepare import as_run_in, prepare
from sim.run.report.document import build_report, report_text
from sim.run.running import dry_run
from sim.run.times.predicted import predicted
from sim.setup.machine.guides import Guides
from sim.setup.part import SIDES, DrawingTarget, Offset, OffsetPass
from sim.setup.scenario import Scenario, load_scenario
from sim.setup.shop import Shop
from sim.setup.taper import TaperSettings, UpperProgram, heights_of
from sim.setup.wire import DEFAULT_WIRE
from sim.show.report_page.figures import key_figures

PUNCH = b"""B0B5000B5000GYL2
B10000B0B10000GXL1
B0B20000B20000GYL2
B20000B0B20000GXL3
B0B20000B20000GYL4
B10000B0B10000GXL1
B0B5000B5000GYL4
DD
"""
UPPER = PUNCH.replace(b"B20000", b"B16000").replace(b"B10000", b"B8000")
RAD = 0.017453292519943295
Run = Callable[..., DryRun]


@pytest.fixture
def run(tmp_path: Path) -> Run:
    def of(program: bytes = PUNCH, name: str = "part.3b", **settings: object) -> DryRun:
        path = tmp_path / name
        path.write_bytes(program)
        scenario = replace(load_scenario(path), trace_spacing_um=50.0, **settings)  # type: ignore[arg-type]
        return dry_run(load_program(program, name, scenario.choices), scenario, silent)

    return of


def angle(degrees: float, **others: object) -> TaperSettings:
    return TaperSettings(angle_rad=degrees * RAD, **others)  # type: ignore[arg-type]


def above(program: bytes) -> TaperSettings:
    """The contour of another program at the top of the work."""
    return TaperSettings(upper=UpperProgram("upper.3b", program))


def codes(of: DryRun) -> list[str]:
    return [finding.code for finding in of.findings]


def test_a_sound_program_is_silent_and_its_lean_is_checked(run: Run) -> None:
    done = run(taper=angle(3.0), kerf=True)
    assert codes(done) == []
    assert [state.state for state in done.coverage.checks if state.name == "check-taper"] == ["complete"]
    taper = build_report(done)["taper"]
    assert taper is not None
    assert taper["uv_most_um"] == {"side": 10481.555857, "corner": 14823.158447}
    assert taper["volume_mm3"]["programmed"] == 19588.472302
    assert taper["guides_assumed"]
    assert all(section["max_deviation_um"] < 3.0 for section in taper["sections"])


def test_the_piece_is_what_the_kerf_leaves_of_each_height(run: Run) -> None:
    done = run(taper=angle(3.0), kerf=True)
    assert done.tilted is not None
    reach = done.scenario.wire.reach_um / 0.9986295
    for section in done.tilted.sections:
        side_mm = 1e-3 * (float((section.high_um - section.low_um)[0]) - 2.0 * reach)
        # Table and head let the wire be off its walls, 83 mm round, by up to 3 µm.
        assert section.piece_mm2 == pytest.approx(side_mm**2, abs=0.25)
    (solid,) = done.tilted.solids
    assert (solid.kind, solid.larger, solid.drops) == ("part", "top", False)
    sides = [20.0 - 2e-3 * reach + by for by in (0.0, 4.192622)]
    frustum = 40.0 / 3.0 * (sides[0] ** 2 + sides[1] ** 2 + sides[0] * sides[1])
    assert solid.volume_mm3 == pytest.approx(frustum, rel=5e-4)


def test_four_axes_take_the_time_of_the_longer_contour(run: Run) -> None:
    done = run(taper=angle(3.0))
    taper = build_report(done)["taper"]
    assert taper is not None
    feed = float(np.max(done.scenario.machine.feeds(done.scenario.thickness_mm).cut_um_s))
    # The top is 24.192622 mm wide. Leads of 5 mm tilt the wire: up there they are 2.096311 mm shorter.
    length_um = 4.0 * 24_192.622 + 2.0 * 5000.0
    assert taper["time_s"] == pytest.approx(length_um / feed, rel=2e-3)
    assert taper["time_s"] > 1.15 * build_report(done)["time_s"]["total"]


def test_an_angle_of_0_changes_no_byte(run: Run) -> None:
    plain, upright = (report_text(build_report(run(kerf=True, taper=taper))) for taper in (None, angle(0.0)))
    assert plain == upright
    assert '"taper": null' in plain


def test_an_offset_is_divided_by_the_cosine(run: Run) -> None:
    text = (
        b"H001=100\nG92 X0 Y0\nG90\nG52 A10. G42 G01 X0 Y5000 H001\n"
        b"X10000 Y5000\nY25000\nX-10000\nY5000\nX0\nG50 G40 X0 Y0\nM02\n"
    )
    done = run(text, "part.iso", dialect="skd2")
    assert float(done.toolpath.end_um[1, 0]) == pytest.approx(10_000.0 + 100.0 / 0.984807753, abs=1e-3)
    assert [code for code in codes(done) if not code.startswith("ISO1")] == []


def test_a_header_whose_offset_was_not_widened_is_told(run: Run) -> None:
    head = b"CAXAWEDM - Version 2.0, Name: part.3b\nConner R= 0.00000, Offset F= 0.10000, Length= 90.000 mm\n"
    done = run(head + PUNCH, taper=angle(10.0))
    assert "3B708" in codes(done)
    (found,) = (finding for finding in done.findings if finding.code == "3B708")
    assert found.values["off"] == pytest.approx(100.0 * (1.0 / 0.984807753 - 1.0), abs=1e-4)
    assert "3B708" not in codes(run(head + PUNCH, taper=angle(3.0)))


@pytest.mark.parametrize(
    ("code", "settings"),
    [
        ("3B702", {"guides": Guides(travel_u_um=20_000.0, travel_v_um=29_000.0)}),
        ("3B703", {"guides": Guides(most_rad=4.0 * RAD)}),
        ("3B710", {"guides": Guides(travel_u_um=0.0, travel_v_um=0.0)}),
    ],
)
def test_what_the_machine_does_not_reach_is_told(run: Run, code: str, settings: dict[str, object]) -> None:
    assert code in codes(run(taper=angle(3.0), past_stop=True, **settings))


def test_a_lower_guide_beyond_the_travel_is_told_where_the_program_is_within(run: Run) -> None:
    # The program reaches 2 mm from the end of the travel, the lower guide 3.144 mm farther.
    outward = run(taper=angle(3.0, side=SIDES["left"]), start_mm=(12.0, 100.0))
    (found,) = (finding for finding in outward.findings if finding.code == "3B704")
    assert found.values["by_mm"] == pytest.approx(1.144467, abs=1e-6)
    assert codes(run(taper=angle(3.0), start_mm=(12.0, 100.0))) == []


def test_sharp_corners_need_more_travel_than_walls(run: Run) -> None:
    guides = Guides(travel_u_um=20_970.0, travel_v_um=20_970.0, most_rad=4.23 * RAD)
    assert codes(run(taper=angle(3.0), guides=guides)) == ["3B703"]
    assert codes(run(taper=angle(3.0, corner="cone"), guides=guides)) == []


def test_a_fillet_that_turns_over_names_the_height(run: Run) -> None:
    text = b"""B0B5000B5000GYL2
B8000B0B8000GXL1
B0B2000B2000GYNR4
B0B16000B16000GYL2
B2000B0B2000GXNR1
B16000B0B16000GXL3
B0B2000B2000GYNR2
B0B16000B16000GYL4
B2000B0B2000GXNR3
B8000B0B8000GXL1
B0B5000B5000GYL4
DD
"""
    inward = run(text, taper=angle(3.0, side=SIDES["left"]))
    (found,) = (finding for finding in inward.findings if finding.code == "3B701")
    assert found.values["z_mm"] == pytest.approx(38.1623, abs=1e-3)
    assert codes(run(text, taper=angle(3.0))) == []


NECK = b"""B0B5000B5000GYL2
B9500B0B9500GXL1
B0B5000B5000GYL2
B3000B0B3000GXL3
B0B5000B5000GYL2
B7000B0B7000GXL1
B0B4000B4000GYL4
B3000B0B3000GXL3
B0B5000B5000GYL4
B8500B0B8500GXL1
B0B19000B19000GYL2
B38000B0B38000GXL3
B0B20000B20000GYL4
B19000B0B19000GXL1
B0B5000B5000GYL4
DD
"""


def test_a_neck_whose_walls_meet_above_is_told(run: Run) -> None:
    # A neck 1 mm wide into a wide pocket: its walls move by 40 mm tan T towards each other, 0.349 and 0.698 mm.
    assert codes(run(NECK, taper=angle(0.5))) == []
    narrow = run(NECK, taper=angle(1.0))
    (found,) = narrow.findings
    assert (found.code, found.values["z_mm"]) == ("3B709", 40.0)


def test_two_programs_are_run_block_by_block(run: Run) -> None:
    done = run(taper=above(UPPER), kerf=True)
    taper = build_report(done)["taper"]
    assert taper is not None
    assert (codes(done), taper["angle_deg"]) == ([], None)
    assert taper["sections"][4]["box_mm"] == [16.0, 16.0]
    assert taper["volume_mm3"]["programmed"] == pytest.approx(40.0 / 3.0 * (400.0 + 256.0 + 320.0), abs=1e-3)


ROUND_ON_SQUARE = b"""D1=0.1
G92 X0. Y-15.
G90
G152 D1
G01 X0. Y-10. : G01 X0. Y-8.
G01 X10. Y-10. : G03 X5.657 Y-5.657 I0. J8.
G01 X10. Y0. : G03 X8. Y0. I-5.657 J5.657
G01 X10. Y10. : G03 X5.657 Y5.657 I-8. J0.
G01 X0. Y10. : G03 X0. Y8. I-5.657 J-5.657
G01 X-10. Y10. : G03 X-5.657 Y5.657 I0. J-8.
G01 X-10. Y0. : G03 X-8. Y0. I5.657 J-5.657
G01 X-10. Y-10. : G03 X-5.657 Y-5.657 I8. J0.
G01 X0. Y-10. : G03 X0. Y-8. I5.657 J5.657
G150
G01 X0. Y-15. : G01 X0. Y-15.
M02
"""
"""Worked solid of round on square, its wire to the right of both contours by 0.1 mm."""
THIN = replace(DEFAULT_WIRE, diameter_um=180.0, spark_gap_um=10.0)


def test_the_offset_of_two_contours_leaves_the_solid_between_them(run: Run) -> None:
    done = run(ROUND_ON_SQUARE, "part.iso", wire=THIN, kerf=True, dialect="fast-wire")
    taper = build_report(done)["taper"]
    assert taper is not None
    assert codes(done) == ["ISO112"]
    # The wire leans by 3° across its walls, so it cuts 0.15 um farther than its offset, and steps are 1 um.
    assert taper["volume_mm3"]["piece"] == pytest.approx(11_855.509, rel=4e-4)
    areas = [section["piece_area_mm2"] for section in taper["sections"]]
    assert areas == pytest.approx([400.0, 345.6043, 294.3161, 246.1353, 201.0619], rel=5e-4)


def test_an_offset_beside_two_programs_is_that_of_each(run: Run) -> None:
    offset = Offset((OffsetPass(100.0),), SIDES["right"])
    done = run(taper=above(UPPER), offset=offset, wire=THIN, kerf=True)
    taper = build_report(done)["taper"]
    assert taper is not None
    assert codes(done) == []
    boxes = [section["box_mm"] for section in taper["sections"]]
    assert (boxes[0], boxes[4]) == ([20.2, 20.2], [16.2, 16.2])
    assert taper["sections"][4]["piece_area_mm2"] == pytest.approx(256.0, abs=0.05)


NOTCHED = b"""B0B5000B5000GYL2
B10000B0B10000GXL1
B0B8000B8000GYL2
B3000B0B3000GXL3
B0B%dB%dGYL2
B3000B0B3000GXL1
B0B%dB%dGYL2
B20000B0B20000GXL3
B0B20000B20000GYL4
B10000B0B10000GXL1
B0B5000B5000GYL4
DD
"""


def test_an_offset_that_fits_the_lower_contour_alone_is_told(run: Run) -> None:
    wide, narrow = (NOTCHED % (gap, gap, 12_000 - gap, 12_000 - gap) for gap in (2000, 150))
    offset = Offset((OffsetPass(100.0),), SIDES["right"])
    assert codes(run(wide, taper=above(wide), offset=offset, wire=THIN)) == []
    found = run(wide, taper=above(narrow), offset=offset, wire=THIN).findings
    assert "3B712" in [each.code for each in found]
    assert next(each for each in found if each.code == "3B712").values["other"] in {"3B503", "3B504"}


def test_contours_of_which_one_closes_are_not_offset(run: Run) -> None:
    offset = Offset((OffsetPass(100.0),), SIDES["right"])
    opened = UPPER.replace(b"B8000B0B8000GXL1\nB0B5000B5000GYL4", b"B7000B0B7000GXL1\nB0B5000B5000GYL4")
    with pytest.raises(ProgramError) as refused:
        run(taper=above(opened), offset=offset)
    assert (refused.value.finding.code, refused.value.finding.values["what"]) == ("3B705", "pair-rounds")


ISO = b"G92 X0 Y0\nG90\nG01 X0 Y5000\nX5000 Y5000\nX0 Y0\nM02\n"


@pytest.mark.parametrize(
    ("lower", "upper", "what"),
    [
        (PUNCH, UPPER.replace(b"B8000B0B8000GXL1\nB0B16000", b"B0B16000", 1), "pair-counts"),
        (ISO, ISO.replace(b"G01 X0 Y5000", b"G00 X0 Y5000").replace(b"X5000", b"G01 X5000"), "pair-jumps"),
    ],
)
def test_contours_that_do_not_match_are_refused(run: Run, lower: bytes, upper: bytes, what: str) -> None:
    with pytest.raises(ProgramError) as refused:
        run(lower, taper=above(upper))
    assert (refused.value.finding.code, refused.value.finding.values["what"]) == ("3B705", what)


def test_contours_that_are_matched_a_block_off_are_told(run: Run) -> None:
    lines = UPPER.splitlines()
    upper = b"\n".join([*lines[:2], b"B0B100B100GYL2", b"B0B15900B15900GYL2", *lines[3:]])
    lower = PUNCH.replace(b"B10000B0B10000GXL1\nB0B5000", b"B9900B0B9900GXL1\nB100B0B100GXL1\nB0B5000")
    assert "3B706" in codes(run(lower, taper=above(upper)))


def test_what_does_not_go_together_is_refused(run: Run) -> None:
    leaning = b"G92 X0 Y0\nG90\nG51 A1. G01 X0 Y5000\nX5000 Y5000\nG50 X0 Y0\nM02\n"
    with pytest.raises(SettingsError, match="leans the wire by itself"):
        run(leaning, "part.iso", taper=angle(3.0))
    with pytest.raises(SettingsError, match="above the work"):
        run(taper=angle(3.0, program_plane_um=50_000.0))


@pytest.mark.parametrize(
    ("upper", "complaint"),
    [
        (b"0\nSECTION\n2\nENTITIES\n0\nENDSEC\n0\nEOF\n", "upper.3b: this is a DXF drawing"),
        (b"nothing\n", "upper.3b: no block in the file"),
        (UPPER.replace(b"B8000B0B8000GXL1", b"B8000B0B8000GYL1", 1), "upper.3b, line 2: 3B202"),
    ],
)
def test_what_is_wrong_with_the_upper_program_names_its_own_file(run: Run, upper: bytes, complaint: str) -> None:
    with pytest.raises(SettingsError, match=complaint):
        run(taper=above(upper))


def test_two_contours_at_one_height_are_refused(run: Run) -> None:
    with pytest.raises(SettingsError, match="two contours need two heights"):
        run(taper=above(UPPER)._replace(program_plane_um=40_000.0), thickness_mm=40.0)


def test_a_lag_bows_the_wire_back_at_each_height(run: Run) -> None:
    straight, bowed = (run(taper=angle(3.0), kerf=True, wire=replace(DEFAULT_WIRE, lag=lag)) for lag in (0.0, 300.0))
    assert straight.tilted is not None
    assert bowed.tilted is not None
    for one, other in zip(straight.tilted.sections, bowed.tilted.sections, strict=True):
        assert one.off_um == other.off_um
        # Each of the four corners is cut off by the lag, inside of the wire's way.
        assert 0.01 < (one.piece_mm2 or 0.0) - (other.piece_mm2 or 0.0) < 0.2


def test_backlash_of_the_head_shows_at_the_top_most(run: Run) -> None:
    free, loose = (run(taper=angle(3.0), guides=Guides(backlash_um=(by, by))) for by in (0.0, 40.0))
    assert free.tilted is not None
    assert loose.tilted is not None
    by = [other.off_um - one.off_um for one, other in zip(free.tilted.sections, loose.tilted.sections, strict=True)]
    assert by[0] < by[2] < by[4]


def test_scenario_files_say_it_and_are_written_again(tmp_path: Path) -> None:
    (tmp_path / "program.3b").write_bytes(PUNCH)
    (tmp_path / "scenario.toml").write_text(
        '[taper]\nangle_deg = 2.5\nside = "left"\ncorner = "cone"\nprogram_plane_mm = 5\n'
        "[guides]\nlower_guide_mm = 30\nupper_guide_mm = 50\ntravel_u_mm = 20\nmass_u_kg = 9\nmass_v_kg = 4\n"
    )
    scenario = load_scenario(tmp_path)
    assert scenario.taper is not None
    assert scenario.taper.angle_rad == pytest.approx(2.5 * RAD)
    assert (scenario.taper.side, scenario.taper.corner) == (SIDES["left"], "cone")
    heights = heights_of(scenario.taper, scenario.known_guides, scenario.thickness_mm)
    assert heights == (40_000.0, 5000.0, -30_000.0, 90_000.0)
    head = scenario.known_guides.head(scenario.machine.table)
    assert (head.moved_kg, head.travel_x_mm) == ((9.0, 4.0), 20.0)


@pytest.mark.parametrize(
    ("text", "complaint"),
    [
        ('[taper]\nangle_deg = 3\nupper = "upper.3b"\n', "an angle and an upper program"),
        ("[taper]\nangle_deg = 70\n", "angle_deg"),
        ("[guides]\nmass_u_kg = 3\n", "masses of both U and V"),
        ("[guides]\nmass_u_kg = 3\nmass_v_kg = 4\n", "masses of both U and V"),
    ],
)
def test_wrong_keys_are_told(tmp_path: Path, text: str, complaint: str) -> None:
    (tmp_path / "program.3b").write_bytes(PUNCH)
    (tmp_path / "scenario.toml").write_text(text)
    with pytest.raises(SettingsError, match=complaint):
        load_scenario(tmp_path)


def test_whoever_reads_the_path_of_a_wire_that_leans_has_its_wider_offset(tmp_path: Path) -> None:
    path = tmp_path / "part.3b"
    path.write_bytes(PUNCH)
    program = load_program(PUNCH, path.name)

    def scenario(by_um: float, taper: TaperSettings | None) -> Scenario:
        return replace(load_scenario(path), offset=Offset((OffsetPass(by_um),), SIDES["right"]), taper=taper)

    leaning, wider = scenario(100.0, angle(45.0)), scenario(100.0 * 2.0**0.5, None)
    lengths = [predicted(program, each, Shop()).length_mm for each in (scenario(100.0, None), leaning, wider)]
    assert lengths[1] == pytest.approx(lengths[2], abs=1e-9)
    assert lengths[1] > lengths[0] + 0.2
    ends = [as_run_in(program, each).toolpath.end_um for each in (leaning, wider)]
    assert np.abs(ends[0] - ends[1]).max() < 1e-6
    assert prepare(program, leaning).tilt is not None
    assert prepare(program, wider).tilt is None


def square(folder: Path, name: str, half_mm: float, shift_mm: float = 0.0) -> Path:
    """The drawing of a square about the middle of the punch at (0, 15) mm, its sides that far off."""
    document = ezdxf.new(units=4)
    corners = [(x * half_mm + shift_mm, 15.0 + y * half_mm) for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    document.modelspace().add_lwpolyline(corners, close=True)
    document.saveas(folder / name)
    return folder / name


@pytest.mark.parametrize(
    ("grown_um", "shift_um", "off"),
    [(0.0, 0.0, False), (20.0, 0.0, True), (-20.0, 0.0, True), (0.0, 20.0, True)],
    ids=["as drawn", "too large", "too small", "shifted against the bottom"],
)
def test_the_edge_at_the_top_is_held_against_a_drawing_of_its_own(
    run: Run, tmp_path: Path, grown_um: float, shift_um: float, off: bool
) -> None:
    reach_mm = 0.1 / 0.998629535
    below = square(tmp_path, "below.dxf", 10.0 - reach_mm)
    above_half_mm = 10.0 + 40.0 * 0.052407779 - reach_mm + 1e-3 * grown_um
    top = square(tmp_path, "top.dxf", above_half_mm, 1e-3 * shift_um)
    done = run(taper=angle(3.0), drawing=DrawingTarget(below, upper=top))
    assert codes(done) == ["3B711"] * 2 * off
    entry = build_report(done)["taper"]
    assert entry is not None
    assert entry["drawing"] is not None
    # Table and head let the wire be off by up to 3 µm; a corner is off by √2 of its sides.
    assert entry["drawing"]["max_um"] == pytest.approx((2.0**0.5 if grown_um else 1.0) * 20.0 * off, abs=3.5)
    assert done.comparison is not None
    assert done.comparison.max_um < 3.0
    shown = {figure.entry: figure.value for figure in key_figures(done, build_report(done))}
    assert shown["taper.drawing.max_um"] == entry["drawing"]["max_um"]


def test_a_drawing_of_the_top_of_an_upright_cut_is_refused(run: Run, tmp_path: Path) -> None:
    below = square(tmp_path, "below.dxf", 9.9)
    with pytest.raises(SettingsError, match="the wire is upright"):
        run(drawing=DrawingTarget(below, upper=below))
