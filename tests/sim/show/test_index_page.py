"""The page of a shop: its data are what its scripts expect, its pictures are small, and nothing in it is unescaped."""

import json
import re
from pathlib import Path

import numpy as np
import pytest
from page_types import types_of, unlike
from runs import plain_scenario

from parser.findings.catalogue import Bilingual
from parser.findings.codes import Severity
from parser.findings.findings import Count
from parser.program import Program, parse_program
from sim.jobs.index import Entry, Row, build_index, index_text
from sim.show import index_page as room
from sim.show.index_page import BesideTheIndex, index_page
from sim.show.index_page.page import HEIGHT, WIDTH, thumbnail
from sim.show.texts.phrases import same

FAILS = (Count("3B301", Severity.ERROR, 2), Count("3B405", Severity.WARNING, 1))

ASSETS = Path(room.__file__).with_name("assets")
HOSTILE = "</script><img src=x onerror=alert(1)>"
ROWS = [
    Row("pass", same("a.3b"), time_s=61.5, time_within_s=(36.9, 86.1), max_um=1.25, picture="M1,1l2,0"),
    Row(
        "fail",
        Bilingual("Die", "凹模"),
        findings=FAILS,
        time_s=3600.0,
        max_um=0.5,
        picture="M1,1l0,2",
    ),
    Row("refused", same(HOSTILE), Bilingual("no program", "没有程序"), findings=(Count("3B100", Severity.ERROR, 1),)),
]
ENTRIES = [
    Entry("shop/a.3b", "a.3b", ROWS[0], from_cache=True),
    Entry("shop/die/program.3b", "die", ROWS[1], from_cache=False),
    Entry(f"shop/{HOSTILE}.3b", None, ROWS[2], from_cache=False),
]


def page_of(entries: list[Entry]) -> str:
    return index_page(build_index(entries), [BesideTheIndex(entry.row.picture, entry.row.message) for entry in entries])


def data_of(page: str) -> dict:
    (text,) = re.findall(r'<script type="application/json" id="index">(.*?)</script>', page, re.DOTALL)
    return json.loads(text)


def places(path: str) -> np.ndarray:
    """All corners of SVG path data of ``M`` and ``l``."""
    found = []
    for run in path.split("M")[1:]:
        first, _, steps = run.partition("l")
        moves = [tuple(map(float, pair.split(","))) for pair in (first, *steps.split())]
        found.append(np.cumsum(moves, axis=0))
    return np.concatenate(found)


def test_the_data_of_the_page_are_what_its_scripts_say() -> None:
    types = types_of(ASSETS / "data.js", ASSETS.parents[1] / "html" / "assets" / "language.js")
    assert list(unlike(types, "Index", data_of(page_of(ENTRIES)))) == []


def test_whatever_a_shop_says_stands_escaped() -> None:
    page = page_of(ENTRIES)
    assert HOSTILE not in page
    assert data_of(page)["programs"][2]["title"] == HOSTILE


def test_the_index_counts_its_programs_and_their_findings() -> None:
    counts = build_index(ENTRIES)["counts"]
    assert list(counts.values()) == [3, 1, 1, 0, 1, 0, 1, 3, 1, 0]
    assert json.loads(index_text(build_index(ENTRIES))) == build_index(ENTRIES)
    assert json.loads(index_text(build_index([])))["programs"] == []


def test_a_picture_has_the_shape_of_its_path_and_points_up() -> None:
    triangle = parse_program("B40000B0B40000GXL1\nB0B30000B30000GYL2\nB40000B30000B40000GXL3\nDD\n").toolpath
    corners = places(thumbnail(triangle))
    assert len(corners) == 4
    assert np.ptp(corners, axis=0) == pytest.approx([66 / 3 * 4, 66], abs=1.0)
    assert corners[2, 1] < corners[0, 1]
    assert (corners >= 0).all()
    assert (corners <= (WIDTH, HEIGHT)).all()


def test_jumps_are_left_out() -> None:
    program: Program = parse_program("B40B0B40GXL1\nD\nB900B0B900GXL1\nD\nB40B0B40GXL1\nDD\n")
    assert thumbnail(program.toolpath).count("M") == 2


def test_a_picture_of_a_path_without_end_is_small() -> None:
    text = "\n".join(f"B{x}B{y}B{max(x, y)}G{'X' if x >= y else 'Y'}L{q}" for x, y, q in zigzag(4000))
    assert len(thumbnail(parse_program(f"{text}\nDD\n").toolpath)) < 8000


def zigzag(count: int) -> list[tuple[int, int, int]]:
    chance = np.random.default_rng(18)
    return [(int(x), int(y), int(q)) for x, y, q in chance.integers((1, 1, 1), (9000, 9000, 5), (count, 3))]


def test_a_point_has_no_picture_that_breaks() -> None:
    still = parse_program("B0B0B0GXL1\nDD\n", name=plain_scenario().title).toolpath
    assert thumbnail(still) in {"", "M48,36l0,0"}


def test_a_time_stands_with_its_own_interval() -> None:
    first, second, _ = data_of(page_of(ENTRIES))["programs"]
    assert (first["time"], first["time_within"]) == ("0:01:02", "0:00:37 … 0:01:26")
    assert (second["time"], second["time_within"]) == ("1:00:00", "")
