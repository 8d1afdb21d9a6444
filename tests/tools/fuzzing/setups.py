"""Targets `scenario`, `machine`, `settings` and `baseline`: files of TOML and JSON, read, written and read again."""

import difflib
import json
import random
from collections.abc import Iterator, Mapping
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

from places import MACHINES, SCENARIOS

from fuzzing.mutate import damaged
from fuzzing.ran import answer_of, broken_by, ran
from fuzzing.target import Input, Judged
from fuzzing.toml_trees import change, fuzzed_toml
from parser.findings.catalogue import texts
from parser.findings.errors import DrycutError
from parser.program import parse_program
from sim.run.findings import expectation_findings
from sim.run.report import build_report
from sim.run.running import dry_run
from sim.setup.expectations import missed
from sim.setup.machine import machine as machines
from sim.setup.machine.machine import load_machine, machine_sections
from sim.setup.scenario import MACHINE_FILE, SECTIONS, Scenario, load_scenario, scenario_sections
from sim.setup.toml.keys import toml_text

_SETTINGS = (
    'machine = "dk7740"\nstart_mm = [120.0, 200.0]\nfail_on = "warning"\nignore = ["3B102"]\nend_marks = ["E"]\n'
    "[wire]\ndiameter_mm = 0.18\n",
    'root = true\nopen = true\nselect = ["3B2", "3B301"]\npause_marks = ["M"]\nend_marks = ["MJ", "FF"]\n'
    'exclude = ["old", "**/try/*", "[!a]?"]\n[wire]\nspark_gap_mm = 0.02\n[per_file_ignores]\n"p*.3b" = ["3B301"]\n',
    'baseline = "known.json"\ninclude = ["O[0-9]*"]\ndialect = "makino"\n[dialects.makino]\nextends = "fanuc"\n'
    '[dialects.makino.g]\n145 = "switch"\n',
    '[tool.drycut]\nmachine = "machine.toml"\n[tool.other]\nx = 1\n',
)
_SETTINGS_NAMES = (
    *(
        "machine",
        "start_mm",
        "open",
        "select",
        "dialect",
        "dialects",
        "include",
        "ignore",
        "fail_on",
        "end_marks",
        "pause_marks",
        "wire",
        "diameter_mm",
    ),
    *(
        "*",
        "[",
        "**/" * 50,
        "*a" * 50,
        "[" * 90,
        "spark_gap_mm",
        "tool",
        "drycut",
        "root",
        "per_file_ignores",
        "exclude",
        "baseline",
    ),
)
_PATHS = (
    *(
        "blocks.0.exact.end_um",
        "blocks.²",
        "blocks.0.exact.end_um.x",
        "blocks.kind.x",
        "summary.steps.0",
        "findings",
        "",
    ),
    *(
        "blocks." + "9" * 5000,
        "blocks.-1.kind",
        ".",
        "..",
        "contours.0.closure_exact_um",
        "blocks",
        "scenario.machine.name",
    ),
)
_BASELINE = (
    b'{"schema": "drycut.baseline/1", "files": {"part.3b": {"0123456789abcdef": "3B204", "f": "3B301"}, "x/y": {}}}'
)
_FILES = "scenario.toml", MACHINE_FILE
PROGRAM = "B100B0B100GXL1\nB0B100B100GYL2\nB100B0B100GXL3\nB0B100B99GYL4\nDD\n"
_DRAWING = SCENARIOS / "round-hole" / "drawing.dxf"


@cache
def _seeds(pattern: str) -> tuple[bytes, ...]:
    return tuple(file.read_bytes() for folder in (SCENARIOS, MACHINES) for file in sorted(folder.glob(pattern)))


@cache
def _names() -> tuple[str, ...]:
    """All keys and sections of scenario and machine files."""
    sections = (*SECTIONS, *machines.SECTIONS)
    return (*(section.name for section in sections), *(key.name for section in sections for key in section.keys))


def make_scenario(rng: random.Random) -> Input:
    """A scenario file."""
    return fuzzed_toml(rng, _seeds("*/scenario.toml"), (*_names(), *_PATHS))


def make_machine(rng: random.Random) -> Input:
    """A machine file."""
    return fuzzed_toml(rng, (*_seeds("*/machine.toml"), *_seeds("*.toml")), _names())


def make_settings(rng: random.Random) -> Input:
    """A settings file."""
    return fuzzed_toml(rng, tuple(text.encode() for text in _SETTINGS), _SETTINGS_NAMES)


