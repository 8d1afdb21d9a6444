"""What a path is made of, and where its fields stand in the text."""

import numpy as np
import pytest

from parser.program import parse_program
from parser.shape.contours import contour_rows, find_contours, runs
from parser.text.source import Field, Source

TWO_HOLES = "B5B0B5GXL1B5B0B20GYNR1B5B0B5GXL3 D B9B0B9GXL1 D B5B0B5GXL1B5B0B20GYNR1 DD"


def test_jumps_part_the_runs() -> None:
    toolpath = parse_program(TWO_HOLES).toolpath
    assert toolpath.is_jump.tolist() == [False] * 3 + [True] + [False] * 2
    assert runs(toolpath).tolist() == [[0, 3], [4, 6]]
    assert contour_rows(toolpath).tolist() == [0, 0, 0, -1, 1, 1]
    contours = find_contours(toolpath, np.zeros((7, 2), dtype=np.int64))
    assert [(contour.first, contour.last) for contour in contours] == [(1, 3), (5, 6)]


def test_the_length_before_each_row() -> None:
    toolpath = parse_program("B3B4B4GYL1 B0B5B5GYL2 DD").toolpath
    assert toolpath.before_um.tolist() == [0.0, 5.0, 10.0]


@pytest.mark.parametrize("text", ["N1:B30 B0B 30 G X L 1 DD", "Ｎ１：Ｂ３０ B0B 30 ＧＸＬ１ DD"])
def test_a_source_tells_where_a_field_stands(text: str) -> None:
    source = parse_program(text).toolpath.source
    written = {field: source.field(0, field) for field in Field}
    shown = {field: text[slice(*span)] for field, span in written.items() if span}
    assert {field: "".join(said.split()) for field, said in shown.items()} == {
        Field.X: text[4:6],
        Field.Y: "0",
        Field.COUNT: "30",
        Field.AXIS: "GX" if text.isascii() else "ＧＸ",
        Field.SENSE: "L1" if text.isascii() else "Ｌ１",
    }
    assert written[Field.RADIUS] is None


def test_an_empty_field_has_its_place() -> None:
    source = parse_program("BBB40000GXL1 DD").toolpath.source
    assert source.field(0, Field.X) == (1, 1)


def test_nobody_points_at_fields_that_no_reader_finds() -> None:
    none = np.zeros(1, dtype=np.int64)
    source = Source("go", none + 1, np.array([[0, 2]]), none + 1, ("",))
    assert source.field(0, Field.X) is None
    assert source.block_text(0) == "go"
