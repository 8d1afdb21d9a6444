"""What a drawing leaves out, entity by entity with its reason and its place; marks, colours, and malformed splines."""

import math
from collections.abc import Callable
from pathlib import Path

import pytest
from drawings_dxf import drawn, new, saved
from ezdxf.document import Drawing as Document
from ezdxf.layouts import Modelspace

from parser.drawing.model import Drawing, LeftOut
from parser.drawing.read import read_drawing
from parser.findings.catalogue import remark_text
from parser.findings.errors import DrawingError
from sim.show.texts.texts import texts


def _square(space: Modelspace) -> None:
    space.add_lwpolyline([(0, 0), (90, 0), (90, 90), (0, 90)], close=True)


def _left(folder: Path, draw: Callable[[Modelspace], object]) -> LeftOut:
    """The one thing that is left out beside a square."""

    def both(space: Modelspace) -> None:
        _square(space)
        draw(space)

    drawing = read_drawing(drawn(folder, both))
    assert [loop.closed for loop in drawing.loops] == [True]
    (one,) = drawing.left_out
    return one


def _notes(drawing: Drawing) -> list[str]:
    return [remark_text(note) for note in drawing.notes]


@pytest.mark.parametrize(
    ("draw", "kind", "why", "place_mm"),
    [
        (lambda space: space.add_text("A", dxfattribs={"insert": (3, 4)}), "TEXT", "text", (3, 4)),
        (
            lambda space: space.add_text("A", dxfattribs={"insert": (3, 4), "extrusion": (0, 0, -1)}),
            "TEXT",
            "text",
            (-3, 4),
        ),
        (lambda space: space.add_mtext("A", {"insert": (3, 4)}), "MTEXT", "text", (3, 4)),
        (lambda space: space.add_attdef("A", (3, 4)), "ATTDEF", "text", (3, 4)),
        (lambda space: space.add_linear_dim((0, 5), (3, 4), (9, 4)).render(), "DIMENSION", "dimension", (3, 5)),
        (lambda space: space.add_leader([(3, 4), (5, 6)]), "LEADER", "leader", (3, 4)),
        (lambda space: space.add_hatch().paths.add_polyline_path([(3, 4), (5, 4), (5, 9)]), "HATCH", "hatch", (3, 4)),
        (
            lambda space: space.add_hatch().paths.add_edge_path().add_line((3, 4), (5, 4)),
            "HATCH",
            "hatch",
            (3, 4),
        ),
        (lambda space: space.add_hatch().paths.add_edge_path().add_arc((3, 4), 2), "HATCH", "hatch", (3, 4)),
        (lambda space: space.add_point((3, 4)), "POINT", "point", (3, 4)),
        (lambda space: space.add_solid([(3, 4), (5, 4), (5, 9)]), "SOLID", "solid", (3, 4)),
        (lambda space: space.add_3dface([(3, 4), (5, 4), (5, 9)]), "3DFACE", "solid", (3, 4)),
        (lambda space: space.add_polymesh((2, 2)), "POLYLINE", "solid", (0, 0)),
        (lambda space: space.add_blockref("NONE", (3, 4)), "INSERT", "block", (3, 4)),
        (lambda space: space.add_xline((3, 4), (1, 0)), "XLINE", "endless", (3, 4)),
        (lambda space: space.add_mline([(3, 4), (5, 6)]), "MLINE", "no-curve", (3, 4)),
        (lambda space: space.add_line((3, 4), (3, 4)), "LINE", "short", (3, 4)),
        (lambda space: space.add_line((3, 4), (3e8, 4)), "LINE", "beyond", (3, 4)),
        (lambda space: space.add_circle((3, 0, 4), 2, {"extrusion": (0, 1, 0)}), "CIRCLE", "upright", None),
        (lambda space: space.add_circle((3, 4), 2, {"invisible": 1}), "CIRCLE", "hidden", (3, 4)),
        (lambda space: space.add_circle((3, 4), 2, {"layer": "defPOINTS"}), "CIRCLE", "never-plotted", (3, 4)),
        (lambda space: space.add_open_spline([(3, 4), (5, 5)], degree=3), "SPLINE", "unreadable", (3, 4)),
    ],
)
def test_what_is_left_out_is_told_with_its_reason_and_its_place(tmp_path, draw, kind, why, place_mm):
    one = _left(tmp_path, draw)
    assert (one.entity.kind, one.why) == (kind, why)
    if place_mm is not None:
        assert one.place_um == pytest.approx([1000.0 * at for at in place_mm])
    assert one.entity.handle
    assert f"left-out-{why}" in texts("program")


