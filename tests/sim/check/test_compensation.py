"""The check of a program's own compensation: what is told of its words, of the path, and what is not."""

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pytest
from compensated_iso import DIE, Place, around, die, head, lines, program
from compensating import LINUXCNC, TEXTBOOK

from controller.offset.reach import reach
from controller.offset.shifted import Side
from parser.controller_words import CompensationRules
from parser.dialect.reader import Choices
from parser.findings.catalogue import LANGUAGES, texts
from parser.findings.codes import Check, Severity
from parser.findings.findings import Finding
from parser.program import Program, parse_program
from sim.check.compensation.rounds import contour_of
from sim.check.offset import Offsetting
from sim.check.path_checks import Checked, Demands, run_checks

STUB_OF_A_COMPENSATED_LEAD = 100.0 * (math.sqrt(5.0) / 2.0 - 1.0)  # midway between two places an offset apart


def under(program: Program, rules: CompensationRules) -> Program:
    told = program.toolpath.compensation
    assert told is not None
    return replace(program, toolpath=replace(program.toolpath, compensation=replace(told, rules=rules)))


def check(text: str, rules: CompensationRules = TEXTBOOK, **registers: float) -> Checked:
    read = parse_program(text, choices=Choices(registers=tuple(registers.items())))
    return run_checks(under(read, rules), Demands())


def found(checked: Checked) -> list[Finding]:
    return [finding for finding in checked.findings if finding.code.startswith("ISO5")]


def codes(checked: Checked) -> list[str]:
    """Of all findings but the notes on what was assumed."""
    return [finding.code for finding in checked.findings if finding.code != "ISO112"]


def made(checked: Checked) -> Offsetting:
    assert checked.compensation is not None
    return checked.compensation


def state(checked: Checked, name: Check) -> tuple[str, str]:
    (one,) = (state for state in checked.coverage.checks if state.name == name)
    return one.state, one.reason


def test_a_program_without_compensation_is_not_asked_about_it() -> None:
    checked = run_checks(parse_program("G92 X0 Y0\nG90\nG01 X5000\nY5000\nX0\nY0\nM02\n"), Demands())
    assert checked.compensation is None
    assert Check.COMPENSATION not in {one.name for one in checked.coverage.checks}


def test_a_sound_die_and_a_sound_punch_are_silent() -> None:
    corners = [(5000, 5000), (15000, 5000), (15000, -5000), (5000, -5000)]
    punch = program(head("H1=100"), around([(5000, 0), *corners, (5000, 0)]))
    for text in (die(), punch):
        checked = check(text)
        assert codes(checked) == []
        assert state(checked, Check.COMPENSATION) == ("complete", "")
        assert made(checked).loops == (1,)


def test_the_other_side_crosses_the_contour_and_is_told() -> None:
    assert codes(check(die("G42"))) == ["ISO506", "ISO512"]


def test_a_negative_register_turns_the_side() -> None:
    assert codes(check(die("G42", "H1=-100"))) == []
    assert "ISO512" in codes(check(die("G41", "H1=-100")))


@pytest.mark.parametrize("radius", [5000.0, 800.0])
def test_a_round_hole_closes_with_next_normal_and_keeps_a_ridge_with_own_normal(radius: float) -> None:
    """The set-up ends an offset aside of the lead along its own normal: between there and the end an arc is not cut."""
    text = program(head("H1=100"), [f"G41 G01 X{radius:.0f} H1", f"G03 I-{radius:.0f} J0", "G40 G01 X0"])
    assert codes(check(text)) == []
    (stub,) = found(check(text, LINUXCNC))
    inner = radius - 100.0
    half = 0.5 * math.asin(100.0 / inner)
    left = math.hypot(radius * math.cos(half) - inner, radius * math.sin(half)) - 100.0
    assert stub.code == "ISO514"
    assert stub.values["left"] == pytest.approx(left, abs=0.3)


def test_a_lead_out_under_compensation_leaves_a_ridge_unless_the_contour_overlaps() -> None:
    out = lines([(1000, 0)])
    (stub,) = found(check(program(head("H1=100"), around(DIE)[:-1], out, ["G40 G01 X0"])))
    assert (stub.code, stub.line) == ("ISO514", 5)
    assert stub.values["left"] == pytest.approx(STUB_OF_A_COMPENSATED_LEAD, abs=0.02)
    overlap = lines([(5000, 100), (1000, 100)])
    assert codes(check(program(head("H1=100"), around(DIE)[:-1], overlap, ["G40 G01 X0 Y0"]))) == []


