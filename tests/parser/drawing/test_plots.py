"""Plotter files and lists of curves as drawings: what pens draw, held against the interpreter of another library."""

import io
import math
import random
from pathlib import Path

import numpy as np
import pytest
import shapely
from ezdxf.addons.hpgl2.backend import Recorder, RecordType
from ezdxf.addons.hpgl2.interpreter import Interpreter
from ezdxf.addons.hpgl2.plotter import Plotter
from ezdxf.addons.hpgl2.tokenizer import hpgl2_commands, pe_encode

from parser.drawing.model import Drawing
from parser.drawing.plots.plotter import PLOT_UNIT
from parser.drawing.read import read_drawing
from parser.findings.errors import DrawingError
from parser.geometry.curves import joined

PLATE_PLT = (
    "IN;SP1;PU0,0;PD800,0,800,400;PD0,400,0,0;PU;SP2;PU200,200;CI80;"
    "PU500,120;PD660,120;AA660,200,180;PD500,280;AA500,200,180;PU;SP0;"
)
PLATE_CSV = """# plate, a hole and a slot
kind,x1,y1,x2,y2
line,0,0,20,0
line,20,0,20,10
line,20,10,0,10
line,0,10,0,0
circle,5,5,2
line,12.5,3,16.5,3
arc,16.5,3,16.5,7,16.5,5,ccw
line,16.5,7,12.5,7
arc,12.5,7,12.5,3,12.5,5,ccw
"""


def read(folder: Path, text: str, name: str = "part.plt") -> Drawing:
    file = folder / name
    file.write_bytes(text.encode("latin-1"))
    return read_drawing(file)


def drawn_lines(drawing: Drawing, parts: int = 64) -> shapely.Geometry:
    """All of it as lines, µm."""
    curves, lines = drawing.curves, []
    for row in range(len(curves)):
        share = np.linspace(0.0, 1.0, parts + 1 if curves.is_arc[row] else 2)[:, None]
        start, end = curves.start_um[row], curves.end_um[row]
        if curves.is_arc[row]:
            angle = curves.start_angle_rad[row] + curves.sweep_rad[row] * share[:, 0]
            heading = np.stack([np.cos(angle), np.sin(angle)], axis=1)
            lines.append(curves.center_um[row] + curves.radius_um[row] * heading)
        else:
            lines.append(start + share * (end - start))
    return shapely.union_all(np.array([shapely.linestrings(each) for each in lines]))


def plotted(text: str) -> shapely.Geometry:
    """The same by ezdxf's interpreter, whose arcs are Bézier curves; µm."""
    recorder = Recorder()
    Interpreter(Plotter(recorder)).run(hpgl2_commands(b"\x1b%1B" + text.encode("latin-1")))
    lines: list[np.ndarray] = []
    for kind, _, data in recorder.player().recordings():
        ways = [data.vertices()] if kind is RecordType.POLYLINE else [p.to_path().flattening(0.01, 32) for p in data]
        lines += [np.array([[place.x, place.y] for place in way]) for way in ways]
    shapes = [shapely.linestrings(each * PLOT_UNIT.um) for each in lines if len(each) > 1]
    return shapely.union_all(np.array(shapes))


def apart_um(this: shapely.Geometry, other: shapely.Geometry) -> float:
    """How far any place of one lies from the other at most, seen every 200 µm and at all ends."""
    return max(_off_um(this, other), _off_um(other, this))


def _off_um(of: shapely.Geometry, beside: shapely.Geometry) -> float:
    tree = shapely.STRtree(shapely.get_parts(beside))
    places = shapely.points(shapely.get_coordinates(shapely.segmentize(of, 200.0)))
    return float(tree.query_nearest(places, return_distance=True, all_matches=False)[1].max())


def test_a_plot_and_a_list_are_the_same_plate(tmp_path: Path) -> None:
    plot, listed = read(tmp_path, PLATE_PLT), read(tmp_path, PLATE_CSV, "part.csv")
    assert apart_um(drawn_lines(plot), drawn_lines(listed)) < 1e-6
    for drawing, version, unit in ((plot, "HPGL", "plot unit"), (listed, "CSV", "mm")):
        assert (drawing.version, drawing.unit) == (version, unit)
        assert sorted(len(loop.row) for loop in drawing.loops if loop.closed) == [1, 4, 4]
    assert {entity.layer for entity in plot.entities} == {"PEN 1", "PEN 2"}


