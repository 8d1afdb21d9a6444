"""Drawings on the page: laid beneath a program, made into one, and what a run is held against."""

import json
import math
import re
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from drawings_dxf import drawn
from ezdxf.layouts import Modelspace
from opened_page import OpenedPage, opened_page

from parser.findings.errors import DrawingError, SettingsError
from sim.serve.page.answers import answer
from sim.serve.page.drafter import _make
from sim.serve.page.drawings import LOOK_KEYS, MAKE_KEYS, PLAN_KEYS, is_drawing
from sim.serve.page.planner import _look
from sim.serve.page.runs import KEYS

# The plate of `plate` as a punch: the wire of 0.18 mm and its gap of 10 µm run 0.1 mm outside, from a thread point
# that lies 1 mm above its upper edge, at (0, 0) of the program.
PUNCH = """B0B900B900GYL4
B10100B0B10100GXL1
B0B10200B10200GYL4
B20200B0B20200GXL3
B0B10200B10200GYL2
B10100B0B10100GXL1
B0B900B900GYL2
DD
"""


def plate(space: Modelspace) -> None:
    """20 mm by 10 mm, its lower left corner at (30, 40) mm."""
    corners = [(30.0, 40.0), (50.0, 40.0), (50.0, 50.0), (30.0, 50.0)]
    for one, next_ in zip(corners, [*corners[1:], corners[0]], strict=True):
        space.add_line(one, next_)


@pytest.fixture(name="drawing", scope="module")
def drawing_file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return drawn(tmp_path_factory.mktemp("drawn"), plate).rename(tmp_path_factory.mktemp("named") / "plate.dxf")


@pytest.fixture(name="dxf", scope="module")
def drawing_bytes(drawing: Path) -> bytes:
    return drawing.read_bytes()


@pytest.fixture(name="served", scope="module")
def served_page() -> Iterator[OpenedPage]:
    with opened_page() as served:
        yield served


def came(served: OpenedPage, data: bytes, name: str = "plate.dxf") -> str:
    """The number of a drawing that came to the page."""
    number: str = json.loads(served.ask(f"read?name={name}", data).body)["drawing"]
    return number


@pytest.fixture(name="came_oddly", scope="module")
def drawing_of_an_odd_name(served: OpenedPage, dxf: bytes) -> tuple[str, Any]:
    """The number of a drawing whose name would lead elsewhere, and what the page is told of it."""
    number = came(served, dxf, "..%2F..%2F%3Cb%3E.dxf")
    return number, look(served, number)


def look(served: OpenedPage, number: str) -> Any:
    told = dict.fromkeys(LOOK_KEYS, "")
    return json.loads(served.ask("look", json.dumps({**told, "name": "part.3b", "drawing": number})).body)


def looked(drawing: Path, text: str, result: Path) -> Any:
    """What a look finds, a second sooner: here, in no process of its own."""
    files = {"drawing_file": str(drawing), "result_file": str(result)}
    _look({**dict.fromkeys(LOOK_KEYS, ""), "name": "part.3b", "text": text, **files})
    return json.loads(result.read_text("utf-8"))


def made(drawing: Path, result: Path, **values: str) -> Any:
    """What is made of a drawing, here as well."""
    files = {"drawing_file": str(drawing), "result_file": str(result)}
    _make({**dict.fromkeys(MAKE_KEYS, ""), "language": "3b", **files, **values})
    return json.loads(result.read_text("utf-8"))


def draft(served: OpenedPage, number: str, **values: str) -> Any:
    """The state once a program of a drawing is made, or is not."""
    told = {**dict.fromkeys(MAKE_KEYS, ""), "language": "3b"}
    assert served.ask("draft", json.dumps({**told, "drawing": number, **values})).status == 200
    return ended(served)


def ended(served: OpenedPage) -> Any:
    for _ in range(1200):
        state = json.loads(served.ask("progress").body)
        if state["state"] != "running":
            return state
        time.sleep(0.05)
    raise AssertionError(state)


def extent(curves: dict[str, list[float]]) -> tuple[float, float, float, float]:
    xs, ys = curves["place_x_um"], curves["place_y_um"]
    return min(xs), min(ys), max(xs), max(ys)