def test_a_neck_is_gouged_and_the_contour_falls_apart() -> None:
    """The dumbbell: a neck of 0.15 mm under an offset of 0.1 mm loses 50 µm on each side."""
    room = [(4000, 0), (4000, 1900), (8000, 1900), (8000, 0), (12000, 0), (12000, 4000), (8000, 4000), (8000, 2050)]
    dumbbell = [(2000, 0), *room, (4000, 2050), (4000, 4000), (0, 4000), (0, 0), (2000, 0)]
    text = program(["H1=100", "G92 X2000 Y2000", "G90"], around(dumbbell, out=(2000, 2000)))
    of = {finding.code: finding for finding in found(check(text))}
    assert set(of) == {"ISO506", "ISO507"}
    assert of["ISO507"].values["loops"] == 2
    assert of["ISO506"].values["depth"] == pytest.approx(50.0, abs=1e-6)
    assert codes(check(text.replace("H1=100", "H1=70"))) == []


def with_corner(corner: Sequence[Place], by_um: int = 100) -> str:
    """The square hole with other places between the first and the third."""
    return program(head(f"H1={by_um}"), around((DIE[0], *corner, *DIE[2:])))


@pytest.mark.parametrize(
    "corner",
    [[(5000, 2000), (4950, 2000), (4950, 5000)], [(5000, 4960), (4960, 5000)]],
    ids=["step", "chamfer"],
)
def test_what_the_wire_does_not_come_to_is_told(corner: list[Place]) -> None:
    assert codes(check(with_corner(corner))) == ["ISO505"]
    assert codes(check(with_corner(corner, by_um=20))) == []


def test_a_thin_wall_is_no_groove() -> None:
    assert codes(check(with_corner([(5000, 2000), (3000, 2000), (3000, 2150), (5000, 2150), (5000, 5000)]))) == []


def test_a_groove_narrower_than_the_kerf_has_no_place() -> None:
    groove = [(5000, 2000), (6000, 2000), (6000, 2150), (5000, 2150), (5000, 5000)]
    assert set(codes(check(with_corner(groove)))) == {"ISO505", "ISO506"}
    assert codes(check(with_corner(groove, by_um=70))) == []


@pytest.mark.parametrize("radius", [50, 100, 101])
def test_an_inside_arc_must_be_larger_than_the_offset(radius: int) -> None:
    arc = [f"G01 X5000 Y{5000 - radius}", f"G03 X{5000 - radius} Y5000 I-{radius} J0"]
    text = program(head("H1=100"), around(DIE[:1])[:-1], arc, lines(DIE[2:]), ["G40 X0"])
    assert codes(check(text)) == (["ISO504"] if radius <= 100 else [])  # at 100 µm some controllers stop
    stops = check(text, TEXTBOOK._replace(too_small="alarm"))
    assert codes(stops) == (["ISO504"] if radius <= 100 else [])


def test_where_the_controller_stops_a_wide_pass_is_told_too() -> None:
    """A rough cut runs past a fillet that only the trim fits into: no fault, but for controllers that stop."""
    fillet = ["G01 X5000 Y4850", "G03 X4850 Y5000 I-150 J0"]
    turn = [*fillet, *lines(DIE[2:])]
    passes = [step for register in ("H1", "H2") for step in (f"G41 G01 X5000 Y0 {register}", *turn, "G40 G01 X0 Y0")]
    text = program(head("H1=200", "H2=100"), passes)
    assert codes(check(text)) == []
    stopped = found(check(text, TEXTBOOK._replace(too_small="alarm")))
    assert [(finding.code, finding.line) for finding in stopped] == [("ISO504", 7)]
    assert stopped[0].values["act"] == "compensation-stops"


def test_the_register_that_a_sum_lacks_is_asked_for() -> None:
    text = program(head("H1 = 60 + H175"), around(DIE))
    (asked,) = [one for one in check(text).findings if one.code == "ISO500"]
    said = {language: texts(asked, language) for language in LANGUAGES}
    assert "and nobody says what H175 holds" in said["en"].found
    assert all("H1" in one.found and "--offset H175=0.1mm" in one.hint for one in said.values())
    assert codes(check(text, H175=40.0)) == []


