"""The server of a page: who may ask it, what it answers, and when it ends."""

import asyncio
import io
import json
import os
import random
import re
import signal
import socket
import stat
import subprocess
import sys
import time
import zipfile
from collections.abc import Iterator
from pathlib import Path
from urllib.parse import urlsplit

import pytest
from awaited import awaited
from command import run_command
from opened_page import OpenedPage, Recorder, opened_page
from PIL import Image
from places import ROOT

from parser.findings.errors import SettingsError
from sim.serve.page.child import AWAY_S, FIRST_S, Child, Life, begun
from sim.serve.page.runner import _film
from sim.serve.page.runs import KEYS, Runs, zipped
from sim.serve.page.served import MOST_BYTES

WRONG = "B9900B0B39600GXNR1\nDD\n"
SOUND = "B3000B0B3000GXL1\nB0B2000B2000GYL2\nB3000B0B3000GXL3\nB0B2000B2000GYL4\nDD\n"


@pytest.fixture(name="served", scope="module")
def served_page(tmp_path_factory: pytest.TempPathFactory) -> Iterator[OpenedPage]:
    file = tmp_path_factory.mktemp("open") / "part.3b"
    file.write_bytes(WRONG.replace("\n", "\r\n").encode())
    with opened_page(file) as served:
        yield served


def checked(served: OpenedPage, text: str, name: str = "part.3b", number: str = "") -> dict:
    told = {"name": name, "text": text, "number": number, "machine": "", "thickness_mm": ""}
    answer = served.ask("check", json.dumps(told))
    assert answer.status == 200
    return json.loads(answer.body)


@pytest.mark.parametrize("asks_otherwise", [False, True])
def test_what_was_checked_before_the_page_asked_is_the_answer_to_that_alone(
    tmp_path: Path, asks_otherwise: bool
) -> None:
    """It is of the text as it stood and the form as it is at first: each other one is checked by itself."""
    file = tmp_path / "part.3b"
    file.write_bytes(WRONG.encode())
    with opened_page(file) as served:
        if asks_otherwise:
            assert checked(served, SOUND, number="0")["verdict"] == "pass"
        first, again = checked(served, WRONG, number="0"), checked(served, WRONG, number="0")
        assert first == again
        assert first["verdict"] == "fail"


def test_the_first_line_is_an_address_on_the_loopback_with_a_token_nobody_guesses(served: OpenedPage) -> None:
    assert re.fullmatch(r"http://127\.0\.0\.1:\d+/[\w-]{32}/", served.address)


def test_the_page_may_load_nothing_and_ask_nobody_but_its_server(served: OpenedPage) -> None:
    answer = served.ask("", method="GET")
    assert answer.status == 200
    policy = answer.headers["content-security-policy"]
    assert "default-src 'none'" in policy
    assert "connect-src 'self'" in policy
    (nonce,) = re.findall(r"script-src 'nonce-([\w-]+)'", policy)
    assert answer.body.decode().count(f'nonce="{nonce}"') == 1
    assert re.findall(rb'(?:src|href)="(?!data:)', answer.body) == []
    assert served.ask("", method="GET").headers["content-security-policy"] != policy, "a nonce is used once"
    for name, value in {
        "cache-control": "no-store",
        "referrer-policy": "no-referrer",
        "x-frame-options": "DENY",
        "x-content-type-options": "nosniff",
        "cross-origin-resource-policy": "same-origin",
    }.items():
        assert answer.headers[name] == value


@pytest.mark.parametrize(
    ("path", "headers", "status"),
    [
        ("/", {}, 404),
        ("/check", {}, 404),
        ("/wrong/check", {}, 404),
        ("first", {"Host": "evil.example"}, 421),  # a name that was made to lead to the loopback
        ("first", {"Host": "localhost"}, 421),
        ("first", {"Origin": "http://evil.example"}, 403),
        ("first", {"Origin": "null"}, 403),
        ("first", {"Origin": "http://127.0.0.1:1"}, 403),
        ("first", {"Sec_Fetch_Site": "cross-site"}, 403),
        ("first", {"Sec_Fetch_Site": "same-site"}, 403),
        ("nowhere", {}, 404),
        ("../../etc/passwd", {}, 404),
        ("%2e%2e/%2e%2e/etc/passwd", {}, 404),
    ],
)
def test_whoever_is_not_the_page_gets_no_answer(
    served: OpenedPage, path: str, headers: dict[str, str], status: int
) -> None:
    for method in ("POST", "GET"):
        answer = served.ask(path, b"{}", method, **headers)
        assert answer.status == status or (path == "first" and not headers)
        assert b"B9900" not in answer.body


