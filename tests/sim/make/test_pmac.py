"""PMAC programs written: the six conversions of the sheet, random programs there and back, and the paper's spiral."""

import math
import random
from pathlib import Path

import archimedes
import numpy as np
import pytest
import sound
from places import ROOT

from parser.dialect.reader import Choices
from parser.findings.codes import Severity
from parser.geometry.curves import extents
from parser.program import Program, load_program, parse_program
from parser.write.pmac import Card, PmacChoices, Way, blocks_of_source
from sim.check.path_checks import Demands, run_checks
from sim.make.convert import Converted, Refused, converted
from sim.make.wanted import Wanted
from sim.show.terminal.convert import converted_lines

MM = Choices(dialect="common", unit="mm")
HEAD = "CLOSE\n&1\n#1->1000X\n#2->1000Y\n#3->1000Z\nI5113=10\nI5190=60000\n"


def wanted(program: Program, way: Way = "native", card: Card = "turbo") -> Wanted:
    return Wanted(
        "pmac", pmac=PmacChoices(way, card, blocks_of_source(program.text, program.toolpath, program.decoder))
    )


def conversion(text: str, way: Way = "native", card: Card = "turbo") -> Converted:
    program = parse_program(text, "part.iso", choices=MM)
    done = converted(program, wanted(program, way, card))
    assert isinstance(done, Converted), done
    return done


def body(text: str) -> list[str]:
    """Lines behind the head."""
    written = conversion(text).data.decode()
    assert written.startswith(f"{HEAD}OPEN PROG 1\nCLEAR\n")
    return written.removeprefix(f"{HEAD}OPEN PROG 1\nCLEAR\n").splitlines()


LINES = "G90 G00 X1 Y2\nG01 X11 F120\nY12\nM02\n"


def test_lines_come_out_as_they_stand_in_the_sheet() -> None:
    assert body(LINES) == ["ABS", "FRAX(X,Y,Z)", "RAPID X1 Y2", "LINEAR X11 F120", "Y12", "DWELL0", "CLOSE"]


def test_the_way_of_the_paper_keeps_g_words_and_supplies_their_routines() -> None:
    routines = (
        "OPEN PROG 1000\nCLEAR\nRAPID RET\nN1000 LINEAR RET\nN2000 CIRCLE1 RET\nN3000 CIRCLE2 RET\nN90000 ABS\nRET\n"
        "N91000 INC\nRET\nCLOSE\n"
    )
    main = "OPEN PROG 1\nCLEAR\nG90 G00 X1 Y2\nG01 X11 F120\nY12\nCLOSE\n"
    assert conversion(LINES, "gcode").data.decode() == HEAD + routines + main


def test_power_clears_by_opening_and_has_colons() -> None:
    text = conversion(LINES, "gcode", "power").data.decode()
    assert "CLEAR" not in text
    assert "N1000: LINEAR RET" in text
    assert "Coord[1].FeedTime=60000" in text


@pytest.mark.parametrize(
    ("source", "lines"),
    [
        (
            "G90 G00 X10 Y0\nG03 X0 Y10 I-10 J0 F60\nG02 X10 Y0 I0 J-10\nM02\n",
            ["NORMAL K-1", "RAPID X10 Y0", "CIRCLE2 X0 Y10 I-10 J0 F60", "CIRCLE1 X10 Y0 I0 J-10"],
        ),
        (
            "G90 G00 X10 Y0\nG03 X0 Y10 R10\nG03 X10 Y0 R-10\nG02 X10 Y0 I-10 J0\nM02\n",
            ["CIRCLE2 X0 Y10 R10", "X10 Y0 R-10", "CIRCLE1 X10 Y0 I-10 J0"],
        ),
        (
            "G91 G01 X5 F60\nG04 P0.5\nG02 X2 Y-2 I0 J-2\nM00\nG90\nM02\n",
            ["LINEAR X5 F60", "DWELL500", "CIRCLE1 X2 Y-2 I0 J-2", "STOP", "ABS"],
        ),
    ],
    ids=["centres", "radii", "increments"],
)
def test_arcs_and_dwells_come_out_as_they_stand_in_the_sheet(source: str, lines: list[str]) -> None:
    made = body(source)
    first = made.index(lines[0])
    assert made[first : first + len(lines)] == lines


def test_a_program_with_errors_is_not_converted() -> None:
    program = parse_program("G90 G00 X1 Y0\nG03 X0 Y5 I-1 J0\nM02\n", choices=MM)
    assert isinstance(converted(program, wanted(program)), Refused)


