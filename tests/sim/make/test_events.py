"""Dwells, optional stops, feeds and conditions of ISO: written where they belong, or told to be lost."""

import random
import re

import pytest
from depth import cases

from parser.program import parse_program
from parser.write.iso import iso_choices
from sim.make.convert import Converted, converted
from sim.make.wanted import Language, Wanted

SQUARE = "G90 G92 X0 Y0\nG01 X10. Y0. F3.\nG04 X2.\nG01 X10. Y20.\nM01\nG01 X0. Y20.\nE12\nG01 X0. Y0.\nM02\n"


def done(text: str, wanted: Wanted, dialect: str = "") -> Converted:
    from parser.dialect.reader import Choices

    made = converted(parse_program(text, choices=Choices(dialect=dialect)), wanted)
    assert isinstance(made, Converted), made
    return made


def to_iso(dialect: str) -> Wanted:
    return Wanted("iso", iso_choices(dialect, "mm"), keeps=True)


def body(made: Converted) -> list[str]:
    """Blocks behind the head, coordinates left out."""
    lines = [re.sub(r"^N\d+ ", "", line) for line in made.data.decode().splitlines()]
    return [re.sub(r" [XY][-\d.]+", "", line) if "G04" not in line else line for line in lines if "M02" not in line][2:]


def test_all_events_stay_where_they_are_in_their_own_family() -> None:
    made = done(SQUARE, to_iso("common"), "common")
    assert body(made) == ["F3.", "G01", "G04 X2.000", "G01", "M01", "G01", "E12", "G01"]
    assert {loss.what for loss in made.lost} == set()


def test_another_family_keeps_dwells_and_optional_stops_and_says_that_the_rest_is_lost() -> None:
    made = done(SQUARE, to_iso("sodick"), "common")
    assert body(made) == ["G01", "G04 X2.000", "G01", "M01", "G01", "G01"]
    assert {(loss.what, loss.of) for loss in made.lost} == {("switches", "F3., E12")}


@pytest.mark.parametrize("language", ["3b", "4b"])
def test_languages_without_words_for_them_say_so(language: Language) -> None:
    lost = {loss.what: loss.of for loss in done(SQUARE, Wanted(language)).lost}
    assert lost == {"switches": "F3., E12", "dwells": "G04 X2.", "stops": "M01"}


def test_no_event_vanishes_without_a_word() -> None:
    """Events anywhere in a contour: what is read back has them, or the conversion names them."""
    words = {"dwell": "G04 X1.5", "optional-stop": "M01", "feed": "F2.", "condition": "E7"}
    for number in cases(20, 3000):
        rng = random.Random(number)
        lines = ["G90 G92 X0 Y0"]
        kinds = []
        corners = [(5.0, 0.0), (5.0, 5.0), (-5.0, 5.0), (-5.0, -5.0), (5.0, -5.0), (5.0, 0.0), (0.0, 0.0)]
        for at, (x, y) in enumerate(corners):
            kind = rng.choice([*words, "", ""]) if at else ""
            if kind and not (kind == "optional-stop" and at < 2):
                kinds.append(kind)
                lines.append(words[kind])
            lines.append(f"G01 X{x} Y{y}")
        text = "\n".join([*lines, "M02", ""])
        dialect = rng.choice(["common", "sodick", "fanuc", "mitsubishi"])
        made = done(text, to_iso(dialect), "common")
        for kind in kinds:
            told = " ".join(loss.of for loss in made.lost)
            again = words[kind].replace("X1.5", "X1.500")
            assert again in made.data.decode() or words[kind] in told, (kind, text, made.data.decode())
