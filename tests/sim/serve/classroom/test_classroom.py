"""A lesson served to a class: who has the code comes in, marks come in live, and nothing else gets an answer."""

import http.client
import json
import re
import signal
import subprocess
import sys
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any, NamedTuple

import pytest
from places import ROOT
from sittings import LESSONS, hand_in_of, ready, text_of

from sim.serve.classroom.hand_ins import HandIns, file_name
from sim.serve.classroom.pupils import Tries
from sim.teach.handins import MOST_BYTES, HandIn

NAME = "1-first-blocks"
PUPILS = 40


class Answer(NamedTuple):
    status: int
    headers: dict[str, str]
    text: str


class Room(NamedTuple):
    """A class that is open: the teacher's way, where pupils come, the code, and where hand-ins go."""

    process: subprocess.Popen[str]
    teacher: str
    pupils: str
    code: str
    folder: Path

    def ask(self, method: str, path: str = "/", body: bytes | str = b"", **headers: str) -> Answer:
        """What a pupil's browser gets."""
        return asked(self.pupils, method, path, body, headers)

    def enter(self) -> str:
        """The cookie of somebody who has the code."""
        answer = self.ask("POST", "/enter", f"code={self.code}", content_type="application/x-www-form-urlencoded")
        assert answer.status == 303
        return answer.headers["set-cookie"].partition(";")[0]


def asked(host: str, method: str, path: str, body: bytes | str, headers: dict[str, str]) -> Answer:
    link = http.client.HTTPConnection(host, timeout=30)
    named = {name.replace("_", "-"): value for name, value in headers.items()}
    try:
        link.request(method, path, body or None, named)
        answer = link.getresponse()
        return Answer(
            answer.status, {name.lower(): value for name, value in answer.getheaders()}, answer.read().decode()
        )
    finally:
        link.close()


def opened(folder: Path, *more: str) -> Room:
    lesson = LESSONS / NAME / "lesson.toml"
    command = [sys.executable, "-m", "drycut", "open", "--class", str(lesson), "--no-browser", "--lang", "en"]
    process = subprocess.Popen(
        [*command, "--hand-ins", str(folder), *more],
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        env={"PYTHONPATH": str(ROOT), "PATH": "", "PYTHONUTF8": "1", "LC_ALL": "C.UTF-8"},
        cwd=ROOT,
    )
    assert process.stdout
    teacher = process.stdout.readline().strip()
    says = process.stdout.readline()
    host, code = re.search(r"http://([\d.:]+)/", says), re.search(r"code (\d{6})", says)
    own = re.search(r":(\d+)/", host[0]) if host else None
    return Room(process, teacher, f"127.0.0.1:{own[1]}" if own else "", code[1] if code else "", folder)


def ended(room: Room) -> None:
    room.process.send_signal(signal.SIGTERM)
    room.process.communicate(timeout=30)


@pytest.fixture(name="room", scope="module")
def room_of_a_class(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Room]:
    room = opened(tmp_path_factory.mktemp("class") / "in", "--network")
    yield room
    ended(room)


def hand_in(name: str) -> dict[str, Any]:
    return hand_in_of(ready(NAME), name, 0.8)


def test_who_has_the_code_comes_in_and_nobody_else(room: Room) -> None:
    before = room.ask("GET")
    assert (before.status, 'name="code"' in before.text, 'id="lesson"' in before.text) == (200, True, False)
    wrong = room.ask("POST", "/enter", "code=12345x")
    assert (wrong.status, "set-cookie" in wrong.headers) == (403, False)
    assert room.ask("POST", "/hand-in", text_of(hand_in("x"))).status == 403
    cookie = room.enter()
    inside = room.ask("GET", cookie=cookie)
    assert (inside.status, 'id="lesson"' in inside.text, 'id="send"' in inside.text) == (200, True, True)
    assert 'id="lesson"' not in room.ask("GET", cookie="drycut=x").text