@pytest.mark.parametrize(
    ("path", "dest", "method", "status"),
    [
        ("", "document", "GET", 200),  # from the file that leads to the page
        ("", "iframe", "GET", 403),
        ("", "document", "POST", 403),
        ("first", "document", "POST", 403),
        ("run/1/report.html", "document", "GET", 403),
        ("/wrong/", "document", "GET", 404),
    ],
)
def test_a_tab_may_go_to_the_page_from_elsewhere_and_nothing_else_may(
    served: OpenedPage, path: str, dest: str, method: str, status: int
) -> None:
    headers = {"Sec_Fetch_Site": "cross-site", "Sec_Fetch_Mode": "navigate", "Sec_Fetch_Dest": dest}
    assert served.ask(path, b"{}", method, **headers).status == status


@pytest.mark.deeper
def test_a_browser_is_led_to_the_page_by_a_file_that_only_its_owner_reads(tmp_path: Path) -> None:
    recorder = Recorder(tmp_path)
    with opened_page(None, browser=recorder.program) as served:
        way = recorder.heard()
        token = served.path.strip("/")
        assert token not in way
        file = Path(urlsplit(way).path)
        assert token in file.read_text("utf-8")
        assert [stat.S_IMODE(each.stat().st_mode) for each in (file.parent, file)] == [0o700, 0o600]
    assert not file.exists()


def test_halves_of_surrogate_pairs_are_answered(served: OpenedPage) -> None:
    half = "B1\ud800\nDD\n"
    answer = served.ask("lines", json.dumps({"before": half, "after": "DD\n"}))
    assert answer.status == 200
    assert json.loads(answer.body)["places"][0]["before"] == "B1\ufffd"
    told = dict.fromkeys(("name", "text", "number", "machine", "thickness_mm"), half)
    assert served.ask("check", json.dumps(told)).status == 200
    saved = {"text": half, "opened": half, "encoding": "utf-8", "newline": "\n"}
    assert served.ask("save", json.dumps(saved)).body == "B1\ufffd\nDD\n".encode()


@pytest.mark.parametrize("encoding", ["\0", "utf-8\0", "no such", "hex", "undefined", "\ud800", "x" * 10_000])
def test_an_encoding_that_is_none_is_utf_8(served: OpenedPage, encoding: str) -> None:
    saved = {"text": "B1·\n", "opened": "B1\n", "encoding": encoding, "newline": "\n"}
    answer = served.ask("save", json.dumps(saved))
    assert (answer.status, answer.body) == (200, "B1·\n".encode())


def test_only_the_page_itself_can_be_got_by_an_address(served: OpenedPage) -> None:
    assert {served.ask(name, method="GET").status for name in ("first", "read", "check", "save", "close")} == {405}


def test_more_than_the_bound_is_refused_before_it_is_read(served: OpenedPage) -> None:
    with socket.create_connection(("127.0.0.1", int(served.host.partition(":")[2])), 10.0) as link:
        head = f"POST {served.path}read HTTP/1.1\r\nHost: {served.host}\r\nContent-Length: {MOST_BYTES + 1}\r\n\r\n"
        link.sendall(head.encode())
        assert link.recv(64).startswith(b"HTTP/1.1 413")


@pytest.mark.parametrize("body", ["", "[]", "{}", '{"name": 1, "text": ""}', "[" * 100_000, "\xff", '{"name": "a"}'])
def test_requests_that_the_page_does_not_send_are_refused(served: OpenedPage, body: str) -> None:
    assert served.ask("check", body).status == 400
    assert served.ask("save", body).status == 400


