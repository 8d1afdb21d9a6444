"""Drawings read from DXF: every entity where it is, exact where it can be, chained, and no damage that escapes."""

import io
import math
import random
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import ezdxf
import numpy as np
import pytest
import shapely
from drawings_dxf import VERSIONS, drawn, every_entity, farthest_um, new, points_on, polylines, saved
from ezdxf import disassemble
from ezdxf.entities.dxfgfx import DXFGraphic
from ezdxf.layouts import Modelspace
from ezdxf.math import BSpline, ConstructionArc, Vec2, Vec3

from parser.drawing.dxf import blocks
from parser.drawing.loops.joints import Ends, joints
from parser.drawing.model import Drawing, DrawnLoop, running
from parser.drawing.read import read_drawing
from parser.findings.catalogue import Language, remark_text
from parser.findings.errors import DrawingError, DrycutError, FileUnreadableError
from parser.geometry.curves import CurveKind, Curves

EXACT_UM = 1e-6


def _read(folder: Path, draw: Callable[[Modelspace], object], **asked: float) -> Drawing:
    return read_drawing(drawn(folder, draw), **asked)


def notes(drawing: Drawing, language: Language = "en") -> list[str]:
    return [remark_text(note, language) for note in drawing.notes]


def _ran(drawing: Drawing, loop: DrawnLoop) -> Curves:
    return running(drawing.curves, loop.row, loop.backwards)


def _area_mm2(drawing: Drawing, loop: DrawnLoop) -> float:
    return shapely.Polygon(points_on(_ran(drawing, loop))).area / 1e6


# Entities against closed forms


def test_a_line_runs_between_its_ends(tmp_path):
    drawing = _read(tmp_path, lambda space: space.add_line((1, 2), (4.5, -6)))
    assert drawing.curves.kind.tolist() == [CurveKind.LINE]
    np.testing.assert_allclose(drawing.curves.start_um, [[1000, 2000]], atol=EXACT_UM)
    np.testing.assert_allclose(drawing.curves.end_um, [[4500, -6000]], atol=EXACT_UM)
    assert (drawing.entities[0].kind, drawing.entities[0].layer, drawing.unit) == ("LINE", "0", "mm")


def test_an_arc_keeps_centre_radius_and_sweep(tmp_path):
    curves = _read(tmp_path, lambda space: space.add_arc((10, -3), 7.123, 350, 80)).curves
    assert curves.radius_um.tolist() == [7123.0]
    np.testing.assert_allclose(curves.center_um, [[10000, -3000]], atol=EXACT_UM)
    assert curves.sweep_rad[0] == pytest.approx(math.radians(90), abs=1e-12)
    angle = math.radians(350)
    start = (10000 + 7123 * math.cos(angle), -3000 + 7123 * math.sin(angle))
    np.testing.assert_allclose(curves.start_um[0], start, atol=EXACT_UM)


def test_a_circle_is_one_arc_of_a_full_turn_that_closes_exactly(tmp_path):
    drawing = _read(tmp_path, lambda space: space.add_circle((3, 4), 5))
    curves = drawing.curves
    assert (len(curves), curves.sweep_rad[0], curves.radius_um[0]) == (1, 2 * math.pi, 5000.0)
    assert curves.start_um.tolist() == curves.end_um.tolist()
    assert [loop.closed for loop in drawing.loops] == [True]


@pytest.mark.parametrize("bulge", [0.001, 0.1, math.tan(math.pi / 8), 1.0, 3.0, -0.5, -1.0, -20.0])
@pytest.mark.parametrize("add", ["add_lwpolyline", "add_polyline2d"])
def test_a_bulge_is_the_circle_through_its_ends_and_its_middle(tmp_path, bulge, add):
    start, end = Vec2(12.5, -3.25), Vec2(17.75, 9.5)
    ends = [(*start, bulge), (*end, 0.0)]
    curves = _read(tmp_path, lambda space: getattr(space, add)(ends, format="xyb")).curves
    # The bulge is the sagitta over half the chord; counter-clockwise bulges to the right of the chord.
    middle = start.lerp(end) + (end - start).orthogonal(ccw=False) * (bulge / 2)
    circle = ConstructionArc.from_3p(start, end, middle)
    scale = max(1.0, circle.radius)
    np.testing.assert_allclose(curves.center_um[0] / 1000, tuple(circle.center), atol=1e-9 * scale)
    assert curves.radius_um[0] / 1000 == pytest.approx(circle.radius, rel=1e-9)
    assert curves.sweep_rad[0] == pytest.approx(4 * math.atan(bulge), rel=1e-12)
    np.testing.assert_allclose(curves.end_um[0] / 1000, tuple(end), atol=1e-9)
    assert farthest_um(np.array([tuple(middle * 1000)]), [points_on(curves, 20001)]) < 0.01


def test_a_bulge_flatter_than_a_nanometre_is_a_line(tmp_path):
    curves = _read(tmp_path, lambda space: space.add_lwpolyline([(0, 0, 1e-9), (10, 0, 0)], format="xyb")).curves
    assert curves.kind.tolist() == [CurveKind.LINE]


