"""``drycut program --json``: its schema, and its figures against what was made."""

import copy
import json
from collections.abc import Callable
from dataclasses import replace
from itertools import pairwise
from pathlib import Path
from typing import Any

import pytest
from drawings_dxf import drawn
from jsonschema import Draft202012Validator
from made_programs import plate_file
from places import ROOT
from runs import plain_scenario

from parser.drawing.model import LeftOut
from parser.findings.catalogue import Remark
from sim.make.cam.document import document, document_text
from sim.make.cam.maker import MadeProgram, NotMade, made_program, unproved
from sim.make.cam.model import FigureCut
from sim.make.wanted import Wanted
from sim.setup.making import Making
from sim.show.terminal.program import told_lines
from sim.show.texts import Words

SCHEMA = json.loads((ROOT / "docs" / "program.schema.json").read_text(encoding="utf-8"))
VALIDATOR = Draft202012Validator(SCHEMA)
PAGE = (ROOT / "docs" / "program.md").read_text(encoding="utf-8")
SAY = Words("en")


def complaints(entry: object) -> list[str]:
    return [f"{error.json_path}: {error.message}" for error in VALIDATOR.iter_errors(entry)]


@pytest.fixture(name="done", scope="module")
def made_plate(tmp_path_factory: pytest.TempPathFactory) -> MadeProgram:
    path = plate_file(tmp_path_factory.mktemp("plate"))
    done = made_program(path, Making(), Wanted("3b"), plain_scenario())
    assert isinstance(done, MadeProgram)
    return done


@pytest.fixture(name="entry", scope="module")
def entry_of_plate(done: MadeProgram) -> dict[str, Any]:
    entry: dict[str, Any] = json.loads(document_text(done, SAY))
    return entry


def test_a_proved_program_fits_its_schema(entry: dict[str, Any]) -> None:
    Draft202012Validator.check_schema(SCHEMA)
    assert complaints(entry) == []
    assert entry["made"]
    assert entry["proof"]["verdict"] == "pass"
    assert entry["proof"]["pieces"] == {"parts": 1, "slugs": 2}
    assert max(entry["proof"]["edge_to_drawing_um"], entry["proof"]["drawing_to_edge_um"]) < 5.0
    assert [one["kind"] for one in entry["figures"]] == ["hole", "hole", "outline"]


def test_blocks_of_figures_are_those_of_the_text(done: MadeProgram, entry: dict[str, Any]) -> None:
    blocks = [one["blocks"] for one in entry["figures"]]
    assert blocks[0][0] == 1
    assert blocks[-1][1] == int(done.program.toolpath.source.block[-1])
    assert all(before[1] < behind[0] for before, behind in pairwise(blocks))


def test_what_was_not_run_has_no_times(tmp_path: Path) -> None:
    done = unproved(plate_file(tmp_path), Making(), Wanted("3b"), plain_scenario())
    entry = json.loads(document_text(done, SAY))
    assert complaints(entry) == []
    assert (entry["proof"], entry["time_s"], entry["figures"][0]["passes"][0]["time_s"]) == (None, None, None)


def test_a_refusal_is_told_with_its_places(tmp_path: Path) -> None:
    path = drawn(tmp_path, lambda space: space.add_line((0, 0), (30, 0)))
    done = made_program(path, Making(), Wanted("3b"), plain_scenario())
    assert isinstance(done, NotMade)
    entry = json.loads(document_text(done, SAY))
    assert complaints(entry) == []
    assert not entry["made"]
    assert entry["refusal"]["why"] == done.refusal.why
    assert entry["refusal"]["text"]
    assert "{" not in entry["refusal"]["text"]


def test_the_fit_is_held_to_what_was_asked_and_not_to_how_near_it_was_tried(done: MadeProgram) -> None:
    fit = done.plan.drawing.fit
    assert fit is not None
    drawing = replace(done.plan.drawing, fit=fit._replace(tolerance_um=1.76))
    nearer = done._replace(plan=done.plan._replace(drawing=drawing))
    assert document(nearer, SAY)["fit"]["tolerance_um"] == Making().tolerance_um == 2.0
    assert not [line for line in told_lines(nearer.plan, "en", 80) if "1.76" in line]


def test_what_is_wrong_with_an_entity_and_how_far_it_is_from_closing_is_told_once(done: MadeProgram) -> None:
    entity = done.plan.drawing.entities[0]
    wrong = Remark("spline-degree", {"entity": "SPLINE A", "degree": 0})
    left = (LeftOut(entity, "unreadable", detail=wrong), LeftOut(entity, "open", (0.0, 0.0), 2500.0))
    drawing = replace(done.plan.drawing, notes=(wrong, Remark("unreadable", {"kinds": "1 SPLINE"})))
    plan = done.plan._replace(left_out=left, drawing=drawing)
    entry = document(done._replace(plan=plan), SAY)
    assert complaints(entry) == []
    assert [one["detail"] for one in entry["left_out"]] == ["SPLINE A: degree 0; expected 1 or more", None]
    assert [one["gap_um"] for one in entry["left_out"]] == [None, 2500.0]
    told = " ".join(line.strip() for line in told_lines(plan, "en", 80))
    assert told.count("degree 0") == 1
    assert "2.5 mm away" in told
    assert "note:" not in told


def test_figures_in_a_row_are_told_as_a_range(done: MadeProgram) -> None:
    cut = next(cut for cut in done.plan.cuts if cut.thread.by == "chosen")
    cuts = tuple(replace_number(cut, number) for number in (9, 4, 3, 2, 1, 7, 6))
    (line,) = [line for line in told_lines(done.plan._replace(cuts=cuts), "en", 200) if line.startswith("chosen")]
    assert line.startswith("chosen: thread points of 1–4, 6, 7, 9; ")


def replace_number(cut: FigureCut, number: int) -> FigureCut:
    return cut._replace(figure=cut.figure._replace(number=number))


@pytest.mark.alike(1)
@pytest.mark.parametrize("language", ["en", "zh"])
def test_what_fails_is_told_in_both_languages(tmp_path: Path, language: str) -> None:
    done = made_program(plate_file(tmp_path), Making(passes_um=(300.0, 280.0)), Wanted("3b"), plain_scenario())
    entry = document(done, Words(language))
    assert complaints(entry) == []
    assert entry["proof"]["verdict"] != "pass"
    assert entry["proof"]["unproved"]


@pytest.mark.parametrize(
    "spoil",
    [
        lambda entry: entry.update(more=1),
        lambda entry: entry.pop("notes"),
        lambda entry: entry.update(made=False),
        lambda entry: entry["figures"][0].update(kind="slot"),
        lambda entry: entry["figures"][0]["passes"].clear(),
        lambda entry: entry["proof"].update(unproved=["something"]),
        lambda entry: entry["proof"]["findings"][0].update(severity="error"),
        lambda entry: entry["proof"].update(path_um=-1.0),
    ],
)
def test_the_schema_is_strict(entry: dict[str, Any], spoil: Callable[[dict[str, Any]], object]) -> None:
    spoiled = copy.deepcopy(entry)
    spoil(spoiled)
    assert complaints(spoiled) != []
