"""Where the region of a kerf cannot be worked out, the run says so and all else is told."""

import pytest
import shapely
from runs import codes, run_text
from shapely.errors import GEOSException

from sim.run.findings import verdict
from sim.run.recording import NO_PIECES, pieces_of_run
from sim.run.report import build_report

HOLE = "B 2000 B 0 B 2000 GX L1\nB 2000 B 0 B 8000 GY NR1\nB 2000 B 0 B 2000 GX L3\nDD\n"


@pytest.fixture
def no_unions(monkeypatch):
    def never(*regions, grid_size=None):
        raise GEOSException("TopologyException: side location conflict")

    monkeypatch.setattr(shapely, "union", never)


def state_of_remains(run) -> tuple[str, str]:
    (state,) = (one for one in run.coverage.checks if one.name == "check-remains")
    return state.state, state.reason


def test_a_kerf_that_does_not_come_out_is_a_finding_beside_a_whole_report(no_unions):
    run, without = run_text(HOLE, kerf=True), run_text(HOLE)
    assert codes(run) == [*codes(without), "3B407"]
    told = run.findings[-1]
    assert (told.block, told.values) == (1, {"first": 1, "last": 3})
    assert verdict(run.findings) == "pass"
    assert state_of_remains(run) == ("incomplete", "reason-no-region")
    report, plain = build_report(run), build_report(without)
    changed = {"findings", "coverage"}
    assert {key: report[key] for key in report if key not in changed} == {
        key: plain[key] for key in plain if key not in changed
    }


def test_pictures_of_such_a_run_show_no_pieces(no_unions):
    assert pieces_of_run(run_text(HOLE)) == NO_PIECES


def test_the_check_of_what_is_left_is_told_with_the_others():
    assert state_of_remains(run_text(HOLE, kerf=True)) == ("complete", "")
    run = run_text(HOLE)
    assert state_of_remains(run) == ("not asked", "reason-no-kerf")
    assert run.coverage.is_complete