def test_an_unknown_register_leaves_the_check_incomplete_and_other_contours_judged() -> None:
    beside = [(x + 20000, y) for x, y in DIE]
    hole = ["M00", "G92 X20000 Y0"]
    text = program(head("H1=100"), around(DIE, register="H2"), hole, around(beside, "G42", out=(20000, 0)))
    checked = check(text)
    assert [(f.code, f.line) for f in found(checked)] == [("ISO500", 4), ("ISO506", 13), ("ISO512", 13)]
    assert state(checked, Check.COMPENSATION) == ("incomplete", "reason-no-register")
    assert codes(check(text.replace("G42", "G41"), H2=120.0)) == []


def test_what_changes_while_on_is_told_once_with_the_number_of_the_rest() -> None:
    blocks = ["G41 G01 X1000 H1", "G01 X2000 H2", "G01 X3000 H1", "G42 X4000", "G41 X5000", "G40 X9000"]
    notes = {f.code: f for f in found(check(program(head("H1=10", "H2=100"), blocks)))}
    assert (notes["ISO508"].line, notes["ISO508"].values["more"]) == (8, 1)
    assert (notes["ISO509"].line, notes["ISO509"].values["more"]) == (6, 1)
    assert notes["ISO509"].severity is Severity.NOTE
    stops = {f.code: f for f in found(check(program(head("H1=10", "H2=100"), blocks), LINUXCNC))}
    assert stops["ISO508"].severity is stops["ISO509"].severity is Severity.ERROR


def test_an_offset_that_changes_on_the_contour_is_a_warning_and_no_gouge() -> None:
    blocks = ["G41 G01 X5000 H1", "H2", *lines(DIE[1:]), "G40 G01 X0"]
    (wedge,) = found(check(program(head("H1=10", "H2=100"), blocks)))
    assert (wedge.code, wedge.line, wedge.severity) == ("ISO509", 7, Severity.WARNING)


@pytest.mark.parametrize(
    ("last", "expected"),
    [(["G40 X0"], []), ([], ["ISO510"]), (["G40 G03 X4000 Y1000 I-1000 J0"], ["ISO502"])],
    ids=["line", "none", "arc"],
)
def test_how_compensation_ends(last: list[str], expected: list[str]) -> None:
    text = program(head("H1=100"), around(DIE)[:-1], last)
    assert [finding.code for finding in found(check(text))] == expected


def test_a_program_that_ends_compensated_stays_at_the_offset_and_gouges_nothing() -> None:
    path = made(check(program(head("H1=100"), around(DIE)[:-1]))).path
    assert path.curves.end_um[-1].tolist() == pytest.approx([4900.0, 0.0])


def test_a_set_up_must_be_longer_than_the_offset() -> None:
    for length, expected in ((99, ["ISO503"]), (100, ["ISO503"]), (101, [])):
        text = program(head("H1=100"), [f"G41 G01 X{length} H1", *lines([*DIE, (5000, 200)]), "G40 G01 X0 Y0"])
        assert codes(check(text)) == expected
        severities = {Severity.WARNING: TEXTBOOK, Severity.ERROR: TEXTBOOK._replace(startup="own-normal")}
        for severity, rules in severities.items():
            assert all(f.severity is severity for f in found(check(text, rules)) if f.code == "ISO503")


def test_a_register_of_nothing_is_a_note() -> None:
    (nothing,) = found(check(die(by="H1=0")))
    assert (nothing.code, nothing.severity) == ("ISO513", Severity.NOTE)


def trims(offsets: Sequence[int]) -> str:
    """The square hole in passes there and back: each on the other side, as seen along its way."""
    turns = [DIE if at % 2 == 0 else DIE[::-1] for at in range(len(offsets))]
    ways = [around(turn, ("G41", "G42")[at % 2], f"H{at + 1}") for at, turn in enumerate(turns)]
    return program(head(*[f"H{at + 1}={by}" for at, by in enumerate(offsets)]), *ways)


