"""Passes over one edge are found in whatever way they are written, and a contour that is cut once is one pass."""

import random

import numpy as np
import pytest
from pass_styles import STYLES, Style, written
from paths import Pen
from rough_and_trim import RoughAndTrim, rough_and_trim
from sound import sound_program
from tab_elsewhere import TAB_ELSEWHERE

from parser.program import load_program
from parser.shape.passes import Pass, find_passes, row_shifts_um

ROUNDED_UM = 4.0  # places in whole µm, radii that follow them
WAVE_UM = 10.0  # of many small arcs in a row, whose ends drift


def passes_of(text: str) -> tuple[Pass, ...]:
    return find_passes(load_program(text.encode(), "program.3b").toolpath).passes


def true_shifts(program: RoughAndTrim) -> list[float]:
    last = {(one.edge, one.is_tab): one.offset_um for one in program.passes}
    return [one.offset_um - last[one.edge, one.is_tab] for one in program.passes]


@pytest.mark.alike(1)
@pytest.mark.parametrize("part", range(3))
def test_passes_of_random_programs_are_those_that_were_written(part: int) -> None:
    rng = random.Random(f"passes {part}")
    for _ in range(15):
        program = rough_and_trim(rng)
        found = passes_of(program.text)
        told = [(one.edge, one.number, one.first, one.last, one.is_back, one.is_tab) for one in found]
        true = [(one.edge, one.number, one.first, one.last, one.is_back, one.is_tab) for one in program.passes]
        assert told == true, f"{program.name}\n{program.text}"
        assert [one.shift_um for one in found] == pytest.approx(
            true_shifts(program), abs=WAVE_UM if "wave" in program.name else ROUNDED_UM
        )


def test_rows_tell_their_pass_and_leads_none() -> None:
    program = load_program(rough_and_trim(random.Random(3)).text.encode(), "program.3b")
    passes, of_row = find_passes(program.toolpath)
    for number, one in enumerate(passes):
        assert (of_row[one.first : one.last + 1] == number).all()
    assert (of_row >= 0).sum() == sum(one.last - one.first + 1 for one in passes)


def test_contours_that_are_cut_once_are_one_pass_each() -> None:
    rng = random.Random("once")
    for _ in range(60):
        program = sound_program(rng)
        if "trimmed" not in program.name:
            assert {one.number for one in passes_of(program.data.decode())} == {1}, program.name


@pytest.mark.parametrize("style", STYLES, ids=lambda style: style.__name__)
def test_passes_are_found_whatever_lies_between_them(style: Style) -> None:
    rng = random.Random(style.__name__)
    for _ in range(6):
        program = written(rng, style)
        found = passes_of(program.text)
        assert [(one.edge, one.first, one.last, one.is_back, one.is_tab) for one in found] == program.passes, (
            program.text
        )


def slot(wide_um: float) -> Pen:
    """A slot cut from its hole, all round."""
    pen = Pen(0, wide_um / 2).to(0, 0).to(9000, 0).to(9000, wide_um).to(-500, wide_um).to(-500, 0)
    return pen.to(0, 0).to(0, wide_um / 2)


def hole(pen: Pen, x: float, radius: float) -> Pen:
    return pen.to(x + radius, 0).arc(x, 0, 2 * np.pi).to(x, 0)


@pytest.mark.parametrize(
    ("pen", "number"),
    [
        (slot(60.0), 1),  # its sides are no passes there and back
        (slot(140.0), 1),
        (slot(200.0), 1),
        (Pen().to(9000, 0).to(0, 0), 1),  # a slit, in and out on one line
        (Pen().to(9000, 0).to(9000, 300).to(0, 300), 1),  # in and out on two
        (hole(hole(Pen(), 0, 300).jump(700, 0), 700, 300), 2),  # equal holes side by side
        (hole(hole(Pen(), 0, 3000).jump(3200, 0), 0, 3500), 2),  # a thin ring, wider than two passes are apart
    ],
)
def test_what_is_cut_once_has_one_pass_however_near_it_lies_to_itself(pen: Pen, number: int) -> None:
    assert [one.number for one in find_passes(pen.path()).passes] == [1] * number


