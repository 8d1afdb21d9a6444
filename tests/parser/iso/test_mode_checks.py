"""I J and the scale are held against the path: what does not fit is told, or read otherwise and said."""

import math
from random import Random

import numpy as np
import pytest

from parser.dialect.reader import Choices
from parser.findings.codes import Severity
from parser.findings.findings import Finding
from parser.program import Program, parse_program

Point = tuple[int, int]


def read(text: str, **choices: str) -> Program:
    return parse_program(text, choices=Choices(**choices))


def told(program: Program, code: str) -> list[Finding]:
    return [finding for finding in program.findings if finding.code == code]


def arcs(seed: int) -> list[tuple[Point, Point]]:
    """Ends and centres of some arcs one behind the other, µm, as rounded by a CAM."""
    random = Random(seed)
    at, made = (random.randint(4000, 9000), random.randint(4000, 9000)), []
    for _ in range(random.randint(1, 12)):
        radius, angle = random.uniform(500.0, 9000.0), random.uniform(0.0, 2 * math.pi)
        center = (at[0] + radius * math.cos(angle), at[1] + radius * math.sin(angle))
        turned = angle + math.pi + random.uniform(0.3, 6.0)
        end = (round(center[0] + radius * math.cos(turned)), round(center[1] + radius * math.sin(turned)))
        made.append((end, (round(center[0]), round(center[1]))))
        at = end
    return made


def written(seed: int, *, absolute: bool, head: str = "G90") -> str:
    random = Random(seed)
    at = (random.randint(4000, 9000), random.randint(4000, 9000))
    lines = [f"G92 X{at[0]} Y{at[1]}", head]
    for end, center in arcs(seed):
        i, j = center if absolute else (center[0] - at[0], center[1] - at[1])
        lines.append(f"G03 X{end[0]} Y{end[1]} I{i} J{j}")
        at = end
    return "\n".join([*lines, "M02", ""])


@pytest.mark.parametrize("seed", range(40))
def test_either_way_of_writing_centres_is_the_same_path(seed: int) -> None:
    paths = [read(written(seed, absolute=absolute)) for absolute in (False, True)]
    for name in ("start_um", "end_um", "center_um", "sweep_rad"):
        first, other = (getattr(path.toolpath, name) for path in paths)
        assert np.allclose(first, other), name
    for path, taken in zip(paths, ("from-start", "absolute"), strict=True):
        [centres] = [one for one in path.reading.assumptions if one.what == "assumed-centres"]
        assert (centres.taken, centres.why) == (taken, "because-arcs")
        assert not told(path, "ISO215") + told(path, "ISO212")


@pytest.mark.parametrize(("dialect", "absolute"), [("fanuc", True), ("fast-wire", True), ("robofil", False)])
def test_a_chosen_family_is_kept_and_told_that_its_arcs_are_of_the_other_kind(dialect: str, absolute: bool) -> None:
    program = read(written(3, absolute=absolute), dialect=dialect)
    [finding] = told(program, "ISO215")
    taken, fits = ("centres-absolute", "centres-from-start")[:: -1 if absolute else 1]
    assert (finding.values["taken"], finding.values["fits"]) == (taken, fits)
    assert (finding.line, program.lines.text[slice(*finding.span)][0]) == (3, "I")
    assert not told(program, "ISO212"), "one cause, one finding"


def test_a_mode_that_is_written_is_kept_too() -> None:
    assert told(read(written(5, absolute=True, head="G90 G91.1")), "ISO215")
    assert not told(read(written(5, absolute=True, head="G90 G90.1")), "ISO215")


def moves(seed: int, *, incremental: bool) -> str:
    """The same arcs without a word of the mode: ways or places."""
    lines = written(seed, absolute=False, head="G01").splitlines()
    if not incremental:
        return "\n".join(lines)
    at = [int(word[1:]) for word in lines[0].split()[1:]]
    for number in range(2, len(lines) - 1):
        words = lines[number].split()
        to = [int(words[1][1:]), int(words[2][1:])]
        lines[number] = " ".join([words[0], f"X{to[0] - at[0]}", f"Y{to[1] - at[1]}", *words[3:]])
        at = to
    return "\n".join(lines)


@pytest.mark.parametrize("seed", [seed for seed in range(30) if len(arcs(seed)) > 1])
def test_a_mode_that_nothing_says_is_told_by_the_arcs(seed: int) -> None:
    ways, places = (read(moves(seed, incremental=incremental)) for incremental in (True, False))
    assert np.allclose(ways.toolpath.end_um, places.toolpath.end_um)
    told_by = {
        one.taken: one.why for of in (ways, places) for one in of.reading.assumptions if one.what.endswith("ance")
    }
    assert told_by == {"G91": "because-profile", "G90": "because-arcs"}, "fast wire begins with G91"
    kept = read(moves(seed, incremental=False), dialect="fast-wire")
    assert [one.taken for one in kept.reading.assumptions if one.what == "assumed-distance"] == ["G91"]


