"""Every scenario of the project runs and is as it expects."""

import json
import math
import re
from collections.abc import Iterator
from datetime import date
from pathlib import Path

import pytest
from places import ROOT, SCENARIOS
from report_schema import complaints
from runs import codes, run_folder, scenario_run

from parser.findings.catalogue import texts
from sim.run.findings import expectation_findings
from sim.run.report import build_report
from sim.setup.expectations import missed, read_expectation, wanted
from sim.setup.scenario import load_scenario

PAGE = (ROOT / "docs" / "scenarios.md").read_text("utf-8")
FOLDERS = sorted(path for path in SCENARIOS.iterdir() if path.is_dir())
LONG = {"logo", "gear"}  # made of splines, a program of its drawing takes seconds


def times_in(part: object) -> Iterator[float]:
    """All times of what happened that a part of a report tells."""
    for key, value in part.items() if isinstance(part, dict) else enumerate(part if isinstance(part, list) else ()):
        if key == "spark":  # of another clock
            continue
        if str(key).endswith("t_s") and value is not None:
            yield value
        yield from times_in(value)


@pytest.mark.parametrize(
    "folder",
    [pytest.param(folder, marks=pytest.mark.deeper if folder.name in LONG else ()) for folder in FOLDERS],
    ids=lambda folder: folder.name,
)
def test_scenario_is_as_it_expects_and_its_report_as_documented(folder: Path) -> None:
    """In one test, so that no two processes make and run the same scenario."""
    run = scenario_run(folder.name)
    assert [finding for finding in run.findings if finding.code == "3B490"] == []
    report = json.loads(json.dumps(build_report(run), allow_nan=False))
    assert max(times_in(report), default=0.0) <= report["time_s"]["total"]
    assert complaints(report) == []
    row = re.search(rf"^\| `{folder.name}` \|.*\| ([01]) \|$", PAGE, flags=re.MULTILINE)
    assert row
    assert (row[1] == "1") == (report["verdict"] == "fail")


@pytest.mark.parametrize("folder", FOLDERS, ids=lambda folder: folder.name)
def test_scenario_says_where_it_comes_from_and_what_it_expects(folder: Path) -> None:
    scenario = load_scenario(folder)
    assert scenario.provenance != "not given"
    assert any(expectation.path == "verdict" for expectation in scenario.expect)


@pytest.mark.parametrize(
    ("name", "x_mm"),
    [
        ("clamp-hit", 2.0 + 0.18 / 2),  # edge of the clamp, and the wire's radius before it
        ("arm-hit", 20.0 - 15.0),  # edge of the clamp, and the arm's reach before it
        ("leaves-work", 2.0),  # edge of the work
    ],
)
def test_things_in_the_way_are_met_where_their_edges_stand(name: str, x_mm: float) -> None:
    (finding,) = scenario_run(name).findings
    assert finding.values["x_mm"] == pytest.approx(x_mm, abs=0.0005)


def test_an_expectation_that_is_not_met_fails_the_run(tmp_path: Path) -> None:
    (tmp_path / "program.3b").write_text("B100B0B100GXL1 DD", "utf-8")
    (tmp_path / "scenario.toml").write_text('[expect]\n"summary.steps" = 99', "utf-8")
    run = run_folder(tmp_path)
    assert codes(run) == ["3B490"]
    assert "`summary.steps` is 100; expected 99;" in texts(run.findings[0]).message


def test_a_scenario_may_leave_its_contour_open(tmp_path: Path) -> None:
    (tmp_path / "program.3b").write_text("B0B100B100GYL2 B100B0B100GXL1 B0B100B100GYL4 DD", "utf-8")
    (tmp_path / "scenario.toml").write_text("", "utf-8")
    assert codes(run_folder(tmp_path)) == ["3B301"]
    (tmp_path / "scenario.toml").write_text("open = true", "utf-8")
    assert codes(run_folder(tmp_path)) == []


REPORT = {"a": {"b": 2.5, "c": True, "d": "x"}, "rows": [{"n": 1}, {"n": 2}], "none": []}


@pytest.mark.parametrize(
    ("expect", "met"),
    [
        ({"a.b": 2.5}, True),
        ({"a.b": 2.6}, False),
        ({"a.b": {"min": 2.5, "max": 2.5}}, True),
        ({"a.b": {"min": 2.6}}, False),
        ({"a.b": {"max": 2.4}}, False),
        ({"a.c": True}, True),
        ({"a.c": 1}, False),
        ({"a.c": {"min": 0}}, False),
        ({"a.d": "x"}, True),
        ({"a.d": {"min": 0}}, False),
        ({"rows.1.n": 2}, True),
        ({"rows.2.n": 2}, False),
        ({"rows.n": [1, 2]}, True),
        ({"rows.n": [1]}, False),
        ({"a.nowhere": 0}, False),
        ({"none": []}, True),
        ({"rows.²": 1}, False),
        ({"rows." + "9" * 5000: 1}, False),
        ({"rows.n.x": 1}, False),
        ({"a.b.x": 1}, False),
        ({"a.b": {"max": 10**400}}, True),
        ({"a.b": {"min": 10**400}}, False),
        ({"a.b": date(2026, 1, 2)}, False),
    ],
)
def test_expectations_can_be_met_and_missed(expect: dict, met: bool) -> None:
    assert (missed(REPORT, read_expectation(expect, "test")) == ()) is met


@pytest.mark.parametrize("ends", [{"min": 1.0}, {"min": 1.0, "max": 2.0}, {"max": math.inf}, {"max": -math.inf}])
def test_a_range_is_written_as_it_is_read(ends: dict) -> None:
    (read,) = read_expectation({"a.b": ends}, "test")
    assert wanted(read) == ends


@pytest.mark.parametrize(
    ("expect", "found", "wanted"),
    [
        ({"a.b": {"max": 2}}, "2.5", "at most 2"),
        ({"a.b": {"min": 3}}, "2.5", "at least 3"),
        ({"a.b": {"min": 3, "max": 4.5}}, "2.5", "3 to 4.5"),
        ({"a.nowhere": "x"}, "nothing", '"x"'),
        ({"findings": []}, '["3B204", "3B301"]', "[]"),
        ({"a.b": date(2026, 1, 2)}, "2.5", '"2026-01-02"'),
        ({"a.d": {"max": math.inf}}, '"x"', "at most inf"),
    ],
)
def test_a_missed_expectation_says_what_was_found_and_wanted(expect: dict, found: str, wanted: str) -> None:
    tables = [{"code": "3B204", "block": 2, "message": "…"}, {"code": "3B301", "block": 3, "message": "…"}]
    (finding,) = expectation_findings(missed(REPORT | {"findings": tables}, read_expectation(expect, "test")))
    told = texts(finding)
    assert (told.found, told.expected) == (f"`{next(iter(expect))}` is {found}", wanted)
    assert not re.search("[A-Za-z]{2}", texts(finding, "zh").expected.replace('"x"', "").replace("inf", ""))
