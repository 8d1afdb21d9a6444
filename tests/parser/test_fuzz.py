"""Any input gets an answer: what `make fuzz` tries on many, on a few of each kind; and programs bad on purpose."""

import time
import zlib
from pathlib import Path

import pytest
from depth import cases
from fuzzing import iso_text
from fuzzing.program_text import SEEDS
from fuzzing.programs import judge
from fuzzing.target import SEED
from fuzzing.targets import TARGETS
from fuzzing.worker import Task, tried
from hostile import HOSTILE
from places import CORPUS

from parser.findings.codes import Severity
from sim.check.file_check import Job, check_file
from sim.check.settings import CheckSettings

SLOWEST_S = 10.0
"""Of processor time; each takes less than 0.5 s. Machines of build servers may be slow."""


INPUTS = {
    **{
        "read": 200,
        "program": 120,
        "fix": 15,
        "iso": 100,
        "iso-fix": 10,
        "convert": 20,
        "scenario": 200,
        "machine": 200,
        "settings": 60,
        "baseline": 40,
        "dialect": 60,
        "trace": 100,
        "loop": 100,
        "results": 30,
        "editor": 60,
        "card": 200,
        "dxf": 60,
    },
    **{"pmac": 100, "compare": 3, "make": 3, "command": 30, "run": 4, "iso-run": 4},
}
"""How many of each kind are tried; `make fuzz` tries a million."""


@pytest.mark.alike(6)
@pytest.mark.parametrize("name", TARGETS)
def test_any_input_gets_an_answer(name: str, tmp_path: Path) -> None:
    task = Task(TARGETS[name], SEED, 0, len(cases(max(INPUTS[name] // 2, 2), INPUTS[name])))
    broken = {number: tried(task, number, tmp_path / "input")[0] for number in range(task.past)}
    assert {number: promises for number, promises in broken.items() if promises} == {}


@pytest.mark.parametrize("path", sorted((CORPUS / "odd").iterdir()), ids=lambda path: path.name)
def test_an_input_that_once_broke_a_promise_gets_an_answer(path: Path, tmp_path: Path) -> None:
    data = path.read_bytes()
    number = zlib.crc32(data)
    target = TARGETS[path.name.partition("-")[0]]
    broken, _ = tried(Task(target, SEED, number, number + 1, data), number, tmp_path / "input")
    assert broken == []


@pytest.mark.alike(5)
@pytest.mark.deep
@pytest.mark.parametrize("name", HOSTILE)
def test_hostile_programs_end_in_bounded_time(name: str) -> None:
    begin = time.process_time()
    text = HOSTILE[name](len(cases(2_000, 10_000)))
    result = check_file(Job("hostile.3b", text.encode(), CheckSettings()))
    assert time.process_time() - begin < SLOWEST_S
    assert result.coverage.checks


@pytest.mark.deeper
def test_a_figure_that_is_never_left_takes_no_square_of_its_pauses() -> None:
    text = HOSTILE["20,000 circles with a jump of 1 µm"](50_000)
    begin = time.process_time()
    check_file(Job("hostile.3b", text.encode(), CheckSettings()))
    assert time.process_time() - begin < SLOWEST_S


@pytest.mark.parametrize("text", [*SEEDS, *iso_text.SEEDS[:-1]])
def test_the_programs_that_are_fuzzed_are_read_to_their_last_block(text: str) -> None:
    cover = check_file(Job("seed.3b", text.encode(), CheckSettings())).coverage
    assert cover.read == cover.found > 0


def test_a_hidden_finding_still_keeps_a_mend_from_being_certain() -> None:
    # The second side of an open square counts on the wrong axis as well: how far it should go is not known.
    text = b"B10000B0B10000GXL1\nB9000B8000B8000GYL2\nB10000B0B10000GXL3\nB0B5000B5000GYL4\nDD\n"
    shown = check_file(Job("a.3b", text, CheckSettings(ignore=("3B301",))))
    everything = check_file(Job("a.3b", text, CheckSettings()))
    assert everything.count(Severity.ERROR) > 0
    edits = {finding.code: finding.edits for finding in everything.findings}
    assert all(edits[finding.code] == finding.edits for finding in shown.findings)


def test_a_4b_block_behind_a_damaged_block_keeps_its_radius() -> None:
    text = b"B10B0B10GXL1\nB10B0B10GXL3\nB9900B0B395\nB0B5000B10000B5000DGXNR4\nDD\n"
    assert judge(text, 0, Path()).broken == []


@pytest.mark.parametrize(
    ("bad", "named"),
    [
        ("N2: B0 B10000 B10000 GYL2;10.000,1.000", {"3B207"}),  # its printed end alone is wrong
        ("N2: B0 B10000 B10090 GYL2;10.000,10.000", {"3B217"}),  # its J alone is wrong
    ],
)
def test_a_printed_end_accuses_one_block(bad: str, named: set[str]) -> None:
    text = (
        f"N1: B10000 B0 B10000 GXL1;10.000,0.000\n{bad}\n"
        "N3: B10000 B0 B10000 GXL3;0.000,10.000\nN4: B0 B10000 B10000 GYL4;0.000,0.000\nDD\n"
    )
    findings = check_file(Job("a.3b", text.encode(), CheckSettings())).findings
    assert named <= {finding.code for finding in findings}
    assert {finding.line for finding in findings if finding.code in {"3B207", "3B217"}} == {2}
    assert judge(text.encode(), 0, Path()).broken == []
    if named == {"3B207"}:
        assert [finding.edits for finding in findings] == [()]


def test_a_length_behind_the_end_code_is_no_fault_of_the_program() -> None:
    text = f"{SEEDS[0]}{SEEDS[0]}Start Point = 0.0 , 0.0 ; Length = 40.0\n{SEEDS[0]}".encode()
    assert judge(text, 0, Path()).broken == []
