"""``drycut compare`` as a user meets it: programs of a CAM against DXF drawings, its document and its table."""

import functools
import json
import math
import random
import re
from pathlib import Path

import click
import numpy as np
import pytest
from command import run_inside
from compare_cases import INCH, circle, die, path_beside, polygon, punch, square, text_of, toolpath, write_dxf
from drawings import Arc, Line
from jsonschema import Draft202012Validator
from places import ROOT
from sound_shapes import SHAPES, Shape, filleted, placed, reverse

from parser.drawing.read import read_drawing
from parser.findings.catalogue import remark_text
from sim.cli.compare import compare as command
from sim.measure.compare.compare import compare_program
from sim.measure.compare.findings import by_entity
from sim.measure.compare.result import Comparison, FitRequest
from sim.run.report.drawing import comparison_document
from sim.setup.part import SharpCorners

PAGE_FILE = ROOT / "docs" / "compare.md"
SCHEMA_FILE = ROOT / "docs" / "compare.schema.json"
_CORNERS = ((0, 0), (30_000, 0), (30_000, 8000), (12_000, 8000), (12_000, 40_000), (0, 40_000))
L_SHAPE = filleted("L", _CORNERS, 500.0, 8000.0)
SHARP = polygon(*_CORNERS)
CONVEX = {"polygon", "rectangle", "slot", "thin", "D", "circle"}
CAM_UM = 1.5
"""A CAM rounds ends to whole µm, and arcs through them by as much again."""


def compared(
    tmp_path: Path,
    text: str,
    *shapes: Shape,
    offset: float = 100.0,
    tolerance: float = 5.0,
    sharp: SharpCorners = "tell",
) -> Comparison:
    drawing = read_drawing(write_dxf(tmp_path / "part.dxf", shapes))
    return compare_program(toolpath(text), offset, drawing, FitRequest(tolerance, sharp_corners=sharp))


def names(found: Comparison) -> list[str]:
    return [named.name for named in found.names]


def test_a_round_hole_is_that_of_the_drawing(tmp_path: Path) -> None:
    found = compared(tmp_path, die(circle(10_000.0)), circle(10_000.0))
    assert found.max_um < 1.3e-3
    assert found.passes
    assert names(found) == []


@pytest.mark.parametrize("make", [punch, die])
def test_punch_and_die_of_one_contour_are_its_drawing(tmp_path: Path, make: object) -> None:
    found = compared(tmp_path, make(L_SHAPE), L_SHAPE)
    assert found.max_um < CAM_UM
    assert names(found) == []
    assert found.notes == ()


@pytest.mark.parametrize(("make", "at"), [(punch, (12_000.0, 8000.0)), (die, (0.0, 0.0))])
def test_a_sharp_inner_corner_is_rounded_by_the_wire(tmp_path: Path, make: object, at: tuple[float, float]) -> None:
    """(√2 − 1) f is left in it: one corner of the punch, and in a die those that are outer ones of the punch."""
    found = compared(tmp_path, make(SHARP), SHARP, sharp="fail")
    assert found.max_um == pytest.approx((math.sqrt(2.0) - 1.0) * 100.0, abs=CAM_UM)
    worst = by_entity(found)
    shift = np.array(found.placement.shift_um)
    near = [place for place in worst if math.dist(np.array(place.where_um) - shift, at) < 100.0]
    assert {place.side for place in near} == {1}
    assert max(place.deviation_um for place in near) > 40.0


@pytest.mark.alike(4)
@pytest.mark.parametrize("seed", range(13))
def test_random_contours_are_their_drawings(tmp_path: Path, seed: int) -> None:
    rng = random.Random(seed)
    shape = placed(
        SHAPES[seed % len(SHAPES)](rng, 20_000.0), rng.choice((0.0, rng.uniform(0, 6.28))), rng.random() < 0.5
    )
    by = 100.0 if shape.name in CONVEX else 0.0  # inner corners are rounded by the wire
    path = path_beside(shape, by)
    found = compared(tmp_path, text_of(path if seed % 2 else reverse(path)), shape, offset=by)
    assert found.max_um < CAM_UM + 2.0 * (shape.name in {"wave", "gear"}), shape.name  # many short arcs drift
    assert "mirrored" not in names(found)


