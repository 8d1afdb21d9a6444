"""Quizzes: read strictly from scenarios, and answered from what a block really does."""

import math
import re
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any, get_args

import numpy as np
import pytest
from hypothesis import given
from places import SCENARIOS
from plain import SIGNS, PlainBlock, motion_quadrant, plain_arc_end, plain_steps
from replayed import recording_of
from runs import plain_scenario, scenario_recording
from strategies import blocks, program_text

from controller.offset.shifted import Side
from controller.stepping.pulses import Pulses
from controller.stepping.steps import words_of
from parser.findings.catalogue import Bilingual
from parser.findings.errors import SettingsError
from parser.program import parse_program, read_program
from sim.measure.causes import BlockSteps
from sim.run.dryrun import DryRun
from sim.setup import quiz
from sim.setup.machine.machine import load_machine
from sim.setup.part import Offset, OffsetPass
from sim.setup.quiz import About, Question, WrittenQuestion, read_quiz, refuse_unanswerable
from sim.setup.scenario import load_scenario
from sim.show.replay.answers import AskedBlock, in_mm, written_out
from sim.show.replay.quiz import IN_A_SET, SETS, question_entries, quiz_of, sets_of

KINDS: tuple[About, ...] = get_args(About)
SET_17 = [3, 7, 8, 11, 16, 18, 21, 25, 29, 30]
"""What a class is asked that was told 17, of 32 questions of four kinds: to be kept, as numbers are handed on."""


def scenario_of(tmp_path: Path, text: str) -> Path:
    (tmp_path / "scenario.toml").write_text(text, "utf-8")
    return tmp_path


def test_a_quiz_is_read(tmp_path: Path) -> None:
    text = """
        [[quiz]]
        block = 2
        about = "turn"
        [[quiz]]
        block = 7
        ask = "Why?"
        ask_zh = "为什么？"
        answers = ["So", "Not\\u0007 so"]
        answers_zh = ["是", "否"]
        right = 2
        why = "Because"
    """
    one, other = load_scenario(scenario_of(tmp_path, text)).quiz
    assert one[:2] == (2, "turn")
    assert other[:2] == (
        7,
        WrittenQuestion(
            Bilingual("Why?", "为什么？"),
            (Bilingual("So", "是"), Bilingual("Not\ufffd so", "否")),
            1,
            Bilingual("Because", "Because"),
        ),
    )
    assert other.where == f"{tmp_path / 'scenario.toml'}: [[quiz]] 2"


FREE: dict[str, object] = {"block": 1, "ask": "a", "answers": ["b", "c"], "right": 1, "why": "d"}


@pytest.mark.parametrize(
    ("table", "complaint"),
    [
        ({}, "block is missing"),
        ({"block": 0, "about": "turn"}, "block is 0; it must lie between 1 and 1000000"),
        ({"block": 1.5, "about": "turn"}, "block is a whole number; found 1.5"),
        ({"block": "1", "about": "turn"}, "block is a number; found '1'"),
        ({"block": 1, "abuot": "turn"}, "unknown key 'abuot'; did you mean about?"),
        ({"block": 1, "about": "colour"}, "about is one of quadrant, count_axis, .*; found 'colour'"),
        ({"block": 1, "about": "turn", "right": 1}, "about asks a question of its own and takes no right"),
        ({"block": 1}, "ask is a text|answers is a list of texts"),
        ({**FREE, "ask": 3}, "ask is a text and must be given; found 3"),
        ({**FREE, "answers": "b"}, "answers is a list of texts and must be given; found 'b'"),
        ({**FREE, "answers": ["b", ""]}, "answers is a list of texts"),
        ({**FREE, "answers": ["b"]}, "the number of answers is 1; it must lie between 2 and 6"),
        ({**FREE, "answers": list("abcdefg")}, "the number of answers is 7"),
        ({**FREE, "answers": ["b", "b"]}, "answers holds the same text twice"),
        ({**FREE, "answers_zh": ["b", "c", "d"]}, "there are 2 answers and 3 answers_zh"),
        ({**FREE, "right": 3}, "right is 3; it must lie between 1 and 2"),
        ({**FREE, "right": True}, "right is a number; found True"),
        ({key: value for key, value in FREE.items() if key != "right"}, "right is missing"),
        ({key: value for key, value in FREE.items() if key != "why"}, "why is a text and must be given"),
        ({**FREE, "why_zh": ""}, "why_zh is a text"),
    ],
)
def test_a_wrong_question_is_refused_with_its_key(table: dict[str, object], complaint: str) -> None:
    with pytest.raises(SettingsError, match=rf"^f: \[\[quiz\]\] 2: (.*)?({complaint})"):
        read_quiz({"quiz": [FREE, table]}, "f")


