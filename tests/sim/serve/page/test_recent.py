"""Files that were opened before: offered again while they are there, and no reason for a command to fail."""

import json
import os
import sys
from pathlib import Path

import pytest
from drawings_dxf import drawn
from opened_page import opened_page

from sim.serve.page.recent import recent, remember

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="elsewhere no variable names the folder")
SQUARE = "B3000B0B3000GXL1\nB0B2000B2000GYL2\nB3000B0B3000GXL3\nB0B2000B2000GYL4\nDD\n"


@pytest.fixture(name="state")
def folder_of_the_list(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))
    return tmp_path / "state"


def files(folder: Path, *names: str) -> list[Path]:
    made = [folder / name for name in names]
    for file in made:
        file.write_text(SQUARE)
    return made


def test_the_last_ones_are_told_once_each_the_last_first(state: Path, tmp_path: Path) -> None:
    a, b, *others = files(tmp_path, "a.3b", "b.3b", *(f"{number}.3b" for number in range(6)))
    assert recent() == ()
    for file in (a, b, a):
        remember(file)
    assert recent() == (a, b)
    b.unlink()
    assert recent() == (a,)
    for file in others:
        remember(file)
    assert recent() == tuple(reversed(others)), "six of them"


def test_names_of_any_letters_are_remembered_or_left_out(state: Path, tmp_path: Path) -> None:
    odd = files(tmp_path, "凸模.3b", 'a"b\n.3b', "😀.3b")
    for file in odd:
        remember(file)
    assert recent() == tuple(reversed(odd))
    gbk = Path(os.fsdecode(os.fsencode(tmp_path) + b"/" + "王".encode("gbk") + b".3b"))
    gbk.write_text(SQUARE)
    remember(gbk)
    assert recent() == tuple(reversed(odd)), "no text can name it, and the others stay"


@pytest.mark.parametrize("stored", [b"", b"{}", b"[1, null]", b"\xff", b"[" * 50_000, b'["part.3b", "/nowhere"]'])
def test_a_damaged_list_counts_as_none_and_is_written_anew(state: Path, tmp_path: Path, stored: bytes) -> None:
    (a,) = files(tmp_path, "a.3b")
    remember(a)
    (list_,) = state.rglob("recent.json")
    list_.write_bytes(stored)
    assert recent() == ()
    remember(a)
    assert recent() == (a,)


def test_where_nothing_can_be_written_nothing_is_remembered(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("XDG_STATE_HOME", os.devnull)
    remember(*files(tmp_path, "a.3b"))
    assert recent() == ()


def test_an_empty_page_offers_them_by_numbers_and_reads_each_anew(tmp_path: Path) -> None:
    state, (program,) = tmp_path / "state", files(tmp_path, "part.3b")
    drawing = drawn(tmp_path, lambda space: space.add_circle((0, 0), 3))
    for file in (program, drawing):
        with opened_page(file, state=state) as served:
            assert "recent" not in json.loads(served.ask("first").body)
    program.write_text(SQUARE.replace("3000", "4000"))
    with opened_page(state=state) as served:
        offered = json.loads(served.ask("first").body)["recent"]
        assert [(each["name"], each["folder"]) for each in offered] == [
            (drawing.name, str(tmp_path)), ("part.3b", str(tmp_path))
        ]  # fmt: skip
        read = [json.loads(served.ask("program", json.dumps({"number": each["number"]})).body) for each in offered]
        assert "drawing" in read[0]
        assert "B4000" in read[1]["text"]
        assert served.ask("program", json.dumps({"number": "2"})).status == 404