def test_a_turned_and_shifted_drawing_is_found(tmp_path: Path) -> None:
    drawn = placed(L_SHAPE, math.radians(33.0), mirror=False)
    found = compared(tmp_path, punch(L_SHAPE), drawn)
    assert math.degrees(found.placement.turn_rad) == pytest.approx(-33.0, abs=0.01)
    assert names(found) == ["turned"]
    assert found.passes


def test_a_mirrored_program_is_named(tmp_path: Path) -> None:
    found = compared(tmp_path, punch(L_SHAPE), placed(L_SHAPE, 0.0, mirror=True))
    assert names(found) == ["mirrored"]
    assert found.max_um < CAM_UM


@pytest.mark.parametrize("turn", [1, -1])
def test_a_lead_in_from_the_middle_of_a_half_circle_is_inside(tmp_path: Path, turn: int) -> None:
    """It lies on the chord of the arc."""
    hole = [Arc((0.0, -4900.0 * turn), (0.0, 0.0), turn), Arc((0.0, 4900.0 * turn), (0.0, 0.0), turn)]
    path = Shape("hole", (0.0, 4900.0 * turn), hole, 1.0)
    found = compared(tmp_path, text_of(path, (0.0, 0.0), (0.0, 0.0)), circle(5000.0))
    assert found.passes
    assert names(found) == []


@pytest.mark.parametrize("make", [punch, die])
def test_an_offset_to_the_wrong_side_is_named(tmp_path: Path, make: object) -> None:
    found = compared(tmp_path, make(L_SHAPE, by=-100.0), L_SHAPE)
    assert names(found) == ["wrong-side"]
    assert "0.2 mm inside the part" in remark_text(found.names[0])
    assert found.edge_max_um >= 200.0 - CAM_UM
    assert not found.passes


@pytest.mark.parametrize("make", [punch, die])
def test_a_missing_offset_is_named(tmp_path: Path, make: object) -> None:
    found = compared(tmp_path, make(L_SHAPE, by=0.0), L_SHAPE)
    assert names(found) == ["offset-missing"]
    assert "0.1 mm inside the part" in remark_text(found.names[0])


def test_without_a_lead_in_the_side_that_fits_is_taken(tmp_path: Path) -> None:
    for by in (100.0, -100.0):
        found = compared(tmp_path, text_of(path_beside(L_SHAPE, by)), L_SHAPE)
        assert found.passes
        assert any(note.name == "side-tried" for note in found.notes)


def test_a_lead_in_the_part_counts_and_one_in_the_waste_does_not(tmp_path: Path) -> None:
    path = path_beside(square(20_000.0), 100.0)
    waste, part = (-3000.0, -3000.0), (800.0, 900.0)
    assert compared(tmp_path, text_of(path, waste, waste), square(20_000.0)).max_um < CAM_UM
    found = compared(tmp_path, text_of(path, waste, part), square(20_000.0))
    assert names(found) == ["lead-in-part"]
    # The wire ends 0.8 mm inside the nearest side, and cuts 0.1 mm farther.
    assert found.edge_max_um == pytest.approx(900.0, abs=1.0)
    assert not found.passes


def test_a_lead_in_the_part_counts_without_offset(tmp_path: Path) -> None:
    text = text_of(square(20_000.0), (-3000.0, -3000.0), (800.0, 900.0))
    found = compared(tmp_path, text, square(20_000.0), offset=0.0)
    assert found.edge_max_um == pytest.approx(800.0, abs=1.0)


def test_a_drawing_in_inches_read_as_mm_is_named(tmp_path: Path) -> None:
    (tmp_path / "part.3b").write_text(punch(L_SHAPE), "ascii")
    write_dxf(tmp_path / "part.dxf", [L_SHAPE], 25_400.0 + 1e-9)  # numbers are inches, the unit says mm
    done = run_inside("compare", "part.3b", "part.dxf", "--offset", "0.1mm", "--json", cwd=tmp_path)
    result = json.loads(done.stdout)
    assert done.returncode == 1
    assert result["fit"]["scale"] == 25.4
    assert [named["name"] for named in result["names"]] == ["unit-slip"]
    write_dxf(tmp_path / "part.dxf", [L_SHAPE], INCH)  # the unit says inches
    assert run_inside("compare", "part.3b", "part.dxf", "--offset", "0.1mm", cwd=tmp_path).returncode == 0