@pytest.mark.parametrize("value", [3, {"block": 1}, [1]])
def test_a_quiz_is_a_list_of_tables(value: object) -> None:
    with pytest.raises(SettingsError, match=r"^f: quiz are tables, \[\[quiz\]\]; found"):
        read_quiz({"quiz": value}, "f")


@pytest.mark.parametrize(
    ("question", "complaint"),
    [
        (Question(4, "end", "f"), "^f: block 4 is not in the program, which ends at 3$"),
        (Question(1, "turn", "f"), "^f: block 1 is a line, and does not turn$"),
        (Question(3, "quadrant", "f"), "^f: block 3 has no length, and nothing to ask about$"),
    ],
)
def test_a_question_without_an_answer_is_refused(question: Question, complaint: str) -> None:
    toolpath = parse_program("B0B30B30GYL2 B30B0B60GYNR1 B0B30B0GYL4 DD").toolpath
    refuse_unanswerable([Question(2, kind, "f") for kind in KINDS], toolpath)
    with pytest.raises(SettingsError, match=complaint):
        refuse_unanswerable([question], toolpath)


def own(run: DryRun, steps: Pulses) -> list[dict[str, Any]]:
    return question_entries(run, steps, words_of(run.toolpath))


def asked(text: str, questions: list[Question], **changes: object) -> list[dict[str, Any]]:
    recording = recording_of(text, **changes)
    scenario = replace(recording.run.scenario, quiz=tuple(questions))  # of those too that a run would refuse
    return own(replace(recording.run, scenario=scenario), recording.steps)


def right(entry: dict[str, Any], language: str = "en") -> str:
    return str(entry["answers"][entry["right"]][language])


def test_answers_are_those_of_a_round_hole() -> None:
    """Read off the program by hand, with docs/3b.md §1 to §3."""
    text = "B99B0B99GXL1B99B0B396GYNR1B99B0B99GXL3"
    entries = {(e["block"], e["about"]): e for e in asked(text, [Question(b, k, "f") for b in (1, 2) for k in KINDS])}
    answers = {key: right(entry) for key, entry in entries.items()}
    assert answers == {
        (1, "quadrant"): "L1",
        (1, "count_axis"): "GX",
        (1, "count_length"): "99",
        (1, "next_step"): "+X",
        (1, "end"): "X 0.099 mm, Y 0.000 mm",
        (2, "quadrant"): "NR1",
        (2, "count_axis"): "GY",
        (2, "turn"): "counter-clockwise (NR)",
        (2, "count_length"): "396",
        (2, "next_step"): "−X",
        (2, "end"): "X 0.099 mm, Y 0.000 mm",
    }
    assert right(entries[2, "turn"], "zh") == "逆时针（NR）"


EVERYTHING = tuple(Question(1, kind, "f") for kind in KINDS)
WAYS = {(1, 0): "+X", (-1, 0): "−X", (0, 1): "+Y", (0, -1): "−Y"}


def asked_about(block: PlainBlock) -> dict[About, dict[str, Any]]:
    """Questions of all kinds about a program of one block, run by nobody: entries as the document has them."""
    places = np.array(plain_steps(block), dtype=np.int32)
    steps = Pulses(np.zeros(len(places)), *places.T, np.zeros(len(places), dtype=np.int32))
    stepped = BlockSteps(np.array([len(places)]), np.array([[0, 0], places[-1]]))
    program = parse_program(program_text([block]))
    asked = plain_scenario(quiz=EVERYTHING)
    run = SimpleNamespace(program=program, toolpath=program.toolpath, stepped=stepped, scenario=asked)
    return {entry["about"]: entry for entry in own(run, steps)}