@pytest.mark.parametrize("add", ["add_lwpolyline", "add_polyline2d"])
def test_a_closed_polyline_runs_back_to_its_start_and_drops_pieces_without_length(tmp_path, add):
    corners = [(0, 0), (10, 0), (10, 0), (10, 5), (0, 5), (0, 0)]
    drawing = _read(tmp_path, lambda space: getattr(space, add)(corners, close=True))
    assert len(drawing.curves) == 4
    assert [loop.closed for loop in drawing.loops] == [True]
    assert _area_mm2(drawing, drawing.loops[0]) == pytest.approx(50)


def test_control_points_of_a_fitted_polyline_are_no_corners(tmp_path):
    def draw(space: Modelspace) -> None:
        line = space.add_polyline2d([(0, 0), (5, 50), (5, 1), (10, 0)])
        line.dxf.flags |= 4
        line.vertices[1].dxf.flags |= 16

    curves = _read(tmp_path, draw).curves
    np.testing.assert_allclose(curves.end_um, [[5000, 1000], [10000, 0]], atol=EXACT_UM)


@pytest.mark.parametrize("tolerance_um", [0.01, 0.1, 5.0])
@pytest.mark.parametrize("part", [(0.0, 2 * math.pi), (0.3, 2.9), (5.0, 1.0)])
def test_an_ellipse_is_flattened_within_the_tolerance(tmp_path, tolerance_um, part):
    drawing = _read(tmp_path, lambda space: space.add_ellipse((5, 5), (8, 3), 0.2, *part), flatten_um=tolerance_um)
    sweep = (part[1] - part[0]) % (2 * math.pi) or 2 * math.pi
    t = (part[0] + np.linspace(0.0, sweep, 20001))[:, None]
    dense = 1000 * (np.array([[5, 5]]) + np.cos(t) * (8, 3) + 0.2 * np.sin(t) * (-3, 8))
    corners = np.vstack([drawing.curves.start_um, drawing.curves.end_um[-1:]])
    assert farthest_um(dense, [corners]) <= tolerance_um
    assert farthest_um(corners, [dense]) < 1e-3 + tolerance_um / 100
    assert (drawing.flattened, drawing.flatten_um) == (1, tolerance_um)
    assert drawing.loops[0].closed == (sweep == 2 * math.pi)


def test_an_ellipse_that_is_a_circle_is_an_arc(tmp_path):
    drawing = _read(tmp_path, lambda space: space.add_ellipse((5, 5), (3, 4), 1.0, 0.0, math.pi / 2))
    assert (drawing.curves.radius_um.tolist(), drawing.flattened) == ([5000.0], 0)
    np.testing.assert_allclose(drawing.curves.start_um, [[8000, 9000]], atol=EXACT_UM)
    np.testing.assert_allclose(drawing.curves.end_um, [[1000, 8000]], atol=EXACT_UM)


@pytest.mark.alike(9)
@pytest.mark.parametrize("tolerance_um", [0.02, 0.1, 5.0])
@pytest.mark.parametrize("seed", range(12))
def test_a_spline_is_flattened_within_the_tolerance(tmp_path, seed, tolerance_um):
    rng = random.Random(seed)
    degree, number = rng.choice([1, 2, 3, 5]), rng.randint(6, 12)
    control = [(rng.uniform(0, 30), rng.uniform(0, 30), 0) for _ in range(number)]
    weights = [rng.uniform(0.3, 3) for _ in control] if seed % 2 else None
    curve = BSpline(control, order=degree + 1, weights=weights)

    def draw(space: Modelspace) -> None:
        spline = space.add_spline()
        spline.apply_construction_tool(curve)

    drawing = _read(tmp_path, draw, flatten_um=tolerance_um)
    dense = 1000 * np.array([tuple(Vec2(at)) for at in curve.points(np.linspace(0, curve.max_t, 8001))])
    corners = np.vstack([drawing.curves.start_um, drawing.curves.end_um[-1:]])
    assert farthest_um(dense, [corners]) <= tolerance_um
    assert farthest_um(corners, [dense]) < 1.0  # as fine as `dense` is
    assert len(corners) < 12000 / math.sqrt(tolerance_um)


def test_a_spline_through_points_passes_them(tmp_path):
    through = [(0, 0), (5, 8), (12, 3), (20, 9)]
    drawing = _read(tmp_path, lambda space: space.add_spline(through))
    assert farthest_um(1000.0 * np.array(through), [np.vstack([drawing.curves.start_um, drawing.curves.end_um])]) < 0.2
    assert len(drawing.loops) == 1


def test_a_spline_that_is_straight_is_a_line(tmp_path):
    drawing = _read(tmp_path, lambda space: space.add_open_spline([(0, 0), (1, 2), (2, 4), (5, 10), (6, 12)]))
    assert (drawing.curves.kind.tolist(), drawing.flattened) == ([CurveKind.LINE], 0)
    np.testing.assert_allclose(drawing.curves.end_um, [[6000, 12000]], atol=EXACT_UM)


def test_a_spline_with_loose_knots_runs_only_where_it_is_defined(tmp_path):
    def draw(space: Modelspace) -> None:
        spline = space.add_spline()
        # Uniform and closed: the cubic runs between the third knot from either end.
        spline.control_points = [(0, 0), (10, 0), (10, 10), (0, 10), (0, 0), (10, 0), (10, 10)]
        spline.knots = range(11)
        spline.dxf.degree = 3

    drawing = _read(tmp_path, draw)
    assert [loop.closed for loop in drawing.loops] == [True]
    # The first place is (p0 + 4 p1 + p2) / 6.
    assert farthest_um(1000.0 * np.array([[50 / 6, 10 / 6]]), [drawing.curves.start_um]) < EXACT_UM