def test_a_circle_of_a_plot_is_a_circle(tmp_path: Path) -> None:
    """In 40 units to the mm; a Bézier curve would be off by 0.03 % of the radius."""
    drawing = read(tmp_path, "IN;SP1;PU400,800;CI400;PU;")
    assert drawing.curves.radius_um == pytest.approx([10_000.0])
    assert drawing.curves.center_um[0] == pytest.approx([10_000.0, 20_000.0])


def random_plot(seed: int) -> str:
    """Moves and curves of most kinds, within some 3,000 units."""
    rng = random.Random(seed)

    def near() -> int:
        return rng.randint(-1500, 1500)

    parts = ["IN;", "SP1;", "PD40,30;", f"PU{near()},{near()};"]
    for _ in range(rng.randint(5, 25)):
        kind = rng.choice(["PA", "PR", "PD", "PU", "AA", "AR", "AT", "RT", "CI", "BZ", "BR", "PE"])
        x, y = near(), near()
        match kind:
            case "PA" | "PR":
                parts.append(f"{kind};PD{x},{y},{near()},{near()};")
            case "PD" | "PU":
                parts.append(f"{kind}{x},{y};")
            case "AA" | "AR":
                parts.append(f"PD;{kind}{x},{y},{rng.choice([-1, 1]) * rng.randint(5, 350)};")
            case "AT" | "RT":
                parts.append(f"PD;{kind}{x},{y},{near()},{near()};")
            case "CI":
                parts.append(f"PD;CI{rng.randint(10, 900)};")
            case "BZ" | "BR":
                parts.append(f"PD;{kind}{x},{y},{near()},{near()},{near()},{near()};")
            case "PE":
                parts.append("PE" + encoded(rng) + ";")
    return "".join(parts) + "PU;SP0;"


def encoded(rng: random.Random) -> str:
    base = rng.choice([32, 64])
    coded = b"7" if base == 32 else b""
    for _ in range(rng.randint(1, 6)):
        coded += b"<" if rng.random() < 0.2 else b""
        coded += b"=" if rng.random() < 0.2 else b""
        coded += b"".join(pe_encode(rng.randint(-900, 900), 0, base) for _ in range(2))
    return coded.decode("latin-1")


@pytest.mark.alike(20)
@pytest.mark.parametrize("seed", range(400))
def test_the_pens_draw_what_another_interpreter_has_them_draw(tmp_path: Path, seed: int) -> None:
    """Within three thousandths of the largest radius: so far its Bézier curves are off."""
    text = random_plot(seed)
    drawing = read(tmp_path, text)
    largest_um = float(np.max(drawing.curves.radius_um, initial=0.0, where=drawing.curves.is_arc))
    assert apart_um(drawn_lines(drawing, 128), plotted(text)) < 10.0 + 3e-3 * largest_um


@pytest.mark.parametrize("frame", ["EA300,200", "ER200,100"])
def test_a_rectangle_is_drawn_from_the_pen_to_its_far_corner(tmp_path: Path, frame: str) -> None:
    drawing = read(tmp_path, f"IN;SP1;PU100,100;{frame};PU;")
    assert [len(loop.row) for loop in drawing.loops if loop.closed] == [4]
    low, high = drawing.curves.start_um.min(axis=0), drawing.curves.start_um.max(axis=0)
    assert (low.tolist(), high.tolist()) == ([2500.0, 2500.0], [7500.0, 5000.0])


def test_the_edge_of_a_polygon_closes(tmp_path: Path) -> None:
    drawing = read(tmp_path, "IN;SP1;PU0,0;PM0;PD400,0,400,400,0,400;PM2;EP;PU;")
    assert [(loop.closed, len(loop.row)) for loop in drawing.loops] == [(True, 4)]


