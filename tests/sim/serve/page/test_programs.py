"""A folder in the browser: which programs are listed, what is told of each; a number leads to no other file."""

import json
import time
from collections.abc import Iterator
from pathlib import Path

import pytest
from command import run_command
from opened_page import OpenedPage, opened_page
from page_types import types_of, unlike

from parser.findings.errors import FileUnreadableError
from sim.serve.page import programs
from sim.serve.page.answers import file_of, read_file
from sim.serve.page.programs import Opened, Programs, row_or_why
from sim.show import open_page

SQUARE = "B3000B0B3000GXL1\nB0B2000B2000GYL2\nB3000B0B3000GXL3\nB0B2000B2000GYL4\nDD\n"
WRONG = "B9900B0B39600GXNR1\nDD\n"
ALL = '{"known": "0", "list": "0"}'


@pytest.fixture(name="shop", scope="module")
def shop_folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with programs, and with what is none or stands elsewhere."""
    shop = tmp_path_factory.mktemp("outside") / "shop"
    (shop / "孔").mkdir(parents=True)
    (shop.parent / "secret.3b").write_text(SQUARE)
    (shop / "a&b.3b").write_text(SQUARE)
    (shop / "empty.iso").write_text("")
    (shop / "letter.3b").write_text("hello")
    (shop / "link.3b").symlink_to(shop.parent / "secret.3b")
    (shop / "raw.3b").write_bytes(b"\0\1\2")
    (shop / "readme.txt").write_text(SQUARE)
    (shop / "孔" / "圆.3b").write_text(WRONG)
    return shop


@pytest.fixture(name="served", scope="module")
def served_shop(shop: Path) -> Iterator[OpenedPage]:
    with opened_page(shop) as served:
        yield served


def rows_of(served: OpenedPage) -> dict:
    """What is told of the folder once all is checked; the rows come in the order of the files."""
    told = json.loads(served.ask("rows", ALL).body)
    for _ in range(600):
        if len(told["rows"]) == told["total"]:
            return told
        time.sleep(0.05)
        told = json.loads(served.ask("rows", ALL).body)
    raise AssertionError(told)


def program(served: OpenedPage, number: str) -> tuple[int, bytes]:
    answer = served.ask("program", json.dumps({"number": number}))
    return answer.status, answer.body


def test_the_programs_of_a_folder_are_told_with_what_the_check_says(served: OpenedPage) -> None:
    told = rows_of(served)
    assert (told["folder"], told["total"], told["left_out"]) == ("shop", 5, 1)
    rows = {row["file"]: row for row in told["rows"]}
    assert list(rows) == ["a&b.3b", "empty.iso", "letter.3b", "raw.3b", "孔/圆.3b"]
    square, wrong = rows["a&b.3b"], rows["孔/圆.3b"]
    assert (square["verdict"], square["cut_um"], square["box_um"]) == ("pass", 10_000.0, [0.0, 0.0, 3000.0, 2000.0])
    assert square["picture"].startswith("M")
    assert (wrong["verdict"], wrong["findings"]) == ("fail", [{"code": "3B204", "severity": "error", "count": 1}])
    assert wrong["titles"]["3B204"]["zh"] == "计数方向选错"
    for name in ("empty.iso", "letter.3b", "raw.3b"):
        assert rows[name]["verdict"] == "refused"
        assert rows[name]["message"]["en"] != rows[name]["message"]["zh"]


def test_the_list_says_of_each_what_drycut_check_says(served: OpenedPage, shop: Path) -> None:
    done = run_command("check", "--format", "json", str(shop))
    checked = {Path(file["name"]).name: file["verdict"] for file in json.loads(done.stdout)["files"]}
    listed = {Path(row["file"]).name: row["verdict"] for row in rows_of(served)["rows"]}
    assert {name: "fail" if verdict == "refused" else verdict for name, verdict in listed.items()} == {
        name: verdict for name, verdict in checked.items() if name in listed
    }


def test_a_number_is_the_file_that_was_found_and_nothing_else_is_read(served: OpenedPage) -> None:
    first = rows_of(served)["rows"][0]
    status, body = program(served, first["number"])
    assert status == 200
    assert json.loads(body) == {
        "name": "a&b.3b",
        "text": SQUARE,
        "encoding": "utf-8",
        "newline": "\n",
        "number": first["number"],
    }
    for number in ("999", "-1", "", "a", "../secret.3b", "a&b.3b", "²", "9" * 5000):
        assert program(served, number) == (404, b"")
    for known in ("-1", "", "a"):
        assert served.ask("rows", json.dumps({"known": known, "list": "0"})).status == 400


def test_settings_near_a_program_of_the_folder_count_for_it(tmp_path: Path) -> None:
    (tmp_path / "drycut.toml").write_text('root = true\nignore = ["3B204"]\n', "utf-8")
    (tmp_path / "part.3b").write_text(WRONG)
    found = Programs(Opened(folder=tmp_path))
    assert row_or_why("part.3b", found.file("0"), found.read("0"))["verdict"] == "pass"
    assert row_or_why("part.3b", None, found.read("0"))["verdict"] == "fail"


@pytest.mark.deeper
def test_what_came_and_went_shows_after_another_look_and_numbers_stay(tmp_path: Path) -> None:
    (tmp_path / "a.3b").write_text(SQUARE)
    with opened_page(tmp_path) as served:
        (was,) = rows_of(served)["rows"]
        (tmp_path / "0.3b").write_text(WRONG)
        assert served.ask("again").status == 200
        new, same = rows_of(served)["rows"]
        assert (new["file"], new["verdict"], same["file"]) == ("0.3b", "fail", "a.3b")
        assert json.loads(program(served, was["number"])[1])["name"] == "a.3b", "an open page goes on with its file"
        (tmp_path / "0.3b").unlink()
        assert program(served, new["number"])[0] == 404
        (tmp_path / "a.3b").unlink()
        again = json.loads(served.ask("again").body)
        assert (again["total"], again["rows"], again["is_over"]) == (0, [], True)


def test_rows_come_behind_those_that_are_known_of_the_same_list(served: OpenedPage) -> None:
    told = rows_of(served)
    asked = {"known": "3", "list": str(told["list"])}
    assert json.loads(served.ask("rows", json.dumps(asked)).body)["rows"] == told["rows"][3:]
    asked = {"known": "3", "list": str(told["list"] + 9)}
    assert json.loads(served.ask("rows", json.dumps(asked)).body)["rows"] == told["rows"]


def test_rows_are_what_the_page_takes_them_for(served: OpenedPage) -> None:
    types = types_of(Path(open_page.__file__).with_name("assets") / "data.js")
    told = rows_of(served)
    assert list(unlike(types, "Rows", {**told, "rows": []})) == []
    for row in told["rows"]:
        del row["number"]
        assert list(unlike(types, "Row", row)) == []


def test_a_file_that_became_a_link_out_of_the_folder_is_not_read(tmp_path: Path) -> None:
    shop = tmp_path / "shop"
    shop.mkdir()
    (tmp_path / "secret").write_text("secret")
    (shop / "a.3b").write_text(SQUARE)
    found = Programs(Opened(folder=shop))
    assert found.read("0") == SQUARE.encode()
    (shop / "a.3b").unlink()
    (shop / "a.3b").symlink_to(tmp_path / "secret")
    with pytest.raises(FileUnreadableError):
        found.read("0")


def test_more_programs_than_the_bound_are_said(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(programs, "MOST", 3)
    for number in range(5):
        (tmp_path / f"{number}.3b").write_text(SQUARE)
    found = Programs(Opened(folder=tmp_path))
    assert [found.file(str(number)) is not None for number in range(5)] == [True, True, True, False, False]
    assert found._left_out == 2


def test_a_folder_without_a_program_is_said(tmp_path: Path) -> None:
    done = run_command("open", str(tmp_path), "--no-browser")
    assert done.returncode == 2
    assert b"no program there; expected files that end in .3b" in done.stderr


@pytest.mark.parametrize("data", [b"", b"\0", b"B1" * 5000, b"DD\n", b"\xff\xfe", "// 孔\x1b".encode("gbk"), b"G90"])
def test_whatever_is_dropped_has_a_row(data: bytes) -> None:
    row = row_or_why("<img src=x>\x1b", None, data)
    assert row["verdict"] in {"pass", "incomplete", "fail", "refused"}
    assert "\x1b" not in json.dumps(row, ensure_ascii=False)


def test_a_fault_of_drycut_at_one_file_is_told_of_that_one(monkeypatch: pytest.MonkeyPatch) -> None:
    def broken(*_: object) -> None:
        raise ZeroDivisionError("planted")

    monkeypatch.setattr("sim.serve.page.programs.as_typed", broken)
    row = row_or_why("a.3b", None, SQUARE.encode())
    assert (row["verdict"], row["message"]["en"]) == ("fault", "ZeroDivisionError: planted")


def test_each_line_of_a_file_with_mixed_line_ends_has_its_own_again() -> None:
    data = b"B1\r\nB2\nB3\rB4\r\nDD"
    read = read_file(data)
    assert read.text == "B1\nB2\nB3\nB4\nDD"
    assert file_of(read, read.text) == data
    assert file_of(read, "B1\nB9\nB3\nB4\nDD") == b"B1\r\nB9\nB3\rB4\r\nDD"
    assert file_of(read, "B1\nB2\nnew\nB3\nB4\nDD\n") == b"B1\r\nB2\nnew\rB3\r\nB4\r\nDD\r\n"
    assert file_of(read, "B1\nB4\nDD") == b"B1\r\nB4\r\nDD"
    assert file_of(read, "") == b""