def _layered(folder: Path, prepare: Callable[[Document], object], layer: str, **attributes: object) -> Path:
    document = new()
    document.layers.add(layer)
    prepare(document)
    _square(document.modelspace())
    document.modelspace().add_circle((45, 45), 9, {"layer": layer, **attributes})
    return saved(document, folder)


@pytest.mark.parametrize("why", ["off", "frozen"])
def test_layers_that_are_off_and_those_that_are_frozen_are_told_apart(tmp_path, why):
    def prepare(document: Document) -> None:
        layer = document.layers.get("Other")
        layer.off() if why == "off" else layer.freeze()

    path = _layered(tmp_path, prepare, "Other")
    assert [(one.why, one.place_um) for one in read_drawing(path).left_out] == [(why, (45_000.0, 45_000.0))]
    assert [one.why for one in read_drawing(path, layer="other").left_out] == ["other-layer"]


def _linetypes(document: Document) -> None:
    document.linetypes.add("轴线", [2.0, 1.25, -0.25, 0.25, -0.25])
    document.linetypes.add("Bold", [1.0, 1.0])
    document.linetypes.add("CENTER", [0.0])
    document.layers.get("Other").dxf.linetype = "轴线"


@pytest.mark.parametrize(
    ("linetype", "is_left"),
    [
        ("BYLAYER", True),
        ("轴线", True),
        ("Bold", False),  # a pattern without gaps
        ("CENTER", False),  # this file says itself that it has none
        ("Continuous", False),
        ("CENTER2", True),  # named and not defined: by the name
        ("DASHDOTX2", True),
        ("Phantom", True),
        ("HIDDEN", True),
        ("ACAD_ISO04W100", True),
        ("ACAD_ISO01W100", False),
        ("点划线", True),
        ("虚线", True),
        ("MyOwn", False),
    ],
)
def test_circles_of_broken_linetypes_are_no_contours(tmp_path, linetype, is_left):
    path = _layered(tmp_path, _linetypes, "Other", linetype=linetype)
    drawing = read_drawing(path)
    assert [one.why for one in drawing.left_out] == ["broken-line"] * is_left
    assert len(drawing.loops) == 2 - is_left
    said = "1 of the entities left out: in broken linetypes, such as centre lines; --layer reads those of one layer"
    assert (said in _notes(drawing)) == is_left
    assert len(read_drawing(path, layer="Other").loops) == 1


def test_what_a_block_draws_by_block_is_as_its_insert_is(tmp_path):
    document = new()
    document.linetypes.add("AXIS", [2.0, 1.25, -0.75])
    document.layers.add("Red", color=1)
    block = document.blocks.new("B")
    for attributes in ({"linetype": "BYBLOCK"}, {"color": 0}, {"color": 5}, {"layer": "Red"}, {"true_color": 255}):
        block.add_circle((len(block) * 10, 0), 3, attributes)
    _square(document.modelspace())
    document.modelspace().add_blockref("B", (100, 0), {"linetype": "AXIS", "color": 3})
    drawing = read_drawing(saved(document, tmp_path))
    assert [one.why for one in drawing.left_out] == ["broken-line"]
    assert [entity.color for entity in drawing.entities] == [7, 3, 5, 1, 0]


def test_a_drawing_of_centre_lines_alone_is_no_contour_and_says_so(tmp_path):
    document = new()
    document.modelspace().add_circle((45, 45), 9, {"linetype": "CENTER"})
    with pytest.raises(DrawingError, match=r"holds no line, arc or curve \(1 of the entities left out: in broken"):
        read_drawing(saved(document, tmp_path))


def test_marks_are_points_and_circles_of_all_layers_where_they_are_placed(tmp_path):
    document = new()
    document.layers.add("Holes").freeze()
    block = document.blocks.new("B")
    block.add_point((1, 2), dxfattribs={"layer": "Holes"})
    block.add_circle((3, 4), 5)
    document.modelspace().add_blockref("B", (10, 20), {"xscale": 2, "yscale": 2, "rotation": 90, "layer": "Pins"})
    document.modelspace().add_circle((7, 8), 1, {"extrusion": (0, 0, -1)})
    _square(document.modelspace())
    marks = read_drawing(saved(document, tmp_path)).marks
    assert [(mark.layer, mark.radius_um) for mark in marks] == [
        ("Holes", 0.0),
        ("Pins", pytest.approx(10_000.0)),
        ("0", pytest.approx(1_000.0)),
    ]
    # By a quarter turn, (x, y) twice as large is (-2y, 2x) from the place of the block.
    expected = [(6_000.0, 22_000.0), (2_000.0, 26_000.0), (-7_000.0, 8_000.0)]
    assert [mark.place_um for mark in marks] == [pytest.approx(place) for place in expected]