def test_user_units_are_scaled_between_the_corners(tmp_path: Path) -> None:
    plain = read(tmp_path, "IN;SP1;PU0,0;PD400,0,400,400,0,400,0,0;PU;")
    scaled = read(tmp_path, "IN;IP0,0,4000,4000;SC0,100,0,100;SP1;PU0,0;PD10,0,10,10,0,10,0,0;PU;")
    by_factor = read(tmp_path, "IN;IP0,0,4000,4000;SC0,40,0,40,2;SP1;PU0,0;PD10,0,10,10,0,10,0,0;PU;")
    for other in (scaled, by_factor):
        assert apart_um(drawn_lines(plain), drawn_lines(other)) < 1e-6


def test_what_a_plot_lacks_is_said(tmp_path: Path) -> None:
    whole = read(tmp_path, PLATE_PLT)
    assert [note.name for note in whole.notes] == ["whole-plot-units"]
    parts = read(tmp_path, "IN;SP1;PU0,0;PD400.5,0,400.5,400,0,400,0,0;PU;WG100,0,90;LBtwo words\x03PU;")
    assert [note.name for note in parts.notes if note.name.startswith(("whole", "plot"))] == ["plot-passed-over"]
    assert [each.why for each in parts.left_out] == ["text"]
    broken = read(tmp_path, PLATE_PLT.replace("SP2;", "SP2;LT2;"))
    assert {each.why for each in broken.left_out} == {"broken-line"}


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("IN;SP1;PU0,0;PD10,0;AA5,5;PU;", "AA has numbers that are none or too few: 5,5"),
        ("IN;SP1;PU0,0;PD1,1,2;PU;", "PD has numbers"),
        ("IN;SP1;PU0,0;PE<\x20;", "holds no line"),
        ("IN;SP1;PU0,0;PE?????", "PE has numbers"),
        ("IN;SP1;SC0,1,0,1;PU0,0;PD1,1;", "its size is known to the plotter alone"),
        ("IN;IP0,0,9,9;SC1,1,0,1;PU0,0;PD1,1;", "SC has numbers"),
        ("IN;SP1;PU0,0;PD" + "9" * 400 + ",0;PU;", "PD has numbers"),
        ("line,0,0,1\n", "line 1: “line,0,0,1” is no curve"),
        ("line,0,0,1,1\nline,0,0,x,1\n", "line 2: “line,0,0,x,1” is no curve"),
        ("circle,0,0,-1\n", "line 1"),
        ("circle,0,0,inf\n", "line 1"),
        ("arc,1,0,0,2,0,0,ccw\n", "line 1"),
        ("arc,1,0,0,1,0,0,left\n", "line 1"),
        ("line,0,0,1,1\nspline,0,0,1,1\n", "line 2: “spline,0,0,1,1” is no curve"),
    ],
)
def test_what_cannot_be_drawn_is_named(tmp_path: Path, text: str, said: str) -> None:
    with pytest.raises(DrawingError, match=r"part\.plt: ") as caught:
        read(tmp_path, text)
    assert said in str(caught.value)
    assert str(caught.value).count("part.plt") == 1


def test_arcs_of_a_list_go_the_way_they_say(tmp_path: Path) -> None:
    for sense, sweep in (("ccw", math.pi / 2), ("cw", -3 * math.pi / 2)):
        drawing = read(tmp_path, f"arc,10,0,0,10,0,0,{sense}\n", "arc.csv")
        assert float(joined([drawing.curves]).sweep_rad.sum()) == pytest.approx(sweep)
    whole = read(tmp_path, "arc;10,5;0;10,5;0;0;0;cw\n", "arc.csv")  # decimal commas
    assert float(np.abs(whole.curves.sweep_rad).sum()) == pytest.approx(2 * math.pi)
    assert whole.curves.radius_um == pytest.approx([10_500.0] * len(whole.curves))


def test_a_plot_without_end_is_refused(tmp_path: Path) -> None:
    text = io.StringIO()
    text.write("IN;SP1;")
    for _ in range(20_001):
        text.write("PU0,0;PD1,1;")
    with pytest.raises(DrawingError, match="more than 20,000 entities"):
        read(tmp_path, text.getvalue())
