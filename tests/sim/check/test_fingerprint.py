"""A finding is known again when its program was changed elsewhere."""

import random

from cam_programs import sound_program
from checking import WRONG_AXIS
from mutants import mutant

from sim.check.file_check import Job, check_file
from sim.check.result import fingerprints
from sim.check.settings import CheckSettings

AXIS_LABEL = "B9900B0B9900GXL4\n"  # 3B203
THERE_AND_BACK = "B500B0B500GXL4\nB500B0B500GXL3\n"  # 3B203


def known(text: str) -> dict[str, str]:
    result = check_file(Job("part.3b", text.encode(), CheckSettings()))
    return dict(zip(fingerprints(result), (finding.code for finding in result.findings), strict=True))


def test_blocks_that_are_put_in_elsewhere_change_no_fingerprint() -> None:
    before = known(WRONG_AXIS)
    assert list(before.values()) == ["3B204"]
    assert known(THERE_AND_BACK + WRONG_AXIS).items() > before.items()
    assert known(WRONG_AXIS.replace("DD", "D\n" + THERE_AND_BACK + "DD")).items() >= before.items()


def test_labels_that_count_on_blanks_and_case_change_no_fingerprint() -> None:
    lines = WRONG_AXIS.splitlines()
    labelled = [f"N{number}: {line.lower().replace('b', 'b ')}" for number, line in enumerate(lines, start=7)]
    assert known("\n".join(labelled)) == known(WRONG_AXIS)


def test_a_program_in_one_line_keeps_its_fingerprints() -> None:
    glued = (THERE_AND_BACK + WRONG_AXIS).replace("\n", "")
    assert known(glued).items() > known(WRONG_AXIS).items()
    damaged = "B500B0B500GXL1" * 9 + "B9900B0B99O0GXL3" + "B500B0B500GXL3" * 9 + "DD"
    before = {mark for mark, code in known(damaged).items() if code == "3B106"}
    assert before
    assert before <= known("B7B0B7GXL1" + damaged).keys()


def test_findings_that_are_alike_have_a_fingerprint_each() -> None:
    back = "B9900B0B9900GXL3\n"
    once, twice = known(AXIS_LABEL + back + "DD"), known((AXIS_LABEL + back) * 2 + "DD")
    assert [*once.values(), *twice.values()] == ["3B203"] * 3
    assert once.keys() < twice.keys()


def test_another_text_or_another_code_is_another_finding() -> None:
    assert known(WRONG_AXIS).keys().isdisjoint(known(WRONG_AXIS.replace("9900", "8800").replace("39600", "35200")))
    both = known(WRONG_AXIS.replace("GXNR1", "GXNR4"))
    assert len(both) == len({*both.values()}) > 1


def test_what_has_no_place_has_a_fingerprint_too() -> None:
    assert list(known("hello").values()) == ["3B100"]


def test_how_a_program_is_set_changes_no_fingerprint_of_a_broken_one() -> None:
    draw = random.Random(17)
    found = 0
    for number in range(8):
        broken = mutant(draw, sound_program(draw, printed=number % 2 == 1), None)
        if broken is None:
            continue
        lines: list[str] = []
        for line in broken.text:
            lines += draw.choice(([], [], [""], ["// turned over 加工"], ["(by hand)", "  "]))
            lines.append(line.lower() if draw.random() < 0.5 else line)
        before, after = known("\n".join(broken.text)), known(draw.choice(("\n", "\r\n", "\r")).join(lines))
        assert before == after, broken.text
        found += len(before)
    assert found > 4