def test_a_file_comes_with_its_lines_and_goes_with_its_bytes(served: OpenedPage) -> None:
    first = json.loads(served.ask("first").body)
    assert first == {"name": "part.3b", "text": WRONG, "encoding": "utf-8", "newline": "\r\n", "number": "0"}
    assert json.loads(served.ask("program", '{"number": "0"}').body) == first
    data = "B100B0B100GXL1 //孔\r\nDD\r\n".encode("gbk")
    read = json.loads(served.ask("read?name=%E5%AD%94.3b", data).body)
    assert read["number"] == ""
    assert (read["name"], read["text"]) == ("孔.3b", "B100B0B100GXL1 //孔\nDD\n")
    assert served.ask("save", json.dumps({**read, "opened": read["text"]})).body == data
    foreign = {**read, "opened": read["text"], "text": read["text"] + "😀"}
    assert served.ask("save", json.dumps(foreign)).body.decode(read["encoding"]).endswith("😀")
    latin = {**read, "opened": read["text"], "text": "B1 //é😀\n", "encoding": "latin-1"}
    assert served.ask("save", json.dumps(latin)).body == "B1 //é😀\r\n".encode(), "what it lacks, in UTF-8"
    assert json.loads(served.ask("read?name=a.3b", b"\0\1\2").body)["text"] is None


def test_what_is_found_has_its_places_in_units_of_the_page(served: OpenedPage) -> None:
    answer = checked(served, f"// 😀\n{WRONG}")
    assert (answer["verdict"], answer["dialect"], answer["settings"]) == ("fail", "3B", "")
    (found,) = answer["findings"]
    # Behind "// " stand two units of one letter: the words begin at 6 + 13.
    assert (found["code"], found["line"], found["first"], found["past"]) == ("3B204", 2, 19, 21)
    assert found["edits"] == [[20, 21, "Y"]]
    assert found["title"]["zh"] == "计数方向选错"
    assert answer["size"]["box_um"] == [-19_800.0, -9_900.0, 0.0, 9_900.0]
    assert answer["path"]["radius_um"] == [9900.0]
    assert answer["path"]["first"] == [6]
    assert answer["figures"][0]["thread_um"] == [0.0, 0.0]


@pytest.mark.parametrize("text", ["", "\0", "hello", "B1" * 5000, "DD\n", "\ufeff", "\udce4", "G90"])
def test_a_text_that_is_no_program_is_answered(served: OpenedPage, text: str) -> None:
    answer = checked(served, text, "<img src=x>\x1b[31m")
    assert answer["verdict"] in {"none", "pass", "fail", "incomplete"}
    assert "\x1b" not in answer["name"]


@pytest.mark.deeper
def test_settings_near_the_first_file_count_for_it_alone(tmp_path: Path) -> None:
    (tmp_path / "drycut.toml").write_text('root = true\nignore = ["3B204"]\n', "utf-8")
    (tmp_path / "part.3b").write_text(WRONG, "utf-8")
    with opened_page(tmp_path / "part.3b") as served:
        assert checked(served, WRONG, number="0")["findings"] == []
        assert len(checked(served, WRONG)["findings"]) == 1
        (tmp_path / "drycut.toml").write_text('ignored = ["3B204"]\n', "utf-8")
        told = checked(served, WRONG, number="0")
        assert "ignored" in told["settings"]
        assert len(told["findings"]) == 1


@pytest.mark.alike(1)
@pytest.mark.parametrize("how", ["button", signal.SIGINT, signal.SIGTERM])
def test_it_ends_well_by_its_button_and_by_signals(how: str | signal.Signals) -> None:
    with opened_page() as served:
        assert json.loads(served.ask("first").body)["text"] == ""
        if isinstance(how, str):
            assert served.ask("close").status == 204
        else:
            served.process.send_signal(how)
        assert served.ended() == 0
        assert served.process.stderr is not None
        assert served.process.stderr.read() == ""


def test_it_lives_while_a_page_is_seen() -> None:
    now = [0.0]
    life = Life(lambda: now[0])
    now[0] = FIRST_S - 1.0
    assert not life.is_over
    life.note_page()
    now[0] += AWAY_S + 1.0
    assert not life.is_over, "browsers let hidden pages say so once a minute"
    now[0] += AWAY_S
    assert life.is_over