def test_an_outer_corner_keeps_its_form_under_the_offset(tmp_path: Path) -> None:
    """A fillet of radius 50 drawn, cut by a path with a sharp corner: (√2 − 1) R is left at it."""
    corner = Shape(
        "one fillet",
        (0.0, 0.0),
        [
            Line((20_000, 0)),
            Line((20_000, 19_950)),
            Arc((19_950, 20_000), (19_950, 19_950), 1),
            Line((0, 20_000)),
            Line((0, 0)),
        ],
        1.0,
    )
    found = compared(tmp_path, punch(square(20_000.0)), corner, tolerance=1.0)
    assert found.edge_max_um == pytest.approx((math.sqrt(2.0) - 1.0) * 50.0, abs=0.5)
    assert found.edge_side[found.edge_to_drawing.max_um.argmax()] >= 0


def test_a_layer_is_chosen(tmp_path: Path) -> None:
    (tmp_path / "part.3b").write_text(punch(L_SHAPE), "ascii")
    write_dxf(tmp_path / "part.dxf", [L_SHAPE, square(60_000.0, -9000.0, -9000.0)], layers=["CUT", "PLATE"])
    arguments = ("compare", "part.3b", "part.dxf", "--offset", "0.1mm")
    whole, layer = run_inside(*arguments, cwd=tmp_path), run_inside(*arguments, "--layer", "cut", cwd=tmp_path)
    assert (whole.returncode, layer.returncode) == (1, 0)
    hint = "note: the drawing: all layers are compared: CUT, PLATE; --layer takes one"
    assert hint in whole.stdout.decode()
    assert "--layer" not in layer.stdout.decode()


def test_a_drawing_that_does_not_close_is_said(tmp_path: Path) -> None:
    loose = Shape("line", (-2000.0, 0.0), [Line((0.0, 3000.0))], 1.0)
    found = compared(tmp_path, punch(L_SHAPE), L_SHAPE, loose)
    assert [remark_text(note) for note in found.notes] == ["the drawing: 1 of 2 chains of curves do not close"]


def test_the_tolerance_decides_the_exit_code(tmp_path: Path) -> None:
    (tmp_path / "part.3b").write_text(die(circle(10_000.0)), "ascii")
    write_dxf(tmp_path / "part.dxf", [circle(10_004.0)])
    arguments = ("compare", "part.3b", "part.dxf", "--offset", "0.1mm")
    plain, tight = run_inside(*arguments, cwd=tmp_path), run_inside(*arguments, "--tolerance", "3.9um", cwd=tmp_path)
    assert (plain.returncode, tight.returncode) == (0, 1)
    assert plain.stdout.decode().splitlines()[-1] == "verdict: pass, 4.000 µm of 5.000 µm allowed"
    assert tight.stdout.decode().splitlines()[-1] == "verdict: fail, 4.000 µm of 3.900 µm allowed"


def test_in_place_a_shift_is_a_deviation(tmp_path: Path) -> None:
    (tmp_path / "part.3b").write_text(text_of(square(20_000.0)), "ascii")
    write_dxf(tmp_path / "part.dxf", [square(20_000.0, 30.0, 0.0)])
    arguments = ("compare", "part.3b", "part.dxf", "--offset", "0um", "--json")
    fitted = json.loads(run_inside(*arguments, cwd=tmp_path).stdout)
    assert fitted["fit"]["shift_um"] == [-30.0, 0.0]
    in_place = json.loads(run_inside(*arguments, "--no-fit", cwd=tmp_path).stdout)
    assert in_place["edge_to_drawing"]["max_um"] == 30.0
    assert in_place["fit"] == {"fitted": False, "turn_deg": 0.0, "shift_um": [0.0, 0.0], "mirror": False, "scale": 1.0}


