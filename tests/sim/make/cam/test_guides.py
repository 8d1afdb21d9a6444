"""Programs for a wire that lags: the guides lead it, so that it cuts what is drawn, and no worse where the lag is else.

The wire that follows is a plain loop of its own here: the guides go on by some 0.1 µm and pull it straight to them.
"""

import math
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pytest
from drawings_dxf import drawn
from ezdxf.layouts import Modelspace
from made_programs import plate, plate_file
from runs import plain_scenario

from parser.geometry.along import outline
from parser.geometry.curves import Curves, curves_between
from sim.make.cam.guides import ARC_SHARE, CORNER_SHARE, guided
from sim.make.cam.maker import MadeProgram, NotMade, made_program
from sim.make.cam.model import Entry, Figure, FigureCut, PassCut, Thread
from sim.make.wanted import Wanted
from sim.setup.making import Corners, Making
from sim.setup.scenario import Scenario
from sim.setup.wire import DEFAULT_WIRE, WireForces

ANGLES = (30.0, 60.0, 90.0, 120.0, 150.0)
LAGS = (5.0, 20.0, 50.0, 100.0)
STEP_UM = 0.1
TO_3B = Wanted("3b")


class Way:
    """Lines and arcs one behind the other, as they are drawn."""

    def __init__(self, x: float, y: float) -> None:
        self.at = complex(x, y)
        self.rows: list[tuple[complex, complex, complex, float]] = []

    def line(self, to: complex) -> "Way":
        self.rows.append((self.at, to, complex(math.nan, math.nan), 0.0))
        self.at = to
        return self

    def arc(self, center: complex, sweep: float) -> "Way":
        to = center + (self.at - center) * complex(math.cos(sweep), math.sin(sweep))
        self.rows.append((self.at, to, center, sweep))
        self.at = to
        return self

    def curves(self) -> Curves:
        start, end, center = (np.array([[row[at].real, row[at].imag] for row in self.rows]) for at in range(3))
        return curves_between(start, end, center, np.array([row[3] for row in self.rows]))


def cut_along(along: Curves, figure: Figure | None = None) -> FigureCut:
    """A cut of one pass, without leads; what it is of does not matter here."""
    nothing = along.picked(slice(0))
    x, y = along.start_um[0].tolist()
    entry = Entry(0, 0.0, (x, y), (0.0, 1.0))  # type: ignore[arg-type]  # a pair will do
    thread = Thread((x, y), "contour", entry)  # type: ignore[arg-type]
    return FigureCut(figure, thread, 1, True, (PassCut(100.0, False, nothing, along, nothing),))  # type: ignore[arg-type]


def led(along: Curves, lag_um: float) -> Curves:
    """The guides' way round."""
    return guided(cut_along(along), lag_um).passes[0].along


def places(way: Curves, step_um: float = STEP_UM) -> np.ndarray:
    """Places so far apart, x + iy."""
    found = [complex(*way.start_um[0])]
    for row in range(len(way)):
        parts = max(int(way.length_um[row] / step_um), 1)
        share = np.arange(1, parts + 1) / parts
        if way.is_arc[row]:
            center = complex(*way.center_um[row])
            found += (
                (complex(*way.start_um[row]) - center) * np.exp(1j * way.sweep_rad[row] * share) + center
            ).tolist()
        else:
            start, end = complex(*way.start_um[row]), complex(*way.end_um[row])
            found += (start + (end - start) * share).tolist()
    return np.array(found)


def dragged(guides: np.ndarray, lag_um: float) -> np.ndarray:
    """Where a wire is that is straight at first, and pulled straight toward its guides where they are a lag away."""
    at, found = guides[0], []
    for guide in guides.tolist():
        by = guide - at
        if abs(by) > lag_um:
            at = guide - by / abs(by) * lag_um
        found.append(at)
    return np.array(found)


def apart(this: np.ndarray, other: np.ndarray) -> np.ndarray:
    """How far each place lies from the nearest of the others, which lie as near to each other."""
    import shapely

    tree = shapely.STRtree(shapely.points(other.real, other.imag))
    _, far = tree.query_nearest(shapely.points(this.real, this.imag), return_distance=True, all_matches=False)
    return np.asarray(far)