@pytest.mark.alike(4)
@pytest.mark.parametrize("way", ["native", "gcode"])
@pytest.mark.parametrize("seed", range(5))
def test_random_iso_comes_back_within_a_micrometre(seed: int, way: Way) -> None:
    rng = random.Random(seed)
    lines, x, y = ["G92 X0 Y0", "G90"], 0.0, 0.0
    for _ in range(40):
        x1, y1 = round(x + rng.uniform(-9, 9), 3), round(y + rng.uniform(-9, 9), 3)
        radius = rng.uniform(0.51, 3.0) * math.hypot(x1 - x, y1 - y)
        word = rng.choice((f"G01 X{x1} Y{y1} F60", f"G00 X{x1} Y{y1}", f"G02 X{x1} Y{y1} R{radius:.4f} F60"))
        lines.append(word)
        x, y = x1, y1
    done = conversion("\n".join([*lines, "M02", ""]), way)
    source = parse_program("\n".join([*lines, "M02", ""]), choices=MM).toolpath
    assert done.off_um <= 1.0
    assert np.abs(done.program.toolpath.length_um - source.length_um).max() <= 1.0


@pytest.mark.alike(4)
@pytest.mark.parametrize("way", ["native", "gcode"])
@pytest.mark.parametrize("seed", range(200, 206))
def test_random_3b_comes_back_within_a_micrometre_and_in_its_box(seed: int, way: Way) -> None:
    program = load_program(sound.sound_program(random.Random(seed)).data, "part.3b")
    done = converted(program, wanted(program, way))
    assert isinstance(done, Converted), done
    assert done.off_um <= 1.0
    back = done.program.toolpath
    assert len(back) == len(program.toolpath)
    for own, other in zip(extents(program.toolpath), extents(back), strict=True):
        assert np.abs(own - other).max() <= 1.5, "1 µm and what the middle of a long arc is off beside"


@pytest.mark.parametrize("name", ["round-hole/program.3b", "iso-die/program.iso", "punch/program.3b"])
@pytest.mark.parametrize("way", ["native", "gcode"])
def test_shipped_programs_come_back_within_a_micrometre(name: str, way: Way) -> None:
    program = load_program((ROOT / "scenarios" / name).read_bytes(), name)
    done = converted(program, wanted(program, way))
    assert isinstance(done, Converted)
    assert done.off_um <= 1.0


# The spiral of the paper


def test_the_spiral_of_the_scenario_is_that_of_the_generator() -> None:
    text = (ROOT / "scenarios" / "spiral" / "program.iso").read_text("utf-8")
    assert text == archimedes.spiral_iso()
    assert archimedes.chord_error_um() < 0.364


@pytest.mark.parametrize(("turns", "length_mm"), [(1, 13.009), (2, 44.572), (3, 94.928)])
def test_the_closed_form_of_the_spiral_is_that_of_the_paper(turns: int, length_mm: float) -> None:
    assert archimedes.length_mm(turns) == pytest.approx(length_mm, abs=0.0005)


@pytest.mark.parametrize("way", ["native", "gcode"])
def test_the_spiral_goes_to_the_card_and_back(way: Way) -> None:
    done = conversion(archimedes.spiral_iso(), way)
    path = done.program.toolpath
    assert float(path.length_um[1:].sum()) == pytest.approx(1000.0 * archimedes.length_mm(), abs=2.0)
    radius, angle = np.hypot(*path.end_um.T), np.arange(1081) * math.tau / archimedes.STEPS
    assert np.abs(radius - (500.0 + 3000.0 * angle / math.tau)).max() < 0.75
    assert "TA10\nTS0\n" in done.data.decode()
    assert done.ramp_ms == 10
    told = " ".join(line.strip() for line in converted_lines(done, Path("a.pmc"), Wanted("pmac"), "en", 80))
    assert "TA10 TS0 is written" in told
    assert [found for found in done.program.findings if found.severity is not Severity.NOTE] == []


def test_the_spiral_begins_as_in_the_sheet() -> None:
    made = body(archimedes.spiral_iso(4))
    first = made.index("LINEAR X0.5083 Y0.0089 F60")
    assert made[first + 1 : first + 3] == ["X0.5164 Y0.018", "X0.5243 Y0.0275"]
    assert made[-3] == "X9.5 Y0"


def test_without_its_acceleration_time_the_spiral_is_told_to_run_slower() -> None:
    text = conversion(archimedes.spiral_iso()).data.decode().replace("TA10\nTS0\n", "")
    (found,) = parse_program(text, "part.pmc").findings
    assert found.values["ramp"] == 100.0
    assert found.values["runs"] < 8.0


def test_spiral_arcs_are_refused_by_the_rule_of_the_paper() -> None:
    program = parse_program(archimedes.spiral_arcs_iso(), "part.iso", choices=MM)
    errors = [found for found in run_checks(program, Demands(may_stay_open=True)).findings if found.code == "ISO212"]
    assert len(errors) == 4 * archimedes.TURNS
    assert {found.severity for found in errors} == {Severity.ERROR}
    assert isinstance(converted(program, wanted(program)), Refused)


def test_a_motion_program_is_converted_to_3b_and_loses_no_words_of_iso() -> None:
    program = conversion(LINES).program
    done = converted(program, Wanted("3b"))
    assert isinstance(done, Converted)
    assert done.off_um <= 1.0
    assert "settings" not in {loss.what for loss in done.lost}


def test_every_shortened_time_is_said_by_power_too() -> None:
    assert "TA10\nTS0\n" in conversion(archimedes.spiral_iso(), "gcode", "power").data.decode()
