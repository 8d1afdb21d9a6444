"""What is converted and what is refused; compensation worked in or kept; what is told to be lost."""

from collections.abc import Callable
from functools import partial

import numpy as np
import pytest
from twins import TWIN_3B, TWIN_ISO

from parser.dialect.reader import Choices
from parser.program import Program, load_program, parse_program
from parser.write.iso import iso_choices
from sim.check.path_checks import Demands, run_checks
from sim.make import convert as conversion
from sim.make.convert import Converted, Refused, converted
from sim.make.wanted import Language, Wanted

OPEN = "B9000B0B9000GXL1\nB0B9000B9000GYL2\nB9000B0B9000GXL3\nB0B8000B8000GYL4\nDD\n"
HOLE = "G92 X0 Y0\nG90\nG41 D0\nG01 X5000 Y0\nG03 X5000 Y0 I-5000 J0\nG40\nG01 X0 Y0\nM02\n"
"""A hole of R 5 mm, cut from its centre, with an offset that stands outside."""
CONTOUR = """\
G41 H001
G01 X9000 Y0
G01 X9000 Y9000
G01 X29000 Y9000
G01 X29000 Y-9000
G01 X9000 Y-9000
G01 X9000 Y0
G40
G01 X0 Y0
M99
"""
CALLS = "H001=110\nG92 X0 Y0\nG90\nM98 P0001\nM00\nH001=100\nM98 P0001\nM02\n"
TWO_PASSES = f"E0001=12\n{CALLS}N0001\nT84 F200\n{CONTOUR}"

TO_3B = Wanted("3b")
TO_4B = Wanted("4b", keeps=True)


def to_iso(dialect: str = "fast-wire", *, keeps: bool = True) -> Wanted:
    return Wanted("iso", iso_choices(dialect), keeps=keeps)


def program(text: str, **choices: object) -> Program:
    return parse_program(text, "part", choices=Choices(**choices))


def done(text: str, wanted: Wanted, **choices: object) -> Converted:
    made = converted(program(text, **choices), wanted)
    assert isinstance(made, Converted), made
    return made


def refused(text: str, wanted: Wanted, **choices: object) -> Refused:
    made = converted(program(text, **choices), wanted)
    assert isinstance(made, Refused)
    return made


def lost(made: Converted) -> dict[str, int]:
    return {loss.what: loss.number for loss in made.lost}


@pytest.mark.alike(3)
@pytest.mark.parametrize("wanted", [TO_3B, TO_4B, to_iso("robofil"), to_iso("sodick")])
@pytest.mark.parametrize("text", [TWIN_ISO, TWIN_3B])
def test_a_sound_program_is_written_within_its_bound(text: str, wanted: Wanted) -> None:
    made = done(text, wanted)
    assert made.off_um <= 0.6
    assert made.bound_um == 3.0
    assert made.told_by_itself
    assert load_program(made.data, "again").toolpath.kind.tolist() == program(text).toolpath.kind.tolist()


def test_a_program_with_an_error_is_not_converted() -> None:
    made = refused("B9000B0B9000GXL1\nB9O00B0B9000GXL3\nDD\n", to_iso())
    assert made.why == "source"
    assert [finding.code for finding in made.findings] == ["3B106"]


def test_a_contour_that_stays_open_is_converted_as_it_is() -> None:
    made = done(OPEN, to_iso())
    assert (made.off_um, made.stays_open) == (0.0, True)
    assert "ISO300" in {finding.code for finding in run_checks(made.program, Demands()).findings}


def test_a_program_that_could_not_be_read_whole_is_not_converted() -> None:
    assert refused(TWIN_ISO.replace("G01 X60200 Y0", "G01 X60200 Y?0"), TO_3B).why == "source"


