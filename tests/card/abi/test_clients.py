"""Programs in C, written as those that drive such cards: they end where the card's own would."""

import re
import signal
from pathlib import Path

import pytest
from c_library import CLIENTS, Made, Ran
from places import ROOT

from controller.card.log import Replay, call_of

LIMITS = "[[switches]]\nnegative = -40000\n[[switches]]\nnegative = -60000\n"
HOMES = "[[switches]]\nnegative = -90000\npositive = 90000\nhome = [-60000, -40000]\nindex_every = 2000\n"
AT_END = "0 0 60000 2001"


def end_of(ran: Ran) -> str:
    """Place and status at the end of `stream`, without error."""
    assert (ran.code, ran.err) == (0, "")
    (end,) = re.findall("^end: (.*)$", ran.out, re.MULTILINE)
    return str(end)


def repeated(ran: Ran) -> None:
    """The log is whole, and what it says is what the card does."""
    assert list(Replay("client.log", ran.log)) == []


@pytest.mark.deeper
def test_scan_from_the_limits_and_back(library: Made, tmp_path: Path) -> None:
    ran = library.run(library.client("scan"), tmp_path, card=LIMITS)
    *lines, milliseconds = ran.out.splitlines()
    assert lines == ["zero: 30000 20000 0 2001", "scan 1", "scanned: 0 30150 0 2001", "back: 0 0 0 2001"]
    assert 30_000 < int(milliseconds.split()[0]) < 40_000
    assert (ran.code, ran.err) == (0, "")
    repeated(ran)


@pytest.mark.deeper
def test_scan_without_switches_finds_no_zero(library: Made, tmp_path: Path) -> None:
    ran = library.run(library.client("scan"), tmp_path)
    assert (ran.code, ran.out) == (1, "no zero: -1000000 0 0 2001\n")


@pytest.mark.deeper
def test_home_and_index_of_three_axes(library: Made, tmp_path: Path) -> None:
    ran = library.run(library.client("home"), tmp_path, card=HOMES * 3)
    assert ran.out.splitlines()[0] == "levels 3f"
    for axis, line in zip((3, 2, 1), ran.out.splitlines()[1:4], strict=True):
        assert re.fullmatch(rf"axis {axis}: home -40000 index -38000 zero 0 sts \w{{4}} levels 3f", line)
    assert ran.out.splitlines()[4] == "home: 0 0 0 2001"
    assert 3.0 < float(ran.out.splitlines()[5].split()[0]) < 7.0
    repeated(ran)


@pytest.mark.alike(1)
@pytest.mark.parametrize(("capacity", "refuses"), [(4096, False), (32, True), (16, True)])
def test_stream_into_a_list_of_any_length(library: Made, tmp_path: Path, capacity: int, refuses: bool) -> None:
    ran = library.run(library.client("stream"), tmp_path, card=f"capacity = {capacity}")
    assert end_of(ran) == AT_END
    (refused,) = re.findall(r"^refused (\d+)$", ran.out, re.MULTILINE)
    assert (int(refused) > 100) == refuses
    repeated(ran)


def test_stream_with_a_pause_ends_as_much_later(library: Made, tmp_path: Path) -> None:
    took = []
    for arguments in ((), ("pause",)):
        ran = library.run(library.client("stream"), tmp_path, *arguments)
        assert end_of(ran) == AT_END
        took.append(int(re.findall(r"^(\d+) ms$", ran.out, re.MULTILINE)[0]))
    assert "pause: set 0 restore 0, at rest 1" in ran.out
    assert 1000 <= took[1] - took[0] <= 1100


@pytest.mark.deeper
def test_origin_from_a_limit_with_cards_from_zero(library: Made, tmp_path: Path) -> None:
    ran = library.run(library.client("origin"), tmp_path, card=HOMES)
    assert ran.out.splitlines() == [
        "card 0 open 0 card 0 is 0",
        "limit: 90400 0 0 2201",
        "capture 0 at -40000",
        "origin: 0 0 0 2001",
    ]
    repeated(ran)


def test_a_hook_hears_of_each_call_and_asks_the_card(library: Made, tmp_path: Path) -> None:
    ran = library.run(library.client("hook"), tmp_path, card="capacity = 1")
    assert (ran.code, ran.err) == (0, "")
    assert ran.out.splitlines() == ["GT_SetSynVel 4 0000", "GT_LnXY 1 8000", "heard 5"]
    repeated(ran)