# Versions, units, blocks, mirrors


@pytest.mark.alike(5)
@pytest.mark.parametrize("fmt", ["asc", "bin"])
@pytest.mark.parametrize("version", VERSIONS)
def test_every_version_gives_the_same_curves(tmp_path, version, fmt):
    document = new(version)
    every_entity(document)
    drawing = read_drawing(saved(document, tmp_path, fmt=fmt))
    reference = new("R2018")
    every_entity(reference)
    expected = read_drawing(saved(reference, tmp_path, "reference.dxf"))
    assert drawing.version == version
    rows = len(drawing.curves)
    assert rows == len(expected.curves) if version != "R12" else rows == 10
    if version != "R12":
        np.testing.assert_allclose(drawing.curves.end_um, expected.curves.end_um, atol=EXACT_UM)


@pytest.mark.parametrize(
    ("code", "name", "um"),
    [
        *((1, "inch", 25400.0), (2, "foot", 304800.0), (4, "mm", 1e3), (5, "cm", 1e4), (6, "m", 1e6), (9, "mil", 25.4)),
        (10, "yard", 914_400.0),
    ],
)
def test_lengths_are_in_the_unit_of_the_file(tmp_path, code, name, um):
    document = new(units=code)
    length = min(5.0, 1e6 / um)  # no part is longer than 2 m
    document.modelspace().add_line((0, 0), (0.6 * length, 0.8 * length))
    drawing = read_drawing(saved(document, tmp_path))
    assert [note.name for note in drawing.notes] == (["doubtful-unit"] if um < 100.0 else [])  # 0.1 mm: no part either
    assert drawing.unit == name
    assert drawing.curves.length_um[0] == pytest.approx(length * um, rel=1e-12)


@pytest.mark.parametrize(
    ("code", "measurement", "length", "other"),
    [
        (1, 1, 5.0, ("mm", 5.0)),  # 127 mm in inches, of a file that says it is metric
        (1, 0, 5.0, None),
        (4, 1, 5.0, None),
        (4, 0, 5.0, None),
        (6, 1, 100.0, ("mm", 100.0)),  # 100 m
        (4, 1, 0.2, ("inch", 5.08)),
        (4, 1, 2500.0, ("µm", 2.5)),
        (4, 1, 9e6, None),  # in no unit a part
        (0, 1, 5.0, None),
        (0, 1, 0.2, ("inch", 5.08)),
    ],
)
def test_a_unit_that_makes_no_part_is_to_be_checked(tmp_path, code, measurement, length, other):
    document = new()
    document.header["$INSUNITS"], document.header["$MEASUREMENT"] = code, measurement
    document.modelspace().add_line((0, 0), (length, 0))
    path = saved(document, tmp_path)
    found = [note.values for note in read_drawing(path).notes if note.name == "doubtful-unit"]
    assert [(each["other"], pytest.approx(each["other_size"])) for each in found] == ([other] if other else [])
    assert not any("e+" in note for note in notes(read_drawing(path)))
    if length < 1e4:
        asked = read_drawing(path, unit="inch")
        assert (asked.unit, asked.notes, asked.curves.length_um[0]) == ("inch", (), pytest.approx(25_400.0 * length))


def test_a_file_that_names_no_unit_is_in_mm(tmp_path):
    """Files of R12 and of many CAMs have no header at all."""
    path = tmp_path / "plain.dxf"
    path.write_text("0\nSECTION\n2\nENTITIES\n0\nCIRCLE\n8\n0\n10\n0\n20\n0\n40\n10\n0\nENDSEC\n0\nEOF\n", "ascii")
    drawing = read_drawing(path)
    assert (drawing.unit, drawing.curves.radius_um.tolist()) == ("mm", [10_000.0])
    assert notes(drawing) == ["the file names no unit; taken as mm (--drawing-unit sets another one)"]
    assert notes(drawing, "zh") == ["文件没有给出单位；按 mm 处理（可用 --drawing-unit 指定）"]


@pytest.mark.parametrize("version", ["R12", "R2000", "R2018"])
def test_layers_have_their_names_in_any_release(tmp_path, version):
    """Of a code page that has no Chinese, older releases spell it in digits."""
    document = new(version)
    document.modelspace().add_line((0, 0), (3, 4), {"layer": "中心线"})
    path = saved(document, tmp_path)
    assert read_drawing(path, layer="中心线").entities[0].layer == "中心线"


@pytest.mark.parametrize(("code", "said"), [(0, "names no unit"), (18, "$INSUNITS 18")])
def test_without_a_unit_mm_is_taken_and_said(tmp_path, code, said):
    document = new()
    document.header["$INSUNITS"] = code
    document.modelspace().add_line((0, 0), (3, 4))
    drawing = read_drawing(saved(document, tmp_path))
    assert (drawing.unit, drawing.curves.length_um.tolist()) == ("mm", [5000.0])
    assert any(said in note and "taken as mm" in note for note in notes(drawing))


