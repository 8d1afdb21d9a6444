"""Of random sheets in four units each contour is cut on its side and in its turn, by a way that shapely agrees with."""

from pathlib import Path

import numpy as np
import pytest
import shapely
from depth import cases
from random_sheets import Sheet, sheet
from runs import plain_scenario

from parser.geometry.along import outline
from sim.make.cam.maker import MadeProgram, NotMade, unproved
from sim.make.cam.model import FigureCut
from sim.make.wanted import Wanted
from sim.measure.compare.rings import polygon
from sim.setup.making import Making

TO_3B = Wanted("3b")
BY_UM = 100.0
SAME_UM = 20.0  # of area over border: gaps of 8 µm, ends in between
OFF_UM = 15.0  # a bridged gap moves a corner by as much as it is wide
WRITTEN_UM = 1.5
"""Of a written path off its plan, as conversions promise."""


def cut_of(made: MadeProgram, wanted: shapely.Polygon) -> FigureCut | None:
    """The cut of the contour that encloses what a polygon does, µm."""
    middle = np.array(wanted.centroid.coords[0])
    for cut in made.plan.cuts:
        ring = polygon(cut.figure.contour)
        if np.hypot(*(np.array(ring.centroid.coords[0]) - middle)) < SAME_UM and (
            ring.symmetric_difference(wanted).area < SAME_UM * wanted.length
        ):
            return cut
    return None


def made_of(folder: Path, seed: int) -> tuple[Sheet, MadeProgram | NotMade]:
    drawn = sheet(folder, seed)
    making = Making(passes_um=(BY_UM,), corners="round")
    return drawn, unproved(drawn.path, making, TO_3B, plain_scenario())


@pytest.mark.parametrize("seed", cases(12, 10_000))
def test_a_random_sheet_is_cut_as_it_was_drawn(tmp_path: Path, seed: int) -> None:
    drawn, done = made_of(tmp_path, seed)
    if not drawn.parts:
        assert isinstance(done, NotMade)
        return
    assert isinstance(done, MadeProgram), done
    assert sorted(left.why for left in done.plan.left_out if left.why in {"frame", "shared-edge"}) == sorted(drawn.left)
    turn = {cut.figure.number: at for at, cut in enumerate(done.plan.cuts)}
    found = 0
    for part in drawn.parts:
        cuts = [cut_of(done, shapely.affinity.scale(ring, 1000.0, 1000.0, origin=(0, 0))) for ring in part]
        assert None not in cuts
        outline_cut, *holes = [cut for cut in cuts if cut is not None]
        assert [cut.figure.kind for cut in (outline_cut, *holes)] == ["outline", *["hole"] * len(holes)]
        assert {cut.figure.part for cut in holes} <= {outline_cut.figure.part}
        assert all(turn[hole.figure.number] < turn[outline_cut.figure.number] for hole in holes)
        found += len(cuts)
        for ring, cut in zip(part, (outline_cut, *holes), strict=True):
            off_by_shapely(cut, shapely.affinity.scale(ring, 1000.0, 1000.0, origin=(0, 0)))
    assert found == len(done.plan.cuts)
    assert done.written.off_um < WRITTEN_UM


def off_by_shapely(cut: FigureCut, ring: shapely.Polygon) -> None:
    """Asserts that the way of a cut is the border of what shapely makes of its contour: by its corners and by area."""
    wanted = ring.buffer(BY_UM if cut.figure.kind == "outline" else -BY_UM, quad_segs=32)
    made = shapely.Polygon(outline(cut.passes[0].along))
    assert wanted.exterior.hausdorff_distance(made.exterior) < OFF_UM
    assert wanted.symmetric_difference(made).area < SAME_UM * wanted.length
