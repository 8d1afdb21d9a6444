"""Stock that passes take off: closed forms of parallel paths, and the area that shapely says a pass removes."""

import random

import numpy as np
import pytest
import shapely
from rough_and_trim import REACH_UM, RoughAndTrim, TruePass, rough_and_trim

from parser.geometry.curves import Curves, Floats, curves_between
from parser.program import parse_program
from parser.shape.passes import Pass, find_passes
from sim.measure.passes import WireTaken, stocks_of
from sim.show.draw.flatten import along

SPACING_UM = 5.0
SIDE_UM = 2000.0


def taken(curves: Curves, off_um: dict[int, float] | None = None) -> WireTaken:
    """A wire on the ideal path, or so far to the left of it on some rows."""
    number = np.ceil(curves.length_um / SPACING_UM).astype(np.int64) + 1
    row = np.repeat(np.arange(len(curves)), number)
    share = (np.arange(len(row)) - np.repeat(np.cumsum(number) - number, number)) / (number[row] - 1)
    place, heading = along(curves, row, share)
    off = np.array([(off_um or {}).get(one, 0.0) for one in range(len(curves))])[row]
    left = np.stack([-heading[:, 1], heading[:, 0]], axis=1)
    length = curves.before_um[row] + share * curves.length_um[row]
    return WireTaken(row, place + off[:, None] * left, length, off, length)


def ring(grown_um: float, *, is_back: bool = False) -> Curves:
    """A square with round corners of 500 µm, grown to all sides: four lines and four arcs."""
    half, radius = SIDE_UM / 2.0 - 500.0, 500.0 + grown_um
    corner = np.array([[half, half], [-half, half], [-half, -half], [half, -half]])
    out = np.array([[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]]) * radius
    place = np.concatenate([np.stack([corner + out, corner + np.roll(out, -1, axis=0)], axis=1).reshape(-1, 2)])
    place = np.concatenate([place, place[:1]])
    sweep = np.tile([np.pi / 2.0, 0.0], 4)
    center = np.repeat(corner, 2, axis=0)
    if is_back:
        place, sweep, center = place[::-1], -sweep[::-1], center[::-1]
    return curves_between(place[:-1], place[1:], center, sweep)


def laid(*rings: Curves) -> Curves:
    return Curves(*(np.concatenate([getattr(one, name) for one in rings]) for name in Curves.__dataclass_fields__))


def passes_of(sides: list[int], rows: int = 8) -> list[Pass]:
    """A pass a ring, with the side that the part lies on; what its offset is does not matter."""
    return [
        Pass(0, at + 1, at * rows, (at + 1) * rows - 1, False, True, False, 0.0, side) for at, side in enumerate(sides)
    ]


@pytest.mark.parametrize("way", [(False, False, False), (False, True, False), (True, True, False)])
@pytest.mark.parametrize("sign", [1.0, -1.0], ids=["punch", "die"])
def test_parallel_passes_take_off_the_difference_of_their_offsets(sign: float, way: tuple[bool, ...]) -> None:
    offsets = [160.0, 120.0, 100.0]
    path = laid(*(ring(sign * by, is_back=back) for by, back in zip(offsets, way, strict=True)))
    to_part = [int(sign) * (-1 if back else 1) for back in way]  # rings run counter-clockwise
    found = stocks_of(path, passes_of(to_part), taken(path), np.full(len(path), REACH_UM))
    for stock, thick in zip(found, [2.0 * REACH_UM, 40.0, 20.0], strict=True):
        assert stock == pytest.approx((thick, thick, thick), abs=1e-6)


def test_the_stock_is_taken_from_where_the_wires_really_were() -> None:
    path = laid(ring(40.0), ring(0.0))
    rough_off = taken(path, dict.fromkeys(range(8), 3.0))  # to the left: nearer to the part inside
    trim_off = taken(path, dict.fromkeys(range(8, 16), 2.0))
    assert stocks_of(path, passes_of([1, 1]), rough_off, np.full(len(path), REACH_UM))[1] == pytest.approx(
        (37.0,) * 3, abs=1e-6
    )
    assert stocks_of(path, passes_of([1, 1]), trim_off, np.full(len(path), REACH_UM))[1] == pytest.approx(
        (42.0,) * 3, abs=1e-6
    )


@pytest.mark.parametrize(
    ("second_um", "side", "thick_um"),
    [
        (40.0, 1, 0.0),  # the same path once more
        (60.0, 1, 0.0),  # farther from the part than before
        (-260.0, 1, 200.0),  # so far that the kerfs do not meet
        (60.0, 0, 20.0),  # where the part may lie on either side, what is new on both
        (20.0, 0, 20.0),
    ],
)
def test_a_pass_takes_no_less_than_nothing_and_no_more_than_its_kerf(
    second_um: float, side: int, thick_um: float
) -> None:
    path = laid(ring(40.0), ring(second_um))
    stock = stocks_of(path, passes_of([side, side]), taken(path), np.full(len(path), REACH_UM))[1]
    assert stock == pytest.approx((thick_um,) * 3, abs=1e-6)


def test_other_edges_and_passes_that_the_wire_did_not_come_to_do_not_count() -> None:
    path = laid(ring(40.0), ring(0.0))
    way, (rough, trim) = taken(path), passes_of([1, 1])
    other = stocks_of(path, [rough, trim._replace(edge=1)], way, np.full(len(path), REACH_UM))[1]
    assert other == pytest.approx((200.0,) * 3)
    short = WireTaken(*(column[way.row < 8] for column in way))
    assert stocks_of(path, [rough, trim], short, np.full(len(path), REACH_UM)) == [pytest.approx((200.0,) * 3), None]


@pytest.mark.parametrize("seed", range(6))
def test_the_stock_is_the_area_that_a_pass_removes_over_its_length(seed: int) -> None:
    made = rough_and_trim(random.Random(seed), most_um=6000.0)
    path = parse_program(made.text).toolpath
    way = taken(path)
    found = stocks_of(path, find_passes(path).passes, way, np.full(len(path), REACH_UM))
    for one, stock in zip(made.passes, found, strict=True):
        before = [other for other in made.passes if (other.edge, other.number) == (one.edge, one.number - 1)]
        if one.is_tab or not before:
            continue
        assert stock is not None
        assert stock.mean_um == pytest.approx(band_um(made, one, before[0], way), abs=0.5)


def band_um(made: RoughAndTrim, one: TruePass, before: TruePass, way: WireTaken) -> float:
    """Mean thickness of what a pass removes on the part's side: its area over the length of its middle line."""
    own, earlier = (shapely.LineString(on(way, which)).buffer(REACH_UM, quad_segs=64) for which in (one, before))
    drawn = shapely.Polygon(on(way, one))
    inside = shapely.difference(own, earlier)
    is_punch = made.figures[one.edge].kind == "punch"
    band = shapely.intersection(inside, drawn) if is_punch else shapely.difference(inside, drawn)
    return float(2.0 * band.area / band.length) if band.length else 0.0


def on(way: WireTaken, one: TruePass) -> Floats:
    """Places (k, 2) of the wire on a pass."""
    return way.place_um[(way.row >= one.first) & (way.row <= one.last)]