def test_a_unit_that_is_a_text_is_told_without_its_control_characters(tmp_path):
    tags = [
        "0",
        "SECTION",
        "2",
        "HEADER",
        "9",
        "$ACADVER",
        "1",
        "AC9999",
        "9",
        "$INSUNITS",
        "8",
        "\x1b[2J",
        "0",
        "ENDSEC",
    ]
    tags += ["0", "SECTION", "2", "ENTITIES", "0", "CIRCLE", "8", "0", "10", "0.0", "20", "0.0", "40", "5.0"]
    path = tmp_path / "part.dxf"
    path.write_text("\n".join([*tags, "0", "ENDSEC", "0", "EOF", ""]), encoding="utf-8")
    assert any("$INSUNITS \ufffd[2J" in note for note in notes(read_drawing(path)))


def _dense(entity: DXFGraphic) -> list[Vec3]:
    match entity.dxftype():
        case "LINE":
            return [entity.dxf.start, entity.dxf.end]
        case "LWPOLYLINE":
            return [place for part in entity.virtual_entities() for place in _dense(part)]
        case _:
            return list(entity.flattening(1e-4))


def _is_uneven(attributes: dict[str, float]) -> bool:
    return abs(attributes.get("xscale", 1)) != abs(attributes.get("yscale", 1))


def _inserted(attributes: dict[str, float]) -> ezdxf.document.Drawing:
    document = new()
    inner = document.blocks.new("INNER", base_point=(2, 1))
    inner.add_arc((3, 3), 2, 20, 140)
    inner.add_line((0, 0), (4, 1))
    inner.add_lwpolyline([(0, 0, 0.7), (3, 0, -0.4), (3, 3, 0)], format="xyb", close=True)
    inner.add_circle((8, 1), 1.5)
    inner.add_ellipse((0, 9), (3, 1), 0.5, 0.2, 4.0)
    inner.add_open_spline([(0, 0), (3, 9), (6, -5), (9, 2)])
    outer = document.blocks.new("OUTER")
    outer.add_blockref("INNER", (5, 0), dxfattribs={"rotation": 25, "xscale": -1.5, "yscale": 1.5})
    outer.add_blockref("INNER", (-20, 4), dxfattribs={"rotation": 70})
    # ezdxf has no INSERT that is skewed: it is off where an uneven scale meets a turned block within a block.
    document.modelspace().add_blockref("INNER" if _is_uneven(attributes) else "OUTER", (40, 30), dxfattribs=attributes)
    return document


@pytest.mark.alike(4)
@pytest.mark.parametrize(
    "attributes",
    [
        {},
        {"rotation": 33},
        {"xscale": -1},
        {"xscale": 2.5, "yscale": 2.5, "zscale": 2.5, "rotation": -100},
        {"xscale": 2, "yscale": 0.7, "rotation": 12},
        {"xscale": -2, "yscale": 3},
        {"column_count": 3, "row_count": 2, "column_spacing": 50, "row_spacing": -60, "rotation": 15},
        {"extrusion": (0, 0, -1), "rotation": 40},
    ],
    ids=lambda attributes: ",".join(attributes) or "plain",
)
def test_blocks_are_placed_as_ezdxf_places_them(tmp_path, attributes):
    document = _inserted(attributes)
    drawing = read_drawing(saved(document, tmp_path), flatten_um=0.1)
    expected = [
        1000.0 * np.array([(at.x, at.y) for at in _dense(entity)])
        for entity in disassemble.recursive_decompose(document.modelspace())
    ]
    ours = polylines(drawing.curves)
    assert farthest_um(np.vstack(ours), expected) < 0.25
    assert farthest_um(np.vstack(expected), ours) < 0.25
    assert {entity.block for entity in drawing.entities} == {"INNER"}
    assert len(drawing.entities) == len(expected) - 2 * _is_uneven(attributes)  # ezdxf takes the uneven polyline apart


def test_an_uneven_scale_skews_what_is_turned_within_a_block(tmp_path):
    document = new()
    document.blocks.new("INNER", base_point=(2, 1)).add_line((0, 0), (4, 1))
    document.blocks.new("OUTER").add_blockref("INNER", (5, 0), {"rotation": 25, "xscale": -1.5, "yscale": 1.5})
    document.modelspace().add_blockref("OUTER", (40, 30), {"xscale": 2, "yscale": 0.7})
    curves = read_drawing(saved(document, tmp_path)).curves

    def placed(x: float, y: float) -> tuple[float, float]:
        inner = (
            complex(-1.5 * (x - 2), 1.5 * (y - 1)) * complex(*(f(math.radians(25)) for f in (math.cos, math.sin))) + 5
        )
        return 1000 * (40 + 2 * inner.real), 1000 * (30 + 0.7 * inner.imag)

    np.testing.assert_allclose([*curves.start_um, *curves.end_um], [placed(0, 0), placed(4, 1)], atol=EXACT_UM)


def test_circles_stay_arcs_where_a_block_is_scaled_evenly_and_only_there(tmp_path):
    document = new()
    document.blocks.new("HOLE").add_circle((1, 0), 2)
    for scale in ((3, 3), (-3, 3), (3, 2)):
        document.modelspace().add_blockref("HOLE", (20 * scale[1], 0), {"xscale": scale[0], "yscale": scale[1]})
    drawing = read_drawing(saved(document, tmp_path))
    arcs = drawing.curves.picked(drawing.curves.is_arc)
    np.testing.assert_allclose(arcs.radius_um, [6000, 6000], atol=EXACT_UM)
    assert np.sign(arcs.sweep_rad).tolist() == [1, -1]
    assert (drawing.flattened, [loop.closed for loop in drawing.loops]) == (1, [True, True, True])