@given(blocks)
def test_what_drycut_answers_is_so(block: PlainBlock) -> None:
    found = asked_about(block)
    sx, sy = SIGNS[block.quadrant]
    assert right(found["next_step"]) == WAYS[plain_steps(block)[0]]
    assert right(found["count_axis"]) == f"G{block.axis}"
    assert right(found["count_length"]) == str(block.count)
    assert ("turn" in found) == (block.sense != "L")
    if block.sense == "L":
        ruled = {(1, 0): 1, (0, 1): 2, (-1, 0): 3, (0, -1): 4}.get(
            (sx * (block.x > 0), sy * (block.y > 0)), block.quadrant
        )
        assert ("quadrant" in found) == (ruled == block.quadrant)
        if "quadrant" in found:
            assert right(found["quadrant"]) == f"L{ruled}"
        share = block.count / (block.x if block.axis == "X" else block.y)
        end = sx * share * block.x, sy * share * block.y
    else:
        assert right(found["quadrant"]) == f"{block.sense}{motion_quadrant(sx * block.x, sy * block.y, block.sense)}"
        assert right(found["turn"]).endswith(f"({block.sense})")
        end = plain_arc_end(block)
    if "end" in found:
        place = [
            float(part.replace("−", "-")) for part in right(found["end"]).replace(",", "").split() if part[-1].isdigit()
        ]
        assert math.dist(place, (end[0] / 1000.0, end[1] / 1000.0)) < 0.0008
    for entry in found.values():
        for language in ("en", "zh"):
            answers = [answer[language] for answer in entry["answers"]]
            assert 2 <= len(answers) == len(set(answers)) <= 6
            assert entry["ask"][language]
            assert entry["why"][language]
            assert "{" not in entry["ask"][language] + entry["why"][language]


@pytest.mark.parametrize(
    ("block", "why"),
    [
        (PlainBlock(40, 30, 40, "X", "L", 1), "|X| is 40 µm and |Y| is 30 µm: the longer one is counted."),
        (PlainBlock(40, 40, 40, "Y", "L", 3), "At 45° it is GY in quadrants 1 and 3, GX in 2 and 4."),
        (
            PlainBlock(40, 40, 40, "X", "L", 3),
            "The block says GX, though the rule would have it count on the other axis.",
        ),
        (
            PlainBlock(40, 30, 30, "Y", "L", 1),
            "The block says GY, though the rule would have it count on the other axis.",
        ),
        (
            PlainBlock(50, 0, 100, "Y", "NR", 1),
            "From the centre it ends at (−50, 0) µm, nearer the X axis: the other one is counted.",
        ),
        (
            PlainBlock(50, 0, 100, "X", "NR", 1),
            "The block says GX, though the rule would have it count on the other axis.",
        ),
        (
            PlainBlock(300, 0, 88, "X", "NR", 1),
            "It ends as far from one axis as from the other: either may be counted, and the block says GX.",
        ),
    ],
)
def test_why_an_axis_counts_is_the_rule_or_its_breach(block: PlainBlock, why: str) -> None:
    assert asked_about(block)["count_axis"]["why"]["en"] == why


def test_wrong_ends_are_no_place_where_steps_might_end() -> None:
    block = AskedBlock(
        1,
        False,
        np.zeros(2),
        np.array([9.0, 0.0]),
        np.full(2, np.nan),
        9.0,
        (9, 0),
        9,
        "X",
        1,
        0,
        (1, 0),
        9,
        True,
        ("SR", "NR"),
    )
    assert written_out("end", block) is None
    far = written_out("end", block._replace(end_um=np.array([9.0, 300.0])))
    assert far is not None
    assert Bilingual("X −0.009 mm, Y 0.300 mm", "X −0.009 mm，Y 0.300 mm") not in far.answers
    assert len(far.answers) == 4


def test_three_wrong_answers_stand_beside_the_right_one() -> None:
    answers = asked_about(PlainBlock(40, 30, 40, "X", "L", 1))["count_length"]["answers"]
    assert [answer["en"] for answer in answers] == ["30", "40", "50", "70"]


@pytest.mark.parametrize(
    ("um", "text"), [(-0.3, "0.000"), (0.0, "0.000"), (-24_900.4, "−24.900"), (56_756.6, "56.757")]
)
def test_places_are_written_as_programs_print_them(um: float, text: str) -> None:
    assert in_mm(um) == text


def test_a_block_without_a_step_is_not_asked_about() -> None:
    questions = [Question(block, "next_step", "f") for block in (1, 2, 3)]
    entries = asked("B30B0B30GXL1 B0B30B0GYL2 B30B0B30GXL3 DD", questions)
    assert [(entry["block"], right(entry)) for entry in entries] == [(1, "+X"), (3, "−X")]


