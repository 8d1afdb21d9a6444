"""Programs on file: the real ones are sound, every spelling is read, every fault is named at its place.

Beside the files stand the expectations, worked out from docs/3b.md and docs/iso.md: ``spellings/expected.json`` with
the words ``X Y J axis Z`` of each file, ``faults/expected.json`` with the findings ``[code, line, column, block]``,
``faults/told.json`` with what they say: ``[code, values, edits]``, lengths in µm.
"""

import json
from pathlib import Path
from typing import Any

import pytest
from places import CORPUS

from parser.findings.codes import CODES
from parser.findings.findings import Finding
from parser.program import Program, read_program
from sim.check.file_check import Job, check_file
from sim.check.settings import CheckSettings
from sim.setup.machine.machine import load_machine

SPELLINGS: dict[str, dict[str, Any]] = json.loads((CORPUS / "spellings/expected.json").read_text(encoding="utf-8"))
FAULTS: dict[str, dict[str, Any]] = json.loads((CORPUS / "faults/expected.json").read_text(encoding="utf-8"))
TOLD: dict[str, list[Any]] = json.loads((CORPUS / "faults/told.json").read_text(encoding="utf-8"))
_SENSES = {0: "L", 1: "NR", -1: "SR"}
_OF_A_RUN = {code for code, of in CODES.items() if of.check is None}
_ON_PAGES = {"ISO217", "ISO219", "ISO306", "ISO307", "ISO308", "ISO309", "ISO514"}  # as the examples of their pages
_OF_HEIGHTS = {code for code in CODES if code.startswith("3B7")}  # what a check sees that is told heights
_NEEDS_MORE = {"3B303"} | _OF_A_RUN | _OF_HEIGHTS  # a block that no search has found yet; what a check cannot see


def words(program: Program) -> list[str]:
    of = program.toolpath.words
    columns = zip(of.x_um, of.y_um, of.count_um, of.count_axis, of.turn, of.quadrant, strict=True)
    return [f"{x} {y} {j} {'XY'[axis]} {_SENSES[int(turn)]}{quadrant}" for x, y, j, axis, turn, quadrant in columns]


def facts(program: Program) -> dict[str, Any]:
    """All that a spelling may say about its program."""
    toolpath, header = program.toolpath, program.header
    return {
        "encoding": program.encoding,
        "dialect": program.reading.dialect,
        "words": words(program),
        "radius_um": toolpath.words.radius_um.tolist(),
        "curve": toolpath.words.curve.tolist(),
        "labels": list(toolpath.source.label),
        "lines": toolpath.source.line.tolist(),
        "ends_um": [[round(x, 3), round(y, 3)] for x, y in toolpath.end_um.tolist()],
        "printed_um": toolpath.printed_end_um.tolist(),
        "jumps": [block.number for block in toolpath if toolpath.is_jump[block.number - 1]],
        "stops": [[stop.kind, stop.after] for stop in toolpath.stops],
        "header": {
            **header,
            "lengths_um": [round(length_um, 3) for length_um in header["lengths_um"]],
        },
    }


def findings(file: Path) -> list[list[Any]]:
    return [placed(finding) for finding in check_file(Job(file.name, file, CheckSettings())).findings]


def placed(finding: Finding) -> list[Any]:
    return [finding.code, finding.line, finding.column, finding.block]


def told(finding: Finding) -> list[Any]:
    values = {
        name: pytest.approx(value, abs=5e-4) if isinstance(value, float) else value
        for name, value in finding.values.items()
    }
    return [finding.code, values, [list(edit) for edit in finding.edits]]


@pytest.mark.parametrize("name", ["keyhole.3b", "round-hole.3b"])
def test_real_programs_are_sound(name: str) -> None:
    assert [code for code, *_ in findings(CORPUS / "real" / name)] == (["3B102"] if name == "round-hole.3b" else [])
    scenario = CORPUS.parents[1] / "scenarios" / name.removesuffix(".3b") / "program.3b"
    assert (CORPUS / "real" / name).read_bytes() == scenario.read_bytes()


@pytest.mark.parametrize("name", SPELLINGS)
def test_every_spelling_is_read(name: str) -> None:
    program, expected = read_program(CORPUS / "spellings" / name), dict(SPELLINGS[name])
    codes, header = expected.pop("codes"), expected.pop("header", {})
    found = facts(program)
    assert {key: found[key] for key in expected} == expected
    assert {key: found["header"][key] for key in header} == header
    assert [code for code, *_ in findings(CORPUS / "spellings" / name)] == codes


@pytest.mark.parametrize("name", FAULTS)
def test_every_fault_is_named_at_its_place_with_its_figures(name: str) -> None:
    known = dict(FAULTS[name].get("settings", {}))
    machine = {"machine": load_machine(known.pop("machine"))} if "machine" in known else {}
    found = check_file(Job(name, CORPUS / "faults" / name, CheckSettings(**known, **machine))).findings
    assert [placed(finding) for finding in found] == FAULTS[name]["findings"]
    assert [told(finding) for finding in found] == TOLD[name]


def test_every_file_has_its_expectation() -> None:
    for folder, expected in (("spellings", SPELLINGS), ("faults", FAULTS), ("faults", TOLD)):
        files = {file.name for file in (CORPUS / folder).iterdir() if file.suffix != ".json"}
        assert files == set(expected)


def test_every_code_has_a_fault_on_file() -> None:
    assert {name.partition("-")[0] for name in FAULTS} == set(CODES) - _NEEDS_MORE - _ON_PAGES
