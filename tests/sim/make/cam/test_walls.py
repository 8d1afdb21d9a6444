"""What lies between figures: waste that is too narrow for the wire is refused, thin walls are told."""

import time

import pytest
from drawn_loops import Piece, circle, drawing_of, polygon, square

from parser.findings.catalogue import remark_text
from sim.make.cam.contacts import walls
from sim.make.cam.model import CannotCutError
from sim.make.cam.parts import parts_of
from sim.setup.making import Making

REACH_UM = 100.0


def _told(*entities: list[Piece], offset_um: float | list[float] = REACH_UM) -> list[str]:
    """What is told of entities with one offset for all figures, or with one for each."""
    figures = parts_of(drawing_of(list(entities)), Making()).figures
    each = offset_um if isinstance(offset_um, list) else [offset_um] * len(figures)
    return [remark_text(note) for note in walls(figures, each, REACH_UM)]


@pytest.mark.parametrize(
    ("entities", "apart"),
    [
        ([square(0, 0, 10), square(10.19, 0, 10)], "0.19"),  # two parts
        ([square(0, 0, 10), square(10, 10, 10)], "0"),  # that touch
        ([square(0, 0, 50), square(10, 10, 30), square(10.15, 15, 10)], "0.15"),  # a part within a hole of another
        ([circle(0, 0, 5), circle(10.1, 0, 5)], "0.1"),
    ],
)
def test_waste_narrower_than_what_the_wire_removes_is_refused(entities, apart):
    with pytest.raises(CannotCutError) as caught:
        _told(*entities)
    assert caught.value.refusal.why == "too-near"
    assert dict(caught.value.refusal.values)["apart_mm"] == apart
    assert _told(*entities, offset_um=0.0) == []  # of a program on the contour itself nothing is known


def test_waste_as_wide_as_what_the_wire_removes_is_cut():
    assert _told(square(0, 0, 10), square(10.2, 0, 10)) == []
    pair = square(0, 0, 10), square(10.22, 0, 10)
    assert _told(*pair, offset_um=[100.0, 0.0]) == []
    for offsets in ([150.0, 100.0], [100.0, 150.0], [0.0, 150.0]):  # as much as the first of several passes lies off
        with pytest.raises(CannotCutError) as caught:
            _told(*pair, offset_um=offsets)
        assert dict(caught.value.refusal.values)["kerf_mm"] == "0.25"


def test_thin_walls_and_contours_that_touch_are_told_with_their_place():
    plate = square(0, 0, 50)
    assert _told(plate, square(10, 10, 10), square(20.1, 10, 10)) == [
        "walls thinner than the kerf is wide: 1, the thinnest of 100 µm at (20, 10) mm"
    ]
    assert _told(plate, circle(10, 10, 5), circle(20, 10, 5)) == [
        "contours touch, so that no wall is left there: 1 of their pairs, the first at (15, 10) mm"
    ]
    assert _told(plate, polygon([(0, 25), (10, 20), (10, 30)])) == [
        "contours touch, so that no wall is left there: 1 of their pairs, the first at (0, 25) mm"
    ]
    assert _told(plate, square(10, 10, 10), square(20.3, 10, 10)) == []


@pytest.mark.deeper
def test_a_plate_of_ten_thousand_lines_is_parted_and_looked_at_in_a_part_of_a_second():
    holes = [[piece] for at in range(2500) for piece in square(12 * (at % 50), 12 * (at // 50), 10)]
    drawing = drawing_of([*holes, square(-10, -10, 650)])
    begin = time.process_time()
    parts = parts_of(drawing, Making())
    assert walls(parts.figures, [REACH_UM] * 2501, REACH_UM) == ()
    taken_s = time.process_time() - begin
    assert [figure.kind for figure in parts.figures] == ["hole"] * 2500 + ["outline"]
    assert taken_s < 3.0  # 0.25 s on an idle core