def test_a_file_is_a_drawing_by_its_name_or_its_first_lines() -> None:
    for data in (
        b"0\nSECTION\n2\nHEADER",
        b"  0\r\nSECTION",
        b"999\nby a CAD\n  0\nSECTION",
        b"AutoCAD Binary DXF\r\n",
    ):
        assert is_drawing("part", data)
    assert is_drawing("PART.DXF", b"")
    assert is_drawing("part.plt", b"IN;SP1;PU0,0;PD100,0,100,100;")
    assert is_drawing("part.svg", b"<svg xmlns='http://www.w3.org/2000/svg'></svg>")
    assert is_drawing("part", b"# list\nline,0,0,1,1\n")
    for data in (b"", b"B0B0B0GXL1", b"0\nB1B1B1GXL1", b"// SECTION"):
        assert not is_drawing("part.3b", data)


@pytest.mark.deeper
def test_a_drawing_alone_lies_as_it_is_drawn(came_oddly: tuple[str, Any]) -> None:
    _, found = came_oddly
    assert extent(found["curves"]) == (30_000.0, 40_000.0, 50_000.0, 50_000.0)
    assert found["curves"]["kind"] == ["line"] * 4


def test_beneath_a_program_it_lies_where_the_part_is_cut(drawing: Path, tmp_path: Path) -> None:
    found = looked(drawing, PUNCH, tmp_path / "look.json")
    # The path spans -10.1 to 10.1 and -11.1 to -0.9 mm; the part lies 0.1 mm inside of it.
    assert extent(found["curves"]) == pytest.approx((-10_000.0, -11_000.0, 10_000.0, -1000.0), abs=0.01)


def test_where_no_edge_can_be_told_it_lies_as_it_is_and_says_why(drawing: Path, tmp_path: Path) -> None:
    found = looked(drawing, "B1000B0B1000GXL1\nDD\n", tmp_path / "look.json")
    assert extent(found["curves"]) == (30_000.0, 40_000.0, 50_000.0, 50_000.0)
    assert "no contour of the program closes a loop" in found["told"][-1]["en"]


def planned(served: OpenedPage, number: str, **values: str) -> Any:
    laid = {"turn_rad": 0.0, "shift_um": [0.0, 0.0], "mirror": False}
    told = {**dict.fromkeys(PLAN_KEYS, ""), "language": "3b", "placement": json.dumps(laid), "drawing": number}
    return json.loads(served.ask("plan", json.dumps({**told, **values})).body)


def test_plans_are_those_that_the_maker_has_and_lie_as_the_drawing_does(served: OpenedPage, dxf: bytes) -> None:
    number = came(served, dxf)
    plan = planned(served, number)
    (figure,) = plan["figures"]
    assert (figure["number"], figure["spans"]) == (1, [[0, len(plan["path"]["kind"])]])
    assert figure["thread_um"] == [plan["path"]["place_x_um"][0], plan["path"]["place_y_um"][0]]
    assert extent(plan["path"])[::3] == (29_900.0, 50_100.0)  # µm: 0.1 mm outside
    assert plan["is_lead"][0], "from its thread point the wire comes by a lead"
    assert [said["en"] for said in plan["told"]] == ["Plan, not proved: 1 figure, 64.600 mm of way."]
    assert sum(plan["path"]["length_um"]) == pytest.approx(2.0 * (20_200.0 + 10_200.0) + 2.0 * 1_900.0)  # and its leads
    turned = {"turn_rad": math.pi / 2.0, "shift_um": [1000.0, 0.0], "mirror": False}
    laid = planned(served, number, placement=json.dumps(turned))
    x, y = plan["path"]["place_x_um"], plan["path"]["place_y_um"]
    assert laid["path"]["place_x_um"] == pytest.approx([1000.0 - each for each in y], abs=1e-3)
    assert laid["path"]["place_y_um"] == pytest.approx(x, abs=1e-3)