@pytest.mark.parametrize("offsets", [(200, 130, 110, 105), (134, 133, 132), (100, 100)])
def test_passes_there_and_back_along_the_same_places_are_passes_of_one_edge(offsets: tuple[int, ...]) -> None:
    checked = check(trims(offsets))
    assert codes(checked) == []
    passes = made(checked).edge_passes.passes
    assert [one.number for one in passes] == list(range(1, len(offsets) + 1))
    assert {one.edge for one in passes} == {0}
    assert [one.is_back for one in passes] == [bool(at % 2) for at in range(len(offsets))]
    assert [one.shift_um for one in passes] == [by - offsets[-1] for by in offsets]
    assert all(one.is_closed for one in passes)
    assert [one.by_um for one in made(checked).passes] == list(offsets)


def test_a_pass_that_runs_back_on_the_same_side_word_cuts_into_the_part() -> None:
    assert set(codes(check(trims((200, 110)).replace("G42", "G41")))) >= {"ISO506"}


def test_a_tab_is_a_pass_of_the_edge_that_left_it() -> None:
    main = (*DIE[:-1], (5000, -300))
    tab = ((5000, -300), (5000, 0))
    text = program(head("H1=100"), around(main), ["M01"], around(tab))
    checked = check(text)
    assert [code for code in codes(checked) if code != "ISO309"] == []
    assert [(one.number, one.is_tab) for one in made(checked).edge_passes.passes] == [(1, False), (2, True)]


def convex(rng: np.random.Generator, number: int) -> list[Place]:
    """Corners of a convex outline about 0, 0, counter-clockwise, no two nearer than 2 mm."""
    angle = np.sort(rng.uniform(0.0, 2.0 * np.pi, number))
    angle = angle[np.diff(angle, prepend=angle[-1] - 2.0 * np.pi) > 0.25]
    return [(round(10000.0 * math.cos(a)), round(10000.0 * math.sin(a))) for a in angle]


@pytest.mark.alike(8)
@pytest.mark.parametrize("seed", range(30))
def test_random_convex_outlines_are_silent_inside_and_outside_either_way_round(seed: int) -> None:
    rng = np.random.default_rng(seed)
    corners = convex(rng, 9)
    middle = (sum(x for x, _ in corners) // len(corners), sum(y for _, y in corners) // len(corners))
    (ax, ay), (bx, by) = corners[-1], corners[0]
    start = (round((ax + bx) / 2), round((ay + by) / 2))
    by_um = int(rng.integers(20, 250))
    ring = [start, *corners, start]
    way = ring[::-1] if seed % 2 else ring
    inside, outside = ("G42", "G41") if seed % 2 else ("G41", "G42")
    far = (2 * start[0] - middle[0], 2 * start[1] - middle[1])
    for side, hole in ((inside, middle), (outside, far)):
        text = program([f"H1={by_um}", f"G92 X{hole[0]} Y{hole[1]}", "G90"], around(way, side, out=hole))
        checked = check(text)
        assert codes(checked) == []
        assert made(checked).loops == (1,)


def star(rng: np.random.Generator) -> list[Place]:
    """Corners of an outline about 0, 0 that has inner and outer corners, counter-clockwise."""
    angle = np.arange(24) * np.pi / 12.0
    radius = rng.uniform(1000.0, 9000.0, 24)
    return [(round(r * math.cos(a)), round(r * math.sin(a))) for r, a in zip(radius, angle, strict=True)]


def test_a_contour_that_is_not_looked_at_by_itself_has_one_loop_and_no_gouge() -> None:
    """Most contours are passed over, since their path comes to every block and too near to none: proved one by one."""
    passed_over = 0
    for seed in range(20):
        rng = np.random.default_rng(seed)
        corners = star(rng)
        start = tuple(round((a + b) / 2) for a, b in zip(corners[-1], corners[0], strict=True))
        ring = [(start[0], start[1]), *corners, (start[0], start[1])]
        by_um = int(rng.integers(20, 900))
        checked = check(program(head(f"H1={by_um}"), around(ring)))
        (one,) = made(checked).passed.rounds
        contour = contour_of(made(checked).passed.curves, one.round.section)
        loops = len(reach(contour, by_um, Side.LEFT).loops)
        assert made(checked).loops == (loops,)
        if not made(checked).gouges and not len(made(checked).path.vanished):
            assert loops == 1
            passed_over += 1
    assert 5 < passed_over < 18