def test_arcs_drawn_from_below_are_mirrored(tmp_path):
    def draw(space: Modelspace) -> None:
        below = {"extrusion": (0, 0, -1)}
        space.add_arc((10, 5), 2, 0, 90, dxfattribs=below)
        space.add_lwpolyline([(20, 5, 1.0), (24, 5, 0)], format="xyb", dxfattribs=below)

    curves = _read(tmp_path, draw).curves
    np.testing.assert_allclose(curves.center_um, [[-10000, 5000], [-22000, 5000]], atol=EXACT_UM)
    np.testing.assert_allclose(curves.start_um, [[-12000, 5000], [-20000, 5000]], atol=EXACT_UM)
    np.testing.assert_allclose(curves.end_um, [[-10000, 7000], [-24000, 5000]], atol=EXACT_UM)
    np.testing.assert_allclose(curves.sweep_rad, [-math.pi / 2, -math.pi], atol=1e-12)


def test_what_is_not_level_is_seen_from_above_and_said(tmp_path):
    def draw(space: Modelspace) -> None:
        space.add_line((0, 0, 0), (3, 0, 4))
        space.add_circle((10, 0), 2, dxfattribs={"extrusion": (0, 1, 1)})
        space.add_circle((20, 0), 2, dxfattribs={"extrusion": (1, 0, 0)})

    drawing = _read(tmp_path, draw)
    assert drawing.curves.length_um[0] == pytest.approx(3000)
    assert np.ptp(drawing.curves.start_um[1:, 1]) == pytest.approx(4000 / math.sqrt(2), abs=1)
    assert any(note.startswith("2 of the curves not level") for note in notes(drawing))
    assert any(note.startswith("1 of the circles and ellipses left out") for note in notes(drawing))


def test_a_block_that_inserts_itself_or_is_missing_ends_in_a_note(tmp_path):
    document = new()
    block = document.blocks.new("A")
    block.add_line((0, 0), (1, 0))
    block.add_blockref("A", (5, 0))
    document.modelspace().add_blockref("A", (0, 0))
    document.modelspace().add_blockref("NONE", (0, 0))
    drawing = read_drawing(saved(document, tmp_path))
    assert len(drawing.curves) == 1
    assert any("INSERT of A" in note and "INSERT of NONE" in note for note in notes(drawing))


@pytest.mark.parametrize("name", ["NONE", "EMPTY"])
def test_an_array_that_places_nothing_costs_what_one_insert_does(tmp_path, monkeypatch, name):
    monkeypatch.setattr(blocks, "MOST_ENTITIES", 10)
    document = new()
    document.blocks.new("EMPTY")
    array = {"row_count": 30_000, "column_count": 30_000, "row_spacing": 1.0, "column_spacing": 1.0}
    document.modelspace().add_blockref(name, (0, 0), dxfattribs=array)
    document.modelspace().add_line((0, 0), (1, 0))
    drawing = read_drawing(saved(document, tmp_path))
    assert len(drawing.curves) == 1
    assert any("1 INSERT of NONE" in note for note in notes(drawing)) == (name == "NONE")


def test_blocks_that_multiply_without_end_are_refused(tmp_path, monkeypatch):
    monkeypatch.setattr(blocks, "MOST_ENTITIES", 1000)
    document = new()
    document.blocks.new("B0").add_line((0, 0), (1, 0))
    for level in range(1, 9):
        block = document.blocks.new(f"B{level}")
        for at in range(8):
            block.add_blockref(f"B{level - 1}", (at, level))
    document.modelspace().add_blockref("B8", (0, 0))
    with pytest.raises(DrawingError, match=r"part\.dxf: holds more than 1,000 entities"):
        read_drawing(saved(document, tmp_path))


# Layers and notes


def _layered(folder: Path) -> Path:
    document = new()
    for name in ("Cut", "HIDDEN", "COLD", "中文"):
        document.layers.add(name)
    document.layers.get("HIDDEN").off()
    document.layers.get("COLD").freeze()
    document.blocks.new("ON0").add_line((0, 9), (1, 9))
    space = document.modelspace()
    for at, name in enumerate(("Cut", "HIDDEN", "COLD", "中文")):
        space.add_line((0, at), (1, at), dxfattribs={"layer": name})
    space.add_blockref("ON0", (0, 0), dxfattribs={"layer": "Cut"})
    space.add_text("R5", dxfattribs={"layer": "中文"})
    return saved(document, folder)


def test_layers_that_are_off_or_frozen_are_left_out_and_counted(tmp_path):
    drawing = read_drawing(_layered(tmp_path))
    assert [entity.layer for entity in drawing.entities] == ["Cut", "中文", "Cut"]
    assert any(note.startswith("2 of the entities left out: on other layers") for note in notes(drawing))
    assert "left out, as no curves: 1 TEXT" in notes(drawing)


