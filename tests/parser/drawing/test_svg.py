"""SVG as drawings: forms of known size, in any unit, moved and turned; what is damaged or without end is refused."""

import math
from pathlib import Path

import numpy as np
import pytest

from parser.drawing.model import Drawing
from parser.drawing.read import read_drawing
from parser.findings.errors import DrawingError
from parser.geometry.along import places

HEAD = '<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink"'
IN_MM = f'{HEAD} width="50mm" height="30mm" viewBox="0 0 50 30">'


def read(folder: Path, body: str, head: str = IN_MM, flatten_um: float = 0.01) -> Drawing:
    file = folder / "part.svg"
    file.write_text(f"{head}{body}</svg>", "utf-8")
    return read_drawing(file, flatten_um=flatten_um)


def area_mm2(drawing: Drawing) -> float:
    """By many places along all curves: the loops are closed, and none lies in another one."""
    total = 0.0
    for loop in drawing.loops:
        assert loop.closed
        rows = [drawing.curves.picked(slice(row, row + 1)) for row in loop.row.tolist()]
        found = []
        for curve, back in zip(rows, loop.backwards.tolist(), strict=True):
            share = np.linspace(0.0, 1.0, 400)
            along = places(curve, np.zeros(400, dtype=np.int64), share[::-1] if back else share)
            found.append(along[:-1])
        ring = np.concatenate(found) / 1000.0
        x, y = ring.T
        total += abs(0.5 * float((x * np.roll(y, -1) - y * np.roll(x, -1)).sum()))
    return total


def box_mm(drawing: Drawing) -> tuple[float, ...]:
    ends = np.concatenate(
        [places(drawing.curves, np.arange(len(drawing.curves)), np.full(len(drawing.curves), share))
         for share in np.linspace(0, 1, 65)]
    )  # fmt: skip
    return tuple(np.round(np.concatenate([ends.min(axis=0), ends.max(axis=0)]) / 1000.0, 3).tolist())


@pytest.mark.parametrize(
    ("body", "area", "box"),
    [
        ('<rect x="5" y="5" width="20" height="10"/>', 200.0, (5, 15, 25, 25)),
        ('<rect x="5" y="5" width="20" height="10" rx="2"/>', 200.0 - (4 - math.pi) * 4, (5, 15, 25, 25)),
        ('<circle cx="10" cy="10" r="4"/>', 16 * math.pi, (6, 16, 14, 24)),
        ('<ellipse cx="10" cy="10" rx="2" ry="5"/>', 10 * math.pi, (8, 15, 12, 25)),
        ('<ellipse cx="10" cy="10" rx="5" ry="2" transform="rotate(90 10 10)"/>', 10 * math.pi, (8, 15, 12, 25)),
        ('<polygon points="0,0 10,0 0,10"/>', 50.0, (0, 20, 10, 30)),
        ('<path d="M 0 0 A 5 5 0 0 1 10 0 Z"/>', 12.5 * math.pi, (0, 30, 10, 35)),
        ('<path d="M 0 10 A 5 5 0 1 0 5 5 L 5 10 Z"/>', 75 * math.pi / 4, (0, 15, 10, 25)),
        ('<path d="M 0 10 Q 5 0 10 10 Z"/>', 100.0 / 3.0, (0, 20, 10, 25)),
        ('<path d="m 0 10 c 0 -10 10 -10 10 0 z"/>', 60.0, (0, 20, 10, 27.5)),
        ('<path d="M 0 10 h 10 v -5 H 0 Z"/>', 50.0, (0, 20, 10, 25)),
        ('<g transform="translate(10,5) scale(2)"><circle r="1"/></g>', 4 * math.pi, (8, 23, 12, 27)),
        ('<defs><circle id="c" r="1"/></defs><use href="#c" x="5" y="5"/>', math.pi, (4, 24, 6, 26)),
    ],
)
def test_forms_have_their_areas_and_boxes(tmp_path: Path, body: str, area: float, box: tuple[float, ...]) -> None:
    """Y points up in a drawing, and down from the height in SVG; to a millionth, as svgelements has inches."""
    drawing = read(tmp_path, body)
    assert area_mm2(drawing) == pytest.approx(area, rel=2e-5)
    assert box_mm(drawing) == pytest.approx(box, abs=2e-3)


