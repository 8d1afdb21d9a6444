"""Fault drills: one fault each, in the line that is told, proved by a road of its own, from easy to hard."""

import difflib
import random
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from cam_programs import sound_program
from mutation import has_moved
from places import ROOT

from parser.program import Program, parse_program, read_program
from sim.check.file_check import check_program
from sim.check.settings import CheckSettings
from sim.teach.drills import (
    LEVELS,
    SEEN_FROM,
    Drill,
    DrillRequest,
    departure,
    drills_of,
    level_of,
    lines_of,
)
from sim.teach.kinds import KINDS, Sound, groups_of

SQUARE = "B0B1000B1000GYL2\nB1000B0B1000GXL1\nB0B1000B1000GYL4\nB1000B0B1000GXL3\nDD\n"
FOUR_B = "B5000B0B5000B0GXL1\nB1000B0B4000B1000DGYNR1\nB5000B0B5000B0GXL3\nDD\n"
ISO_ROUND = "G92 X0 Y0\nG01 X10.0 Y0\nG03 X10.0 Y10.0 I0 J5.0\nG01 X0 Y10.0\nG01 X0 Y0\nM02\n"
PLACES = np.linspace(0.0, 1.0, 9)


@cache
def of_scenario(name: str) -> Program:
    (path,) = [one for one in (ROOT / "scenarios" / name).glob("program.*") if one.suffix in {".3b", ".iso"}]
    return read_program(path)


@cache
def drills(name: str, number: int = 1, count: int = 12) -> tuple[Drill, ...]:
    return drills_of(of_scenario(name), CheckSettings(), DrillRequest(number, count))


NAMES = ("die", "iso-die", "keyhole", "rough-and-trim")


@pytest.mark.alike(1)
@pytest.mark.parametrize("name", NAMES)
def test_a_drill_differs_from_its_program_in_the_lines_that_it_tells_alone(name: str) -> None:
    before = of_scenario(name).text.splitlines()
    for drill in drills(name):
        after = drill.program.text.splitlines()
        codes = difflib.SequenceMatcher(None, before, after, autojunk=False).get_opcodes()
        edits = [one for one in codes if one[0] != "equal"]
        touched = {line for _, _, _, first, past in edits for line in range(first + 1, max(past, first + 1) + 1)}
        assert len(edits) <= 2, drill.kind
        assert min(abs(line - told) for line in touched for told in drill.lines) <= 1, drill.kind
        assert max(touched) - min(touched) <= 2  # two neighbours are swapped


@pytest.mark.alike(2)
@pytest.mark.parametrize("name", NAMES)
def test_each_drill_moves_the_path_or_cannot_be_obeyed(name: str) -> None:
    sound = of_scenario(name)
    for drill in drills(name):
        damaged = parse_program(drill.program.text, sound.name)
        told = {(found.code, found.line) for found in damaged.findings}
        assert has_moved(sound.toolpath, damaged.toolpath) or told - {(f.code, f.line) for f in sound.findings}


@pytest.mark.alike(1)
@pytest.mark.parametrize("name", NAMES)
def test_easy_drills_come_first_and_are_told_by_the_text_of_their_lines(name: str) -> None:
    levels = [LEVELS.index(drill.level) for drill in drills(name)]
    assert levels == sorted(levels)
    assert set(levels) == {0, 1, 2}
    for drill in drills(name):
        if drill.level == "words":
            assert {found.line for found in drill.program.findings} & set(drill.lines)


@pytest.mark.parametrize("name", ["die", "keyhole"])
def test_drills_of_the_picture_are_seen_there_and_those_of_sums_are_not(name: str) -> None:
    extent = float(np.ptp(of_scenario(name).toolpath.end_um, axis=0).max())
    seen = [drill for drill in drills(name) if drill.level == "picture" and not drill.by.is_cut_otherwise]
    assert seen
    assert all(drill.by.most_um >= SEEN_FROM * extent for drill in seen)
    assert all(drill.by.most_um < SEEN_FROM * extent for drill in drills(name) if drill.level == "sums")


def test_the_answer_holds_what_stood_there() -> None:
    before = of_scenario("die").text
    for drill in drills("die", count=20):
        after = drill.program.text.splitlines()
        found = [at for at in range(len(after) + 1) if list(drill.stands) == after[at : at + len(drill.stands)]]
        assert any(
            [*after[:at], *drill.was, *after[at + len(drill.stands) :]] == before.splitlines() for at in found
        ), drill.kind


def test_a_set_has_as_many_kinds_as_there_are_and_is_the_same_for_all() -> None:
    first, again, other = (drills_of(of_scenario("die"), CheckSettings(), DrillRequest(number)) for number in (7, 7, 8))
    texts = [drill.program.text for drill in first]
    assert texts == [drill.program.text for drill in again]
    assert texts != [drill.program.text for drill in other]
    assert len(set(texts)) == 10
    assert len({drill.group for drill in first}) >= 6