def test_a_program_that_asks_for_more_than_its_path_is_not_converted() -> None:
    made = refused(TWIN_ISO.replace("G01 X0 Y70100", "G26 G51 G01 X0 Y70100"), TO_3B)
    assert (made.why, made.values) == ("not-simulated", (("words", "G26, G51"),))
    assert [finding.code for finding in made.findings] == ["ISO204", "ISO600"]


LEANING = "G92 X0 Y0\nG90\nG52 A1.5 G01 X0 Y5000\nX9000 Y5000\nA2.25 Y9000\nX-9000\nY5000\nX0\nG50 X0 Y0\nM02\n"


def test_a_lean_is_converted_to_no_language_without_one() -> None:
    made = refused(LEANING, TO_3B)
    assert (made.why, [finding.code for finding in made.findings]) == ("leans", ["ISO601"])
    assert refused(LEANING.replace("Y9000", "Y9000 : X8000 Y8000"), to_iso()).why in {"leans", "not-simulated"}


@pytest.mark.parametrize("dialect", ["sodick", "fanuc", "skd2", "robofil", "fast-wire", "mitsubishi"])
def test_angles_are_kept_by_any_iso_and_come_back(dialect: str) -> None:
    made = done(LEANING, to_iso(dialect))
    there = made.program.toolpath.taper
    assert there is not None
    assert there.side.tolist() == [-1] * 6 + [0]
    assert np.degrees(there.angle_rad)[:6].tolist() == pytest.approx([1.5, 1.5, 2.25, 2.25, 2.25, 2.25])
    assert "switches" not in lost(made)
    again = converted(made.program, to_iso("sodick"))
    assert isinstance(again, Converted)
    assert again.program.toolpath.taper is not None
    assert np.abs(again.program.toolpath.taper.angle_rad - there.angle_rad).max() < 1e-9


def test_a_program_without_the_value_of_its_register_is_not_converted() -> None:
    made = refused(HOLE, TO_3B)
    assert made.why == "source"
    assert "ISO500" in {finding.code for finding in made.findings}


def test_compensation_is_worked_into_3b() -> None:
    made = done(HOLE, TO_3B, registers=(("D0", 100.0),))
    assert made.data.decode().splitlines()[1:] == ["B4900B0B4900GXL1", "B4900B0B19600GYNR1", "B4900B0B4900GXL3", "DD"]
    assert lost(made)["offsets-worked-in"] == 1


def test_compensation_is_kept_in_iso_unless_it_is_to_be_worked_in() -> None:
    registers = (("D0", 100.0),)
    kept = done(HOLE, to_iso("skd2"), registers=registers).program.toolpath
    assert kept.compensation is not None
    assert kept.compensation.left_um.tolist() == [100.0, 100.0, 0.0]
    np.testing.assert_allclose(kept.radius_um[1], 5000.0)
    worked_in = done(HOLE, to_iso("skd2", keeps=False), registers=registers).program.toolpath
    assert worked_in.compensation is None
    np.testing.assert_allclose(worked_in.radius_um[1], 4900.0)


ENDS_ELSEWHERE = """\
%
O0027
G91 S1 D1
G92 X0 Y0
G42
G01 X.5
G01 X.5 Y-.25
G01 X.5 Y-.25
G03 I0.25 X.25 Y.25
G02 X1. R.6
G40 G01 X-2.25
M30
%
"""
"""What comes free is cut off by the lead-out, which ends 0.56 mm from where the lead-in came."""


def test_a_lead_out_that_ends_elsewhere_stays_one_and_is_an_open_contour_without_compensation() -> None:
    """A check calls it open only where the compensation that tells leads from contours is worked in: that is said."""
    for keeps, is_open in ((True, False), (False, True)):
        made = done(ENDS_ELSEWHERE, to_iso("fanuc", keeps=keeps), registers=(("D1", 50.0),))
        codes = {finding.code for finding in run_checks(made.program, Demands()).findings}
        assert (made.stays_open, "ISO300" in codes) == (is_open, is_open)