def make_baseline(rng: random.Random) -> Input:
    """A file of known findings."""
    if rng.random() < 0.1:
        return damaged(rng, _BASELINE, (_BASELINE,))
    tree = json.loads(_BASELINE)
    for _ in range(rng.choice((1, 1, 2, 4))):
        change(rng, tree, tuple(text.encode() for text in _SETTINGS), ("files", "schema", "part.3b", "3B204"))
    if rng.random() < 0.02:
        tree["files"] = "DEEP"
    depth = rng.choice((100, 990, 5000, 100_000))
    try:
        return json.dumps(tree, default=str).replace('"DEEP"', "[" * depth + "]" * depth).encode()
    except ValueError:  # of more digits than Python writes
        return f'{{"files": {"9" * 5000}}}'.encode()


def judge_baseline(data: Input, _: int, folder: Path) -> Judged:
    """A check with known findings is refused in a line, or comes to its end."""
    assert isinstance(data, bytes)
    (folder / "known.json").write_bytes(data)
    (folder / "part.3b").write_text(PROGRAM, encoding="utf-8")
    done = ran(("check", "part.3b", "--baseline", "known.json", "--no-config"), folder)
    return Judged(answer_of(done, folder), list(broken_by(done, folder)), f"exit {done.returncode}")


def judge_scenario(data: Input, number: int, folder: Path) -> Judged:
    """A scenario is read or refused in a line; what was read is written so that it is read alike."""
    assert isinstance(data, bytes)
    (folder / "scenario.toml").write_bytes(data)
    (folder / "program.3b").write_text(PROGRAM, encoding="utf-8")
    (folder / "drawing.dxf").write_bytes(_DRAWING.read_bytes())
    (folder / MACHINE_FILE).write_bytes(_seeds("*/machine.toml")[number % 3])
    try:
        found = load_scenario(folder)
    except DrycutError as error:
        return refused(error, folder)
    wanted = [texts(finding) for finding in expectation_findings(missed(_report(), found.expect))]
    return Judged(repr((found, wanted)).replace(str(folder), "HERE"), [*_of_writing(found, folder)], "read")


@cache
def _report() -> Mapping[str, Any]:
    """A report that expectations are held against."""
    machine = load_machine(str(SCENARIOS / "out-of-travel" / MACHINE_FILE))
    scenario = replace(load_scenario(SCENARIOS / "out-of-travel"), machine=machine, expect=())
    return build_report(dry_run(parse_program(PROGRAM), scenario))


def _of_writing(found: Scenario, folder: Path) -> Iterator[str]:
    """The files of a scenario are read again, and then written as they are."""
    first = _written(found)
    for name, text in zip(_FILES, first, strict=True):
        (folder / name).write_text(text, encoding="utf-8")
    try:
        second = _written(load_scenario(folder))
    except DrycutError as error:
        yield f"is refused when written: {str(error).replace(str(folder), '')[-300:]}"
        return
    for one, other in zip(first, second, strict=True):
        if one != other:
            yield from (
                f"is written otherwise: {line}"
                for line in difflib.ndiff(one.splitlines(), other.splitlines())
                if line[:1] in "+-"
            )


def _written(scenario: Scenario) -> tuple[str, str]:
    return toml_text(scenario_sections(scenario)), toml_text(machine_sections(scenario.machine))


def judge_machine(data: Input, _: int, folder: Path) -> Judged:
    """A machine is read or refused in a line; what was read is written so that it is read alike."""
    assert isinstance(data, bytes)
    file = folder / MACHINE_FILE
    file.write_bytes(data)
    try:
        found = load_machine(str(file))
    except DrycutError as error:
        return refused(error, folder)
    first = toml_text(machine_sections(found))
    file.write_text(first, encoding="utf-8")
    try:
        second = toml_text(machine_sections(load_machine(str(file))))
    except DrycutError as error:
        return Judged(repr(found), [f"is refused when written: {str(error)[-300:]}"], "read")
    return Judged(repr(found), [] if first == second else ["is written otherwise"], "read")


def judge_settings(data: Input, number: int, folder: Path) -> Judged:
    """The check of a program beside a settings file is refused in a line, or comes to its end."""
    assert isinstance(data, bytes)
    here = folder / str(number)  # settings are read once for each folder
    here.mkdir()
    (here / ("pyproject.toml" if number % 4 == 3 else "drycut.toml")).write_bytes(data)
    (here / "part.3b").write_text(PROGRAM, encoding="utf-8")
    (here / MACHINE_FILE).write_bytes(_seeds("*/machine.toml")[number % 3])
    done = ran(("check", "part.3b"), here)
    return Judged(answer_of(done, folder), list(broken_by(done, here)), f"exit {done.returncode}")


def refused(error: DrycutError, folder: Path) -> Judged:
    text = str(error)
    return Judged(text.replace(str(folder), "HERE"), [] if text.strip() else ["refused without a word"], "refused")
