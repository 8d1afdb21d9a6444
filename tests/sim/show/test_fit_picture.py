"""The picture of a fit: a mark for each place, the model and what it leaves, in both languages, whatever the number."""

import re

import numpy as np
import pytest

from parser.findings.catalogue import Language
from parser.geometry.curves import Bools, Floats
from sim.measure.fit.circle import CircleFit
from sim.measure.fit.parameters import FittedRows
from sim.measure.fit.piece import PieceFit
from sim.show.draw.sheet import drawing, pixels
from sim.show.draw.style import DARK
from sim.show.pictures.fit import FIT, FitSubject


def rows_of(places: int, is_back: Bools | None = None) -> FittedRows:
    at = np.linspace(0.0, 359.0, places)
    off = np.sin(np.radians(at))
    none = np.zeros(places, dtype=np.bool_)
    is_used = ~none
    is_used[0] = False
    return FittedRows(at, off, off + 0.1, none if is_back is None else is_back, is_used)


def circle(rows: FittedRows, lack: str = "") -> FitSubject:
    return FitSubject(CircleFit((), 0.1, lack, len(rows.at) - 1, 1, (1,), rows), "turn.csv")


def piece(off_um: Floats) -> FitSubject:
    number = len(off_um)
    used = np.ones(number, dtype=np.bool_)
    rows = FittedRows(np.arange(float(number)), off_um, off_um + 0.5, ~used, used)
    names = tuple(f"slot-{at}" for at in range(number))
    return FitSubject(
        PieceFit((), 0.5, "", 10 * number, number, (), (), names, rows, np.full(number, 0.7)), "piece.csv"
    )


def svg_of(subject: FitSubject, language: Language = "en") -> str:
    return subject.draw(FIT, drawing(language=language)).fragment("a fit")


def test_each_place_is_a_mark_in_both_charts_and_one_that_was_left_out_too() -> None:
    back = np.arange(40) % 2 == 1
    svg = svg_of(circle(rows_of(40, back)))
    of_legend = 3  # each way, and those that were left out
    assert svg.count("<circle") == 2 * 40 + of_legend
    assert "measured, clockwise" in svg
    assert "left out" in svg


def test_one_way_alone_needs_no_name() -> None:
    svg = svg_of(circle(rows_of(40)))
    assert ">measured<" in svg
    assert "clockwise<" not in svg.replace("counter-clockwise, °", "")


def test_a_million_places_are_a_band() -> None:
    svg = svg_of(circle(rows_of(1_000_000)))
    assert len(svg) < 300_000  # bytes


def test_what_speaks_against_the_model_stands_in_the_head() -> None:
    assert "lobes" in svg_of(circle(rows_of(40), "harmonics"))


@pytest.mark.parametrize("language", ["en", "zh"])
def test_sizes_have_their_names_and_their_intervals(language: Language) -> None:
    svg = svg_of(piece(np.array([-2.0, 1.0, 3.5])), language)
    assert [re.search(f">slot-{at}<", svg) is not None for at in range(3)] == [True] * 3
    assert svg.count("<circle") == 3 + 1
    assert ("模型" if language == "zh" else "the model") in svg


def test_the_same_fit_gives_the_same_pixels_and_dark_ones_are_dark() -> None:
    subject = piece(np.array([-2.0, 1.0]))
    first, second = (subject.draw(FIT, pixels(900)).image() for _ in range(2))
    assert first.tobytes() == second.tobytes()
    assert max(subject.draw(FIT, pixels(900, DARK)).image().getpixel((2, 2))) < 60