def test_questions_stand_in_the_order_they_are_asked() -> None:
    free = WrittenQuestion(Bilingual("a", "b"), (Bilingual("c", "d"), Bilingual("e", "f")), 1, Bilingual("g", "h"))
    entries = asked(
        "B0B30B30GYL2 B30B0B60GYNR1 DD", [Question(2, free, "f"), Question(1, "end", "f"), Question(2, "turn", "f")]
    )
    assert [(entry["row"], entry["about"]) for entry in entries] == [(0, "end"), (1, None), (1, "turn")]
    assert entries[1] == {
        "row": 1,
        "block": 2,
        "name": "2",
        "about": None,
        "ask": {"en": "a", "zh": "b"},
        "answers": [{"en": "c", "zh": "d"}, {"en": "e", "zh": "f"}],
        "right": 1,
        "why": {"en": "g", "zh": "h"},
        "hidden": [],
    }


def test_a_card_is_not_asked_for_its_next_step() -> None:
    questions = [Question(1, "next_step", "f"), Question(1, "end", "f")]
    entries = asked("B0B30B30GYL2 DD", questions, machine=load_machine("servo-400x500"))
    assert [entry["about"] for entry in entries] == ["end"]


def test_blocks_that_an_offset_takes_away_are_not_asked_about() -> None:
    text = "B0B500B500GYL2 B500B0B500GXL1 B50B0B50GXNR3 B0B500B500GYL2 B1000B0B1000GXL3 B0B1050B1050GYL4 DD"
    everything = [Question(block, "end", "f") for block in range(1, 7)]
    offset = Offset((OffsetPass(100.0),), Side.LEFT)
    entries = asked(text, everything, offset=offset)
    run = recording_of(text, offset=offset).run
    ran = set(run.toolpath.source.block.tolist())
    assert {entry["block"] for entry in entries} == ran
    assert ran < set(range(1, 7))


@pytest.mark.parametrize("folder", sorted(SCENARIOS.iterdir()), ids=lambda folder: folder.name)
def test_shipped_quizzes_can_be_answered(folder: Path) -> None:
    scenario = load_scenario(folder)
    if scenario.quiz:
        refuse_unanswerable(scenario.quiz, read_program(scenario.program).toolpath)
    if folder.name == "keyhole":
        assert len(scenario.quiz) >= 4


def test_every_key_of_a_question_is_documented() -> None:
    page = (SCENARIOS.parent / "docs" / "scenarios.md").read_text("utf-8")
    section = page.partition("\n## Quiz\n")[2].partition("\n## ")[0]
    rows = [row.split("|")[1] for row in section.splitlines() if row.startswith("| `")]
    named = re.findall(r"`(?:\[\[quiz\]\] )?(\w+)`", " ".join(rows))
    assert set(named) == {*(key.name for key in quiz.QUIZ.keys), *KINDS}
    assert "| 1 to 1,000,000 |" in section
    assert (quiz.BLOCK, quiz.ANSWERS) == ((1, 1e6), (2, 6))


def test_the_quiz_shown_can_be_read(tmp_path: Path) -> None:
    page = (SCENARIOS.parent / "docs" / "scenarios.md").read_text("utf-8")
    (shown,) = re.findall(r"## Quiz\n.*?```toml\n(.*?)```", page, flags=re.DOTALL)
    one, other = load_scenario(scenario_of(tmp_path, shown)).quiz
    assert (one.what, isinstance(other.what, WrittenQuestion)) == ("next_step", True)


PROGRAMS = ["keyhole", "die", "plate", "iso-die", "rough-and-trim", "punch", "servo-trip"]


@pytest.mark.alike(3)
@pytest.mark.parametrize("name", PROGRAMS)
def test_any_program_has_sets_of_questions_of_many_kinds(name: str) -> None:
    recording = scenario_recording(name)
    quiz = quiz_of(recording.run, recording.steps)
    pool, sets = quiz["pool"], quiz["sets"]
    assert len(sets) == SETS
    kinds = {entry["about"] for entry in pool}
    assert ("turn" in kinds) == bool(recording.run.toolpath.is_arc.any())
    assert "offset" in kinds
    assert ("side" in kinds) == (recording.run.offset is not None) == ("end" not in kinds)
    for chosen in sets:
        asked = [(pool[at]["block"], pool[at]["about"]) for at in chosen]
        assert len(chosen) == min(IN_A_SET, len(pool)) == len(set(chosen))
        assert chosen == sorted(chosen, key=lambda at: pool[at]["row"])
        assert len({about for _, about in asked}) == min(len(kinds), len(chosen))
    assert len({tuple(chosen) for chosen in sets}) > SETS // 2 or len(pool) <= IN_A_SET + 2
    assert quiz == quiz_of(recording.run, recording.steps)


