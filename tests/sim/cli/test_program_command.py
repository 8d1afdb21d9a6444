"""``drycut program`` as a user meets it: files, exit codes, tables in both languages, refusals, bad use."""

import json
import re
from pathlib import Path

import pytest
from command import run_inside
from drawings_dxf import drawn
from ezdxf.layouts import Modelspace
from PIL import Image

from parser.program import read_program
from sim.show.terminal.wrap import cells

PLATE = 6.0, 4.0
"""Sides of the plate of these tests, mm; its hole is round, R 0.8."""


def plate(space: Modelspace) -> None:
    width, height = PLATE
    space.add_lwpolyline([(0, 0), (width, 0), (width, height), (0, height)], close=True)
    space.add_circle((width / 3, height / 2), 0.8)


def crossed(space: Modelspace) -> None:
    space.add_line((0, 0), (5, 0))


@pytest.fixture
def part(tmp_path: Path) -> Path:
    return drawn(tmp_path, plate)


def run(*arguments: object, **environment: str) -> tuple[int, str, str]:
    done = run_inside("program", *arguments, **environment)
    return done.returncode, done.stdout.decode(), done.stderr.decode()


def test_a_drawing_becomes_a_proved_program(part: Path) -> None:
    out = part.with_suffix(".3b")
    code, said, _ = run(part, "-o", out)
    assert code == 0, said
    program = read_program(out)
    assert int(program.toolpath.is_jump.sum()) == 1  # from the hole to the outline
    assert "proved" in said.splitlines()
    assert max(map(cells, said.replace(str(out), "").splitlines())) <= 80
    hole, outline = (line.split("│") for line in said.splitlines() if "hole of" in line or "outline of" in line)
    assert [cell.strip() for cell in hole[2:4]] == ["hole of 1", "inside"]
    assert [cell.strip() for cell in outline[2:4]] == ["outline of 1", "outside"]
    assert {int(hole[1]), int(outline[1])} == {1, 2}
    blocks, length = int(hole[4]) + int(outline[4]), float(hole[5]) + float(outline[5])
    assert blocks == len(program.toolpath) - 1
    assert length == pytest.approx(float(program.toolpath.length_um[~program.toolpath.is_jump].sum()) / 1e3, abs=1e-3)


def smaller(space: Modelspace) -> None:
    """The plate of the top: narrower by 0.2 mm to each side, its hole wider."""
    width, height = PLATE
    corners = [(0.2, 0.2), (width - 0.2, 0.2), (width - 0.2, height - 0.2), (0.2, height - 0.2)]
    space.add_lwpolyline(corners, close=True)
    space.add_circle((width / 3, height / 2), 0.9)


@pytest.mark.parametrize(("name", "files"), [("out.3b", {"out.3b", "out-upper.3b"}), ("out.iso", {"out.iso"})])
def test_two_drawings_become_a_program_of_both_contours(part: Path, name: str, files: set[str]) -> None:
    (part.parent / "above").mkdir()
    above, folder = drawn(part.parent / "above", smaller), part.parent / "made"
    folder.mkdir()
    options = ("--upper", above, "--height", "10mm", "-o", folder / name)
    code, said, _ = run(part, *options)
    assert code == 0, said
    assert {file.name for file in folder.iterdir()} == files
    assert "matched curve by curve with the drawing of the top" in " ".join(said.split())
    assert ("out-upper.3b;runbothwith--upper" in "".join(said.split())) == (len(files) > 1)
    code, _, told = run(part, *options, "--taper", "3deg")
    assert (code, "an angle and an upper program were given" in " ".join(told.split())) == (2, True)


def test_what_is_no_drawing_of_the_top_is_told_and_nothing_is_written(part: Path) -> None:
    out = part.with_name("out.iso")
    for upper, complaint in ((part.with_name("nowhere.dxf"), "cannot be read"), (Path(__file__), "is no DXF file")):
        code, _, told = run(part, "--upper", upper, "-o", out)
        assert (code, complaint in " ".join(told.split())) == (2, True)
    assert not out.exists()


def test_a_preview_writes_a_picture_alone_and_its_table_fits_the_width(part: Path) -> None:
    picture = part.with_name("plan.svg")
    options = ("--preview", "--picture", picture, "--pass", "0.13mm", "--pass", "0.1mm", "--tab", "2mm")
    code, said, _ = run(part, *options, "--lang", "zh", "--theme", "dark")
    assert code == 0, said
    assert "穿丝点" in said
    assert max(map(cells, said.replace(str(picture), "").splitlines())) <= 80
    assert "切割规划" in picture.read_text("utf-8")
    assert sorted(file.name for file in part.parent.iterdir()) == [part.name, picture.name]


