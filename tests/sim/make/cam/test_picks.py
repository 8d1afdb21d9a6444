"""Picks: what is named is cut, by the drawing's own parts and holes; a slip is refused."""

import math
from pathlib import Path

import pytest
from drawings_dxf import drawn
from drawn_loops import Piece, circle, drawing_of, square
from ezdxf.layouts import Modelspace
from made_programs import plan_of

from parser.drawing.model import Drawing
from parser.findings.errors import SettingsError
from sim.make.cam.model import CannotCutError
from sim.make.cam.parts import parts_of
from sim.setup.making import Making
from sim.setup.picks import pick_of

ENTITIES = [
    square(0, 0, 40),
    circle(10, 10, 5),
    circle(30, 30, 5),
    square(25, 5, 10),
    circle(30, 10, 2),
    circle(80, 0, 9),
]
"""A plate of 40 mm with two round holes and a square one, in which a disc stands; and a disc beside it."""


def _drawing(entities: list[list[Piece]] = ENTITIES) -> Drawing:
    drawing = drawing_of(entities)
    named = tuple(each._replace(layer="AB"[at % 2], color=at + 1) for at, each in enumerate(drawing.entities))
    return Drawing(*(named if name == "entities" else getattr(drawing, name) for name in Drawing.__dataclass_fields__))


def _areas(*picks: str) -> list[int]:
    parts = parts_of(_drawing(), Making(picks=tuple(pick_of(each, "--pick") for each in picks)))
    radii = [math.sqrt(abs(_area(figure.contour))) for figure in parts.figures]
    return sorted(round(each * 1e-3) for each in radii)


def _area(curves) -> float:
    x, y = curves.start_um.T
    to_x, to_y = curves.end_um.T
    arcs = (curves.radius_um**2 * (curves.sweep_rad - [math.sin(each) for each in curves.sweep_rad]))[curves.is_arc]
    return float(0.5 * ((x * to_y - to_x * y).sum() + arcs.sum()))


PLATE, ROUND, SQUARE, DISC, APART = 40, round(5 * math.sqrt(math.pi)), 10, round(2 * math.sqrt(math.pi)), 16


@pytest.mark.parametrize(
    ("picks", "sides"),
    [
        (("0",), [PLATE]),
        (("1", "4"), [DISC, ROUND]),
        (("20,20",), [ROUND, ROUND, SQUARE, PLATE]),  # in the material: the part with its holes
        (("10,12",), [ROUND]),  # in a hole: that one
        (("26,6",), [SQUARE]),
        (("30,10",), [DISC]),  # the part within a hole
        (("0,0..36,36",), [DISC, ROUND, ROUND, SQUARE]),
        (("36,36..0,0",), [DISC, ROUND, ROUND, SQUARE]),
        (("layer:b",), [ROUND, SQUARE, APART]),
        (("color:1", "color:6"), [APART, PLATE]),
    ],
)
def test_a_pick_takes_what_it_names(picks: tuple[str, ...], sides: list[int]) -> None:
    assert _areas(*picks) == sorted(sides)


def test_what_is_picked_keeps_its_side_and_its_number() -> None:
    whole = {figure.number: figure for figure in parts_of(_drawing(), Making()).figures}
    for figure in parts_of(_drawing(), Making(picks=(pick_of("10,12", ""), pick_of("4", "")))).figures:
        same = whole[figure.number]
        assert (figure.kind, figure.depth, figure.part) == (same.kind, same.depth, same.part)


def test_what_crosses_a_contour_that_is_picked_alone_does_not_matter() -> None:
    crossed = _drawing([square(0, 0, 10), square(5, 5, 10)])
    with pytest.raises(CannotCutError, match="crossing"):
        parts_of(crossed, Making())
    parts = parts_of(crossed, Making(picks=(pick_of("1", ""),)))
    assert [left.why for left in parts.left_out] == ["not-picked"]


@pytest.mark.parametrize("pick", ["FF", "200,200", "layer:C", "color:99", "0,0..1,1"])
def test_a_pick_of_nothing_is_refused(pick: str) -> None:
    with pytest.raises(CannotCutError, match="no-pick"):
        parts_of(_drawing(), Making(picks=(pick_of("0", ""), pick_of(pick, ""))))


@pytest.mark.parametrize("text", ["", "X", "1,", "1,2,3", "1,2..", "layer:", "color:0", "color:red", "nan,1", "1e99,0"])
def test_words_that_pick_nothing_are_refused(text: str) -> None:
    with pytest.raises(SettingsError):
        pick_of(text, "--pick")


@pytest.mark.parametrize("text", ["2F", "12.5,-8", "0,0..40,30.25", "layer:CUT:2", "color:7"])
def test_a_pick_is_written_as_it_is_read(text: str) -> None:
    assert str(pick_of(text, "")) == text


def lined(space: Modelspace) -> None:
    """A rectangle of four lines, the upper and the longest one in red; and a hole."""
    corners = [(0, 0), (30, 0), (30, 10), (0, 10)]
    for at, (start, end) in enumerate(zip(corners, [*corners[1:], corners[0]], strict=True)):
        space.add_line(start, end, dxfattribs={"color": 1 if at == 2 else 7, "layer": "FIT" if at == 0 else "0"})
    space.add_circle((15, 5), 2)


@pytest.mark.parametrize(
    ("picks", "starts_at"),
    [
        ((), (15.0, 0.0)),
        (("layer:FIT",), (15.0, 10.0)),
        (("color:1", "layer:FIT"), (0.0, 5.0)),
        (("15,1", "15,9", "-1,-1..1,11"), (30.0, 5.0)),
    ],
)
def test_no_cut_starts_on_an_edge_that_is_spared(
    tmp_path: Path, picks: tuple[str, ...], starts_at: tuple[float, float]
) -> None:
    making = Making(spared=tuple(pick_of(pick, "test") for pick in picks))
    plan = plan_of(drawn(tmp_path, lined), making)
    (entry,) = [cut.thread.entry for cut in plan.cuts if cut.figure.kind == "outline"]
    assert (entry.place_um.x / 1000.0, entry.place_um.y / 1000.0) == starts_at
    assert "starts-on-spared" not in [note.name for note in plan.notes]


def test_where_all_edges_are_spared_the_cut_starts_on_one_and_that_is_told(tmp_path: Path) -> None:
    making = Making(spared=(pick_of("-5,-5..35,15", "test"),))
    plan = plan_of(drawn(tmp_path, lined), making)
    (note,) = [note for note in plan.notes if note.name == "starts-on-spared"]
    assert note.values == {"figures": "1, 2"}


def test_an_edge_that_nobody_draws_cannot_be_spared(tmp_path: Path) -> None:
    with pytest.raises(CannotCutError) as caught:
        plan_of(drawn(tmp_path, lined), Making(spared=(pick_of("layer:OTHER", "test"),)))
    assert caught.value.refusal.why == "no-spare"
