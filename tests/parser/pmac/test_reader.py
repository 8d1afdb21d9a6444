"""Motion programs read: closed forms, random programs of a writer of these tests, and what PMAC hides."""

import math
import random
import time

import numpy as np
import pytest

from parser.findings.codes import Severity
from parser.findings.errors import ProgramError
from parser.program import Program, parse_program

HEAD = "CLOSE\n&1\n#1->1000X\n#2->1000Y\n#3->1000Z\nI5113=10\nI5190=60000\n"
ROUTINES = (
    "OPEN PROG 1000\nCLEAR\nRAPID RET\nN1000 LINEAR RET\nN2000 CIRCLE1 RET\nN3000 CIRCLE2 RET\n"
    "N90000 ABS\nRET\nN91000 INC\nRET\nCLOSE\n"
)


def read(body: str, head: str = HEAD) -> Program:
    return parse_program(f"{head}OPEN PROG 1\nCLEAR\n{body}\nCLOSE\n", "part.pmc")


def codes(program: Program) -> list[str]:
    return [finding.code for finding in program.findings]


def test_lines_of_the_sheet() -> None:
    path = read("ABS\nFRAX(X,Y,Z)\nTA10\nTS0\nRAPID X1 Y2\nLINEAR X11 F120\nY12\nDWELL0").toolpath
    assert path.end_um.tolist() == [[1000, 2000], [11000, 2000], [11000, 12000]]
    assert path.kind.tolist() == [2, 0, 0]


def test_arcs_of_the_sheet() -> None:
    path = read("NORMAL K-1\nRAPID X10 Y0\nCIRCLE2 X0 Y10 I-10 J0\nX10 Y0 R-10\nCIRCLE1 X10 Y0 I-10 J0").toolpath
    quarter = math.pi / 2.0
    assert path.sweep_rad.tolist() == pytest.approx([0.0, quarter, 3.0 * quarter, -4.0 * quarter])
    assert path.center_um[1:].ravel().tolist() == pytest.approx([0.0] * 6, abs=1e-8)


@pytest.mark.parametrize("close", ["\n", "\r\n", "\r"])
def test_g_words_call_their_routines(close: str) -> None:
    text = f"{HEAD}{ROUTINES}OPEN PROG 1\nCLEAR\nG90 G00 X1 Y2\nG91G01X10F60\nY10\nG03 X0 Y-20 J-10\nCLOSE\n"
    program = parse_program(text.replace("\n", close))
    assert program.toolpath.end_um[-1].tolist() == [11000, -8000]
    assert program.toolpath.length_um[-1] == pytest.approx(10_000.0 * math.pi)
    assert program.reading.dialect == "PMAC"


def test_case_blanks_and_power_are_read_alike() -> None:
    turbo = read("LINEAR X10 F60 ; there\nDWELL0\nX(0)Y-.5").toolpath
    head = "close\nCoord[1].SegMoveTime=10\nCoord[1].FeedTime=60000\n"
    power = parse_program(f"{head}open prog 1\nlinearx10f60 // there\ndwell 0\nx 0 y-0.5\nclose\n")
    assert power.toolpath.end_um.tolist() == turbo.end_um.tolist() == [[10000, 0], [0, -500]]
    assert codes(power) == []