def _malformed(space: Modelspace, degree: int, points: int, knots: list[float], weights: int = 0) -> None:
    spline = space.add_spline()
    spline.dxf.degree = degree
    spline.control_points = [(math.cos(at), math.sin(at), 0.0) for at in range(points)]
    spline.knots = knots
    spline.weights = [1.0] * weights


@pytest.mark.parametrize(
    ("numbers", "english", "chinese"),
    [
        (
            (3, 9, [float(at) for at in range(12)]),
            "12 knots for 9 points of degree 3; expected 13",
            "阶次 3、9 个控制点，节点数为 12；应为 13",
        ),
        ((3, 3, []), "3 points for degree 3; expected 4 or more", "阶次 3 只有 3 个控制点；至少应有 4 个"),
        ((3, 4, [0, 0, 0, 0, 1, 1, 1, 1], 3), "3 weights for 4 points; expected one for each", "4 个控制点有 3 个权重"),
        ((1, 3, [0, 0, 2, 1, 1]), "knot 4 of 5 is below the one before it", "第 4 个节点（共 5 个）小于前一个节点"),
        ((3, 0, []), "no control points, and fewer than two fit points", "没有控制点，拟合点也不足两个"),
    ],
)
def test_a_malformed_spline_says_what_is_wrong_with_it(tmp_path, numbers, english, chinese):
    def draw(space: Modelspace) -> None:
        _malformed(space, *numbers)

    path = drawn(tmp_path, draw)
    with pytest.raises(DrawingError) as caught:
        read_drawing(path)
    handle = next(iter(draw_handles(path)))
    said = f"holds no line, arc or curve (SPLINE {handle}: {english}); expected the contour of a part"
    assert str(caught.value) == f"{path}: {said}"

    def beside(space: Modelspace) -> None:
        _square(space)
        draw(space)

    drawing = read_drawing(drawn(tmp_path, beside))
    (one,) = drawing.left_out
    assert (one.why, one.detail in drawing.notes) == ("unreadable", True)
    assert remark_text(one.detail, "zh").startswith(f"SPLINE {one.entity.handle}：{chinese}")
    assert "left out, as their numbers cannot be: 1 SPLINE" in _notes(drawing)


def draw_handles(path: Path) -> list[str]:
    """Handles of the splines of a file."""
    lines = [line.strip() for line in path.read_text("utf-8").splitlines()]
    return [
        lines[lines.index("5", at) + 1]
        for at in range(1, len(lines))
        if lines[at - 1 : at + 1] == ["0", "SPLINE"] and at % 2
    ]


@pytest.mark.parametrize(
    ("kind", "codes", "missing"),
    [
        ("CIRCLE", {10: 1.0, 20: 2.0}, 40),
        ("CIRCLE", {40: 2.0}, 10),
        ("ARC", {10: 1.0, 20: 2.0, 40: 2.0, 50: 0.0}, 51),
        ("LINE", {10: 1.0, 20: 2.0}, 11),
        ("ELLIPSE", {10: 1.0, 20: 2.0, 11: 3.0, 21: 0.0, 41: 0.0, 42: 6.28}, 40),
    ],
)
def test_an_entity_without_one_of_its_numbers_is_left_out_and_told_which(tmp_path, kind, codes, missing):
    """ezdxf takes a circle without a radius for one of 1, and an ellipse without a ratio for a circle."""
    path = tmp_path / "part.dxf"
    line = "0\nLINE\n8\n0\n10\n0.0\n20\n50.0\n11\n9.0\n21\n50.0\n"
    entity = f"0\n{kind}\n8\n0\n" + "".join(f"{code}\n{value}\n" for code, value in codes.items())
    path.write_text(f"0\nSECTION\n2\nENTITIES\n{line}{entity}0\nENDSEC\n0\nEOF\n", "ascii")
    (one,) = read_drawing(path).left_out
    assert (one.entity.kind, one.why) == (kind, "unreadable")
    assert remark_text(one.detail).endswith(f": group code {missing} is missing")