@pytest.mark.deeper
def test_three_threads_end_alike_each_time(library: Made, tmp_path: Path) -> None:
    ran = library.run(library.client("stream"), tmp_path, "threads", "10")
    assert (ran.code, ran.err) == (0, "")
    assert re.findall("^end: (.*)$", ran.out, re.MULTILINE) == [AT_END] * 10
    repeated(ran)


@pytest.mark.deeper
def test_three_threads_take_the_same_turns_in_every_process(library: Made, tmp_path: Path) -> None:
    runs = [library.run(library.client("stream"), tmp_path, "threads", "pause") for _ in range(6)]
    assert {end_of(ran) for ran in runs} == {AT_END}
    assert all(ran.log == runs[0].log for ran in runs)


def test_sleeps_of_threads_do_not_add_up(library: Made, tmp_path: Path) -> None:
    ran = library.run(library.client("sleepers"), tmp_path)
    assert ran.out.splitlines() == ["3 threads of 10 sleeps of 100 ms: 1 s", "ends in order: 1"]


def test_every_sleep_moves_the_card_and_takes_no_time(library: Made, tmp_path: Path) -> None:
    ran = library.run(library.client("sleeps"), tmp_path)
    told = dict(re.findall(r"^(\w+) ([\d.]+)$", ran.out, re.MULTILINE))
    real = float(told.pop("real"))
    assert told == dict.fromkeys(
        ("Sleep", "usleep", "sleep", "nanosleep", "clock_nanosleep", "until", "thrd_sleep", "select", "poll"), "2.000"
    )
    assert real < 1.0


def test_a_killed_program_leaves_a_whole_log(library: Made, tmp_path: Path) -> None:
    ran = library.run(library.client("killed"), tmp_path)
    assert ran.code == -signal.SIGKILL
    calls = [call_of(line) for line in ran.log[2:]]
    assert [call.name for call in calls[:3]] == ["GT_Open", "GT_SetSynVel", "GT_LnXY"]
    assert len(calls) == 3 + 500
    assert calls[-1].status == 0x2000  # on its way


def test_the_wall_clock_moves_the_card_so_many_times_as_fast(library: Made, tmp_path: Path) -> None:
    ran = library.run(library.client("wall"), tmp_path, DRYCUT_CLOCK="20")
    moved, simulated, real = (float(text) for text in ran.out.split())
    assert moved == 1000.0
    assert 1000.0 <= simulated < 4000.0
    assert simulated / 20.0 * 0.8 < real < 1000.0


def test_cplusplus_and_other_spellings_of_headers(library: Made, tmp_path: Path) -> None:
    (tmp_path / "client.cpp").write_text('#include <Windows.h>\n#include "ges.h"\n#include "origin.c"\n', "utf-8")
    done = library.compile(tmp_path / "client.cpp", tmp_path / "client", "-fsyntax-only")
    assert (done.returncode, done.stderr) == (0, "")


def test_the_other_card_is_refused_by_name(library: Made, tmp_path: Path) -> None:
    (tmp_path / "other.c").write_text("#include <gt400.h>\nint main(void) { return GT_Axis(1); }\n", "utf-8")
    done = library.compile(tmp_path / "other.c", tmp_path / "other")
    assert done.returncode
    assert "gt400.h belongs to another card" in done.stderr


def test_programs_of_the_other_card_do_not_link(library: Made, tmp_path: Path) -> None:
    (tmp_path / "other.c").write_text(
        "short GT_Axis(short), GT_SetPos(long), GT_Open(long);\n"
        "int main(void) { GT_Open(0); GT_Axis(1); return GT_SetPos(0); }\n",
        "utf-8",
    )
    done = library.compile(tmp_path / "other.c", tmp_path / "other")
    assert re.findall(r"undefined reference to [`'](\w+)'", done.stderr) == ["GT_Axis", "GT_SetPos"]


def test_all_clients_are_run() -> None:
    texts = (Path(__file__), ROOT / "tests" / "sim" / "clients" / "test_run.py")
    named = {name for path in texts for name in re.findall(r'client\("(\w+)"\)', path.read_text("utf-8"))}
    assert {path.stem for path in CLIENTS.glob("*.c")} <= named