@pytest.mark.parametrize(
    ("body", "found"),
    [
        ("LINEAR X10 F60", []),
        ("CIRCLE2 X0 Y1.25 I-0.5 J0 F60", ["PMC201"]),
        ("CIRCLE2 X20 Y0 I10.0004 J0 F60", []),
        ("CIRCLE2 X20 Y0 I10.0006 J0 F60", ["PMC201"]),
        ("CIRCLE2 X20 Y0 I20 J0 F60", ["PMC202"]),
        ("CIRCLE2 X20 Y0 R9.9 F60", ["PMC203"]),
        ("CIRCLE2 X0 Y0 R9.9 F60", ["PMC203"]),
        ("LINEAR X10 F60\nG41 X20", ["PMC102"]),
        ("LINEAR X10 F60\nM03", ["PMC102"]),
        ("LINEAR X10 F60\nIF(P1=2)", ["PMC107"]),
        ("LINEAR X10 F60\nIF(P1=2)\nX20\nENDIF", ["PMC107"]),
        ("LINEAR X10 F60\nWHILE(M11=0) WAIT\nX20", []),
        ("LINEAR X10 F60\nSPLINE1 X20\nTM(Q70)\nX(P1*(2+Q3))", ["PMC107"]),
        ("LINEAR X10 F60\nWHILE(1<2)\nX20\nDWELL0\nX10\nDWELL0\nENDWHILE", ["PMC107"]),
        ("LINEAR X10 F60\nM1==1 M2|=4 M3&=$F\nM(P9)==0\nX20", []),
        ("LINEAR X10 F60\nCALL 500 X20", ["PMC107"]),
        ("LINEAR X10 F60\nGOTO 30", ["PMC107"]),
        ("LINEAR X10 F60\nENDIF", ["PMC107"]),
        ("LINEAR X10 F60\nX(SQRT(0-1))", ["PMC107"]),
        ("LINEAR X10 F60\nX(10/0)", ["PMC107"]),
        ("LINEAR X10 F60\nP1=1000\nX(P1*P1)", ["PMC108"]),
        ("LINEAR X10 F60\nP1=0\nWHILE(P1<3)\nP1=P1+1\nDWELL0\nX(P1)X(P1)\nENDWHILE", ["PMC104"]),
        ("LINEAR X10 F60\nX(EXP(700)*EXP(700))", ["PMC107"]),
        ("LINEAR X10 F60\nX(EXP(700)%EXP(0-700))", ["PMC107"]),
        ("LINEAR X10 F60\nX(10", ["PMC101"]),
        ("LINEAR X10 F60\nFOO1 BAR(3) X20", ["PMC101"]),
        ('LINEAR X10 F60\nCMD"#3j+"\nENABLE PLC 3\nDISPLAY 0,"pos %f",P1\nSENDP"ok"', []),
        ("LINEAR X10 F60\nCIRCLE1 X64 K6 R(999999999)", ["PMC108"]),
        ("LINEAR X10 F60\nX10001", ["PMC108"]),
        ("LINEAR CIRCLE1 X10 I5 F60", ["PMC104"]),
        ("LINEAR X10 F60\nZ-1", ["PMC106"]),
        ("LINEAR X0.01 F60", ["PMC204"]),
        ("TA10\nTS0\nLINEAR X0.01 F60", []),
        ("LINEAR X10 F300\nY10", ["PMC205"]),
        ("LINEAR X10 F300\nDWELL0\nY10", []),
        ("LINEAR X10", ["PMC208"]),
        ("LINEAR X10 F-60\nDWELL0\nX20 F60", ["PMC208", "PMC209"]),
        ("TA0\nTS0\nLINEAR X10 F60", ["PMC209"]),
        ("TS0\nLINEAR X10 F60", ["PMC209"]),  # TA is 0 where none is written
        ("TA0\nTS0\nTA20\nLINEAR X10 F60", []),
        (f"LINEAR X10 F60\nG{'9' * 310}", ["PMC101"]),
        (f"LINEAR X10 F60\nX{'9' * 310}\nX20", ["PMC101"]),
    ],
)
def test_what_pmac_hides_is_found(body: str, found: list[str]) -> None:
    assert sorted(codes(read(body))) == sorted(found)


def test_settings_that_are_missing_are_found() -> None:
    assert codes(read("LINEAR X10 F60", "I5113=10\n")) == ["PMC206"]
    assert codes(read("CIRCLE2 X20 I10 F60", "I5190=60000\n")) == ["PMC207"]
    (off,) = read("CIRCLE2 X20 I10 F60", "I5190=60000\nI5113=0\n").findings
    assert off.severity is Severity.ERROR
    assert codes(parse_program("I5190=60000\nOPEN PROG 1\nLINEAR X10 F60\n", "a.pmc")) == ["PMC103", "PMC103"]


def test_a_setting_in_the_program_counts_in_front_of_its_first_word_alone() -> None:
    assert codes(read("I5190=60000\nI5113=10\nCIRCLE2 X20 I10 F60", "\n")) == []
    assert codes(read("F60\nCIRCLE2 X20 I10\nI5190=60000\nI5113=10", "\n")) == ["PMC206", "PMC207"]
    assert codes(read("LINEAR X10 F60", "I5190=0\nI5113=10\n")) == ["PMC206"]


@pytest.mark.parametrize("calls", [3, 60])
def test_a_routine_that_calls_itself_ends_and_is_told(calls: int) -> None:
    text = f"OPEN PROG 1000\nCLEAR\n{'G00 ' * calls}\nRET\nCLOSE\n{HEAD}OPEN PROG 1\nCLEAR\nG00 X1\nX2 F60\nCLOSE\n"
    found = [finding for finding in parse_program(text, "a.pmc").findings if finding.code == "PMC102"]
    assert {finding.values["what"] for finding in found} == {"call-recursive"}
    assert len(found) == 1


@pytest.mark.deeper
def test_routines_that_call_one_another_very_often_end_and_are_told() -> None:
    chain = "".join(f"N{number}000 {f'G{number + 1:02} ' * 10}\nRET\n" for number in range(10, 19))
    text = f"OPEN PROG 1000\nCLEAR\n{chain}N19000 LINEAR\nRET\nCLOSE\n{HEAD}OPEN PROG 1\nCLEAR\nX1 F60\nG10 X2\nCLOSE\n"
    begin = time.process_time()
    found = {finding.values["why"] for finding in parse_program(text, "a.pmc").findings if finding.code == "PMC107"}
    assert found == {"pmac-too-long"}
    assert time.process_time() - begin < 20.0