def test_json_stands_alone_on_stdout(part: Path) -> None:
    code, said, _ = run(part, "--preview", "--json")
    assert code == 0
    assert json.loads(said)["schema"] == "drycut.program/1"


def test_a_drawing_without_a_contour_is_refused_with_its_place(tmp_path: Path) -> None:
    path = drawn(tmp_path, crossed)
    out = path.with_suffix(".3b")
    code, said, _ = run(path, "-o", out)
    assert (code, out.exists()) == (1, False)
    assert "no contour of the drawing is closed" in " ".join(said.split())
    assert "(0, 0) mm" in " ".join(said.split())
    assert json.loads(run(path, "-o", out, "--json")[1])["schema"] == "drycut.program/1"


def test_a_program_that_is_there_stays_where_none_is_proved(tmp_path: Path) -> None:
    path = drawn(tmp_path, crossed)
    out = path.with_suffix(".3b")
    out.write_bytes(b"kept")
    assert run(path, "-o", out)[0] == 1
    assert out.read_bytes() == b"kept"


@pytest.mark.deeper
def test_the_suffix_or_as_tells_the_language(part: Path) -> None:
    out = part.with_suffix(".iso")
    assert run(part, "-o", out, "--dialect", "robofil", "--crlf")[0] == 0
    data = out.read_bytes()
    assert data.startswith(b"%\r\n")
    picture = part.with_name("a.png")
    code, *_ = run(part, "-o", part.with_suffix(".txt"), "--as", "4b", "--preview", "--picture", picture)
    assert code == 0
    assert [file.suffix for file in sorted(part.parent.iterdir())] == [".png", ".dxf", ".iso"]
    with Image.open(picture) as image:
        assert image.width == 1600


@pytest.mark.parametrize(
    ("options", "told"),
    [
        ((), "-o FILE says where"),
        (("-o", "part.txt"), "give --as"),
        (("-o", "part.dxf", "--as", "3b"), "what the program is made of"),
        (("-o", "p.3b", "--offset", "0.1mm", "--pass", "0.1mm"), "--offset and --pass are ways to say one thing"),
        (("-o", "p.3b", "--no-offset", "--offset", "0um"), "--offset and --no-offset are ways to say one thing"),
        (("-o", "p.3b", "--pass", "0.1mm", "--pass", "0.2mm"), "no larger than that of the pass before"),
        (("-o", "p.3b", "--pass", "0.1mm", "--pass", "0um"), "the only one"),
        (("-o", "p.3b", "--tolerance", "0um"), "the tolerance in µm is 0; it must lie between 0.1 and 1000"),
        (("-o", "p.3b", "--start", "1,2,3"), "is no place"),
        (("-o", "p.3b", "--start", "1,900km"), "is no length"),
        (("-o", "p.3b", "--order", "1,1"), "names a figure twice"),
        (("-o", "p.3b", "--order", "1,x"), "no numbers of figures"),
        (("-o", "p.3b", "--on-layer", "HOLES"), "is no wish"),
        (("-o", "p.3b", "--on-layer", "HOLES:side=left"), "a layer takes side="),
        (("-o", "p.3b", "--on-layer", "HOLES:rank=one"), "a layer takes side="),
        (("-o", "p.3b", "--compensation", "kept"), "compensation is for 4B and ISO, not 3b"),
        (("-o", "p.iso", "--form", "aligned"), "form is for 3B and 4B, not iso"),
        (("-o", "p.3b", "--end-code", "THE END"), "is one word; found 'THE END'"),
        (("-o", "p.3b", "--pause-code", ""), "is one word; found ''"),
        (("-o", "p.3b", "--picture", "p.bmp"), "neither a .png nor a .svg"),
        (("-o", "p.3b", "--picture", "part.png", "--machine", "none"), "none"),
    ],
)
def test_bad_use_is_refused_in_a_line(part: Path, options: tuple[str, ...], told: str) -> None:
    done = run_inside("program", part.name, *options, cwd=part.parent)
    assert done.returncode == 2, done.stdout
    assert told in done.stderr.decode()
    assert [file.name for file in part.parent.iterdir()] == [part.name]


def test_force_writes_what_is_not_proved_with_what_was_found_at_its_head(part: Path) -> None:
    out = part.with_suffix(".3b")
    asked = (part, "-o", out, "--part-tolerance", "0.1um")
    code, said, _ = run(*asked)
    assert (code, out.exists()) == (1, False)
    assert "not proved" in said
    assert "not written; --force writes it" in said.replace("\n    ", " ")
    code, said, _ = run(*asked, "--force")
    assert (code, out.exists()) == (1, True)
    assert "written all the same (--force)" in said.replace("\n    ", " ")
    assert "not written" not in said
    head = out.read_text("utf-8").splitlines()[1]
    assert re.match(r"// not proved: .*off the drawing", head)
    assert len(read_program(out).toolpath) > 4


