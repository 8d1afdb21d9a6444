"""What a check says of rough cuts and trims: nothing of sound ones, and of wrong ones what is wrong."""

import random

import pytest
from drawings import Arc, Line, Place
from pass_styles import STYLES, Style, written
from rough_and_trim import rough_and_trim
from sound import program_text
from sound_cam import Move, Post

from sim.check.batch import Job, check_file
from sim.check.settings import CheckSettings

WIRE = CheckSettings(wire_diameter_um=180.0, spark_gap_um=10.0)


def codes(text: str, settings: CheckSettings = WIRE) -> list[str]:
    return [found.code for found in check_file(Job("program.3b", text.encode(), settings)).findings]


def program_of(start: Place, *ways: list[Move] | list[Place]) -> str:
    """Lines to places, and other moves; D stands between two ways."""
    post = Post(start)
    for number, way in enumerate(ways):
        if number:
            post.pause()
        for move in way:
            post.move(Line(move) if len(move) == 2 and isinstance(move[0], float) else move)
    return program_text(random.Random(1), post)


def round_hole(*passes: tuple[float, bool]) -> str:
    """A round hole of R 5000 from its middle: offsets, and whether each pass runs back."""
    moves: list[Move] = []
    for by, back in passes:
        at = 5000.0 - by, 0.0
        moves += [Line(at), Arc(at, (0.0, 0.0), -1 if back else 1)]
    return program_of((0.0, 0.0), [*moves, Line((0.0, 0.0))])


def square(by: float, shift: float = 0.0) -> list[Place]:
    """Round a square of 10 mm at an offset, its left side farther off by a shift; from the middle of the right side."""
    a = 5000.0 + by
    return [(a, 0.0), (a, a), (-a - shift, a), (-a - shift, -a), (a, -a), (a, 0.0)]


@pytest.mark.parametrize("part", range(3))
def test_sound_programs_are_met_with_silence(part: int) -> None:
    rng = random.Random(f"silent {part}")
    for _ in range(10):
        program = rough_and_trim(rng)
        assert codes(program.text) == [], f"{program.name}\n{program.text}"


@pytest.mark.parametrize("style", STYLES, ids=lambda style: style.__name__)
def test_sound_programs_are_met_with_silence_whatever_lies_between_the_passes(style: Style) -> None:
    rng = random.Random(f"silent {style.__name__}")
    for _ in range(4):
        program = written(rng, style)
        assert codes(program.text) == [], program.text


@pytest.mark.parametrize(
    ("passes", "expected"),
    [
        ([(160, False), (120, False), (100, False)], []),
        ([(160, False), (100, True), (100, False)], []),  # once more where it was
        ([(160, False), (100, False), (120, False)], ["3B312"]),
        ([(100, False), (160, False)], ["3B312"]),
        ([(100, False), (105, False)], []),  # less than ends in whole µm may drift
        ([(290, False), (100, False)], []),
        ([(330, False), (100, False)], ["3B313"]),  # the kerf is 200 wide
        ([(160, False), (-120, True), (100, False)], ["3B316"]),
        ([(120, False), (-100, True)], ["3B316"]),
        ([(120, False), (-70, True)], ["3B316"]),
        ([(120, False), (-50, True)], []),  # a trim may take so much
    ],
)
def test_offsets_are_held_against_each_other(passes: list[tuple[float, bool]], expected: list[str]) -> None:
    assert codes(round_hole(*passes)) == expected


def test_a_band_is_told_of_a_known_wire_alone() -> None:
    program = round_hole((330, False), (100, False))
    assert codes(program, CheckSettings()) == []
    assert codes(program, CheckSettings(wire_diameter_um=300.0)) == []


@pytest.mark.parametrize(("shift", "expected"), [(0.0, []), (-45.0, []), (-75.0, ["3B307", "3B314"])])
def test_a_block_of_the_rough_cut_must_not_pass_the_last_one(shift: float, expected: list[str]) -> None:
    hole = 8000.0, 0.0
    assert sorted(codes(program_of(hole, [*square(150.0, shift), *square(100.0), hole]))) == expected


def test_a_tab_that_stays_is_told() -> None:
    """A square roughed and trimmed there and back up to 600 µm before its start, in the middle of the bottom side."""
    hole = 0.0, -8000.0
    rough, trim = ([(0.0, -a), (a, -a), (a, a), (-a, a), (-a, -a), (-600.0, -a)] for a in (5140.0, 5100.0))
    left = [*rough, *trim[::-1], hole]
    assert codes(program_of(hole, left)) == ["3B315"]
    assert codes(program_of(hole, left), CheckSettings(may_stay_open=True)) == []
    assert codes(program_of(hole, left[:-1], [trim[-1], hole])) == []


def test_a_profile_that_is_open_by_its_nature_has_no_tab() -> None:
    rough = [(0.0, 5000.0), (8000.0, 5000.0), (8000.0, 0.0)]
    trim = [(7960.0, 0.0), (7960.0, 4960.0), (0.0, 4960.0)]
    assert "3B315" not in codes(program_of((0.0, 0.0), [*rough, *trim]))