def test_the_offset_is_told_by_the_option_the_header_or_the_wire(tmp_path: Path) -> None:
    write_dxf(tmp_path / "part.dxf", [circle(10_000.0)])
    for header, by, said in (
        ("Conner R= 0.0 , Offset F= 0.12 ,Length= 62.1 mm\n", 120.0, "header"),
        ("", 100.0, "wire"),
    ):
        (tmp_path / "part.3b").write_text(header + die(circle(10_000.0), by=by), "ascii")
        done = run_inside("compare", "part.3b", "part.dxf", cwd=tmp_path)
        assert done.returncode == 0
        assert said in done.stdout.decode()


@pytest.mark.parametrize(
    ("args", "message"),
    [
        (["part.3b", "none.dxf"], "none.dxf"),
        (["none.3b", "part.dxf"], "none.3b"),
        (["part.3b", "part.3b"], "part.3b"),
        (["part.3b", "part.dxf", "--layer", "X"], "layer"),
        (["part.3b", "part.dxf", "--tolerance", "0um"], "--tolerance"),
        (["part.3b", "part.dxf", "--offset", "-0.1mm"], "--offset"),
        (["part.3b", "part.dxf", "--offset", "0.1"], "no length"),
        (["part.3b", "part.dxf", "--gap", "-1um"], "--gap"),
        (["part.3b", "part.dxf", "--gap", "1m"], "--gap"),
        (["part.3b", "part.dxf", "--tolerance", "2m"], "--tolerance"),
        (["part.3b", "part.dxf", "--offset", "11mm"], "--offset"),
        (["part.3b", "part.dxf", "--offset", "10mm"], "leaves no edge"),
        (["open.3b", "part.dxf"], "no contour of the program closes a loop"),
        (["part.3b"], "Missing argument"),
    ],
)
def test_bad_use_exits_2_with_one_clear_line(tmp_path: Path, args: list[str], message: str) -> None:
    (tmp_path / "part.3b").write_text(punch(L_SHAPE), "ascii")
    (tmp_path / "open.3b").write_text("B1000B0B1000GXL1\nDD\n", "ascii")
    write_dxf(tmp_path / "part.dxf", [L_SHAPE])
    done = run_inside("compare", *args, cwd=tmp_path)
    assert (done.returncode, done.stdout) == (2, b"")
    assert message in done.stderr.decode()
    assert len(done.stderr.splitlines()) == 1


def test_a_scenario_is_compared_by_its_own_wire(tmp_path: Path) -> None:
    write_dxf(tmp_path / "part.dxf", [circle(10_000.0)])
    done = run_inside("compare", ROOT / "scenarios" / "round-hole", tmp_path / "part.dxf")
    assert done.returncode == 0, done.stdout.decode()


@pytest.mark.parametrize("name", ["punch", "die"])
def test_the_offset_that_a_controller_adds_is_part_of_the_path(name: str) -> None:
    """The program runs on the drawing's contour."""
    scenario = ROOT / "scenarios" / name
    done = run_inside("compare", scenario, scenario / "drawing.dxf", "--tolerance", "0.01um")
    assert done.returncode == 0, done.stdout.decode()


@functools.cache
def _validator() -> Draft202012Validator:
    schema = json.loads(SCHEMA_FILE.read_text(encoding="utf-8"))
    Draft202012Validator.check_schema(schema)
    return Draft202012Validator(schema)


def complaints(result: object) -> list[str]:
    return [f"{error.json_path}: {error.message}" for error in _validator().iter_errors(result)]


@pytest.fixture(scope="module")
def documents(tmp_path_factory: pytest.TempPathFactory) -> list[dict[str, object]]:
    folder = tmp_path_factory.mktemp("documents")
    gouging = text_of(path_beside(square(20_000.0), 100.0), (-3000.0, -3000.0), (800.0, 900.0))
    cases = [(punch(L_SHAPE), L_SHAPE), (gouging, square(20_000.0)), (die(L_SHAPE, by=-100.0), L_SHAPE)]
    return [comparison_document(compared(folder, text, shape)) for text, shape in cases]


def test_every_outcome_fits_the_schema(documents: list[dict[str, object]]) -> None:
    assert [complaints(result) for result in documents] == [[], [], []]
    assert [result["verdict"] for result in documents] == ["pass", "fail", "fail"]