@pytest.mark.alike(1)
@pytest.mark.parametrize("level", LEVELS)
def test_one_level_can_be_asked_for(level: str) -> None:
    asked = DrillRequest(3, 6, next(one for one in LEVELS if one == level))
    made = drills_of(of_scenario("die"), CheckSettings(), asked)
    assert [drill.level for drill in made] == [level] * 6


@pytest.mark.deeper
def test_findings_of_a_drill_are_those_that_its_program_had_not() -> None:
    sound = of_scenario("iso-die")
    before = [(one.code, sound.excerpt(one.line)) for one in check_program(sound).findings if one.line]
    for drill in drills("iso-die"):
        for found in drill.findings:
            said = (found.code, drill.program.excerpt(found.line) if found.line else "")
            assert said not in before or found.code.startswith("ISO1")


@pytest.mark.deeper
def test_a_program_with_little_to_damage_gives_the_few_drills_that_there_are() -> None:
    made = drills_of(parse_program("B1000B0B1000GXL1\nDD\n"), CheckSettings(), DrillRequest(1, 30))
    assert 0 < len(made) <= 30
    assert len({drill.program.text for drill in made}) == len(made)


@pytest.mark.alike(4)
@pytest.mark.parametrize("name", KINDS)
def test_every_kind_of_fault_can_be_made(name: str) -> None:
    chance = random.Random(name)
    texts = [SQUARE, FOUR_B, ISO_ROUND, of_scenario("iso-die").text, sound_program(chance, printed=True).text]
    texts += [sound_program(chance, printed=False).text for _ in range(8)]
    made = 0
    for text in texts:
        sound = Sound(parse_program(text))
        for _ in range(20):
            slip = KINDS[name].make(chance, sound)
            made += slip is not None and slip.text != text
            assert slip is None or slip.lines <= set(range(1, len(text.splitlines()) + 2))
    assert made > 0


@pytest.mark.deeper
@pytest.mark.parametrize("end", ["\n", "\r\n", "\r"])
def test_damaged_programs_keep_the_ends_of_their_lines(end: str) -> None:
    program = parse_program(SQUARE.replace("\n", end))
    for drill in drills_of(program, CheckSettings(), DrillRequest(2, 20)):
        bare = drill.program.text.replace(end, "")
        assert "\r" not in bare
        assert "\n" not in bare


def test_lines_are_those_that_the_check_counts() -> None:
    text = SQUARE.replace("GYL2\n", "GYL2 //one\x0btwo\u2028three\x1c\n")
    for drill in drills_of(parse_program(text), CheckSettings(), DrillRequest(4, 10)):
        listed = lines_of(drill.program)
        assert len(listed) in {4, 5, 6}
        assert all(drill.program.excerpt(line) == listed[line - 1] for line in drill.lines)


@pytest.mark.parametrize(
    ("change", "most_um", "level"),
    [
        (("B1000B0B1000GXL1", "B1100B0B1100GXL1"), 100.0, "picture"),
        (("B1000B0B1000GXL1", "B1010B0B1010GXL1"), 10.0, "sums"),
        (("B1000B0B1000GXL1", "B1000B0B1000GXL3"), 2000.0, "picture"),
        (("B1000B0B1000GXL1", "B1004B0B1004GXL1"), 4.0, None),
        (("B1000B0B1000GXL1\n", ""), 1000.0, "picture"),
        (("B1000B0B1000GXL1", "1000B0B1000GXL1"), 1000.0, "words"),
    ],
)
def test_departures_are_those_of_a_square_by_hand(change: tuple[str, str], most_um: float, level: str | None) -> None:
    sound, damaged = parse_program(SQUARE), parse_program(SQUARE.replace(*change))
    by = departure(sound.toolpath, damaged.toolpath)
    assert by.most_um == pytest.approx(most_um, abs=1e-6)
    assert level_of(sound, damaged, frozenset({2})) == level


def test_a_jump_that_is_cut_is_a_departure_though_no_place_moves() -> None:
    text = SQUARE.replace("DD\n", "D\nB5000B0B5000GXL1\nD\nB0B900B900GYL2\nDD\n")
    sound, damaged = parse_program(text), parse_program(text.replace("\nD\n", "\n"))
    by = departure(sound.toolpath, damaged.toolpath)
    assert by.most_um == 0.0
    assert by.is_cut_otherwise
    assert by.is_there


def test_what_people_are_asked_for_fits_the_dialect(tmp_path: Path) -> None:
    assert "side" not in groups_of(parse_program(SQUARE))
    assert {"axis", "quadrant"} <= set(groups_of(parse_program(SQUARE)))
    assert not {"axis", "quadrant"} & set(groups_of(of_scenario("iso-die")))
    assert "side" in groups_of(of_scenario("iso-die"))


def test_a_program_of_one_block_has_drills_too() -> None:
    assert drills_of(parse_program("B1000B0B1000GXL1\n"), CheckSettings(), DrillRequest())