@pytest.mark.parametrize(
    ("outer", "inner", "line", "shown"),
    [
        ("Cut", "Cut", "Cut", 1),
        ("COLD", "Cut", "Cut", 0),  # what an INSERT on a frozen layer places is frozen, however deep
        ("Cut", "COLD", "Cut", 0),
        ("Cut", "Cut", "COLD", 0),
        ("HIDDEN", "Cut", "Cut", 1),  # a layer that is off hides what is drawn on it alone
        ("HIDDEN", "Cut", "0", 1),
        ("Cut", "HIDDEN", "0", 0),
    ],
)
def test_what_is_frozen_stays_so_through_blocks_in_blocks(tmp_path, outer, inner, line, shown):
    document = new()
    for name in ("Cut", "HIDDEN", "COLD"):
        document.layers.add(name)
    document.layers.get("HIDDEN").off()
    document.layers.get("COLD").freeze()
    document.blocks.new("INNER").add_line((0, 0), (5, 0), dxfattribs={"layer": line})
    document.blocks.new("OUTER").add_blockref("INNER", (1, 1), dxfattribs={"layer": inner})
    document.modelspace().add_line((0, 9), (9, 9))
    document.modelspace().add_blockref("OUTER", (2, 2), dxfattribs={"layer": outer})
    assert len(read_drawing(saved(document, tmp_path)).curves) == 1 + shown


def test_one_layer_is_read_whatever_its_case_with_what_blocks_draw_on_it(tmp_path):
    assert [entity.block for entity in read_drawing(_layered(tmp_path), layer="CUT").entities] == ["", "ON0"]
    assert len(read_drawing(_layered(tmp_path), layer="hidden").curves) == 1


def test_an_unknown_layer_is_an_error_that_names_those_there_are(tmp_path):
    with pytest.raises(DrawingError, match=r"part\.dxf: has no layer KERF; expected one of COLD, Cut, HIDDEN, 中文"):
        read_drawing(_layered(tmp_path), layer="KERF")


def test_an_entity_of_another_program_is_left_out_by_its_name(tmp_path):
    data = _bytes("R2010").replace(b"\nCIRCLE\n", b"\nMYCAM\n")
    path = tmp_path / "part.dxf"
    path.write_bytes(data)
    assert "left out, as no curves: 1 MYCAM" in notes(read_drawing(path))


def test_what_is_drawn_twice_is_kept_once_whichever_way_it_runs(tmp_path):
    def draw(space: Modelspace) -> None:
        for ends in (((0, 0), (10, 5)), ((10, 5), (0, 0))):
            space.add_line(*ends)
        space.add_circle((30, 0), 3)
        space.add_arc((30, 0), 3, 90, 90 + 360)
        space.add_lwpolyline([(50, 0, 0.3), (55, 5, 0)], format="xyb")
        space.add_lwpolyline([(55, 5, -0.3), (50, 0, 0)], format="xyb")
        space.add_lwpolyline([(50, 0, -0.3), (55, 5, 0)], format="xyb")

    drawing = _read(tmp_path, draw)
    assert len(drawing.curves) == 4
    assert "3 of the curves left out: drawn twice" in notes(drawing)


# Chaining


def _outline() -> list[tuple[str, tuple]]:
    """A slot with a notch, as loose lines and arcs, and a hole of two arcs."""
    return [
        ("add_line", ((0, 0), (20, 0))),
        ("add_arc", ((20, 5), 5, 270, 90)),
        ("add_line", ((20, 10), (12, 10))),
        ("add_line", ((12, 10), (12, 8))),
        ("add_line", ((8, 8), (12, 8))),
        ("add_line", ((8, 10), (8, 8))),
        ("add_line", ((0, 10), (8, 10))),
        ("add_arc", ((0, 5), 5, 90, 270)),
        ("add_arc", ((15, 4), 2, 0, 180)),
        ("add_arc", ((15, 4), 2, 180, 360)),
        ("add_line", ((40, 0), (50, 0))),
        ("add_line", ((50, 0), (50, 7))),
    ]


def _shape(drawing: Drawing) -> list[tuple]:
    """What a drawing's loops are, without the order that its file has."""
    shapes = []
    for loop in drawing.loops:
        ran = _ran(drawing, loop)
        starts = [tuple(place) for place in np.round(ran.start_um, 3).tolist()]
        shapes.append((loop.closed, tuple(starts) if loop.closed else tuple(sorted(starts)[:1])))
    return sorted(shapes)


@pytest.mark.parametrize("seed", range(10))
def test_loops_are_the_same_whatever_the_order_of_the_entities(tmp_path, seed):
    pieces = _outline()

    def draw(space: Modelspace) -> None:
        for name, numbers in pieces:
            getattr(space, name)(*numbers)

    before = _read(tmp_path, draw)
    random.Random(seed).shuffle(pieces)
    after = _read(tmp_path, draw)
    closed = [loop for loop in after.loops if loop.closed]
    assert (len(after.loops), len(closed)) == (3, 2)
    assert [loop for loop in _shape(before) if loop[0]] == [loop for loop in _shape(after) if loop[0]]
    for loop in closed:
        ran = _ran(after, loop)
        np.testing.assert_allclose(ran.end_um, np.roll(ran.start_um, -1, axis=0), atol=EXACT_UM)
    areas = sorted(_area_mm2(after, loop) for loop in closed)
    assert areas == pytest.approx([math.pi * 4, 200 + math.pi * 25 - 8], rel=1e-3)