def test_a_part_that_comes_free_early_is_told_with_the_tab_that_would_hold_it(part: Path) -> None:
    passes = ("--pass", "0.13mm", "--pass", "0.1mm")
    code, said, _ = run(part, "--preview", *passes)
    assert code == 1
    assert "--tab 3mm holds it" in said.replace("\n    ", " ")
    assert "a preview: no program was written" in said


def test_options_reach_the_maker(part: Path) -> None:
    out = part.with_suffix(".3b")
    code, said, _ = run(part, "-o", out, "--offset", "0.15mm", "--wire-diameter", "0.28mm", "--form", "detailed")
    assert code == 0, said
    assert "passes: offset 0.15 mm" in said
    assert "Offset F= 0.150" in out.read_text("utf-8")


SCENARIO = """title = "Plate"
[drawing]
file = "part.dxf"
fit = false
[program]
file = "plate.3b"
passes_mm = [0.12, 0.1]
tab_mm = 1
"""


@pytest.fixture
def shop(part: Path) -> Path:
    (part.parent / "scenario.toml").write_text(SCENARIO, "utf-8")
    return part.parent


def test_a_scenario_without_its_program_is_run_on_the_one_that_is_made(shop: Path) -> None:
    done = run_inside("run", shop, "-o", shop / "out")
    assert done.returncode == 0, done.stderr
    made = (shop / "out" / "plate.3b").read_bytes()
    assert not (shop / "plate.3b").exists()
    assert run_inside("program", shop).returncode == 0
    assert (shop / "plate.3b").read_bytes() == made
    again = run_inside("run", shop, "--json")
    assert json.loads(again.stdout)["program"]["name"] == "plate.3b"


def test_a_scenario_with_codes_of_its_own_is_read_by_them(shop: Path) -> None:
    file = shop / "scenario.toml"
    file.write_text(file.read_text("utf-8").replace("[program]", '[program]\nend_code = "STOP"'), "utf-8")
    code, said, _ = run(shop)
    assert code == 0
    assert "its own words for end and pause, STOP" in said.replace("\n    ", " ")
    written = shop / "plate.3b"
    assert written.read_text("utf-8").split()[-1] == "STOP"
    written.unlink()
    done = run_inside("run", shop)
    assert done.returncode == 0, done.stdout


def test_it_is_compared_and_drawn_from_the_drawing_alone(shop: Path) -> None:
    assert run_inside("compare", shop).returncode == 0
    assert run_inside("draw", shop, "-o", shop / "path.png").returncode == 0
    assert not (shop / "plate.3b").exists()


@pytest.mark.deeper
def test_a_shop_makes_the_programs_of_its_scenarios(shop: Path, tmp_path: Path) -> None:
    out = tmp_path / "shop-out"
    done = run_inside("run", f"{shop.parent}/{shop.name}*", "-o", out, "--jobs", "1")
    assert done.returncode == 0, done.stderr
    (made,) = out.glob("*/plate.3b")
    index = json.loads((out / "index.json").read_text("utf-8"))
    assert index["counts"]["pass"] == 1
    assert made.stat().st_size > 0


def test_a_scenario_of_which_no_program_can_be_made_says_why(shop: Path) -> None:
    drawn(shop, crossed)
    done = run_inside("run", shop)
    assert done.returncode == 2
    assert "no contour of the drawing is closed" in " ".join(done.stderr.decode().split())


def test_options_go_before_the_section(shop: Path) -> None:
    code, said, _ = run(shop, "--preview", "--offset", "0.12mm")
    assert code == 0
    assert "passes: offset 0.12 mm" in said


TECHNOLOGY = """
[technology]
name = "Cr12"
grade = "measured"
[[cut]]
material = "Cr12"
wire_mm = 0.18
height_mm = 40
gap_um = 14
gap_within_um = 2
"""


def test_a_technology_gives_the_offset_and_says_where_another_one_does_not_fit(part: Path) -> None:
    """Half of 180 µm and 14 are 104: an offset of 110 leaves each edge 6 µm outside of its contour."""
    technology = part.with_name("cr12.toml")
    technology.write_text(TECHNOLOGY)
    options = (part, "--preview", "--technology", technology)
    code, said, _ = run(*options)
    assert (code, "offset 0.104 mm" in said, "outside of its contour" in said) == (0, True, False)
    code, said, _ = run(*options, "--offset", "0.11mm")
    words = " ".join(said.split())
    assert code == 0
    assert "pass 1 reaches 102 to 106 µm by the technology, and the offset is 110 µm" in words
    assert "+6 µm outside of its contour" in words
    for more, why in ((("--spark-gap", "10um"), "--spark-gap"), (("--material", "Al"), "Al")):
        code, _, error = run(*options, *more)
        assert (code, why in error) == (2, True)
