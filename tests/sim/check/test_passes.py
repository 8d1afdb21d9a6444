"""What a check says of rough cuts and trims: nothing of sound ones, and of wrong ones what is wrong."""

import random

import pytest
from drawings import Arc, Line, Place
from pass_styles import STYLES, Style, written
from rough_and_trim import rough_and_trim
from sound import program_text
from sound_cam import Move, Post
from tab_elsewhere import TAB_ELSEWHERE

from sim.check.file_check import Job, check_file
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


@pytest.mark.parametrize(
    ("passes", "expected"),
    [
        ([(100, False), (109, False)], []),
        ([(100, False), (111, False)], ["3B312"]),  # more than whole µm drift
        ([(309, False), (100, False)], []),
        ([(311, False), (100, False)], ["3B313"]),  # a kerf of 200, and what whole µm drift
        ([(100, False), (-79, True)], []),
        ([(100, False), (-81, True)], ["3B316"]),  # nearly all of the offset of 100 on the other side
    ],
)
def test_offsets_are_held_against_each_other_to_their_border(
    passes: list[tuple[float, bool]], expected: list[str]
) -> None:
    assert codes(round_hole(*passes)) == expected


@pytest.mark.parametrize(("second", "expected"), [(-79, []), (-81, ["3B316"])])
def test_without_a_wire_the_side_is_judged_by_the_usual_one(second: float, expected: list[str]) -> None:
    # 0.18 mm and 10 µm on each side: its centre runs 100 µm from the edge.
    assert codes(round_hole((100, False), (second, True)), CheckSettings()) == expected


def test_each_pass_is_held_against_the_nearest_before_it_by_its_number() -> None:
    found = check_file(
        Job("p.3b", round_hole((160, False), (100, False), (100, False), (130, False)).encode(), WIRE)
    ).findings
    assert [(f.code, f.values["number"], f.values["other"]) for f in found] == [("3B312", 4, 2)]
    assert found[0].values["by"] == pytest.approx(30.0, abs=1e-6)


def test_a_band_is_told_with_what_is_left_of_it_and_the_next_pass_is_held_against_the_nearer_one() -> None:
    found = check_file(Job("p.3b", round_hole((360, False), (100, False), (115, False)).encode(), WIRE)).findings
    assert [(f.code, f.values["number"], f.values["other"]) for f in found] == [("3B313", 2, 1), ("3B312", 3, 2)]
    told = {name: found[0].values[name] for name in ("by", "left", "kerf")}
    assert told == pytest.approx({"by": 260.0, "left": 60.0, "kerf": 200.0}, abs=1e-6)


@pytest.mark.parametrize(("shift", "is_told"), [(-69.0, False), (-71.0, True)])
def test_a_block_may_come_20_um_nearer_than_the_last_pass(shift: float, is_told: bool) -> None:
    hole = 8000.0, 0.0
    found = codes(program_of(hole, [*square(150.0, shift), *square(100.0), hole]))
    assert ("3B314" in found) == is_told


def _tab(length: float, cut: list[Place]) -> list[str]:
    """A square of 10 mm, roughed and trimmed up to a tab in the middle of its bottom side, and what is cut at last."""
    hole = 0.0, -8000.0
    rough, trim = ([(0.0, -a), (a, -a), (a, a), (-a, a), (-a, -a), (-length, -a)] for a in (5140.0, 5100.0))
    return (
        codes(program_of(hole, [*rough, *trim[::-1]], cut))
        if cut
        else codes(program_of(hole, [*rough, *trim[::-1], hole]))
    )


# The tab lies from x = -600 to 0 at y = -5100; its middle is at x = -300.
@pytest.mark.parametrize(
    ("cut", "expected"),
    [
        ([(-600.0, -5100.0), (0.0, -5100.0)], []),  # all of it
        ([(-300.0, -5110.0), (-300.0, -5900.0)], []),  # to its middle
        ([(8000.0, -8000.0), (9000.0, -8000.0)], ["3B315"]),
    ],
)
def test_a_tab_is_cut_by_what_comes_by_its_middle(cut: list[Place], expected: list[str]) -> None:
    assert [code for code in _tab(600.0, cut) if code == "3B315"] == expected


def test_a_gap_of_more_than_a_quarter_of_the_pass_is_no_tab() -> None:
    # The trim is some 40 mm long: with a tab of 8 mm 32 mm are left of it, with one of 9.6 mm 30.8 mm.
    hole = 0.0, -8000.0

    def left(tab: float) -> list[str]:
        ways = [[(tab / 2, -a), (a, -a), (a, a), (-a, a), (-a, -a), (-tab / 2, -a)] for a in (5140.0, 5100.0)]
        return [code for code in codes(program_of(hole, [*ways[0], *ways[1][::-1], hole])) if code == "3B315"]

    assert left(8000.0) == ["3B315"]
    assert left(9000.0) == []


def test_a_slug_that_hangs_by_a_tab_until_the_wire_comes_back_is_sound() -> None:
    assert codes(TAB_ELSEWHERE) == []


def test_a_contour_left_open_that_nobody_comes_back_to_is_told() -> None:
    """The same without what comes back over the tab: the trim begins at the same hole, but runs 30 µm aside."""
    lines = TAB_ELSEWHERE.splitlines()
    assert "3B301" in codes("\n".join([*lines[:16], *lines[20:]]))