@pytest.mark.parametrize("wrong", [1, 2])
def test_one_arc_in_many_that_is_wrong_changes_no_reading(wrong: int) -> None:
    lines = written(7, absolute=False).splitlines()
    assert len(lines) > 8
    lines[2 + wrong] = lines[2 + wrong].replace("I-", "I").replace("I", "I1")
    program = read("\n".join(lines))
    assert [one.taken for one in program.reading.assumptions if one.what == "assumed-centres"] == ["from-start"]
    assert told(program, "ISO212")
    assert not told(program, "ISO215")


@pytest.mark.parametrize(
    ("arc", "why"),
    [
        ("G03 X-5000 Y0 I-5000 J0", "because-arcs"),
        ("G03 X0 Y5000 I-5000 J0\nG03 X-5000 Y0 I0 J-5000", "because-arcs"),
        ("G03 I-2000 J0", "because-profile"),
        ("G03 X0 Y5000 I-500 J700", "because-arcs-neither"),
        ("G03 X-5000 Y0 I0 J700", "because-arcs"),
        ("G03 X0 Y5000 I2500 J2500", "because-arcs"),
        ("G03 X5000 Y4000 I1000 J2000", "because-arcs-both"),
    ],
)
def test_what_the_arcs_say_is_said(arc: str, why: str) -> None:
    program = read(f"G92 X5000 Y0\nG90\n{arc}\nM02\n")
    [centres] = [one for one in program.reading.assumptions if one.what == "assumed-centres"]
    assert centres.why == why


@pytest.mark.parametrize(
    ("size", "choices", "unit"),
    [
        (20, {}, "mm"),
        (499, {}, "mm"),
        (20, {"dialect": "fast-wire"}, "mm"),
        (20_000, {"dialect": "classroom"}, "um"),
        (20.5, {"dialect": "fanuc"}, ""),
        (0.01, {}, ""),
        (0.02, {}, "inch"),
        (0.03, {"dialect": "sodick"}, "inch"),
        (500, {}, ""),
        (90_000, {}, ""),
        (20, {"unit": "um"}, ""),
    ],
)
def test_a_path_without_the_size_of_a_part_is_told_with_the_unit_in_which_it_has_one(
    size: float, choices: dict[str, str], unit: str
) -> None:
    program = read(f"G92 X0 Y0\nG90 G91\nG01 X{size:g} Y0\nX0 Y{size:g}\nM02\n".replace("G90 ", ""), **choices)
    assert [finding.values["name"] for finding in told(program, "ISO216")] == [unit] * bool(unit)


@pytest.mark.parametrize(
    ("size", "choices", "severity"),
    [
        (99, {}, Severity.ERROR),
        (100, {}, Severity.WARNING),
        (499, {}, Severity.WARNING),
        (30, {"dialect": "fast-wire"}, Severity.ERROR),
        (9_000, {"dialect": "classroom"}, Severity.WARNING),
        (20_000, {"dialect": "classroom"}, Severity.ERROR),
    ],
)
def test_a_path_within_a_kerf_or_beyond_any_table_is_an_error_where_another_unit_fits(
    size: int, choices: dict[str, str], severity: Severity
) -> None:
    program = read(f"G92 X0 Y0\nG91\nG01 X{size} Y0\nX0 Y{size}\nM02\n", **choices)
    assert [finding.severity for finding in told(program, "ISO216")] == [severity]


@pytest.mark.parametrize(
    ("words", "found"),
    [
        ("X10. Y5000", "Y5000"),
        ("X10. Y5.", ""),
        ("X10000 Y5000", ""),
        ("X10. Y0", ""),
        ("X10000 Y5000\nX4.", "X4."),
        ("X10. F5", ""),
    ],
)
def test_numbers_with_and_without_points_are_noted_at_the_rarer_kind(words: str, found: str) -> None:
    program = read(
        f"G92 X0 Y0\nG91\nG01 X9. Y1.\n{words}\nM02\n"
        if "." in words.split(maxsplit=1)[0]
        else f"G91 G01 {words}\nM02\n"
    )
    assert [program.lines.text[slice(*one.span)] for one in told(program, "ISO111")] == [found] * bool(found)


@pytest.mark.parametrize(("word", "found"), [("X-12", "X-12"), ("X-12.", "")])
def test_a_whole_number_among_decimals_is_noted_though_the_unit_was_told(word: str, found: str) -> None:
    """The controller takes it for 12 µm, whatever unit drycut was told."""
    lines = ["G21 G90 G92 X0. Y0.", "G01 X-12. Y0.", f"G01 {word} Y10.", "G01 X12. Y10.", "G01 X12. Y-10."]
    text = "\n".join([*lines, "G01 X-12. Y-10.", "G01 X-12. Y0.", "G01 X0. Y0.", "M02", ""])
    program = parse_program(text, choices=Choices(dialect="fanuc", unit="mm"))
    assert [program.lines.text[slice(*one.span)] for one in told(program, "ISO111")] == [found] * bool(found)