@pytest.mark.deeper
def test_what_cannot_be_opened_is_said(tmp_path: Path, served: OpenedPage) -> None:
    done = run_command("open", "nowhere.3b", "--no-browser", cwd=tmp_path)
    assert (done.returncode, done.stdout) == (2, b"")
    assert b"nowhere.3b: cannot be read" in done.stderr
    port = served.host.partition(":")[2]
    taken = run_command("open", "--no-browser", "--port", port)
    assert taken.returncode == 2
    assert f"port {port} cannot be listened on: Address already in use".encode() in taken.stderr


def asked_run(served: OpenedPage, **values: str) -> dict:
    told = {"name": "part.3b", "text": "B1000B0B1000GXL1\nDD\n"}
    told |= dict.fromkeys((*KEYS, "drawing", "number"), "")
    answer = served.ask("run", json.dumps({**told, **values}))
    assert answer.status == 200
    return json.loads(answer.body)


def came_to(served: OpenedPage, *states: str) -> dict:
    """The state of the run once it is one of these."""
    for _ in range(600):
        state = json.loads(served.ask("progress").body)
        if state["state"] in states:
            return state
        time.sleep(0.05)
    raise AssertionError(f"the run is still {state}")


def test_a_run_is_of_the_text_and_gives_its_files_and_no_others(served: OpenedPage) -> None:
    assert asked_run(served, name="../../../x y;rm.3b")["state"] == "running"
    state = came_to(served, "done", "wrong")
    assert (state["state"], state["verdict"]) == ("done", "pass")
    run = f"run/{state['run']}"
    report = served.ask(f"{run}/report.json", method="GET")
    assert json.loads(report.body)["program"]["name"] == "x_y_rm.3b"
    page = served.ask(f"{run}/replay.html", method="GET")
    assert "default-src 'none'" in page.headers["content-security-policy"]
    assert "connect-src" not in page.headers["content-security-policy"]
    made = {file["name"]: file["bytes"] for file in state["files"]}
    assert sorted(made) == ["cut.png", "replay.html", "report.html", "report.json"]
    assert made["report.json"] == len(report.body)
    for name in ("trace.npz", "..%2fprogram%2fx_y_rm.3b", "%2e%2e/program/x_y_rm.3b", "", "REPORT.JSON"):
        assert served.ask(f"{run}/{name}", method="GET").status == 404
    assert served.ask("run/99/report.json", method="GET").status == 404
    all_of_it = served.ask(f"zip/{state['run']}", method="GET")
    with zipfile.ZipFile(io.BytesIO(all_of_it.body)) as archive:
        assert {entry.filename: entry.file_size for entry in archive.infolist()} == made
        assert archive.read("report.json") == report.body
    assert served.ask("zip/99", method="GET").status == 404


def ran(served: OpenedPage) -> dict:
    """The state of a run that is there, whichever it was; one is made where there is none."""
    state = json.loads(served.ask("progress").body)
    if "files" not in state or state["state"] == "running":
        asked_run(served)
    return came_to(served, "done", "wrong", "cancelled")


def asked_more(served: OpenedPage, job: str, **values: str) -> dict:
    told = {"job": job, "form": "webp", "seconds": "0.5", "set": "3", "language": "en", **values}
    answer = served.ask("more", json.dumps(told))
    assert answer.status == 200
    return json.loads(answer.body)


@pytest.mark.deeper
def test_a_film_and_all_pictures_of_the_run_are_made_when_they_are_asked_for(served: OpenedPage) -> None:
    run = ran(served)["run"]
    assert asked_more(served, "film")["job"] == "film"
    came_to(served, "done")
    film = served.ask(f"run/{run}/film.webp", method="GET")
    assert film.headers["content-type"] == "image/webp"
    with Image.open(io.BytesIO(film.body)) as shown:
        assert (shown.size, shown.n_frames) == ((960, 540), 10), "half a second at 20 a second"
    asked_more(served, "pictures", language="zh")
    state = came_to(served, "done")
    names = {file["name"] for file in state["files"]}
    assert {"film.webp", "cut.png", "path.png", "along.png", "worst.png", "motion.png"} <= names
    assert state["verdict"] == "pass", "the run is still told"


