"""One wrong contour of several is named and measured by itself, and pulls none of the others off."""

import math
from collections.abc import Mapping

import pytest
from compare_cases import circle, drawing_of, path_beside, square, together, toolpath
from drawings import Place
from sound_shapes import Shape

from parser.findings.catalogue import remark_text
from parser.program import parse_program
from sim.measure.compare.compare import compare_program
from sim.measure.compare.findings import drawing_findings
from sim.measure.compare.result import Comparison, FitRequest

R = 4000.0
CENTERS = ((10_000.0, 10_000.0), (50_000.0, 10_000.0), (50_000.0, 50_000.0), (10_000.0, 50_000.0))
OUTLINE = square(60_000.0)


def hole(at: Place, by: float = -100.0) -> tuple[Shape, Place]:
    return path_beside(circle(R, *at), by), at


def holes(changed: Mapping[int, tuple[Shape, Place]]) -> list[tuple[Shape, Place]]:
    return [changed.get(number) or hole(at) for number, at in enumerate(CENTERS)]


def held(cut: list[tuple[Shape, Place]], *drawn: Shape) -> Comparison:
    return compare_program(toolpath(together(*cut)), 100.0, drawing_of(*drawn), FitRequest(5.0))


def drawn_holes() -> list[Shape]:
    return [circle(R, *at) for at in CENTERS]


def test_each_wrong_contour_is_named_with_its_blocks() -> None:
    wrong = {0: hole(CENTERS[0], 0.0), 1: hole(CENTERS[1], 100.0), 2: hole((50_050.0, 49_980.0))}
    outline = path_beside(OUTLINE, 100.0), (-3000.0, -3000.0)
    text = together(*holes(wrong), outline)
    found = held([*holes(wrong), outline], *drawn_holes(), OUTLINE)
    assert [(named.name, named.values["first"]) for named in found.names] == [
        ("contour-offset-missing", 2),
        ("contour-wrong-side", 6),
        ("contour-shifted", 10),
    ]
    assert "+0.0500 mm in X and -0.0200 mm in Y" in remark_text(found.names[2])
    off = dict(zip(found.edge.block.tolist(), found.edge_to_drawing.max_um.tolist(), strict=True))
    # The others stay where they are, and each is off by its own fault.
    assert [off[block] for block in (2, 6, 10)] == pytest.approx([100.0, 200.0, math.hypot(50.0, 20.0)], abs=1.0)
    assert max(off[block] for block in (14, 18, 19, 20, 21)) < 0.1
    codes = [finding.code for finding in drawing_findings(parse_program(text), found)]
    assert codes == ["3B601", "3B601", "3B604", "3B604", "3B605"]


def test_one_hole_of_four_that_is_shifted_turns_no_program() -> None:
    found = held(holes({3: hole((10_040.0, 50_000.0))}), *drawn_holes())
    assert [(named.name, named.values["first"]) for named in found.names] == [("contour-shifted", 14)]
    assert found.placement.turn_rad == pytest.approx(0.0, abs=1e-9)
    assert found.max_um == pytest.approx(40.0, abs=0.1)


def test_holes_that_all_lie_elsewhere_turn_no_program() -> None:
    """Least squares would turn it by 0.01°, which moves holes by 7 µm and leaves each off by as much as before."""
    by = ((60.0, 20.0), (-10.0, 60.0), (-50.0, 5.0), (30.0, -40.0))
    cut = [hole((x + dx, y + dy)) for (x, y), (dx, dy) in zip(CENTERS, by, strict=True)]
    found = held(cut, *drawn_holes())
    assert found.placement.turn_rad == 0.0
    assert "turned" not in [named.name for named in found.names]
    assert not found.passes


def test_a_program_that_is_turned_is_still_told_so() -> None:
    turn = math.radians(0.02)
    cut = [hole((x * math.cos(turn) - y * math.sin(turn), x * math.sin(turn) + y * math.cos(turn))) for x, y in CENTERS]
    found = held(cut, *drawn_holes())
    assert [named.name for named in found.names] == ["turned"]
    assert math.degrees(found.placement.turn_rad) == pytest.approx(0.02, abs=1e-3)
    assert found.passes
