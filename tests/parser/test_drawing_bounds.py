"""A drawing as hostile as it may be ends in a drawing or in one line, and in bounded time."""

import tracemalloc
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from ezdxf.entities.insert import Insert

from parser.drawing import model
from parser.drawing.dxf import document
from parser.drawing.dxf.blocks import MOST_NESTED
from parser.drawing.dxf.entities import Spline
from parser.drawing.plane import places_at
from parser.drawing.read import read_drawing
from parser.findings.catalogue import remark_text
from parser.findings.errors import DrawingError

CORNERS = ((0, 0), (10, 0), (10, 10), (0, 10))


def dxf(entities: str, blocks: str = "") -> str:
    head = "0\nSECTION\n2\nHEADER\n9\n$ACADVER\n1\nAC1015\n0\nENDSEC\n"
    parts = f"0\nSECTION\n2\nBLOCKS\n{blocks}0\nENDSEC\n" if blocks else ""
    return f"{head}{parts}0\nSECTION\n2\nENTITIES\n{entities}0\nENDSEC\n0\nEOF\n"


def line(x: float = 0) -> str:
    return f"0\nLINE\n8\n0\n10\n{x}\n20\n0\n11\n{x + 1}\n21\n1\n"


def outline(bulge: str) -> str:
    vertices = "".join(f"10\n{x}\n20\n{y}\n42\n{bulge}\n" for x, y in CORNERS)
    return f"0\nLWPOLYLINE\n5\nFF\n100\nAcDbEntity\n8\n0\n100\nAcDbPolyline\n90\n4\n70\n1\n{vertices}"


def insert(name: str, array: str = "") -> str:
    return f"0\nINSERT\n8\n0\n2\n{name}\n10\n0\n20\n0\n{array}"


def block(name: str, content: str) -> str:
    return f"0\nBLOCK\n8\n0\n2\n{name}\n70\n0\n10\n0\n20\n0\n3\n{name}\n{content}0\nENDBLK\n8\n0\n"


def nested(depth: int) -> str:
    blocks = "".join(block(f"A{at}", insert(f"A{at + 1}")) for at in range(1, depth)) + block(f"A{depth}", line())
    return dxf(insert("A1"), blocks)


def laughs() -> str:
    return dxf(
        insert("A0"), "".join(block(f"A{at}", insert(f"A{at + 1}") * 10) for at in range(9)) + block("A9", line())
    )


def array() -> str:
    return dxf(insert("A", "70\n30000\n71\n30000\n44\n1\n45\n1\n"), block("A", line()))


def ellipses() -> str:
    huge = (
        "0\nELLIPSE\n5\nFF\n100\nAcDbEntity\n8\n0\n100\nAcDbEllipse\n10\n0\n20\n0\n30\n0\n11\n9000000\n21\n0\n31\n0\n"
    )
    return dxf(huge + "40\n0.5\n41\n0\n42\n6.283185307179586\n")


def _read(folder: Path, text: str) -> "list[str]":
    (folder / "part.dxf").write_text(text)
    return [remark_text(note) for note in read_drawing(folder / "part.dxf").notes]


@pytest.mark.parametrize("bulge", ["1e12", "-1e12", "1e9", "1e300", "1e308", "nan", "inf", "-inf"])
def test_a_bulge_that_cannot_be_is_left_out_and_said(tmp_path: Path, bulge: str) -> None:
    assert any("4" in note for note in _read(tmp_path, dxf(line() + outline(bulge))))
    assert len(read_drawing(tmp_path / "part.dxf").curves) == 1


@pytest.mark.parametrize("bulge", ["1e-320", "1e-9", "0.5", "-1", "100", "1e5"])
def test_a_bulge_that_can_be_is_drawn(tmp_path: Path, bulge: str) -> None:
    _read(tmp_path, dxf(outline(bulge)))
    assert len(read_drawing(tmp_path / "part.dxf").curves) == 4


@pytest.mark.parametrize(
    ("text", "most", "said"),
    [
        (lambda: dxf("".join(map(line, range(120)))), 100, "holds more than 100 entities; save the contour"),
        (laughs, 1000, "holds more than 1,000 entities once its blocks are inserted"),
        (array, 1000, "holds more than 1,000 entities once its blocks are inserted"),
        (lambda: nested(MOST_NESTED + 1), 200_000, f"has blocks within blocks, more than {MOST_NESTED} deep"),
        (ellipses, 200_000, "becomes more than 1,000 lines and arcs"),
        (lambda: dxf(outline("0") * 400), 200_000, "becomes more than 1,000 lines and arcs"),
    ],
)
def test_what_is_more_than_a_drawing_may_hold_is_one_line(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, text: Callable[[], str], most: int, said: str
) -> None:
    for module in ("parser.drawing.dxf.document", "parser.drawing.dxf.blocks"):
        monkeypatch.setattr(f"{module}.MOST_ENTITIES", most)
    monkeypatch.setattr(model, "MOST_CURVES", 1000)
    with pytest.raises(DrawingError) as caught:
        _read(tmp_path, text())
    assert f"part.dxf: {said}" in str(caught.value)


def test_an_array_is_counted_before_its_copies_are_made(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    made: list[Insert] = []
    copy = Insert.copy
    monkeypatch.setattr(
        Insert, "copy", lambda self, *given, **named: (made.append(self), copy(self, *given, **named))[1]
    )
    with pytest.raises(DrawingError, match="holds more than 200,000 entities once its blocks are inserted"):
        _read(tmp_path, array())
    assert len(made) <= 1


def test_an_array_without_a_copy_places_nothing(tmp_path: Path) -> None:
    _read(tmp_path, dxf(line() + insert("A", "70\n-3\n71\n-3\n44\n1\n45\n1\n"), block("A", line())))
    assert len(read_drawing(tmp_path / "part.dxf").curves) == 1


def test_blocks_may_nest_up_to_the_limit(tmp_path: Path) -> None:
    _read(tmp_path, nested(MOST_NESTED))
    assert len(read_drawing(tmp_path / "part.dxf").curves) == 1


def test_entities_are_counted_before_the_library_makes_anything_of_them(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(document, "MOST_ENTITIES", 50)
    monkeypatch.setattr(document.Document, "read", lambda *_: pytest.fail("the library was asked"))
    for end in ("\n", "\r\n", "\r"):
        (tmp_path / "part.dxf").write_bytes(dxf("".join(map(line, range(60)))).replace("\n", end).encode())
        with pytest.raises(DrawingError, match="more than 50 entities"):
            read_drawing(tmp_path / "part.dxf")


def test_a_million_places_on_a_spline_take_little_more_room_than_they_fill() -> None:
    spline = Spline(np.random.default_rng(1).uniform(0.0, 1e4, (12, 3)), np.ones(12), np.arange(16.0), 3)
    at = np.linspace(3.0, 12.0, 1_000_000)
    tracemalloc.start()
    place = places_at(spline, at)
    _, most = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert most < 4 * place.nbytes
    assert (place[::1000] == places_at(spline, at[::1000])).all()
