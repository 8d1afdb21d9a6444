"""Curve marks of 4B, against outlines of which the drawing says what is convex."""

import random

import numpy as np
import pytest
from sound_4b import outline_4b

from parser.program import parse_program
from parser.write.draft import curve_marks, draft_of
from parser.write.threeb import ThreeBChoices, written_3b


@pytest.mark.parametrize("seed", range(40))
def test_marks_are_those_of_the_drawing(seed: int) -> None:
    toolpath = parse_program(outline_4b(random.Random(seed)).text).toolpath
    assert toolpath.words is not None
    assert curve_marks(toolpath).tolist() == toolpath.words.curve.tolist()


def test_each_figure_has_its_own_way_round() -> None:
    ways = ("B1000B0B4000GYNR1\n", "B1000B0B4000GYSR4\n")
    toolpath = parse_program(f"{ways[0]}D\nB9000B0B9000GXL1\nD\n{ways[1]}DD\n").toolpath
    assert curve_marks(toolpath).tolist() == [1, 0, 1]


@pytest.mark.parametrize("seed", range(5))
def test_a_4b_program_is_written_as_it_was(seed: int) -> None:
    text = outline_4b(random.Random(seed)).text
    draft = draft_of(parse_program(text).toolpath)
    made = written_3b(draft, ThreeBChoices(curve=curve_marks(draft.curves)))
    assert made.text.split("\n", 1)[1] == text
    assert np.array_equal(made.row, np.arange(len(draft)))