def test_a_plan_in_rounds_counts_the_passes_over_each_edge_as_they_are(served: OpenedPage, tmp_path: Path) -> None:
    """The trims of a hole come behind the cut of its tab, and there and back over that: they are 2 and 3 still."""

    def plate_with_holes(space: Modelspace) -> None:
        space.add_lwpolyline([(0, 0), (40, 0), (40, 24), (0, 24)], close=True)
        for x in (10, 30):
            space.add_circle((x, 12), 5)

    number = came(served, drawn(tmp_path, plate_with_holes).read_bytes())
    rounds = {"offset_mm": "0.14 0.12 0.1", "rough_first": "yes", "tab_mm": "2", "slug_tab_mm": "1.5"}
    plan = planned(served, number, **rounds)
    row_pass, length = np.array(plan["row_pass"]), np.array(plan["path"]["length_um"])
    for figure in plan["figures"]:
        cut = np.concatenate([np.arange(*span) for span in figure["spans"]])
        of_pass = [float(length[cut][row_pass[cut] == each].sum()) for each in (1, 2, 3)]
        assert of_pass[1] == pytest.approx(of_pass[0], rel=0.07), figure["number"]
        assert of_pass[2] >= of_pass[1]


def test_a_plan_that_cannot_be_says_why_by_the_controls_of_the_page(served: OpenedPage, dxf: bytes) -> None:
    number = came(served, dxf)
    for values, said in (
        ({"order": "2"}, "2"),
        ({"order": "x"}, "the order of figures"),
        ({"wire_side": "left"}, "nesting, inside, outside"),
        ({"passes": "", "offset_mm": "0.1 0.2"}, "the program: "),
    ):
        why = planned(served, number, **values)["why"]
        assert said in why["en"]
        assert "--" not in why["en"]
    assert planned(served, number, placement="nonsense")["why"] is None  # no page sends that: its process ended
    assert planned(served, number)["figures"], "another one plans on"
    assert served.ask("plan", json.dumps({**dict.fromkeys(PLAN_KEYS, ""), "drawing": "99"})).status == 404


def test_order_side_and_direction_of_the_page_are_those_of_the_program(tmp_path: Path) -> None:
    def holes(space: Modelspace) -> None:
        for x in (0.0, 20.0, 40.0):
            space.add_circle((x, 0.0), 5.0)

    file = drawn(tmp_path, holes)
    text = made(file, tmp_path / "made.json", wire_side="inside", direction="cw", order="2 ，3 1")["program"]["text"]
    arcs = [line for line in text.splitlines() if re.search(r"[SN]R[1-4]$", line)]
    assert {re.sub(r".*([SN]R)\d$", r"\1", line) for line in arcs} == {"SR"}, "clockwise"
    assert {line[1:5] for line in arcs} == {"4900"}, "inside"
    jumps = [line for line in text.splitlines() if re.match(r"B[24]0000B0B", line)]
    assert [line[-2:] for line in jumps] == ["L1", "L3"], "from 2 to 3, and back to 1"


def test_a_program_is_made_of_it_that_is_proved(served: OpenedPage, dxf: bytes) -> None:
    number = came(served, dxf)
    assert draft(served, number)["state"] == "done"
    made = json.loads(served.ask("drafted", json.dumps({"drawing": number})).body)
    assert (made["verdict"], made["told"][0]) == ("pass", {"en": "proved", "zh": "验证通过"})
    assert made["program"]["name"] == "plate.3b"
    asked = {"name": "plate.3b", "text": made["program"]["text"], "number": "", "machine": "", "thickness_mm": ""}
    checked = json.loads(served.ask("check", json.dumps(asked)).body)
    assert checked["verdict"] == "pass"
    low_x, _, high_x, _ = checked["size"]["box_um"]
    assert high_x - low_x == 20_200.0  # the wire runs 0.1 mm outside


def test_passes_and_language_of_the_program_are_those_of_the_form(drawing: Path, tmp_path: Path) -> None:
    program = made(drawing, tmp_path / "made.json", language="iso", offset_mm="0.2, 0.1")["program"]
    assert program["name"] == "plate.iso"
    assert program["text"].count("G92") <= 1
    assert answer("plate.iso", None, program["text"])["size"]["cut_um"] > 2 * 60_000.0