@pytest.mark.parametrize(
    ("method", "path", "headers", "status"),
    [
        ("GET", "/", {"host": "evil.example"}, 421),
        ("GET", "/", {"host": "127.0.0.1"}, 421),
        ("GET", "/", {"origin": "http://evil.example"}, 403),
        ("POST", "/enter", {"origin": "null"}, 403),
        ("POST", "/enter", {"sec_fetch_site": "cross-site"}, 403),
        ("POST", "/hand-in", {"content_length": str(MOST_BYTES + 1)}, 413),
        ("POST", "/hand-in", {"content_length": "x"}, 400),
        ("GET", "/number", {}, 404),
        ("GET", "/pupil-1.html", {}, 404),
        ("GET", "/../handed-in", {}, 404),
        ("PUT", "/", {}, 405),
    ],
)
def test_what_is_no_pupil_gets_a_number(
    room: Room, method: str, path: str, headers: dict[str, str], status: int
) -> None:
    answer = room.ask(method, path, **headers)

    assert answer.status == status
    assert len(answer.text) < 100


def test_every_answer_says_that_it_is_in_no_frame_and_no_cache(room: Room) -> None:
    headers = room.ask("GET").headers

    assert (headers["cache-control"], headers["x-frame-options"]) == ("no-store", "DENY")
    assert "server" not in headers
    cookie = room.ask("POST", "/enter", f"code={room.code}").headers["set-cookie"].lower()
    assert "httponly" in cookie
    assert "samesite=strict" in cookie


def test_forty_pupils_hand_in_at_once_and_the_teacher_sees_their_marks(room: Room) -> None:
    cookie = room.enter()
    hand_ins = [hand_in(f"学生{number}") for number in range(PUPILS)]
    with ThreadPoolExecutor(PUPILS) as pool:
        answers = list(pool.map(lambda each: room.ask("POST", "/hand-in", text_of(each), cookie=cookie), hand_ins))

    assert {answer.status for answer in answers} == {200}
    assert all(0.0 <= json.loads(answer.text)["points"] <= 100.0 for answer in answers)
    assert len(list(room.folder.iterdir())) == PUPILS
    host, path = room.teacher.removeprefix("http://").split("/", 1)
    marks = asked(host, "GET", f"/{path}", b"", {})
    assert all(f"学生{number}" in marks.text for number in range(PUPILS))
    assert int(asked(host, "GET", f"/{path}number", b"", {}).text) >= PUPILS
    assert asked(host, "GET", f"/{path}pupil-1.html", b"", {}).status == 200
    assert asked(host, "GET", f"/{path}pupil-999.html", b"", {}).status == 404
    assert asked(host, "GET", "/", b"", {}).status == 404


@pytest.mark.parametrize("body", [b"", b"{", b"[]", text_of(hand_in("x") | {"lesson": "0" * 16})])
def test_what_is_no_hand_in_is_refused(room: Room, body: bytes) -> None:
    before = sorted(room.folder.iterdir())
    answer = room.ask("POST", "/hand-in", body, cookie=room.enter())

    assert answer.status == 400
    assert "why" in json.loads(answer.text)
    assert sorted(room.folder.iterdir()) == before


def test_without_the_switch_nothing_but_the_loopback_listens(tmp_path: Path) -> None:
    room = opened(tmp_path / "in")
    try:
        assert room.teacher.startswith("http://127.0.0.1:")
        assert (room.pupils, room.code) == ("", "")
        host, path = room.teacher.removeprefix("http://").split("/", 1)
        assert "--network" in asked(host, "GET", f"/{path}", b"", {}).text
        assert asked(host, "GET", f"/{path}lesson", b"", {}).status == 200
        assert asked(host, "POST", f"/{path}hand-in", text_of(hand_in("老师")), {}).status == 200
    finally:
        ended(room)
    assert [path.name for path in (tmp_path / "in").iterdir()] == ["1 班 老师.drycut.json"]


def test_codes_cannot_be_tried_out() -> None:
    tries = Tries()
    assert [tries.is_too_many("a") for _ in range(12)] == [False] * 10 + [True] * 2
    assert not tries.is_too_many("b")
    others = [tries.is_too_many(f"c{number}") for number in range(200)]
    assert others.count(False) == 89


def test_names_make_no_way_out_of_the_folder(tmp_path: Path) -> None:
    for name in ("../../x", "a/b", "C:\\x", ".", "..", "x.exe", "a\tb", "*"):
        found = file_name(HandIn(name, name, name, 1, (), (), ()))
        assert Path(found).name == found
        assert not found.startswith(".")
    hand_ins = HandIns(ready(NAME), tmp_path / "in")
    taken = hand_ins.take(text_of(hand_in("../../up")))
    assert taken is not None
    assert [path.name for path in tmp_path.iterdir()] == ["in"]
