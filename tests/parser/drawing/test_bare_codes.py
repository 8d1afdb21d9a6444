"""Drawings of bare group codes, without subclass marks, as small programs write them and the patent reads them."""

import io
import time
from pathlib import Path

import ezdxf
import numpy as np
import pytest

from parser.drawing.dxf.document import with_marks
from parser.drawing.read import read_drawing
from parser.findings.catalogue import remark_text

_HEAD, _TAIL = "0\nSECTION\n2\nENTITIES\n", "0\nENDSEC\n0\nEOF\n"
_LINE = "0\nLINE\n8\n0\n10\n0.0\n20\n50.0\n11\n9.0\n21\n50.0\n"


def _whole() -> str:
    """A drawing with every curve and much that is none, as ezdxf writes it."""
    document = ezdxf.new("R2000", units=4)
    space = document.modelspace()
    space.add_line((0, 0), (1, 1), {"layer": "Cut"})
    space.add_ellipse((0, 0), (5, 1), 0.5)
    space.add_lwpolyline([(0, 0, 0.5), (3, 3, 0), (9, 0, 0)], format="xyb", close=True)
    space.add_rational_spline([(0, 0), (1, 5), (6, 5), (8, 0), (9, 9)], [1, 2, 0.5, 1, 1])
    space.add_spline([(0, 0), (1, 2), (5, 3)])
    space.add_spline([(0, 0), (1, 2), (5, 3)]).set_xdata("ACAD", [(1000, "text"), (1040, 2.0)])
    space.add_hatch().paths.add_polyline_path([(0, 0), (10, 0), (10, 10)])
    space.add_mtext("hello")
    space.add_leader([(0, 0), (1, 1)])
    stream = io.StringIO()
    document.write(stream)
    return stream.getvalue()


def _bare(text: str) -> str:
    """The section of entities of a text alone, without subclass marks."""
    text = "  0\nSECTION\n  2\nENTITIES" + text.split("ENTITIES", 1)[1].split("ENDSEC", 1)[0] + "ENDSEC\n  0\nEOF\n"
    lines = text.split("\n")
    pairs = zip(lines[::2], lines[1::2], strict=False)
    return "".join(f"{code}\n{value}\n" for code, value in pairs if code.strip() != "100")


@pytest.mark.parametrize("end", ["\n", "\r\n"])
@pytest.mark.parametrize("header", [False, True])
def test_bare_group_codes_give_the_curves_that_marked_ones_give(tmp_path, header, end):
    marked, bare = tmp_path / "marked.dxf", tmp_path / "bare.dxf"
    marked.write_text(_whole(), "utf-8")
    if header:  # the entities alone lose their marks: tables and objects keep them
        head, entities = _whole().split("ENTITIES", 1)
        inside, behind = entities.split("ENDSEC", 1)
        stripped = _bare("  0\nSECTION\n  2\nENTITIES" + inside + "ENDSEC\n").split("ENTITIES", 1)[1]
        bare.write_text(head + "ENTITIES" + stripped.split("ENDSEC", 1)[0] + "ENDSEC" + behind, "utf-8", newline=end)
    else:
        bare.write_text(_bare(_whole()), "utf-8", newline=end)
    expected, drawing = read_drawing(marked), read_drawing(bare)
    assert [one[:1] + one[2:3] for one in drawing.entities] == [one[:1] + one[2:3] for one in expected.entities]
    np.testing.assert_allclose(drawing.curves.start_um, expected.curves.start_um, atol=1e-9)
    np.testing.assert_allclose(drawing.curves.end_um, expected.curves.end_um, atol=1e-9)
    said = [remark_text(note, "en") for note in drawing.notes]
    assert "left out, as no curves: 1 HATCH, 1 LEADER, 1 MTEXT" in said
    assert not any("damaged" in text for text in said)


def test_a_spline_alone_in_a_bare_file_is_the_curve_of_its_numbers(tmp_path):
    """A quadratic on three points: at its middle it is (p0 + 2 p1 + p2) / 4."""
    path = tmp_path / "bare.dxf"
    knots = "".join(f"40\n{knot}\n" for knot in (0.0, 0.0, 0.0, 1.0, 1.0, 1.0))
    places = "".join(f"10\n{x}\n20\n{y}\n30\n0.0\n" for x, y in ((0.0, 0.0), (4.0, 8.0), (10.0, 0.0)))
    path.write_text(f"{_HEAD}0\nSPLINE\n8\nCut\n70\n8\n71\n2\n72\n6\n73\n3\n74\n0\n{knots}{places}{_TAIL}")
    drawing = read_drawing(path)
    assert [(one.kind, one.layer) for one in drawing.entities] == [("SPLINE", "Cut")]
    ends = np.vstack([drawing.curves.start_um, drawing.curves.end_um])
    assert np.hypot(*(ends - (4500.0, 4000.0)).T).min() < 1e-6


def test_text_with_marks_and_text_that_wants_none_is_left_as_it_is():
    for text in (_whole(), _HEAD + _LINE + _TAIL, "", "0", "x\ny\nz"):
        data = text.encode()
        assert with_marks(data) is data


def test_marks_are_set_in_a_time_that_grows_with_the_file():
    entity = b"0\nSPLINE\n8\n0\n" + b"40\n0.0\n" * 50
    seconds = []
    for many in (200, 1600):
        data = entity * many
        began = time.process_time()
        assert with_marks(data).count(b"AcDbSpline") == many
        seconds.append(time.process_time() - began)
    assert seconds[1] < 30 * max(seconds[0], 1e-3)


def test_damage_beside_bare_codes_is_mended_as_anywhere(tmp_path):
    path = Path(tmp_path / "bare.dxf")
    text = _bare(_whole())
    path.write_text(text[: len(text) // 2], "utf-8")
    drawing = read_drawing(path)
    assert len(drawing.curves) > 1
    assert any("ends early" in remark_text(note, "en") for note in drawing.notes)
