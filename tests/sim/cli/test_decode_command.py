"""``drycut decode`` as a user meets it: the course's example, the way of a block, JSON, bad use."""

import json
from pathlib import Path

import pytest
from command import run_inside
from jsonschema import Draft202012Validator
from places import ROOT

from parser.text.places import cells

SCHEMA = json.loads((ROOT / "docs" / "decode.schema.json").read_text(encoding="utf-8"))
COURSE = "N06 G90 G41 D11 G01 X200 Y300 F200 ;\n"
PART = f"G92 X72 Y48\n{COURSE}N07 X250\nN08 X250 Y350\nG40 G01 X0 Y0\nM02\n"


@pytest.fixture
def part(tmp_path: Path) -> Path:
    path = tmp_path / "part.iso"
    path.write_text(PART, encoding="utf-8")
    return path


def printed(path: Path, *options: str) -> str:
    done = run_inside("decode", path, "--dialect", "classroom", *options)
    assert (done.returncode, done.stderr) == (0, b"")
    return done.stdout.decode()


def test_what_was_assumed_is_told_as_a_check_tells_it(part: Path) -> None:
    for language in ("en", "zh"):
        of_decode = json.loads(run_inside("decode", part, "--json", "--lang", language).stdout)
        of_check = json.loads(run_inside("check", part, "--format", "json", "--lang", language).stdout)
        assert of_decode["assumptions"] == of_check["files"][0]["assumptions"]
        assert [one["what"] for one in of_decode["assumptions"]][:2] == ["dialect", "unit"]


def test_the_example_of_the_course_is_shown_word_by_word(part: Path) -> None:
    lines = printed(part, "--block", "6", "--lang", "en").splitlines()
    first = lines.index("line 2: N06 G90 G41 D11 G01 X200 Y300 F200")

    assert [line.split(maxsplit=3)[:3] for line in lines[first + 1 : first + 10]] == [
        ["①", "N06", "block_num"],
        ["②", "G90", "G0.D5"],
        ["③", "G41", "G0.D7D6"],
        ["④", "D11", "D"],
        ["⑤", "G01", "G0.D1"],
        ["⑥", "X200", "COOR[1]"],
        ["⑦", "Y300", "COOR[2]"],
        ["⑧", "F200", "F"],
        ["⑨", ";", "buf_state"],
    ]
    assert "block_num=0x06  COOR[1]=200000  COOR[2]=300000  F=200  G0=0x42" in lines[first + 10]


def test_json_has_the_buffer_of_the_course(part: Path) -> None:
    document = json.loads(printed(part, "--block", "6", "--json"))
    (block,) = document["blocks"]

    assert document["schema"] == "drycut.decode/1"
    assert document["dialect"] == "classroom"
    assert {
        key: block[key] for key in ("line", "buf_state", "number", "number_bcd", "f", "s", "g0", "m", "t", "d")
    } == {
        "line": 2,
        "buf_state": 1,
        "number": 6,
        "number_bcd": 0x06,
        "f": 200,
        "s": None,
        "g0": 0x42,
        "m": [],
        "t": None,
        "d": 11,
    }
    assert block["coor_um"] == {"X": 200000.0, "Y": 300000.0}
    assert block["steps"][5] == {"order": 6, "word": "X200", "column": 21, "field": "COOR[1]", "value": 200000}
    assert block["in_force"] == {
        "motion": "G01",
        "distance": "G90",
        "side": "G41",
        "register": "D11",
        "offset_um": None,
        "f": 200,
    }


def test_all_blocks_are_shown_without_a_number(part: Path) -> None:
    assert [block["line"] for block in json.loads(printed(part, "--json"))["blocks"]] == [1, 2, 3, 4, 5, 6]


@pytest.mark.parametrize("language", ["en", "zh"])
def test_lines_fit_a_terminal_of_80_columns(part: Path, language: str) -> None:
    assert max(map(cells, printed(part, "--lang", language).splitlines())) <= 80


def test_a_block_that_is_not_there_is_bad_use(part: Path) -> None:
    done = run_inside("decode", part, "--block", "99")

    assert done.returncode == 2
    assert done.stderr.decode() == "drycut: error: part.iso: no block has the number 99\n"


def test_a_block_of_a_program_without_numbers_is_named_by_its_place(tmp_path: Path) -> None:
    path = tmp_path / "plain.iso"
    path.write_text("G92 X0 Y0\nG91\nG01 X1000\nM02\n", encoding="utf-8")

    assert [block["line"] for block in json.loads(printed(path, "--json", "--block", "3"))["blocks"]] == [3]
    assert run_inside("decode", path, "--block", "0").returncode == 2
    assert run_inside("decode", path, "--block", "5").returncode == 2


def test_a_file_without_blocks_is_bad_use_and_named(tmp_path: Path) -> None:
    path = tmp_path / "empty.iso"
    path.write_text("", encoding="utf-8")
    done = run_inside("decode", path)

    assert done.returncode == 2
    assert done.stderr.decode().startswith(f"{path}: error[")


def test_a_program_in_3b_is_bad_use(tmp_path: Path) -> None:
    path = tmp_path / "part.3b"
    path.write_text("B1000 B0 B1000 GX L1\nDD\n", encoding="utf-8")

    done = run_inside("decode", path)

    assert done.returncode == 2
    assert b"part.3b is a 3B program" in done.stderr


@pytest.mark.parametrize("value", ["D0", "D=0.1mm", "X1=0.1mm", "D0=long"])
def test_a_register_that_cannot_be_read_is_bad_use(part: Path, value: str) -> None:
    done = run_inside("decode", part, "--offset", value)

    assert done.returncode == 2
    assert done.stderr.startswith(b"drycut: error: ")


def test_a_block_that_is_called_twice_says_so(tmp_path: Path) -> None:
    path = tmp_path / "twice.iso"
    path.write_text("G92 X0 Y0\nG90 G01 X10\nM98 P1\nM98 P1\nM02\nN1\nG01 X20\nG01 X30\nM99\n", encoding="utf-8")
    assert "runs 2 times" in " ".join(printed(path, "--lang", "en").split())


@pytest.mark.parametrize("options", [(), ("--offset", "D11=0.1mm"), ("--block", "8")])
def test_json_is_as_its_schema_says(part: Path, options: tuple[str, ...]) -> None:
    Draft202012Validator.check_schema(SCHEMA)
    Draft202012Validator(SCHEMA).validate(json.loads(printed(part, "--json", *options)))


def test_a_long_word_stands_alone_and_leaves_the_columns_their_room(tmp_path: Path) -> None:
    path = tmp_path / "part.iso"
    path.write_text("C000 = 012 014 2215 0 242 00 9 00 8030 000 120 0 045 ;\nG92 X0 Y0\nG01 X5.0 Y0\nM02\n", "utf-8")
    done = run_inside("decode", path)
    lines = done.stdout.decode().splitlines()
    at = lines.index("  ① C000 = 012 014 2215 0 242 00 9 00 8030 000 120 0 045")
    assert lines[at + 1].split("  ")[-1] == "sets no field of the buffer"
    assert lines[at + 2] == "  ② ;  buf_state  1: the block is whole"