def test_circles_and_round_corners_are_arcs(tmp_path: Path) -> None:
    drawing = read(tmp_path, '<circle cx="10" cy="10" r="4"/><rect x="20" y="5" width="20" height="10" rx="2"/>')
    radii = drawing.curves.radius_um[drawing.curves.is_arc]
    assert sorted(np.round(radii, 1).tolist()) == [2000.0] * 4 + [4000.0] * 4


@pytest.mark.parametrize(
    ("head", "size_mm"),
    [
        (f'{HEAD} width="96" height="96">', 25.4),
        (f'{HEAD} width="2in" height="2in" viewBox="0 0 96 96">', 50.8),
        (f'{HEAD} width="10cm" height="10cm" viewBox="0 0 96 96">', 100.0),
        (f'{HEAD} viewBox="0 0 96 96" width="96px" height="96px">', 25.4),
    ],
)
def test_the_size_is_that_of_the_page(tmp_path: Path, head: str, size_mm: float) -> None:
    low_x, low_y, high_x, high_y = box_mm(read(tmp_path, '<rect width="96" height="96"/>', head))
    assert (high_x - low_x, high_y - low_y) == pytest.approx((size_mm, size_mm), rel=1e-6)


def test_a_file_without_a_size_in_mm_says_so(tmp_path: Path) -> None:
    bare = read(tmp_path, '<rect width="96" height="96"/>', f'{HEAD} width="96" height="96">')
    assert [note.name for note in bare.notes] == ["no-svg-size"]
    assert read(tmp_path, '<rect width="9" height="9"/>').notes == ()
    in_mm = read_drawing(tmp_path / "part.svg", unit="mm")
    assert in_mm.unit == "mm"


def test_what_is_no_contour_is_left_out_and_told(tmp_path: Path) -> None:
    body = (
        '<g id="cut"><rect width="9" height="9"/></g><g display="none"><circle r="3"/></g><text x="3" y="3">A</text>'
        '<image width="3" height="3" href="a.png"/><line x1="0" y1="0" x2="9" y2="9" stroke-dasharray="2 1"/>'
    )
    drawing = read(tmp_path, body)
    assert sorted(each.why for each in drawing.left_out) == ["broken-line", "text"]
    assert "svg-passed-over" in [note.name for note in drawing.notes]
    assert [entity.layer for entity in drawing.entities] == ["cut"]


BOMB = "".join(
    f'<g id="b{n}">' + (f'<use href="#b{n - 1}"/>' * 10 if n else '<rect width="1" height="1"/>') + "</g>"
    for n in range(12)
)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (f"{IN_MM}<rect width=", "damaged"),
        (f"{IN_MM}{BOMB}</svg>", "more than 20,000 entities"),
        (f'{IN_MM}<g id="a"><use xlink:href="#a"/></g></svg>', "more than 20,000 entities"),
        (f"{IN_MM}{'<g>' * 500}<rect width='1' height='1'/>{'</g>' * 500}</svg>", "more than 20,000 entities"),
        (f'<!DOCTYPE svg [<!ENTITY a "aaaa">]>{IN_MM}<text>&a;</text></svg>', "no DXF file"),
        (f'<?xml version="1.0"?><!-- <!ENTITY -->{IN_MM}<rect width="9" height="9"/></svg>', "damaged (<!ENTITY)"),
        (f"{IN_MM}</svg>", "holds no line, arc or curve"),
        (f'{IN_MM}<path d="M 0 0 A nonsense"/></svg>', "part.svg"),
    ],
)
def test_what_cannot_be_read_is_refused_in_a_line(tmp_path: Path, text: str, said: str) -> None:
    (tmp_path / "part.svg").write_text(text, "utf-8")
    with pytest.raises(DrawingError, match=r"part\.svg: ") as caught:
        read_drawing(tmp_path / "part.svg")
    assert said in str(caught.value)