@pytest.mark.parametrize("clockwise", [False, True])
def test_closed_loops_run_counter_clockwise_and_open_ones_as_drawn(tmp_path, clockwise):
    corners = [(0, 0, 0.5), (10, 0, 0), (10, 10, 0), (0, 10, 0)]
    other = [(0, 0, 0), (0, 10, 0), (10, 10, 0), (10, 0, -0.5)]

    def draw(space: Modelspace) -> None:
        space.add_lwpolyline(other if clockwise else corners, format="xyb", close=True)
        space.add_line((50, 0), (40, 0))

    drawing = _read(tmp_path, draw)
    ring = shapely.LinearRing(points_on(_ran(drawing, drawing.loops[0])))
    assert ring.is_ccw
    assert _ran(drawing, drawing.loops[1]).start_um.tolist() == [[50000, 0]]
    assert drawing.loops[0].backwards.tolist() == [clockwise] * 4


@pytest.mark.parametrize(("gap_mm", "closed"), [(0.0, True), (0.004, True), (0.0099, True), (0.0101, False)])
def test_gaps_are_bridged_up_to_the_tolerance_and_measured(tmp_path, gap_mm, closed):
    def draw(space: Modelspace) -> None:
        space.add_line((0, 0), (10, 0))
        space.add_line((10, gap_mm), (5, 9))
        space.add_line((5, 9), (0, 0))

    drawing = _read(tmp_path, draw, gap_um=10.0)
    assert [loop.closed for loop in drawing.loops] == [closed]
    expected = gap_mm * 1000 if closed else 0.0
    assert drawing.loops[0].gap_um == pytest.approx(expected, abs=1e-6)
    assert any("bridged" in note for note in notes(drawing)) == (closed and gap_mm > 0)


@pytest.mark.parametrize("step_mm", [0.001, 0.005, 0.02])
def test_lines_shorter_than_the_gap_stay_in_their_order(tmp_path, step_mm):
    number = 400
    angle = 2 * np.pi * np.arange(number) / number
    corners = step_mm * number / (2 * np.pi) * np.column_stack([np.cos(angle), np.sin(angle)])

    def draw(space: Modelspace) -> None:
        lines = list(zip(corners.tolist(), np.roll(corners, -1, axis=0).tolist(), strict=True))
        random.Random(5).shuffle(lines)
        for start, end in lines:
            space.add_line(start, end)

    drawing = _read(tmp_path, draw)
    assert [(loop.closed, len(loop.row), loop.gap_um) for loop in drawing.loops] == [(True, number, 0.0)]


def test_a_line_that_ends_on_a_corner_does_not_break_the_loop_and_is_told(tmp_path):
    pieces = [((0, 0), (10, 0)), ((10, 0), (10, 10)), ((10, 10), (0, 10)), ((0, 10), (0, 0)), ((10, 0), (30, 0))]
    for order in (pieces, pieces[::-1]):
        drawing = _read(tmp_path, lambda space, order=order: [space.add_line(*ends) for ends in order])
        assert sorted((loop.closed, len(loop.row)) for loop in drawing.loops) == [(False, 1), (True, 4)]
        assert "more than two ends meet at (10, 0) mm" in notes(drawing)


def test_where_four_ends_meet_the_straightest_way_is_taken(tmp_path):
    cross = [((0, 0), (5, 5)), ((10, 10), (5, 5)), ((10, 0), (5, 5)), ((5, 5), (0, 10))]
    drawing = _read(tmp_path, lambda space: [space.add_line(*ends) for ends in cross])
    assert [loop.row.tolist() for loop in drawing.loops] == [[0, 1], [2, 3]]


@pytest.mark.parametrize("seed", range(5))
def test_joints_are_those_of_a_plain_search(seed):
    rng = np.random.default_rng(seed)
    place = rng.uniform(-300, 300, (200, 2))
    ends = Ends(place, np.tile((1.0, 0.0), (200, 1)), np.full(200, 1e6))
    found = joints(ends, np.arange(200), 40.0)
    by = np.hypot(*(place[:, None] - place[None]).T)
    np.fill_diagonal(by, np.inf)
    pairs = []
    while by.min() <= 40.0:  # the nearest two of all that are left
        one, other = np.unravel_index(np.argmin(by), by.shape)
        pairs.append({int(one), int(other)})
        by[[one, other]] = np.inf
        by[:, [one, other]] = np.inf
    assert sorted(map(sorted, found.pair.tolist())) == sorted(map(sorted, pairs))


# What is no drawing, and damage


