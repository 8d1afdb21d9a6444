"""Programs written: word for word where a CAM wrote both, and read back as meant in every form and dialect."""

import numpy as np
import pytest
from twins import BLOCKS_3B, BLOCKS_ISO, PAIRS, START_3B, TWIN_3B, TWIN_ISO, motion

from parser.controller_words import Compensation, CompensationRules
from parser.dialect.reader import Choices
from parser.findings.errors import SettingsError
from parser.geometry.curves import CurveKind, curves_between
from parser.program import dialects, parse_program
from parser.toolpath import Stop, Toolpath
from parser.write.draft import Draft, draft_of, without_rapids
from parser.write.iso import IsoChoices, iso_choices, written_iso
from parser.write.threeb import Form, ThreeBChoices, written_3b

FORMS: tuple[Form, ...] = ("compact", "aligned", "detailed")


def draft(text: str, **choices: str) -> Draft:
    return draft_of(parse_program(text, choices=Choices(**choices)).toolpath)


def in_3b(text: str, form: Form = "compact") -> str:
    return written_3b(draft(text), ThreeBChoices(form)).text


def in_iso(text: str, dialect: str = "fast-wire", **choices: object) -> str:
    return written_iso(draft(text), iso_choices(dialect)._replace(**choices)).text


def read(text: str, choices: IsoChoices) -> Toolpath:
    reading = Choices(dialect=choices.profile.name, unit=choices.reading_unit)
    return parse_program(text, choices=reading).toolpath


@pytest.mark.parametrize("form", FORMS)
def test_the_3b_of_the_twin_is_written_of_its_iso_word_for_word(form: Form) -> None:
    text = in_3b(TWIN_ISO, form)
    assert motion(text) == motion(BLOCKS_3B)
    assert START_3B in text
    assert text.rstrip().endswith("DD")


def test_the_iso_of_the_twin_is_written_of_its_3b_word_for_word() -> None:
    text = in_iso(TWIN_3B)
    assert motion(text) == motion(BLOCKS_ISO)
    assert "G92 X115000 Y-10000" in text
    assert text.rstrip().endswith("M02")


@pytest.mark.parametrize(("iso", "three_b"), PAIRS)
def test_an_arc_of_the_twin_is_the_same_by_itself(iso: str, three_b: str) -> None:
    assert motion(in_3b(f"G91 G92 X0 Y0\n{iso}\nM02\n")) == [three_b]
    assert motion(in_iso(f"{three_b}\nDD\n")) == [iso.replace(" ", "")]


@pytest.mark.parametrize("form", FORMS)
def test_all_forms_hold_the_same_words(form: Form) -> None:
    toolpath = parse_program(TWIN_3B).toolpath
    back = parse_program(in_3b(TWIN_3B, form)).toolpath
    assert back.words is not None
    assert toolpath.words is not None
    for name in ("x_um", "y_um", "count_um", "count_axis", "quadrant", "turn"):
        assert getattr(back.words, name).tolist() == getattr(toolpath.words, name).tolist()


def test_the_detailed_form_prints_the_end_of_each_block() -> None:
    back = parse_program(in_3b(TWIN_ISO, "detailed"))
    off = back.toolpath.printed_end_um - back.toolpath.end_um
    assert np.abs(off).max() <= 0.5
    assert not [finding for finding in back.findings if finding.code != "3B110"]


@pytest.mark.parametrize("dialect", dialects())
def test_every_dialect_reads_what_is_written_for_it(dialect: str) -> None:
    toolpath = parse_program(TWIN_ISO).toolpath
    choices = iso_choices(dialect)
    back = read(written_iso(draft_of(toolpath), choices).text, choices)
    np.testing.assert_allclose(back.end_um, toolpath.end_um, atol=1e-6)
    np.testing.assert_allclose(back.center_um, toolpath.center_um, atol=1e-6)
    assert [stop[:2] for stop in back.stops] == [("end", 12)]


@pytest.mark.parametrize("distance", ["absolute", "incremental"])
@pytest.mark.parametrize("centers", ["absolute", "from-start"])
@pytest.mark.parametrize("unit", ["um", "mm", "inch"])
@pytest.mark.parametrize("tape", [False, True])
def test_every_way_to_write_numbers_is_read_again(distance: str, centers: str, unit: str, *, tape: bool) -> None:
    toolpath = parse_program(TWIN_ISO).toolpath
    choices = iso_choices("common", unit)._replace(distance=distance, centers=centers, tape=tape, number_step=5)
    text = written_iso(draft_of(toolpath), choices).text
    back = read(text, choices)
    assert np.abs(back.end_um - toolpath.end_um).max() <= choices.step_um / 2.0 + 1e-9
    assert back.source.label[0] == "N10"
    assert text.startswith("%\n") is tape