@pytest.mark.parametrize(("feed", "off"), [(60.0, 17.678), (300.0, 88.388)])
def test_a_right_angle_is_passed_as_the_sheet_says(feed: float, off: float) -> None:
    (finding,) = read(f"LINEAR X10 F{feed:g}\nY10").findings
    assert finding.values["off"] == pytest.approx(off, abs=0.001)


def test_a_short_block_runs_as_the_sheet_says() -> None:
    (finding,) = read("LINEAR X0.1 F300").findings
    assert finding.values["time"] == pytest.approx(20.0)
    assert finding.values["runs"] == pytest.approx(60.0)


def test_a_place_named_behind_a_stop_is_a_thread_point() -> None:
    program = read("LINEAR X10 F60\nX0\nSTOP\nPSET X50 Y0\nLINEAR X60\nX50")
    assert program.toolpath.kind.tolist() == [0, 0, 2, 0, 0]
    assert (program.reading.threadings, program.toolpath.stops[0].after) == (1, 2)


@pytest.mark.parametrize(
    "text", ["OPEN PROG 1\nCLEAR\nCLOSE\n", "OPEN PROG 1", "\nOPEN PROG 1000\nX1\nCLOSE", "LINEAR X1"]
)
def test_a_text_that_moves_nothing_is_refused(text: str) -> None:
    with pytest.raises(ProgramError):
        parse_program(text, "part.pmc")


def plain(rng: random.Random, rows: int) -> tuple[str, list[tuple[float, float]], list[float]]:
    """A random program, ends in mm and lengths in mm of its moves, all by plain sums."""
    text, ends, lengths = ["ABS"], list[tuple[float, float]](), list[float]()
    x = y = 0.0
    absolute = True
    for _ in range(rows):
        if rng.random() < 0.2:
            absolute = not absolute
            text.append("ABS" if absolute else "INC")
        ox, oy = (0.0, 0.0) if absolute else (x, y)
        if rng.random() < 0.5:
            x1, y1 = round(rng.uniform(-50, 50), 3), round(rng.uniform(-50, 50), 3)
            text.append(f"{rng.choice(('LINEAR', 'RAPID'))} X{x1 - ox:.6f} Y{y1 - oy:.6f}")
            lengths.append(math.hypot(x1 - x, y1 - y))
        else:
            radius, start = rng.uniform(0.5, 20.0), rng.uniform(-3.1, 3.1)
            sweep = rng.choice((-1, 1)) * rng.uniform(0.1, 6.1)
            cx, cy = x - radius * math.cos(start), y - radius * math.sin(start)
            x1, y1 = cx + radius * math.cos(start + sweep), cy + radius * math.sin(start + sweep)
            word = "CIRCLE2" if sweep > 0 else "CIRCLE1"
            told = f"I{cx - x:.9f} J{cy - y:.9f}"
            if rng.random() < 0.3:
                told = f"R{math.copysign(radius, math.pi - abs(sweep)):.9f}"
            text.append(f"{word} X{x1 - ox:.9f} Y{y1 - oy:.9f} {told}")
            lengths.append(radius * abs(sweep))
        x, y = x1, y1
        ends.append((x, y))
    return "\n".join(text), ends, lengths


@pytest.mark.parametrize("seed", range(20))
def test_random_programs_end_where_plain_sums_do(seed: int) -> None:
    text, ends, lengths = plain(random.Random(seed), 60)
    path = read(text).toolpath
    assert np.abs(path.end_um - 1000.0 * np.array(ends)).max() < 0.01
    assert np.abs(path.length_um - 1000.0 * np.array(lengths)).max() < 0.01 * 6.2 * 5.0


def test_what_stands_outside_of_programs_is_for_the_card_and_a_program_of_sums_alone_is_told_as_such() -> None:
    around = 'P1=10\nM1->X:$78400,8\nOPEN PLC 3 CLEAR\nIF(M1=1)\nCMD"#1j+"\nENDIF\nCLOSE\n'
    assert (
        codes(parse_program(f"{around}{HEAD}OPEN PROG 1\nCLEAR\nLINEAR X10 F60\nCLOSE\nENABLE PLC 3\n", "a.pmc")) == []
    )
    with pytest.raises(ProgramError) as refused:
        parse_program("OPEN PROG 1\nCLEAR\nLINEAR\nX(P1*2)\nCLOSE\n", "a.pmc")
    assert (refused.value.finding.code, refused.value.finding.values["text"]) == ("PMC107", "X(P1*2)")
    assert (refused.value.finding.values["why"], refused.value.finding.values["what"]) == ("pmac-no-value", "P1")