@pytest.mark.deeper
def test_fault_drills_of_a_set_are_made_of_the_program_that_ran(served: OpenedPage) -> None:
    run = ran(served)["run"]
    asked_more(served, "drills")
    names = {file["name"] for file in came_to(served, "done")["files"]}
    assert {"drill.html", "answers.html", "drill-01.3b"} <= names
    assert b'"set":3' in served.ask(f"run/{run}/drill.html", method="GET").body
    asked_more(served, "drills", set="many")
    state = came_to(served, "done", "wrong")
    assert state["why"]["en"] == "the number of the set is a number, not 'many'"


FILM = {
    "job": "film",
    "form": "webp",
    "seconds": "1",
    "set": "1",
    "language": "en",
    "file": "part.3b",
    "folder": "nowhere",
}


@pytest.mark.parametrize(
    ("values", "why"),
    [
        ({"form": "exe"}, "films are .gif, .webp, .apng, .mp4, not 'exe'"),
        ({"form": "a/../../program/x.gif"}, "films are"),
        ({"seconds": "1e9"}, "the length of the film in s is 1000000000; it must lie between 0.5 and 600"),
        ({"seconds": "600"}, "would need"),
        ({"seconds": "long"}, "the length of the film in s is a number, not 'long'"),
    ],
)
def test_a_film_that_cannot_be_is_refused_before_anything_is_read_or_run(values: dict[str, str], why: str) -> None:
    with pytest.raises(SettingsError, match=re.escape(why)):
        _film({**FILM, **values})


@pytest.mark.deeper
def test_what_is_wrong_with_a_film_is_said_and_the_run_stays(served: OpenedPage) -> None:
    before = ran(served)["files"]
    asked_more(served, "film", form="exe")
    state = came_to(served, "done", "wrong")
    assert (state["state"], state["files"]) == ("wrong", before)
    assert "films are" in state["why"]["en"]


def test_a_film_can_be_cancelled_and_the_files_of_the_run_stay(served: OpenedPage) -> None:
    files = ran(served)["files"]
    asked_more(served, "film", seconds="60")
    state = json.loads(served.ask("cancel").body)
    assert (state["state"], state["files"]) == ("cancelled", files)


def test_nothing_is_made_of_a_run_that_is_not_there(tmp_path: Path) -> None:
    runs = Runs(tmp_path)
    for job in ("film", "pictures", "drills", "run"):
        awaited(runs.make({**FILM, "job": job}))
        assert runs.state == {"state": "idle"}


def test_only_the_own_files_of_a_run_are_given_out(tmp_path: Path) -> None:
    (tmp_path / "secret").write_text("secret")
    out = tmp_path / "1" / "out"
    (out / "folder").mkdir(parents=True)
    (out / "link.html").symlink_to(tmp_path / "secret")
    (out / "cut.png").write_bytes(b"png")
    runs = Runs(tmp_path)
    assert runs.files(1) == {"cut.png": 3}
    assert runs.file(1, "cut.png") == out / "cut.png"
    assert [runs.file(1, name) for name in ("link.html", "folder", "../../secret", "", "..", "CUT.PNG")] == [None] * 6
    assert runs.files(2) == {}


def test_a_zip_holds_little_at_a_time_and_is_the_same_each_time(tmp_path: Path) -> None:
    large = tmp_path / "large.bin"
    large.write_bytes(random.Random(1).randbytes(5_000_000))
    (tmp_path / "孔.json").write_text("{}" * 1000)
    files = [large, tmp_path / "孔.json"]
    pieces = list(zipped(files))
    assert max(map(len, pieces)) < 600_000
    with zipfile.ZipFile(io.BytesIO(b"".join(pieces))) as archive:
        assert archive.testzip() is None
        assert {name: archive.read(name) for name in archive.namelist()} == {
            one.name: one.read_bytes() for one in files
        }
    os.utime(large, (1, 1))
    assert b"".join(zipped(files)) == b"".join(pieces)


def test_what_cannot_be_run_says_why(served: OpenedPage) -> None:
    asked_run(served, offset_mm="0.1", text="hello")
    state = came_to(served, "done", "wrong")
    assert state["state"] == "wrong"
    assert "no block in the file" in state["why"]["en"]