@pytest.mark.parametrize(
    ("data", "said"),
    [
        (b"", "is empty; expected a DXF drawing"),
        (b" \n", "is empty; expected a DXF drawing"),
        (b"AC1032\0\0\0\0\0", "is a DWG drawing; save it as DXF, or install the ODA File Converter"),
        (b"B1 B2 B3 GX L1\nDD\n", "is no DXF file (this is a 3B program); expected a drawing saved as DXF"),
        (b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR", "is no DXF file (this is a picture); expected a drawing saved as DXF"),
        (
            b"0\nSECTION\n2\nENTITIES\n0\nENDSEC\n0\nEOF\n",
            "holds no line, arc or curve; expected the contour of a part",
        ),
        (b"AutoCAD Binary DXF\r\n\x1a\0\x07", "is damaged beyond what can be mended"),
    ],
)
def test_what_is_no_drawing_is_an_error_of_one_line(tmp_path, data, said):
    path = tmp_path / "part.dxf"
    path.write_bytes(data)
    with pytest.raises(DrawingError) as caught:
        read_drawing(path)
    assert str(caught.value).startswith(f"{path}: {said}")
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("name", ["missing.dxf", ".", "a\0b"])
def test_a_file_that_cannot_be_read_is_an_error(tmp_path, name):
    with pytest.raises(FileUnreadableError):
        read_drawing(tmp_path / name)


def _bytes(version: str, fmt: str = "asc") -> bytes:
    document = new(version)
    every_entity(document)
    stream = io.StringIO() if fmt == "asc" else io.BytesIO()
    document.write(stream, fmt=fmt)
    return stream.getvalue().encode() if fmt == "asc" else stream.getvalue()


def test_a_damaged_file_gives_what_is_left_of_it_and_says_so(tmp_path):
    data = _bytes("R2010")
    path = tmp_path / "part.dxf"
    path.write_bytes(data[: data.index(b"CIRCLE", data.index(b"ENTITIES"))])
    drawing = read_drawing(path)
    assert [entity.kind for entity in drawing.entities][:2] == ["LINE", "ARC"]
    assert any("ends early" in note for note in notes(drawing))


def test_a_number_that_is_none_costs_its_entity_alone_and_is_said(tmp_path):
    data = _bytes("R2010").replace(b"\nAcDbCircle\n 10\n20.0\n", b"\nAcDbCircle\n 10\n2o.0\n")
    path = tmp_path / "part.dxf"
    path.write_bytes(data)
    drawing = read_drawing(path)
    kinds = [entity.kind for entity in drawing.entities]
    assert kinds[:2] == ["LINE", "ARC"]
    assert "SPLINE" in kinds
    assert any(note.startswith("the file is damaged and was read in recover mode") for note in notes(drawing))


def test_an_entity_with_numbers_that_cannot_be_is_left_out_and_the_rest_is_read(tmp_path):
    def draw(space: Modelspace) -> None:
        space.add_line((0, 0), (1, 0))
        space.add_line((0, 0), (1e30, 0))
        space.add_circle((0, 0), math.nan)
        spline = space.add_spline()
        spline.control_points, spline.knots = [(0, 0), (1, 1), (2, 0), (3, 1)], [0, 0, 1]

    drawing = _read(tmp_path, draw)
    assert len(drawing.curves) == 1
    assert any(note.startswith("2 of the curves left out: beyond") for note in notes(drawing))
    assert any("numbers cannot be: 1 SPLINE" in note for note in notes(drawing))


def damaged(data: bytes, rng: random.Random) -> bytes:
    """The bytes with a few of them cut off, changed, lost or doubled."""
    for _ in range(rng.choice([1, 1, 2, 8, 40])):
        at = rng.randrange(len(data))
        match rng.randrange(5):
            case 0 if len(data) > 100:
                data = data[:at] if rng.random() < 0.3 else data
            case 1:
                data = data[:at] + bytes([rng.randrange(256)]) + data[at + 1 :]
            case 2:
                data = data[:at] + data[at + rng.randrange(1, 60) :]
            case 3:
                data = data[:at] + data[at : at + 80] + data[at:]
            case _:
                data = data[:at] + rng.choice([b"-", b"9999999999", b"nan", b"1e400", b"\n", b"0\nEOF\n"]) + data[at:]
        if not data:
            return data
    return data


def _short(version: str, fmt: str) -> bytes:
    """A file mostly of entities: the tail of one, behind a header, so that damage hits what is drawn."""
    data = _bytes(version, fmt)
    if fmt == "bin":
        return data
    entities = data.index(b"ENTITIES")
    begin = data.rindex(b"  0\nSECTION", 0, data.index(b"BLOCKS\n"))
    return data[begin : data.index(b"ENDSEC", entities)] + b"ENDSEC\n  0\nEOF\n"


@pytest.mark.parametrize(("version", "fmt"), [("R12", "asc"), ("R2010", "asc"), ("R12", "bin")])
def test_no_damage_escapes_as_anything_but_an_error_of_drycut(tmp_path, version, fmt):
    data, path = _short(version, fmt), tmp_path / "part.dxf"
    outcomes = set()
    for number in range(40):
        path.write_bytes(damaged(data, random.Random(f"{version}{fmt}{number}")))
        try:
            drawing = read_drawing(path)
        except DrycutError as error:
            outcomes.add("lines" if "\n" in str(error) else "refused")
        else:
            assert np.isfinite(drawing.curves.start_um).all()
            assert sorted(np.concatenate([loop.row for loop in drawing.loops])) == list(range(len(drawing.curves)))
            outcomes.add("read")
    assert "read" in outcomes
    assert "lines" not in outcomes


# Cost


@pytest.mark.deeper
def test_ten_thousand_entities_are_read_and_chained_in_seconds(tmp_path):
    def draw(space: Modelspace) -> None:
        for at in range(100):
            for step in range(100):
                begin, end = 2 * math.pi * step / 100, 2 * math.pi * (step + 1) / 100
                space.add_line(
                    (at * 30 + 10 * math.cos(begin), 10 * math.sin(begin)),
                    (at * 30 + 10 * math.cos(end), 10 * math.sin(end)),
                )

    path = drawn(tmp_path, draw)
    begin = time.process_time()
    drawing = read_drawing(path)
    taken_s = time.process_time() - begin
    assert [len(loop.row) for loop in drawing.loops] == [100] * 100
    assert taken_s < 6.0  # 1 s on an idle core


def test_the_types_of_a_drawing_load_no_ezdxf():
    code = "import sys, parser.drawing.model, sim.check.path_checks; sys.exit('ezdxf' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0