def test_whole_um_are_nothing_for_a_dialect_that_reads_whole_mm() -> None:
    with pytest.raises(SettingsError, match="classroom"):
        iso_choices("classroom", "um")


def test_numbers_have_the_digits_that_are_asked_for() -> None:
    choices = iso_choices("sodick", "mm", 4)
    assert choices.number(-12345) == "-1.2345"
    assert iso_choices("sodick").number(5) == "0.005"
    assert iso_choices("fast-wire").number(-5) == "-5"


JUMPING = "B1000B0B1000GXL1\nB0B1000B1000GYL2\nB1000B1000B1000GYL3\n"
"""A figure that is closed, (0, 0), (1, 0), (1, 1)."""


def test_a_start_node_becomes_a_place_behind_a_stop_and_comes_back() -> None:
    text = f"{JUMPING}D\nStart Point = 5.00000 , 2.00000 ; X , Y\n{JUMPING}DD\n"
    iso = in_iso(text)
    assert "M00\nG92 X5000 Y2000\n" in iso
    assert in_3b(iso).splitlines()[1:] == text.splitlines()


def test_a_line_in_the_air_becomes_a_rapid_and_comes_back() -> None:
    text = f"{JUMPING}D\nB5000B0B5000GXL1\nD\n{JUMPING}DD\n"
    iso = in_iso(text)
    assert "M00\nG00 X5000 Y0\nM00\n" in iso
    assert in_3b(iso).splitlines()[1:] == text.splitlines()


def test_a_rapid_back_through_the_cut_is_a_block_of_3b_like_others() -> None:
    hole = "G01 X5000 Y0\nG03 X5000 Y0 I-5000 J0\n"
    away = f"M00\nG92 X20000 Y0\n{hole.replace('5000 Y0', '25000 Y0')}"
    plan = draft(f"G90 G92 X0 Y0\n{hole}G00 X0 Y0\n{away}G00 X20000 Y0\nM02\n", dialect="common")
    text = written_3b(without_rapids(plan), ThreeBChoices()).text
    assert text.splitlines()[1:] == [
        *("B5000B0B5000GXL1", "B5000B0B20000GYNR1", "B5000B0B5000GXL3", "D"),
        "Start Point = 20.00000 , 0.00000 ; X , Y",
        *("B5000B0B5000GXL1", "B5000B0B20000GYNR1", "B5000B0B5000GXL3", "DD"),
    ]


def test_moves_before_the_first_cut_only_say_where_it_begins() -> None:
    plan = draft("G90 G92 X0 Y0\nG00 X3000 Y0\nM00\nG01 X9000 Y0\nG01 X3000\nM02\n", dialect="common")
    text = written_3b(without_rapids(plan), ThreeBChoices()).text
    assert text.splitlines()[1:] == [
        *("Start Point = 3.00000 , 0.00000 ; X , Y", "B6000B0B6000GXL1", "B6000B0B6000GXL3", "DD")
    ]


def test_more_than_a_turn_is_written_as_whole_turns_and_a_rest() -> None:
    text = "B1000B0B9000GYNR1\nDD\n"  # two turns are 8000
    assert motion(in_iso(text)) == ["G03X0Y0I-1000J0", "G03X0Y0I-1000J0", "G03X-1000Y1000I-1000J0"]


def test_a_full_circle_that_whole_um_close_beside_its_start_is_closed() -> None:
    # sqrt(700² + 701²) = 990.6564; 4R = 3962.63, so that J = 3963 runs 0.4 µm past the start
    assert motion(in_iso("B700B701B3963GYNR1\nDD\n")) == ["G03X0Y0I-700J-701"]


def test_a_full_circle_of_iso_is_one_of_3b() -> None:
    assert motion(in_3b("G91 G92 X0 Y0\nG03 X0 Y0 I-1000 J0\nM02\n")) == ["B1000B0B4000GYNR1"]


def test_an_arc_of_a_few_um_is_written_straight() -> None:
    iso = in_iso("B50000B0B2GYNR1\nB1000B0B1000GXL1\nDD\n")
    assert motion(iso) == ["G01X0Y2", "G01X1000Y0"]


