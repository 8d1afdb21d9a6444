"""A second dialect, read in the tests alone, goes through check, run, pictures, report and replay like 3B."""

import ast
import json
import math
import re
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from command import run_inside
from places import ROOT
from replayed import document_of
from report_schema import validator
from runs import codes, plain_scenario, run_text
from tiny_dialect import TinyReader
from trees import trees_of

from controller.offset.shifted import Side
from controller.stepping.steps import interpolate
from parser import program as door
from parser.findings.errors import FileUnreadableError, ProgramError, SettingsError
from parser.program import load_program, parse_program
from parser.units import mm
from sim.base.progress import silent
from sim.check.file_check import Job, check_file
from sim.check.files import find_files
from sim.check.settings import CheckSettings
from sim.check.settings.search import SettingsSearch
from sim.jobs.run_into import FILES
from sim.run.dryrun import DryRun
from sim.run.report import build_report
from sim.run.running import dry_run
from sim.setup.part import Offset, OffsetPass
from sim.setup.quiz import Question
from sim.show.pictures.gallery import PICTURES

SLOT = "10: go 4 0\narc 4 4 4 2 left\n30: go 0 4\narc 0 0 0 2 left\nend\n"
"""A slot of 4 mm between centres and 4 mm width, its path run counter-clockwise."""
SLOT_3B = "B4000B0B4000GXL1 B0B2000B4000GXNR4 B4000B0B4000GXL3 B0B2000B4000GXNR2 DD"
LENGTH_UM = 8000.0 + 4000.0 * math.pi