AT_A_CORNER = """\
G92 X-5000 Y-5000
G90
G42 D0
G01 X0 Y0
G01 X20000 Y0
G01 X20000 Y10000
G01 X0 Y10000
G01 X0 Y0
M02
"""
"""A punch that begins and ends at a corner, without a way out: the wire begins below it and ends beside it."""


def test_a_path_that_the_kerf_closes_is_written_and_told() -> None:
    made = done(AT_A_CORNER, TO_3B, registers=(("D0", 100.0),))
    assert made.open_um == pytest.approx(100.0 * np.sqrt(2.0), abs=1e-2)
    assert done(AT_A_CORNER, to_iso(), registers=(("D0", 100.0),)).open_um == 0.0


def test_4b_leaves_one_offset_to_the_controller_and_no_more() -> None:
    made = done(HOLE, TO_4B, registers=(("D0", 100.0),))
    assert "B5000B0B20000B5000GYDNR1" in made.data.decode()
    assert lost(made)["offsets-left"] == 1
    assert refused(TWO_PASSES, TO_4B).why == "several-offsets"


def test_subprograms_are_written_out_and_what_moves_nothing_is_told() -> None:
    made = done(TWO_PASSES, TO_3B)
    assert made.program.toolpath.kind.tolist() == [0] * 14
    assert lost(made) == {"switches": 2, "settings": 1, "calls": 2, "offsets-worked-in": 1}
    assert {loss.what: loss.of for loss in made.lost}["switches"] == "T84, F200"


def test_what_stands_beside_the_blocks_of_3b_is_told() -> None:
    text = "(name)\nB1B0B1000GXL1\nB0B1000B1000GYL2\nB1000B1000B1000GYL3\nDD\n"
    assert lost(done(text, to_iso())) == {"remarks": 1, "reduced": 1}


def test_4b_loses_its_radii_elsewhere() -> None:
    text = "B5000B0B5000B0GXL1\nB5000B0B20000B5000GYDNR1\nB5000B0B5000B0GXL3\nDD\n"
    assert lost(done(text, TO_3B)) == {"radii": 1}
    assert lost(done(text, TO_4B)) == {}


def test_lines_end_as_they_are_wanted() -> None:
    made = done(TWIN_3B, to_iso()._replace(newline="\r\n"))
    assert made.data.count(b"\r\n") == made.data.count(b"\n") == 15


def test_a_text_that_does_not_tell_its_unit_says_so() -> None:
    made = converted(program(TWIN_3B), Wanted("iso", iso_choices("mitsubishi", "inch")))
    assert isinstance(made, Converted)
    assert made.told_by_itself  # by G20
    hole = done(HOLE, to_iso("robofil"), registers=(("D0", 100.0),))
    assert hole.told_by_itself


@pytest.mark.parametrize(
    ("spoil", "why"),
    [
        (lambda text: text.replace("B70200", "B70250", 1), "result"),
        (lambda text: text.replace("\nDD", "\nB10B0B10GXL1\nB10B0B10GXL3\nDD"), "differs"),
        (lambda text: text.replace("B9900B0B9900", "B9904B0B9904"), "off"),
    ],
)
def test_a_writer_that_slips_is_found_out(
    monkeypatch: pytest.MonkeyPatch, spoil: Callable[[str], str], why: str
) -> None:
    honest = conversion.written

    def spoiled(draft: object, wanted: Wanted, *, spoil: Callable[[str], str]) -> object:
        made = honest(draft, wanted)  # type: ignore[arg-type]
        return made._replace(text=spoil(made.text))

    monkeypatch.setattr(conversion, "written", partial(spoiled, spoil=spoil))
    assert refused(TWIN_ISO, TO_3B).why == why


@pytest.mark.parametrize("language", ["3b", "4b"])
def test_a_program_that_moves_nothing_is_refused(language: Language) -> None:
    assert refused("G90 G92 X0 Y0\nM02\n", Wanted(language)).why in {"nothing", "source"}