def test_what_has_no_length_in_whole_um_is_left_out() -> None:
    made = written_3b(draft("G90 G92 X0 Y0\nG01 X0.0002\nG01 X1.\nM02\n", dialect="common"), ThreeBChoices())
    assert motion(made.text) == ["B1000B0B1000GXL1"]
    assert made.row.tolist() == [1]


def test_rounding_does_not_add_up_over_ten_thousand_blocks() -> None:
    way = np.tile([[10.4, 0.3], [3.3, 10.45]], (5000, 1))
    end = np.cumsum(way, axis=0)
    start = np.concatenate([[[0.0, 0.0]], end[:-1]])
    nothing = np.full_like(end, np.nan)
    lines = curves_between(start, end, nothing, np.zeros(len(end)))
    plan = Draft(lines, (), np.zeros(len(end), dtype=np.bool_), nothing)
    back = parse_program(written_3b(plan, ThreeBChoices()).text).toolpath
    assert np.abs(back.end_um - end).max() <= 1.0
    choices = iso_choices("fast-wire")
    assert np.abs(read(written_iso(plan, choices).text, choices).end_um - end).max() <= 1.0


def compensated(registers: tuple[str, ...], by_um: tuple[float, ...]) -> Draft:
    """Lines along X, from the second one on compensated to the left, the last one the cancel."""
    n = len(registers)
    start = np.column_stack([1000.0 * np.arange(n), np.zeros(n)])
    nothing = np.full((n, 2), np.nan)
    lines = curves_between(start, start + np.array([1000.0, 0.0]), nothing, np.zeros(n))
    side = np.array([0, *[1] * (n - 2), 0])
    told = Compensation(side, np.array(by_um), registers, CompensationRules())
    return Draft(lines, (Stop("end", n, 0),), np.zeros(n, dtype=np.bool_), nothing, compensation=told)


TWO_VALUES = compensated(("", "D1", "D1", "D1", ""), (0.0, 150.0, 150.0, 100.0, 0.0))


@pytest.mark.parametrize("dialect", dialects())
def test_sides_and_values_are_read_as_they_were_written(dialect: str) -> None:
    choices = iso_choices(dialect)
    text = written_iso(TWO_VALUES, choices).text
    values = (("D1", 150.0), ("D2", 100.0), ("H1", 150.0), ("H2", 100.0))
    told = Choices(dialect=dialect, unit=choices.reading_unit, registers=values)
    back = parse_program(text, choices=told).toolpath.compensation
    assert back is not None
    assert back.side.tolist() == [0, 1, 1, 1, 0]
    np.testing.assert_allclose(back.by_um, [0.0, 150.0, 150.0, 100.0, 0.0], atol=0.05)


def test_a_register_that_the_program_sets_is_set_again() -> None:
    text = written_iso(TWO_VALUES, iso_choices("skd2")).text
    assert "H001=150\nG41 H001\n" in text
    assert "H001=100\nG41 H001\n" in text


def test_a_value_of_the_table_has_a_register_of_its_own_and_a_remark() -> None:
    text = written_iso(TWO_VALUES, iso_choices("robofil")).text
    assert "(offset of register 1: 0.1500 mm)\n(offset of register 2: 0.1000 mm)\n" in text
    assert "G38\n" in text
    assert text.index("G41 D1") < text.index("G41 D2")


def test_register_0_is_not_used_where_it_is_always_0() -> None:
    text = written_iso(compensated(("", "D0", ""), (0.0, 100.0, 0.0)), iso_choices("fanuc")).text
    assert "G41 D1\n" in text


def test_a_side_goes_into_the_block_where_the_dialect_has_it_there() -> None:
    assert "G41 G01 X2.000 Y0.000 H001\n" in written_iso(TWO_VALUES, iso_choices("sodick")).text


def test_jumps_pause_in_3b_and_ways_are_known_in_4b() -> None:
    plan = draft("G90 G92 X0 Y0\nG01 X1000 Y0\nG00 X5000 Y0\nG01 X6000 Y0\nM02\n")
    assert plan.curves.kind.tolist() == [CurveKind.LINE, CurveKind.JUMP, CurveKind.LINE]
    assert written_3b(plan, ThreeBChoices()).text.splitlines()[1:] == [
        *("B1000B0B1000GXL1", "D", "B4000B0B4000GXL1", "D", "B1000B0B1000GXL1", "DD")
    ]