def test_holes_are_cut_without_a_core_where_that_is_ticked(tmp_path: Path) -> None:
    def plate(space: Modelspace) -> None:
        space.add_lwpolyline([(0, 0), (10, 0), (10, 10), (0, 10)], close=True)
        space.add_circle((5, 5), 1.0)

    drawing = drawn(tmp_path, plate)
    found = made(drawing, tmp_path / "made.json", no_core="yes")
    assert (found["verdict"], found["told"][0]["en"]) == ("pass", "proved")
    assert any(text["zh"].startswith("无芯切割") for text in found["told"])
    assert len(found["program"]["text"]) > len(made(drawing, tmp_path / "made.json")["program"]["text"])
    refused = made(drawing, tmp_path / "made.json", no_core="yes", offset_mm="0")
    assert "leave “holes up to 10 mm without a core” out, or give “offset of each pass mm”" in refused["told"][0]["en"]


def test_edges_in_common_are_cut_once_where_that_is_ticked(tmp_path: Path) -> None:
    def two(space: Modelspace) -> None:
        for x in (0, 6):
            space.add_lwpolyline([(x, 0), (x + 6, 0), (x + 6, 5), (x, 5)], close=True)

    drawing = drawn(tmp_path, two)
    found = made(drawing, tmp_path / "made.json", common_edges="yes")
    assert (found["verdict"], found["told"][0]["en"]) == ("pass", "proved")
    assert any("共边只切一次" in text["zh"] for text in found["told"])
    refused = made(drawing, tmp_path / "made.json", common_edges="yes", led_um="20")
    assert "leave “corrected wire lag µm” out, or “edges in common are cut once”" in refused["told"][0]["en"]


def test_thread_points_of_the_page_are_taken_and_its_control_is_named(drawing: Path, tmp_path: Path) -> None:
    chosen = made(drawing, tmp_path / "made.json")
    (said,) = [text for text in chosen["told"] if text["en"].startswith("chosen")]
    assert "“thread points at mm” names others" in said["en"]
    assert "“穿丝点 mm” 指定" in said["zh"]
    asked = made(drawing, tmp_path / "made.json", starts="28，45")  # a comma of a Chinese keyboard
    assert "Start Point = 28.00000 , 45.00000" in asked["program"]["text"]
    assert not [text for text in asked["told"] if text["en"].startswith("chosen")]
    for wrong in ("28", "28,45,1", "here,45"):
        with pytest.raises(SettingsError, match=r"thread point"):
            made(drawing, tmp_path / "made.json", starts=wrong)


def test_the_lag_of_the_wire_is_corrected_where_the_page_says_one(drawing: Path, tmp_path: Path) -> None:
    found = made(drawing, tmp_path / "made.json", led_um="20")
    assert (found["verdict"], found["told"][0]["en"]) == ("pass", "proved")
    assert "B19B19B19G" in found["program"]["text"]
    kept = made(drawing, tmp_path / "made.json", led_um="20", offset_mm="0")
    assert "leave “corrected wire lag µm” out" in kept["told"][0]["en"]
    with pytest.raises(SettingsError, match="lag of the wire"):
        made(drawing, tmp_path / "made.json", led_um="-1")


def test_a_program_that_is_not_proved_says_so_at_its_head(drawing: Path, tmp_path: Path) -> None:
    found = made(drawing, tmp_path / "made.json", offset_mm="0.2 0.1")  # the first pass sets the part free
    assert (found["verdict"], found["told"][0]["en"]) == ("fail", "not proved: the program fails its own proof")
    assert "3B406" in found["program"]["text"][:400]
    (todo,) = [text for text in found["told"] if text["en"].startswith("what to do")]
    assert "passes: 3 in “tab mm” holds it" in todo["en"]
    assert "：“支撑段 mm”填 3，" in todo["zh"]


@pytest.mark.deeper
def test_what_cannot_be_made_says_why(served: OpenedPage, dxf: bytes, drawing: Path, tmp_path: Path) -> None:
    state = draft(served, came(served, dxf), tab_mm="a lot")
    assert state["state"] == "wrong"
    assert "the tab in mm is a number, not 'a lot'" in state["why"]["en"]
    with pytest.raises(SettingsError, match="programs are written in 3b, 4b, iso"):
        made(drawing, tmp_path / "made.json", language="/etc/passwd")