@pytest.mark.deeper
@pytest.mark.skipif(not Path("/proc").is_dir(), reason="asks the kernel of Linux for processes")
def test_a_killed_server_leaves_no_run_behind(tmp_path: Path) -> None:
    with opened_page() as served:
        square = "B9000B0B9000GXL1\nB0B9000B9000GYL2\nB9000B0B9000GXL3\nB0B9000B9000GYL4\n"
        asked_run(served, text=f"{square * 60}DD\n")
        came_to(served, "running")
        (child,) = children_of(served.process.pid)
        served.process.kill()
        served.ended()
        for _ in range(400):
            if not Path(f"/proc/{child}").exists() or state_of(child) == "Z":
                return
            time.sleep(0.05)
        raise AssertionError("the run goes on")


def children_of(process: int) -> list[int]:
    """Processes that a process started, by what the kernel says."""
    told = Path(f"/proc/{process}/task/{process}/children").read_text()
    return [int(child) for child in told.split()]


def state_of(process: int) -> str:
    return Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[0]


@pytest.mark.parametrize(
    ("text", "name"),
    [
        ("B1000B0B1000GXL1\nDD\n", "program.3b"),
        ("G90 G21\nG01 X1. Y0\nM02\n", "program.iso"),
        ("OPEN PROG 1 CLEAR\nLINEAR INC\nX1 Y0\nCLOSE\n", "program.pmc"),
        ("hello", "program.3b"),
        ("", "program.3b"),
    ],
)
def test_a_text_without_a_name_is_named_for_its_language(served: OpenedPage, text: str, name: str) -> None:
    assert checked(served, text, name="")["name"] == name


def test_the_address_without_its_last_slash_leads_to_the_page(served: OpenedPage) -> None:
    answer = served.ask(served.path.rstrip("/"), method="GET")
    assert (answer.status, answer.headers["location"]) == (308, served.address)


@pytest.mark.deeper
def test_a_run_is_read_as_the_check_beside_it_is(tmp_path: Path) -> None:
    (tmp_path / "drycut.toml").write_text('root = true\nunit = "inch"\n', "utf-8")
    text = "G92 X0 Y0\nG01 X10000 F1\nG01 X-10000\nM02\n"
    (tmp_path / "part.iso").write_text(text, "utf-8")
    with opened_page(tmp_path / "part.iso") as served:
        length = checked(served, text, "part.iso", "0")["size"]["cut_um"]
        asked_run(served, name="part.iso", text=text, number="0")
        state = came_to(served, "done", "wrong")
        report = json.loads(served.ask(f"run/{state['run']}/report.json", method="GET").body)
        assert report["summary"]["length_um"] == pytest.approx(length)
        assert length == pytest.approx(2 * 25_400.0)


def test_of_earlier_runs_only_the_last_one_is_kept(tmp_path: Path) -> None:
    async def thrice() -> None:
        runs = Runs(tmp_path)
        for _ in range(3):
            await runs.start("part.3b", b"DD", dict.fromkeys((*KEYS, "drawing_file", "near_file"), ""))
        await runs.cancel()

    awaited(thrice())
    assert sorted(folder.name for folder in tmp_path.iterdir()) == ["2", "3"]


def test_a_run_is_done_by_a_process_that_waited_for_it_and_the_next_one_is_ready_behind_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    begun_ahead = []

    async def noted(module: str, *, ahead: bool = False) -> Child:
        begun_ahead.append(ahead)
        return await begun(module, ahead=ahead)

    async def twice() -> None:
        runs = Runs(tmp_path)
        await runs.warm()
        for _ in range(2):
            await runs.start("part.3b", WRONG.encode(), dict.fromkeys((*KEYS, "drawing_file", "near_file"), ""))
            while runs.state["state"] == "running":
                await asyncio.sleep(0.02)
            assert runs.state["verdict"] == "fail"
        await runs.end()
        await runs.warm()  # the server has ended: nothing is begun any more

    monkeypatch.setattr("sim.serve.page.runs.begun", noted)
    awaited(twice())
    assert begun_ahead == [True, True, True]


def test_the_page_is_there_before_any_engine_is_loaded() -> None:
    code = "import sys, sim.serve.page.served, sim.serve.page.lister; print(*sys.modules)"
    told = subprocess.run([sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=True).stdout
    assert not {"numba", "sim.run.dryrun", "sim.cut.remains", "shapely", "PIL"} & set(told.split())