@pytest.mark.alike(3)
@pytest.mark.parametrize("name", PROGRAMS)
def test_what_is_hidden_in_the_listing_holds_the_answer(name: str) -> None:
    recording = scenario_recording(name)
    source = recording.run.toolpath.source
    for entry in quiz_of(recording.run, recording.steps)["pool"]:
        if recording.run.toolpath.words is None or entry["about"] in {"offset", "side", "fault", "next_step"}:
            continue
        text = source.text[int(source.span[entry["row"], 0]) :]
        hidden = [text[first:past] for first, past in entry["hidden"]]
        shown = "".join(char for at, char in enumerate(source.block_text(entry["row"])) if not is_hidden(entry, at))
        if entry["about"] in {"quadrant", "turn"}:
            assert not re.search(r"L[1-4]|[NS]R", shown)
        if entry["about"] in {"quadrant", "count_axis"}:
            assert not re.search(r"G\s*[XY]", shown)
        if entry["about"] == "count_length":
            assert right(entry) in hidden
        if entry["about"] == "end":
            assert "\n" not in hidden[0]


def is_hidden(entry: dict[str, Any], at: int) -> bool:
    return any(first <= at < past for first, past in entry["hidden"])


def test_the_block_at_fault_stands_beside_sound_ones() -> None:
    text = "B0B300B300GYL2\nB300B0B300GXL1\nB300B0B1200GXNR1\nB0B300B300GYL4\nB300B0B300GXL3\nDD\n"
    recording = recording_of(text, may_stay_open=True)
    faults = [one for one in quiz_of(recording.run, recording.steps)["pool"] if one["about"] == "fault"]
    found = {finding.block for finding in recording.run.findings if finding.block}
    assert faults
    for entry in faults:
        assert int(right(entry)) in found
        others = {int(answer["en"]) for answer in entry["answers"]} - {int(right(entry))}
        assert others
        assert not others & found


def test_a_block_on_which_a_finding_only_hangs_is_not_asked_about() -> None:
    """An open contour is told at its last block, whichever is at fault."""
    for text in (
        "B1000B0B1000GXL1 B0B500B500GYL2 B500B0B500GXL3 B0B300B300GYL4 B500B0B500GXL3 B0B800B800GYL4 DD",
        "B1000B0B1000GXL1 B0B470B470GYL2 B500B0B500GXL3 B0B300B300GYL2 B500B0B500GXL3 B0B800B800GYL4 DD",
    ):
        recording = recording_of(text)
        assert "3B301" in {finding.code for finding in recording.run.findings}
        assert [one for one in quiz_of(recording.run, recording.steps)["pool"] if one["about"] == "fault"] == []


def test_a_line_whose_label_is_not_the_rules_is_not_asked_about() -> None:
    recording = recording_of("B500B0B500GXL4 B0B500B500GYL1 B500B0B500GXL2 B0B500B500GYL3 DD")
    assert not [one for one in quiz_of(recording.run, recording.steps)["pool"] if one["about"] == "quadrant"]


def test_the_edge_lies_half_the_kerf_beside_the_path() -> None:
    recording = recording_of("B0B300B300GYL2 DD", may_stay_open=True)
    (asked_for,) = (one for one in quiz_of(recording.run, recording.steps)["pool"] if one["about"] == "offset")
    assert right(asked_for) == f"{recording.run.scenario.wire.kerf_um / 2.0:g} µm"
    assert len({answer["en"] for answer in asked_for["answers"]}) == len(asked_for["answers"]) >= 3


def test_sets_are_the_same_on_every_machine() -> None:
    pool = [{"row": at, "block": at, "about": kind} for at, kind in enumerate(["a", "b", "c", "d"] * 8)]
    assert sets_of(pool)[16] == SET_17
    assert sets_of([]) == []


def test_the_pool_of_a_long_program_is_bounded() -> None:
    text = "\n".join(["B0B9B9GYL2", "B9B0B9GXL1", "B0B9B9GYL4", "B9B0B9GXL1"] * 300)
    recording = recording_of(f"{text}\nDD\n", may_stay_open=True)
    quiz = quiz_of(recording.run, recording.steps)
    assert len(quiz["pool"]) <= 200
    blocks = {entry["block"] for entry in quiz["pool"]}
    assert (min(blocks), max(blocks)) == (1, 1200)