class Corner(NamedTuple):
    """What is off at a corner, in lags: the wire beside the way that is wanted, and that beside the wire."""

    beyond: float
    missed: float

    @property
    def off(self) -> float:
        return max(self)


def corner(turn_deg: float, said_um: float, lag_um: float) -> Corner:
    """Of two lines that meet at an angle, said to be cut with one lag and cut with another; none is said to be none."""
    turn, long = math.radians(turn_deg), 12.0 * max(said_um, lag_um)
    along = Way(-long, 0.0).line(0j).line(long * complex(math.cos(turn), math.sin(turn))).curves()
    wire = dragged(places(led(along, said_um) if said_um else along), lag_um)
    wanted = places(along)
    near = np.abs(wanted) < 6.0 * lag_um  # at its end the wire hangs a lag behind
    on = np.abs(wire) < 6.0 * lag_um
    return Corner(float(apart(wire[on], wanted).max()) / lag_um, float(apart(wanted[near], wire).max()) / lag_um)


@pytest.mark.alike(6)
@pytest.mark.parametrize("lag_um", LAGS)
@pytest.mark.parametrize("turn_deg", [side * angle for angle in ANGLES for side in (1, -1)])
def test_a_corner_is_cut_to_a_tenth_of_the_lag(turn_deg: float, lag_um: float) -> None:
    """Outside corners and inside ones turn to either side; what is off is the steps of the loop here besides."""
    assert corner(turn_deg, lag_um, lag_um).off <= 0.06 + 2.0 * STEP_UM / lag_um


@pytest.mark.parametrize("turn_deg", [3.0, 10.0, 20.0, *ANGLES, 170.0])
@pytest.mark.parametrize("share", [0.7, 1.3])
def test_a_lag_that_is_30_per_cent_else_leaves_no_corner_worse_than_no_correction(
    turn_deg: float, share: float
) -> None:
    with_it, without = (corner(turn_deg, said_um, 20.0 * share).off for said_um in (20.0, 0.0))
    assert with_it <= without + 2.0 * STEP_UM / 20.0


def test_uncorrected_a_right_angle_is_cut_off_by_0_482_lag() -> None:
    """From the corner itself the wire stays 0.66 lag away; the tractrix is at 0.482 lag (scenario wire-lag-corner)."""
    found = corner(90.0, 0.0, 20.0)
    assert found.beyond == pytest.approx(0.482, abs=0.01)
    assert found.missed == pytest.approx(0.66, abs=0.01)


def test_the_guides_run_ahead_on_lines_and_on_wider_arcs() -> None:
    by = ARC_SHARE * 20.0
    along = Way(0.0, 0.0).line(1000 + 0j).arc(1000 + 400j, math.pi / 2).line(1400 + 900j).curves()
    ahead = led(along, 20.0)
    line, arc, other = (ahead.picked(slice(row, row + 1)) for row in range(3))
    assert line.end_um[0] == pytest.approx([1000 + by, 0])
    assert arc.center_um[0] == pytest.approx([1000, 400])
    assert arc.radius_um[0] == pytest.approx(math.hypot(400, by))
    assert arc.sweep_rad[0] == pytest.approx(math.pi / 2)
    assert other.start_um[0] == pytest.approx([1400, 400 + by])
    assert other.end_um[0] == pytest.approx([1400, 900])


def test_round_a_small_arc_the_guides_pull_the_wire_round_it() -> None:
    """Of R 30 µm a wire with a lag of 20 µm makes R 22 µm; led, it is off by what the share leaves, 0.02 lag² / 2 R."""
    along = Way(-500.0, 0.0).line(0j).arc(30j, math.pi).line(-500 + 60j).curves()
    wanted = places(along)
    near = wanted.real > -200.0
    led_wire, wire = (dragged(places(way), 20.0) for way in (led(along, 20.0), along))
    assert apart(wanted[near], led_wire).max() < 0.4
    assert apart(wanted[near], wire).max() > 7.0


