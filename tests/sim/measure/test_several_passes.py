"""Rough cut and trims held against their drawing: one verdict of the exact path, of the edge as cut, and of what is so.

Programs come from `rough_and_trim.py`. A drawing that is not the program's own is made of its contour, moved aside.
"""

import math
import random
from typing import NamedTuple

import numpy as np
import pytest
from compare_cases import drawing_of
from compare_cases import polygon as closed
from drawings import Arc, Line, Place
from paths import Pen
from rough_and_trim import REACH_UM, Figure, RoughAndTrim, left_polygon, rough_and_trim
from sound_offset import offset
from sound_shapes import Shape
from traced import STEEL, kerf_along

from parser.program import parse_program
from parser.toolpath import Toolpath
from sim.cut.pieces.pieces import pieces_of
from sim.measure.compare.compare import compare, compare_program
from sim.measure.compare.program_edge import edge_at, program_edges
from sim.measure.compare.result import Comparison, FitRequest
from sim.measure.compare.rings import edge_as_cut, polygon

ASKED = FitRequest(6.0)
"""A CAM that rounds ends of arcs drifts by some µm over many of them."""
SIDE = 4000.0
_INSIDE_UM = {"offset-missing": 100.0, "wrong-side": 200.0}


class Case(NamedTuple):
    """A program, and the drawing of it in which one contour is another: then the program has a fault there."""

    made: RoughAndTrim
    fault: str
    of: Figure
    drawn: list[Shape]

    @property
    def path(self) -> Toolpath:
        return parse_program(self.made.text).toolpath

    @property
    def exact(self) -> Comparison:
        return compare_program(self.path, REACH_UM, drawing_of(*self.drawn), ASKED)

    @property
    def as_cut(self) -> Comparison:
        kerf = kerf_along(self.path)
        edge = edge_as_cut(self.path, kerf, pieces_of(kerf, None, STEEL))
        assert edge is not None
        return compare(edge, drawing_of(*self.drawn), ASKED)


def case(seed: int, fault: str, kind: str | None = None) -> Case:
    rng = random.Random(seed)
    made = rough_and_trim(rng, most_um=4000.0, kind=kind)
    wrong = rng.choice(made.figures)
    return Case(made, fault, wrong, [_drawn(figure, fault if figure is wrong else "") for figure in made.figures])


def _drawn(figure: Figure, fault: str) -> Shape:
    """The contour as it would be drawn if the program had a fault there."""
    if fault == "shifted":
        return _moved(figure.drawn, (48.0, -36.0))
    if fault not in _INSIDE_UM:
        return figure.drawn
    aside = offset(figure.drawn, _INSIDE_UM[fault] * (1.0 if figure.kind == "punch" else -1.0), round_corners=False)
    assert aside is not None
    return aside


def _moved(shape: Shape, by: Place) -> Shape:
    def put(place: Place) -> Place:
        return place[0] + by[0], place[1] + by[1]

    moves = [Line(put(m.to)) if isinstance(m, Line) else Arc(put(m.to), put(m.center), m.turn) for m in shape.moves]
    return shape._replace(start=put(shape.start), moves=moves)


@pytest.mark.parametrize("seed", range(5))
def test_a_right_program_passes_and_nothing_is_named(seed: int) -> None:
    """Lead-ins through earlier kerfs, trims and tabs are no leads into the part."""
    found = case(seed, "").exact
    assert found.passes
    assert found.names == ()
    assert {note.name for note in found.notes} <= {"sharp-corners"}


@pytest.mark.parametrize("seed", range(10, 13))
def test_the_edge_of_all_passes_is_what_shapely_says_of_the_last(seed: int) -> None:
    made = case(seed, "").made
    of = program_edges(parse_program(made.text).toolpath, REACH_UM)
    for at, figure in enumerate(made.figures):
        alone = of.alone(at)
        edge = edge_at(alone, alone.sides[0], REACH_UM)
        off_um = polygon(edge.curves).exterior.hausdorff_distance(left_polygon(figure).exterior)
        assert off_um < ASKED.tolerance_um
        last = [one for one in figure.passes if one.offset_um == REACH_UM]
        made_by = {int(block) - 1 for block in edge.block}
        assert made_by <= {row for one in last for row in range(one.first, one.last + 1)}


@pytest.mark.parametrize(("seed", "fault"), [(43, "wrong-side"), (45, "offset-missing")])
def test_a_fault_of_a_whole_program_is_named(seed: int, fault: str) -> None:
    found = case(seed, fault).exact
    assert [named.name for named in found.names] == [fault]
    assert not found.passes


@pytest.mark.alike(1)
@pytest.mark.parametrize("fault", ["offset-missing", "shifted"])
def test_a_fault_of_one_contour_is_named_with_its_last_blocks(fault: str) -> None:
    one = next(made for made in (case(seed, fault, "plate") for seed in range(30, 60)) if len(made.made.figures) > 2)
    (named,) = one.exact.names
    assert named.name == f"contour-{fault}"
    assert any(cut.first <= int(named.values["first"]) - 1 <= cut.last for cut in one.of.passes)
    if fault == "shifted":
        shift = (float(named.values["shift_x_mm"]), float(named.values["shift_y_mm"]))
        assert math.dist(shift, (-0.048, 0.036)) < 0.003


@pytest.mark.alike(1)
@pytest.mark.parametrize(("seed", "fault"), [(42, ""), (46, "offset-missing")])
def test_the_exact_path_and_the_edge_as_cut_give_one_verdict(seed: int, fault: str) -> None:
    one = case(seed, fault)
    exact, as_cut = one.exact, one.as_cut
    assert exact.passes == as_cut.passes == (not fault)
    assert as_cut.max_um == pytest.approx(exact.max_um, abs=0.5)
    assert len(as_cut.unreachable) == len(exact.unreachable)


def test_what_a_pass_leaves_beside_a_trim_that_misses_it_counts() -> None:
    """Of an opening that is cut at 106 µm, and whose trim is 10 µm too low: 10 are lost at the bottom.

    At the top the trim would leave 10, but the first cut left 6: those are what stays.
    """
    pen = Pen()
    for inside, up in ((106.0, 0.0), (100.0, -10.0)):
        half = SIDE - inside
        for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1), (-1, -1)):
            pen.to(x * half, y * half + up)
    corners = [(x * SIDE, y * SIDE) for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    found = compare_program(pen.path(), REACH_UM, drawing_of(closed(*corners)), FitRequest(5.0, fitted=False))
    of, off = found.edge.curves, found.edge_to_drawing.max_um
    level = np.abs(of.start_um[:, 1] - of.end_um[:, 1]) < 0.01  # µm, as near as the nominal kerf's edge is
    top, bottom = level & (of.start_um[:, 1] > 0.0), level & (of.start_um[:, 1] < 0.0)
    assert off[top].max() == pytest.approx(6.0, abs=0.05)
    assert off[bottom].max() == pytest.approx(10.0, abs=0.05)
    assert (found.edge_side[top].max(), found.edge_side[bottom].min()) == (1, -1)
    assert found.names == ()
