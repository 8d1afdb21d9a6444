import cProfile
import pstats
from functools import partial
from pathlib import Path

import bench_goals
import numpy as np
import pytest
from bench_cpu import in_turns, used_by
from bench_cut import cut_parts, grid, squares
from bench_goals import Goal, goal_lines
from bench_growth import by_room
from bench_path import contour_text
from bench_peers import KLIPPER_MISSING, RS274_MISSING
from traced import pieces_along

from parser.program import parse_program
from sim.check.file_check import Job, check_file
from sim.check.settings import CheckSettings


def test_a_goal_says_whether_it_is_reached() -> None:
    assert Goal("table", "ns per tick", "2071", 60.0, 59.0).line().endswith("ns per tick, reached")
    assert Goal("table", "ns per tick", "2071", 60.0, 61.0).line().endswith("ns per tick, not reached")


def test_peers_that_are_not_installed_are_said_to_be_missing(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.delenv("DRYCUT_BENCH_KLIPPER", raising=False)
    monkeypatch.delenv("DRYCUT_BENCH_RS274", raising=False)
    monkeypatch.setattr(bench_goals, "PARTS", (bench_goals.beside_klipper, bench_goals.beside_rs274))
    told = list(goal_lines(tmp_path, 60, 1))[1:]
    assert [line.endswith(KLIPPER_MISSING) for line in told] == [True, True, False, False]
    assert all(line.endswith(RS274_MISSING) for line in told[2:])


@pytest.mark.parametrize("crosses", [False, True])
def test_contours_of_the_benchmark_close_and_cross_themselves_as_they_say(crosses: bool) -> None:
    text = contour_text(400, crosses=crosses)
    toolpath = parse_program(text).toolpath
    assert len(toolpath) == 400
    assert np.hypot(*(toolpath.end_um[-1] - toolpath.start_um[0])) < 2.0
    codes = {finding.code for finding in check_file(Job("contour.3b", text.encode(), CheckSettings())).findings}
    assert ("3B307" in codes) == crosses


def test_parts_of_the_benchmark_are_as_long_as_they_say_and_free_what_they_say() -> None:
    path = {name: parse_program(text).toolpath for name, text, *_ in cut_parts()}
    assert [round(float(each.length_um[~each.is_jump].sum()) / 1e6, 1) for each in path.values()] == [
        4.8,
        4.0,
        38.0,
        0.5,
        2.5,
    ]
    # 3 × 3 squares; two more at the right and one above, each closed by a way from one line to the next.
    assert len(pieces_along(parse_program(grid(4, 2_000, 500)).toolpath).freed) == 12
    assert len(pieces_along(parse_program(squares(3, 1_000)).toolpath).freed) == 3


def test_time_is_told_by_the_room_whose_functions_take_it() -> None:
    profiler = cProfile.Profile()
    profiler.enable()
    np.sort(np.arange(1000.0))  # of no room
    parse_program("B0B0B100GXL1 DD")
    profiler.disable()
    rooms = by_room(pstats.Stats(profiler))
    assert {"parser", "parser/threeb"} < rooms.keys()
    assert not any(room.startswith("tests") for room in rooms)
    assert rooms["parser/threeb"] <= rooms["all"]


def test_works_take_turns_and_the_least_of_each_counts() -> None:
    asked: list[str] = []
    times = iter((3.0, 5.0, 1.0, 7.0))

    def work(name: str) -> float:
        asked.append(name)
        return next(times)

    assert in_turns(2, partial(work, "ours"), partial(work, "theirs")) == [1.0, 5.0]
    assert asked == ["ours", "theirs", "ours", "theirs"]


def test_a_process_that_fails_gives_no_figure() -> None:
    with pytest.raises(RuntimeError, match="ended with 3"):
        used_by(("/bin/sh", "-c", "exit 3"))