def ring(seed: int) -> Curves:
    """A closed way of 5 to 9 corners of any angle, about half of them round, of R 5 … 400 µm."""
    random = np.random.default_rng(seed)
    number = int(random.integers(5, 10))
    angle = np.sort(random.uniform(0, 2 * math.pi, number) * 0.2 + np.arange(number) * 2 * math.pi / number)
    corners = random.uniform(900, 2500, number) * np.exp(1j * angle)
    middle = 0.5 * (corners[-1] + corners[0])
    way = Way(middle.real, middle.imag)
    for at, place in enumerate(corners.tolist()):
        before, after = corners[at - 1], corners[(at + 1) % number]
        into, out = (place - before) / abs(place - before), (after - place) / abs(after - place)
        turn = math.atan2((into.conjugate() * out).imag, (into.conjugate() * out).real)
        radius = float(random.uniform(5, 400)) if random.random() < 0.5 else 0.0
        back = min(radius * math.tan(abs(turn) / 2), 0.4 * abs(place - before), 0.4 * abs(after - place))
        radius = back / math.tan(abs(turn) / 2)
        if radius < 2.0:
            way.line(place)
            continue
        way.line(place - back * into)
        way.arc(way.at + radius * into * (1j if turn > 0 else -1j), turn)
    return way.line(complex(middle)).curves()


def without_gouge(seed: int, step_um: float) -> None:
    """The wire stays within 0.06 lag of the way, and what ends are brought together by, in 5 to 100 µm of lag.

    At the start it comes on its way, and at the end it hangs behind: neither is looked at.
    """
    along, lag_um = ring(seed), float(np.random.default_rng(seed).choice(LAGS))
    wanted, wire = places(along, step_um), dragged(places(led(along, lag_um), step_um), lag_um)
    start = wanted[0]
    bound = 0.06 * lag_um + 0.5 + 2.0 * step_um
    assert apart(wire[np.abs(wire - start) > lag_um], wanted).max() <= bound
    assert apart(wanted[np.abs(wanted - start) > 6.0 * lag_um], wire).max() <= bound


@pytest.mark.parametrize("seed", range(12))
def test_no_way_round_is_gouged(seed: int) -> None:
    without_gouge(seed, 0.2)


@pytest.mark.deeper
def test_no_way_of_a_thousand_is_gouged() -> None:
    for seed in range(12, 1012):
        without_gouge(seed, 0.5)


def made(folder: Path, making: Making, wanted: Wanted = TO_3B, scenario: Scenario | None = None) -> MadeProgram:
    done = made_program(plate_file(folder, with_a_step), making, wanted, scenario or plain_scenario())
    assert isinstance(done, MadeProgram)
    return done


def with_a_step(space: Modelspace) -> None:
    """The plate, and a hole with an inside corner of the part."""
    plate(space)
    space.add_lwpolyline([(5, 0.6), (6.4, 0.6), (6.4, 1.2), (5.8, 1.2), (5.8, 2), (5, 2)], close=True)


def edge_um(done: MadeProgram) -> float:
    assert done.proof is not None
    assert done.proof.comparison is not None
    return done.proof.comparison.max_um


@pytest.mark.alike(3)
@pytest.mark.parametrize(
    "making",
    [
        Making(),
        Making(corners="round"),
        Making(lead="arc"),
        Making(direction="cw"),
        Making(overcut_um=1000.0),
        Making(tab_um=1000.0, passes_um=(120.0, 100.0)),
        Making(no_core=True),
    ],
)
def test_a_program_for_a_wire_that_lags_is_proved_with_that_lag(tmp_path: Path, making: Making) -> None:
    """Its edge lies off by what the same one without a lag is, and 0.06 lag."""
    straight, lagging = made(tmp_path, making), made(tmp_path, making._replace(lag_um=20.0))
    assert straight.is_proved
    assert lagging.is_proved, lagging.proof
    assert edge_um(lagging) <= edge_um(straight) + 1.2 + 1.0  # steps
    assert lagging.proof is not None
    assert lagging.proof.run is not None
    assert lagging.proof.run.scenario.wire_lag_um == 20.0