def test_the_schema_refuses_a_key_more_or_less(documents: list[dict[str, object]]) -> None:
    result = json.loads(json.dumps(documents[1]))
    nodes = (result, result["fit"], result["edge_to_drawing"], result["names"][0], result["worst"][0])
    for node in (*nodes, result["blocks"][0], result["entities"][0], result["drawing"]):
        for key in list(node):
            value = node.pop(key)
            assert complaints(result), key
            node[key] = value
        node["surplus"] = 1
        assert complaints(result)
        del node["surplus"]
    assert complaints(result) == []


def test_the_document_agrees_with_itself(documents: list[dict[str, object]]) -> None:
    for result in documents:
        assert result["edge_to_drawing"]["max_um"] == max(block["max_um"] for block in result["blocks"])
        assert result["drawing_to_edge"]["max_um"] == max(entity["max_um"] for entity in result["entities"])
        assert result["max_um"] == result["worst"][0]["max_um"]


def test_the_same_comparison_gives_the_same_bytes(tmp_path: Path) -> None:
    (tmp_path / "part.3b").write_text(punch(L_SHAPE), "ascii")
    write_dxf(tmp_path / "part.dxf", [L_SHAPE])
    one, other = (run_inside("compare", "part.3b", "part.dxf", "--json", cwd=tmp_path).stdout for _ in range(2))
    assert one == other


def test_keys_and_options_are_documented(documents: list[dict[str, object]]) -> None:
    def keys(node: object) -> set[str]:
        if isinstance(node, dict):
            return set(node) | {key for value in node.values() for key in keys(value)}
        return {key for entry in node for key in keys(entry)} if isinstance(node, list) else set()

    page = PAGE_FILE.read_text(encoding="utf-8")
    text = re.sub(r"^```.*?^```$", "", page, flags=re.MULTILINE | re.DOTALL)
    named = set(re.findall(r"[\w-]+", " ".join(re.findall(r"`([^`]+)`", text))))
    assert keys(documents) - named == set()
    assert {"mirrored", "turned", "unit-slip", "wrong-side", "offset-missing", "lead-in-part"} - named == set()
    written = re.findall(r"^\| `(--[\w-]+)", page, flags=re.MULTILINE)
    assert set(written) == {option.opts[0] for option in command.params if isinstance(option, click.Option)}


def test_the_table_fits_a_narrow_terminal(tmp_path: Path) -> None:
    (tmp_path / "part.3b").write_text(die(L_SHAPE, by=-100.0), "ascii")
    write_dxf(tmp_path / "part.dxf", [L_SHAPE])
    done = run_inside("compare", "part.3b", "part.dxf", "--offset", "0.1mm", cwd=tmp_path, COLUMNS="80")
    printed = done.stdout.decode()
    table = [line for line in printed.splitlines() if line.startswith(("│", "┃"))]
    assert max(len(line) for line in table) <= 80
    assert "error: the program runs on the wrong side of the contour" in printed
    assert np.all(["gouged" in line for line in table if "mm " in line and "cut edge" in line])


def test_a_scenarios_own_drawing_is_taken_where_none_is_given(tmp_path: Path) -> None:
    folder = tmp_path / "case"
    folder.mkdir()
    (folder / "program.3b").write_text(punch(L_SHAPE), "ascii")
    write_dxf(folder / "own.dxf", [L_SHAPE])
    write_dxf(tmp_path / "other.dxf", [square(20_000.0)])
    (folder / "scenario.toml").write_text('[drawing]\nfile = "own.dxf"\ntolerance_um = 50', "utf-8")
    own = json.loads(run_inside("compare", "case", "--json", cwd=tmp_path).stdout)
    assert (own["verdict"], own["tolerance_um"], own["fit"]["fitted"]) == ("pass", 50.0, True)
    assert own["drawing"]["name"] == "own.dxf"
    other = json.loads(run_inside("compare", "case", "other.dxf", "--tolerance", "7um", "--json", cwd=tmp_path).stdout)
    assert (other["verdict"], other["tolerance_um"], other["drawing"]["name"]) == ("fail", 7.0, "other.dxf")
    bare = run_inside("compare", "case/program.3b", cwd=tmp_path)
    assert (bare.returncode, bare.stdout) == (2, b"")
    assert b"DRAWING.dxf" in bare.stderr