def test_a_small_pin_with_long_leads_is_trimmed_by_its_circle_alone() -> None:
    pen = Pen(4000, 0)
    for radius in (220.0, 170.0, 170.0):
        pen.to(radius, 0).arc(0, 0, 2 * np.pi).to(4000, 0)
    found = find_passes(pen.path()).passes
    assert [(one.edge, one.number, one.first, one.last) for one in found] == [(0, 1, 1, 1), (0, 2, 4, 4), (0, 3, 7, 7)]
    assert [one.shift_um for one in found] == pytest.approx([50.0, 0.0, 0.0])


@pytest.mark.parametrize("short_um", [0.0, 0.2])
def test_the_part_lies_outside_a_circle_cut_from_within_though_it_stops_short(short_um: float) -> None:
    pen = Pen(-500, 0).to(3000, 0).arc(0, 0, 2 * np.pi - short_um / 3000).to(3040, 0).arc(0, 0, -2 * np.pi)
    rough, trim = find_passes(pen.path()).passes
    assert (rough.part_side, trim.part_side, trim.is_back) == (-1, 1, True)
    assert (rough.shift_um, trim.shift_um) == (pytest.approx(40.0), 0.0)


def test_each_block_of_a_rough_cut_is_held_against_the_last_pass() -> None:
    pen = Pen().to(4860, 0).to(4860, 4860).to(-4930, 4860).to(-4930, -4860).to(4860, -4860).to(4860, 0)
    pen.to(4900, 0).to(4900, 4900).to(-4900, 4900).to(-4900, -4900).to(4900, -4900).to(4900, 0).to(0, 0)
    path = pen.path()
    shift = row_shifts_um(path, find_passes(path))
    assert shift[1:6] == pytest.approx([40.0, 40.0, -30.0, 40.0, 40.0])
    assert np.isnan(shift[[0, *range(6, 13)]]).all()


def test_without_a_lead_in_the_waste_lies_where_the_first_pass_is_cut() -> None:
    """A pin of 1 mm and a hole of 2 mm, both by jumps; the trims of the hole lie within its edge."""
    pen = Pen(1070, 0)
    for pin, hole in ((1070, 1930), (1030, 1970), (1000, 2000)):
        pen.jump(pin, 0).arc(0, 0, 2 * np.pi).jump(9000 + hole, 0).arc(9000, 0, 2 * np.pi)
    found = find_passes(pen.path()).passes
    assert [(one.edge, one.number, one.part_side) for one in found] == [
        (0, 1, 0), (1, 1, 0), (0, 2, 0), (1, 2, 0), (0, 3, 0), (1, 3, 0)
    ]  # fmt: skip
    assert [one.shift_um for one in found] == pytest.approx([70.0, 70.0, 30.0, 30.0, 0.0, 0.0])


def test_offsets_count_from_the_edge_that_the_pass_nearest_to_the_part_leaves() -> None:
    """100 and then 160 µm, by mistake: the trim cuts nothing, and the edge is that of the rough cut."""
    pen = Pen(4000, 0)
    for radius in (220.0, 280.0):
        pen.to(radius, 0).arc(0, 0, 2 * np.pi).to(4000, 0)
    assert [one.offset_um(100.0) for one in find_passes(pen.path()).passes] == pytest.approx([100.0, 160.0])


def test_a_tab_that_a_single_pass_leaves_is_cut_in_another_contour_and_a_trim_may_follow() -> None:
    """That trim is the second pass, though the tab was cut before it: once over, and once on the way back."""
    told = [(one.edge, one.number, one.first, one.last, one.is_back, one.is_tab) for one in passes_of(TAB_ELSEWHERE)]
    assert told == [
        (0, 1, 1, 1, False, False),
        (1, 1, 4, 8, False, False),
        (0, 3, 12, 12, True, True),
        (0, 4, 13, 13, False, True),
        (0, 2, 16, 16, True, False),
    ]