def test_small_circles_are_cut_with_a_lag_of_a_quarter_of_their_radius(tmp_path: Path) -> None:
    """The guides go round them 6 µm farther out: the leads end there, and the overcut comes back there."""

    def small(space: Modelspace) -> None:
        space.add_lwpolyline([(0, 0), (4, 0), (4, 4), (0, 4)], close=True)
        space.add_circle((1, 2), 0.3)
        space.add_circle((8, 2), 0.1)

    done = made_program(plate_file(tmp_path, small), Making(lag_um=50.0), TO_3B, plain_scenario())
    assert isinstance(done, MadeProgram)
    assert done.is_proved, done.proof
    assert edge_um(done) <= 6.0


def test_its_path_is_no_offset_of_the_drawing_and_without_a_lag_it_fails(tmp_path: Path) -> None:
    """What is held against the offset is the way of the wire; the path itself would leave the corners 19 µm off."""
    done = made(tmp_path, Making(lag_um=20.0))
    assert done.unled is not None
    assert done.wire_way is done.unled.toolpath
    assert done.proof is not None
    assert done.proof.path_um is not None
    assert done.proof.path_um < 0.1
    ends = outline(done.program.toolpath)
    assert ends[:, 0].max() == pytest.approx(done.wire_way.end_um[:, 0].max() + CORNER_SHARE * 20.0, abs=1.0)


@pytest.mark.parametrize(
    ("passes_um", "wanted", "why"), [((), Wanted("4b", keeps=True), "kept-lag"), ((0.0,), TO_3B, "no-lag-offset")]
)
def test_where_the_controller_adds_the_offset_no_lag_is_corrected(
    tmp_path: Path, passes_um: tuple[float, ...], wanted: Wanted, why: str
) -> None:
    done = made_program(plate_file(tmp_path), Making(lag_um=20.0, passes_um=passes_um), wanted, plain_scenario())
    assert isinstance(done, NotMade)
    assert done.refusal.why == why


def test_the_edge_at_the_faces_of_the_work_is_told_where_the_guides_are_known(tmp_path: Path) -> None:
    """Of a span of 100 mm and 40 mm of work the faces have three quarters of the lag of the middle: 60 µm of 80."""
    forces = WireForces(tension_n=12.0, pressure_n_mm=0.0003, guide_span_mm=100.0)
    scenario = plain_scenario(wire=replace(DEFAULT_WIRE, lag=forces), thickness_mm=40.0)
    done = made(tmp_path, Making(lag_um=20.0), scenario=scenario)
    assert done.proof is not None
    assert done.proof.faces is not None
    assert done.proof.faces.lag_um == pytest.approx(15.0)
    assert done.proof.faces.comparison.max_um <= 5.0
    assert [note.name for note in done.proof.notes] == ["lag", "faces"]


def test_where_nobody_says_where_the_guides_are_the_faces_are_left_open(tmp_path: Path) -> None:
    done = made(tmp_path, Making(lag_um=20.0))
    assert done.proof is not None
    assert done.proof.faces is None
    assert [note.name for note in done.proof.notes] == ["lag-middle"]


def a_disc(space: Modelspace) -> None:
    space.add_circle((0, 0), 5)


def a_house(space: Modelspace) -> None:
    space.add_lwpolyline([(0, 0), (9, 0), (9, 4), (6.5, 6.5), (0, 6.5)], close=True)


@pytest.mark.parametrize("passes_um", [(100.0,), (130.0, 100.0), (140.0, 120.0, 100.0)], ids=len)
@pytest.mark.parametrize(("draw", "corners"), [(a_disc, "sharp"), (a_house, "chamfer")])
def test_a_part_that_hangs_by_a_tab_is_proved_for_a_wire_that_lags(
    tmp_path: Path, draw: Callable[[Modelspace], None], corners: Corners, passes_um: tuple[float, ...]
) -> None:
    """Guides that came back from past the end made lines of 20 µm, which the checks took for arcs run backwards."""
    making = Making(passes_um=passes_um, tab_um=2500.0, lag_um=20.0, corners=corners)
    done = made_program(drawn(tmp_path, draw), making, TO_3B, plain_scenario())
    assert isinstance(done, MadeProgram)
    assert done.proof is not None
    assert done.is_proved, [*done.proof.counting, *done.proof.faults]
