"""What rough cuts and trims leave, beside what shapely alone says of the drawing: kinds, boxes, radii, loose parts."""

import math
import random

import numpy as np
import pytest
from drawings import Arc
from rough_and_trim import REACH_UM, Figure, RoughAndTrim, left_polygon, rough_and_trim
from traced import STEEL, contours_of, trace_of

from parser.program import parse_program
from sim.cut.kerf.swept import kerf_of
from sim.cut.pieces.pieces import Pieces, pieces_of
from sim.cut.sizes import Sizes, sizes_of

ROUNDED_UM = 4.0  # ends in whole µm, and the edges of a table that stands on whole µm
COUNTED_UM = 10.0  # a trim that takes less of a loose piece runs along its own kerf again


def cut(made: RoughAndTrim) -> tuple[Pieces, Sizes]:
    path = parse_program(made.text).toolpath
    trace = trace_of(path, 5.0, lambda place, row: np.rint(place))
    kerf = kerf_of(path, trace, contours_of(path), np.full(len(path), REACH_UM))
    pauses = [stop.after for stop in path.stops if stop.kind == "pause"]
    pieces = pieces_of(kerf, None, STEEL, pauses)
    return pieces, sizes_of(path, kerf, pieces, None, np.zeros((len(path), 2)))


def radii_of(figure: Figure) -> list[float]:
    places = [figure.drawn.start, *(move.to for move in figure.drawn.moves)]
    return [math.dist(at, m.center) for at, m in zip(places, figure.drawn.moves, strict=False) if isinstance(m, Arc)]


def is_early(figure: Figure) -> bool:
    """A punch without a tab is loose while it is trimmed."""
    stock = figure.passes[0].offset_um - figure.passes[-1].offset_um
    return figure.kind == "punch" and not figure.tab_um and stock > COUNTED_UM


@pytest.mark.alike(2)
@pytest.mark.parametrize("seed", [2, 6, 8, 14, 20, 25])
def test_what_is_left_is_what_the_last_passes_leave_of_the_drawing(seed):
    made = rough_and_trim(random.Random(seed), most_um=3000.0)
    pieces, sizes = cut(made)
    kinds = {"punch": "part", "die": "opening"}
    assert sorted(box.what for box in sizes.boxes) == sorted(kinds[figure.kind] for figure in made.figures)
    for figure in made.figures:
        low_x, low_y, high_x, high_y = left_polygon(figure).bounds
        middle = (low_x + high_x) / 2, (low_y + high_y) / 2
        box = min(sizes.boxes, key=lambda box: math.dist(box.center_um, middle))
        assert box.what == kinds[figure.kind]
        assert box.center_um == pytest.approx(middle, abs=ROUNDED_UM)
        for widths in (box.cut_um, box.nominal_um):
            assert widths == pytest.approx((high_x - low_x, high_y - low_y), abs=ROUNDED_UM)
        assert pieces.freed[box.piece].early == is_early(figure)
    assert_last_passes(made, sizes)


def assert_last_passes(made: RoughAndTrim, sizes: Sizes) -> None:
    """Radii and distances are those of blocks of the last passes, and the radii those drawn."""
    last = {block + 1 for one in made.passes if one.offset_um == REACH_UM for block in range(one.first, one.last + 1)}
    assert {size.block for size in sizes.radii} <= last
    assert {block for size in sizes.distances for block in size.blocks} <= last
    drawn = [radius for figure in made.figures for radius in radii_of(figure)]
    for size in sizes.radii:
        assert min(abs(size.nominal_um - radius) for radius in drawn) < ROUNDED_UM
        assert size.cut_um == pytest.approx(size.nominal_um, abs=ROUNDED_UM)