@pytest.fixture(autouse=True)
def _tiny_is_read(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(door, "READERS", (*door.READERS, TinyReader()))


@pytest.fixture(scope="module")
def run() -> Iterator[DryRun]:
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(door, "READERS", (*door.READERS, TinyReader()))
        yield run_text(SLOT, kerf=True)


def check(text: str, **settings: object) -> list[tuple[str, int, int, int]]:
    result = check_file(Job("part.tiny", text.encode(), CheckSettings(**settings)))
    return [(finding.code, finding.line, finding.column, finding.block) for finding in result.findings]


# The door


def test_the_door_asks_readers_in_turn() -> None:
    assert parse_program(SLOT).reading.dialect == "tiny"
    assert parse_program(SLOT_3B).reading.dialect == "3B"
    assert load_program(SLOT.encode("utf-16"), "part").reading.dialect == "tiny"
    with pytest.raises(ProgramError, match="no block"):
        parse_program("nothing that anybody reads")


def test_files_of_every_reader_are_found(tmp_path: Path) -> None:
    for name in ("a.3b", "b.TINY", "c.txt"):
        (tmp_path / name).touch()
    assert [Path(file).name for file in find_files([str(tmp_path)]).files] == ["a.3b", "b.TINY"]
    with pytest.raises(FileUnreadableError, match=r"end in \.3b or \.4b .* or \.tiny"):
        find_files([str(tmp_path / "*.dxf")])


def test_a_block_says_where_it_stands() -> None:
    program = parse_program(SLOT)
    assert list(program.toolpath.source.label) == ["N10", "", "N30", ""]
    assert [block.text for block in program.toolpath][:2] == ["go 4 0", "arc 4 4 4 2 left"]
    assert program.toolpath.words is None
    assert program.mender is None


# The check


def test_a_sound_program_passes_and_coverage_says_what_was_not_asked() -> None:
    result = check_file(Job("part.tiny", SLOT.encode(), CheckSettings()))
    states = {state.name: (state.state, state.reason) for state in result.coverage.checks}
    assert (result.verdict, result.dialect, result.findings) == ("pass", "tiny", ())
    assert result.length_um == pytest.approx(LENGTH_UM)
    for name in ("check-blocks", "check-steps"):
        assert states[name] == ("not asked", "reason-no-words")
    for name in ("check-grammar", "check-order", "check-contours", "check-senses", "check-crossings"):
        assert states[name] == ("complete", "")


@pytest.mark.parametrize(
    ("text", "found"),
    [
        # A cusp at both ends: the sense is wrong, and the finding points at it and speaks the dialect's word.
        (SLOT.replace("4 2 left", "4 2 right"), [("3B306", 2, 13, 2)]),
        (SLOT.replace("go 0 4", "go nowhere"), [("3B101", 3, 5, 0)]),
        (SLOT.replace("end\n", ""), [("3B102", 4, 1, 0)]),
        # No suspect is named: nothing knows how to write a block of this dialect otherwise.
        (SLOT.replace("arc 0 0 0 2 left", "arc -1 3 0 3 left"), [("3B301", 4, 1, 4)]),
        ("go 9 0\ngo 9 9\ngo 4 9\ngo 4 -5\ngo 0 -5\ngo 0 0\nend", [("3B307", 4, 1, 4)]),
    ],
    ids=["sense", "unreadable", "no end", "open", "crossing"],
)
def test_what_is_wrong_is_found_at_its_place(text: str, found: list[tuple[str, int, int, int]]) -> None:
    assert check(text) == found


def test_findings_speak_the_words_of_the_dialect() -> None:
    result = check_file(Job("part.tiny", SLOT.replace("4 2 left", "4 2 right").encode(), CheckSettings()))
    assert result.findings[0].values == {"written": "right", "other": "left", "word": "left"}


@pytest.mark.parametrize(
    ("line", "why"),
    [
        ('end_marks = ["arc"]', "'ARC' is a word of blocks"),
        ('pause_marks = ["end"]', "'END' cannot both end and pause"),
        ('end_marks = ["GX"]', "'GX' is a word of blocks"),
        ('pause_marks = ["dd"]', "'DD' cannot both end and pause"),
    ],
)
def test_no_word_of_any_reader_can_be_a_mark_that_says_otherwise(tmp_path: Path, line: str, why: str) -> None:
    (tmp_path / "drycut.toml").write_text(line, "utf-8")
    with pytest.raises(SettingsError, match=why):
        SettingsSearch().near(tmp_path)


# The run, against closed forms


def test_path_end_and_time_are_those_of_the_geometry(run: DryRun) -> None:
    assert float(run.toolpath.length_um.sum()) == pytest.approx(LENGTH_UM, rel=1e-12)
    assert run.toolpath.end_um[-1].tolist() == pytest.approx([0.0, 0.0], abs=1e-9)
    assert run.stepped.corner_um.tolist() == [[0, 0], [4000, 0], [4000, 4000], [0, 4000], [0, 0]]
    assert codes(run) == []


def test_kerf_and_slug_are_those_of_a_slot(run: DryRun) -> None:
    f, most_um = run.scenario.wire.reach_um, 2.0 * run.deviations.wire.max_um
    assert run.remains is not None
    assert run.remains.kerf.region_um.bounds == pytest.approx((-2000.0 - f, -f, 6000.0 + f, 4000.0 + f), abs=most_um)
    (slug,) = run.remains.pieces.freed
    inner_mm = mm(2000.0 - f)
    around_mm = 8.0 + 2.0 * math.pi * inner_mm
    assert slug.area_mm2 == pytest.approx(8.0 * inner_mm + math.pi * inner_mm**2, abs=around_mm * mm(most_um))


def test_a_path_runs_the_same_whatever_told_it(run: DryRun) -> None:
    other = run_text(SLOT_3B, kerf=True)
    assert run.trace.t_s.tolist() == other.trace.t_s.tolist()
    assert run.trace.table_um.tolist() == other.trace.table_um.tolist()
    assert run.deviations.steps.by_row_um.tolist() == other.deviations.steps.by_row_um.tolist()


def test_the_card_interpolates_it() -> None:
    scenario = plain_scenario()
    card = dry_run(parse_program(SLOT), plain_scenario(machine=scenario.machine.stepping_by("card")), silent)
    assert card.stepped.corner_um[-1].tolist() == [0, 0]


def test_steps_end_every_block_as_near_as_words_of_a_cam_would() -> None:
    rng = np.random.default_rng(7)
    turns = rng.uniform(0.2, 6.0, 60).cumsum()
    rows = []
    x = y = 0.0
    for at, turn in enumerate(turns.tolist()):
        cx, cy = x + 3.0 * math.cos(turn), y + 3.0 * math.sin(turn)
        # A point on the circle through where the last block ended, to 0.1 µm, so that starts lie near their circles.
        angle = turn + math.pi + rng.uniform(0.3, 5.0)
        x, y = round(cx + 3.0 * math.cos(angle), 4), round(cy + 3.0 * math.sin(angle), 4)
        way = "left" if at % 2 else "right"
        rows.append(f"arc {x:.4f} {y:.4f} {cx:.6f} {cy:.6f} {way}" if at % 3 else f"go {x:.4f} {y:.4f}")
    toolpath = parse_program("\n".join([*rows, "end"])).toolpath
    miss = interpolate(toolpath).corner_um[1:] - toolpath.end_um
    assert np.hypot(miss[:, 0], miss[:, 1]).max() < 10.0  # docs/3b.md §3; rounding does not add up from block to block


def test_the_controller_adds_an_offset() -> None:
    f = 100.0
    led = "go 1 0\n" + "\n".join(["go 4 0", "arc 4 4 4 2 left", "go 0 4", "arc 0 0 0 2 left", "go 1 0", "end"])
    run = dry_run(
        parse_program(led), plain_scenario(offset=Offset((OffsetPass(f),), Side.RIGHT), may_stay_open=True), silent
    )
    assert run.offset is not None
    arcs = run.toolpath.is_arc & (run.toolpath.radius_um > 1000.0)
    assert run.toolpath.radius_um[arcs].tolist() == pytest.approx([2000.0 + f] * int(arcs.sum()))
    assert run.toolpath.words is None


# What is shown


def test_the_report_has_its_header_and_no_words_of_steps(run: DryRun) -> None:
    report = build_report(run)
    assert report["program"]["dialect"] == "tiny"
    assert report["program"]["header"] == {"words": 3.0}
    assert [block["label"] for block in report["blocks"]] == ["N10", None, "N30", None]
    for block in report["blocks"]:
        assert [block[key] for key in ("count_um", "count_axis", "radius_um", "curve")] == [None] * 4


def test_the_report_keeps_its_schema_but_for_its_header(run: DryRun) -> None:
    complaints = validator().iter_errors(build_report(run))
    assert {error.json_path for error in complaints} == {"$.program.header"}


def test_the_replay_has_its_blocks_and_lines() -> None:
    document = document_of(SLOT)
    assert document["program"]["dialect"] == "tiny"
    assert document["program"]["lines"] == SLOT.splitlines()
    assert document["blocks"]["character"] == [4, 0, 4, 0]
    assert document["blocks"]["characters"] == [6, 16, 6, 16]


def test_a_quiz_asks_for_places_and_not_for_words_that_are_not_there() -> None:
    (asked,) = document_of(SLOT, quiz=(Question(2, "end", "here"),))["quiz"]["own"]
    assert asked["answers"][asked["right"]]["en"] == "X 4.000 mm, Y 4.000 mm"
    (asked,) = document_of(SLOT, quiz=(Question(2, "turn", "here"),))["quiz"]["own"]
    assert [answer["en"] for answer in asked["answers"]] == ["clockwise (right)", "counter-clockwise (left)"]
    assert asked["why"]["en"].startswith("It is written left: right turns clockwise")
    for about in ("quadrant", "count_axis", "count_length", "next_step"):
        with pytest.raises(SettingsError, match="no words"):
            document_of(SLOT, quiz=(Question(2, about, "here"),))


def test_every_command_takes_it(tmp_path: Path) -> None:
    folder = tmp_path / "slot"
    folder.mkdir()
    (folder / "scenario.toml").write_text('title = "A slot"\nkerf = true\n')
    (folder / "program.tiny").write_text(SLOT)

    checked = run_inside("check", "--format", "json", folder)
    assert checked.returncode == 0, checked.stderr
    assert json.loads(checked.stdout)["files"][0]["dialect"] == "tiny"

    done = run_inside("run", folder, "-o", tmp_path / "out")
    assert done.returncode == 0, done.stderr
    assert {file.name for file in (tmp_path / "out").iterdir()} == set(FILES)
    for page in ("report.html", "replay.html"):
        text = (tmp_path / "out" / page).read_text("utf-8")
        assert "arc 4 4 4 2 left" in text
        assert "GNone" not in text

    drawn = run_inside("draw", folder, "-o", tmp_path / "pictures")
    assert drawn.returncode == 0, drawn.stderr
    pictures = {file.stem for file in (tmp_path / "pictures").iterdir()}
    assert pictures == set(PICTURES) - {"polar"}  # which needs a circle

    fixed = run_inside("check", "--fix", folder)
    assert fixed.returncode == 0, fixed.stderr
    assert (folder / "program.tiny").read_text() == SLOT


# Nobody behind the parser knows 3B

_WORDS = r"J|GX|GY|NR\d?|SR\d?|DD|L[1-4]|[34]B|\w*\.[34]b"
_TOKEN = re.compile(rf"(?<![A-Za-z0-9_/])(?:{_WORDS}|\AG\Z|G(?=\$\{{))(?![A-Za-z0-9.])")
"""Tokens of 3B; G where an axis is put behind it, not that of the circular test."""
_SPEAK_3B = {
    "sim/check/radius_rule.py": "the marks of 4B, where a program has them",
    "sim/cli/convert.py": "writes 3B, whose forms its options name",
    "sim/cli/program.py": "makes 3B, which its help names",
    "sim/jobs/class_marks.py": "endings of programs that pupils hand in",
    "sim/make/lessons.py": "marks of 3B behind blocks whose remarks were left out, where there are words",
    "sim/show/class_page/page.py": "right answers in 3B, which lessons teach",
    "sim/show/lesson_page/assets/block_task.js": "right answers in 3B, which lessons teach",
    "sim/show/lesson_page/assets/rules.html.j2": "the rules of a block of 3B, with pictures",
    "sim/teach/plain/blocks.py": "3B as a page without a parser reads it, held to the parser by tests",
    "sim/teach/kinds.py": "letters that a hand leaves out of blocks, where a program has them",
    "sim/setup/making.py": "asks for 3B, whose forms and codes its settings name",
    "sim/run/ballbar/circle.py": "writes the circle of the test as a 3B program",
    "sim/show/replay/assets/decisions.js": "what a counting controller does in each quadrant, where there are words",
    "sim/show/replay/assets/readouts.js": "the count that is left and the comparison, where a program has words",
    "sim/show/replay/assets/words.js": "a block's words beside its geometry, where a program has them",
    "sim/show/keys.py": "keys of a keyboard, G among them",
    "sim/show/replay/answers.py": "the quiz asks in words of 3B, where a program has them",
    "sim/show/report_page/results.py": "the table of blocks shows the count axis, where a program has words",
}
"""Files behind the parser with tokens of 3B in their texts, docstrings and comments aside, and why."""
_COMMENT = re.compile(r"/\*.*?\*/|\{#.*?#\}|<!--.*?-->|(?<![:\"'])//[^\n]*", re.DOTALL)
"""Comments of scripts and templates."""


def modules() -> Iterator[tuple[str, ast.Module]]:
    return ((path.as_posix(), tree) for path, tree in trees_of("sim", "controller"))


def imported(tree: ast.Module) -> Iterator[str]:
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom):
            yield from (f"{node.module}.{name.name}" for name in node.names)
        elif isinstance(node, ast.Import):
            yield from (name.name for name in node.names)


def texts(tree: ast.Module) -> Iterator[str]:
    nodes = list(ast.walk(tree))
    statements = {id(node.value) for node in nodes if isinstance(node, ast.Expr)}
    for node in nodes:
        if isinstance(node, ast.Constant) and isinstance(node.value, str) and id(node) not in statements:
            yield node.value


DIALECTS = ("parser.threeb", "parser.iso", "parser.pmac")


def test_nothing_behind_the_parser_imports_a_dialect() -> None:
    found = {(path, name) for path, tree in modules() for name in imported(tree) if name.startswith(DIALECTS)}
    assert found == set()


def pages() -> Iterator[tuple[str, str]]:
    """Scripts and templates of pages, without their comments."""
    for package in ("sim", "controller"):
        for path in sorted(path for end in ("js", "j2") for path in (ROOT / package).rglob(f"*.{end}")):
            yield path.relative_to(ROOT).as_posix(), _COMMENT.sub(" ", path.read_text("utf-8"))


def test_few_texts_behind_the_parser_speak_3b() -> None:
    found = {path for path, tree in modules() if any(map(_TOKEN.search, texts(tree)))}
    found |= {path for path, text in pages() if _TOKEN.search(text)}
    assert found == set(_SPEAK_3B)