@pytest.mark.deeper
def test_a_run_is_held_against_it(served: OpenedPage, dxf: bytes) -> None:
    told = dict.fromkeys(KEYS, "")
    wrong = PUNCH.replace("10200", "10300")
    asked = {**told, "name": "part.3b", "text": wrong, "number": "", "drawing": came(served, dxf)}
    assert served.ask("run", json.dumps(asked)).status == 200
    state = ended(served)
    assert (state["state"], state["verdict"]) == ("done", "fail")
    report = json.loads(served.ask(f"run/{state['run']}/report.json", method="GET").body)
    assert report["drawing"]["max_um"] > 5.0


@pytest.mark.deeper
def test_what_is_no_drawing_says_why(served: OpenedPage, tmp_path: Path) -> None:
    assert look(served, came(served, b"0\nSECTION\n2\nENTITIES\n0\nEOF\n"))["why"]
    (tmp_path / "part.dxf").write_bytes(b"\x00\xff" * 1000)
    with pytest.raises(DrawingError, match="is no DXF file"):
        looked(tmp_path / "part.dxf", "", tmp_path / "look.json")


def test_a_name_leads_nowhere_and_numbers_that_are_none_get_nothing(
    served: OpenedPage, came_oddly: tuple[str, Any]
) -> None:
    number, found = came_oddly
    assert found["curves"]["kind"] == ["line"] * 4
    told = dict.fromkeys(LOOK_KEYS, "")
    for wrong in ("999", "-1", "", "../0", "9" * 5000):
        assert served.ask("look", json.dumps({**told, "drawing": wrong})).status == 404
        assert served.ask("drafted", json.dumps({"drawing": wrong})).status == 404
    assert served.ask("look", json.dumps({"drawing": number})).status == 400


@pytest.mark.deeper
def test_a_drawing_can_be_what_is_opened(tmp_path: Path) -> None:
    with opened_page(drawn(tmp_path, plate)) as served:
        first = json.loads(served.ask("first").body)
        assert (first["name"], first["text"]) == ("part.dxf", "")
        assert look(served, first["drawing"])["curves"]["kind"] == ["line"] * 4


def crossed_plate(space: Modelspace) -> None:
    """A plate with two holes that cross, one that does not, and a disc with a gap of 0.3 mm."""
    space.add_lwpolyline([(0, 0), (20, 0), (20, 10), (0, 10)], close=True)
    for x in (4, 12, 14):
        space.add_circle((x, 5), 2)
    space.add_lwpolyline([(30, 0.3), (30, 10), (40, 10), (40, 0), (30, 0)])


def test_what_is_not_cut_makes_a_program_to_be_checked_and_names_the_controls_of_the_page(tmp_path: Path) -> None:
    told = made(drawn(tmp_path, crossed_plate), tmp_path / "made.json")
    assert told["verdict"] == "to-check"
    assert told["told"][0]["en"].startswith("to be checked: 3 curves")
    said = " ".join(each["en"] + each["zh"] for each in told["told"])
    assert "“join gaps up to mm” joins" in said
    assert "“只切” 选其一" in said
    assert not [option for option in ("--gap", "--pick", "--drawing-unit") if option in said]


def test_what_is_picked_is_cut_with_the_gap_and_the_unit_of_the_page(tmp_path: Path) -> None:
    path = drawn(tmp_path, crossed_plate)
    told = made(path, tmp_path / "made.json", picks="4,5; 35,5", join_mm="0.4")
    assert told["verdict"] == "pass"
    assert "GXL" in told["program"]["text"]
    small = made(path, tmp_path / "made.json", picks="0.004,0.005", unit="micron")
    assert small["verdict"] == "fail"


@pytest.mark.parametrize("values", [{"unit": "ell"}, {"join_mm": "wide"}, {"join_mm": "-1"}, {"picks": "the hole"}])
def test_what_no_drawing_is_read_by_is_refused(tmp_path: Path, values: dict[str, str]) -> None:
    with pytest.raises(SettingsError):
        made(drawn(tmp_path, crossed_plate), tmp_path / "made.json", **values)


def test_a_look_says_where_the_drawing_lies(tmp_path: Path) -> None:
    path = drawn(tmp_path, crossed_plate)
    assert looked(path, "", tmp_path / "look.json")["placement"] == {
        "turn_rad": 0.0,
        "shift_um": [0.0, 0.0],
        "mirror": False,
    }
