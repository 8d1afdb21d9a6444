"""Runs under sparks: what they add to a report, what they leave as it is, and what they do to the part."""

import json

import numpy as np
import pytest
from places import SCENARIOS
from report_schema import complaints
from runs import codes, run_text, scenario_run

from controller.stepping.counters import Counters, made_by
from controller.stepping.steps import interpolate, words_of
from parser.findings.errors import SettingsError
from parser.program import moving, parse_program
from sim.jobs.shop import program_read, source_of
from sim.process.way import is_cut_again
from sim.run.dryrun import DryRun
from sim.run.recording import check_expectations
from sim.run.report import build_report, report_text
from sim.run.running import dry_run
from sim.setup.scenario import load_scenario, under_sparks
from sim.setup.spark import Event, Spark
from sim.show.report_page.page import report_page
from sim.show.terminal.run import summary_rows

OPENING = (
    "B0B1900B1900GYL4 B2900B0B2900GXL1 B0B3800B3800GYL2 B5800B0B5800GXL3 B0B3800B3800GYL4 B2900B0B2900GXL1"
    " B0B1900B1900GYL2 DD"
)


def run_folder_under_sparks(name: str) -> DryRun:
    scenario = under_sparks(load_scenario(SCENARIOS / name))
    program = moving(program_read(scenario, source_of(scenario)))
    return check_expectations(dry_run(program, scenario))


def test_without_sparks_nothing_but_a_null_is_new() -> None:
    report = build_report(run_text(OPENING))
    assert report["spark"] is None
    assert all(check["check"] != "sparks" for check in report["coverage"]["checks"])


def test_sparks_change_nothing_of_the_table_and_the_steps() -> None:
    plain, sparked = build_report(run_text(OPENING)), build_report(run_text(OPENING, spark=Spark()))
    other = {"spark", "coverage"}
    assert {key: value for key, value in plain.items() if key not in other} == {
        key: value for key, value in sparked.items() if key not in other
    }
    assert complaints(json.loads(report_text(sparked))) == []


def test_the_same_seed_writes_the_same_bytes() -> None:
    events = (Event("short", per_h=200.0), Event("break", per_h=20.0))
    first, again, other = (
        report_text(build_report(run_text(OPENING, spark=Spark(seed=seed), events=events))) for seed in (3, 3, 4)
    )
    assert first == again
    assert first != other


def test_a_cut_that_stops_is_told_and_has_to_be_looked_at() -> None:
    event = Event("short", 3, share=0.5, for_s=1e4, clear_um=5e3)
    run = run_text(OPENING, spark=Spark(), events=(event,))
    assert codes(run) == ["3B609"]
    report = build_report(run)
    assert report["to_check"]
    assert report["spark"] is not None
    assert report["spark"]["stopped"] is not None
    assert report["spark"]["stopped"]["kind"] == "shorted"
    assert report["coverage"]["checks"][-1] == {
        "check": "sparks",
        "state": "incomplete",
        "reason": "the control stopped under sparks before the program was through",
    }


@pytest.mark.parametrize("block", [8, 99])
def test_an_event_in_no_block_of_the_program_is_refused(block: int) -> None:
    with pytest.raises(SettingsError, match=f"block {block} is none that this program cuts"):
        run_text(OPENING, spark=Spark(), events=(Event("break", block=block),))


def test_a_reverse_cut_needs_a_path_that_ends_where_it_starts() -> None:
    with pytest.raises(SettingsError, match="it is open by 1900 µm"):
        run_text("B0B1900B1900GYL4 DD", spark=Spark(threading="reverse"))


def test_what_is_skipped_and_what_the_wire_runs_into_is_told() -> None:
    skipped = run_text(OPENING, spark=Spark(), events=(Event("skip", 4),))
    assert (
        dict(summary_rows(skipped))["  displaced"]
        == "all that follows the skipped blocks lies 5.800, 0.000 mm elsewhere"
    )
    torn = run_text(OPENING, spark=Spark(), events=(Event("origin", 4, share=0.25),))
    assert codes(torn) == ["3B609"]
    assert "2.19 mm of uncut work" in dict(summary_rows(torn))["  collision"]
    assert complaints(json.loads(report_text(build_report(torn)))) == []


def test_a_table_that_trips_cuts_no_block_behind_it() -> None:
    run = run_folder_under_sparks("servo-trip")
    assert run.ended is not None
    assert run.process is not None
    assert run.process.block_s[: run.ended.row].min() > 0.0
    assert run.process.block_s[run.ended.row + 1 :].sum() == 0.0


def test_trims_at_their_usual_feed_are_as_wide_as_ever() -> None:
    """Trims take thin stock, and go as fast as the law lets them: that is their usual feed."""
    run = run_folder_under_sparks("rough-and-trim")
    assert run.process is not None
    assert abs(run.process.wider_um).max() < 0.3
    assert codes(run) == []


def test_a_pause_widens_the_kerf_of_its_block_and_not_the_nominal_size() -> None:
    event = Event("pause", 2, share=0.5, for_s=200.0)
    plain = build_report(run_text(OPENING, kerf=True))["remains"]
    run = run_text(OPENING, kerf=True, spark=Spark(), events=(event,))
    widened = build_report(run)["remains"]
    assert plain is not None
    assert widened is not None
    wider = np.array([each["width_um"]["max"] for each in widened["kerf"]["blocks"]]) - np.array(
        [each["width_um"]["max"] for each in plain["kerf"]["blocks"]]
    )
    assert wider[1] > 0.5
    assert abs(wider[[3, 4]]).max() < 0.1
    boxes = zip(plain["sizes"]["boxes"], widened["sizes"]["boxes"], strict=True)
    for before, after in boxes:
        assert before["nominal_um"] == after["nominal_um"]


def test_a_control_goes_on_after_a_power_loss_from_what_it_shows() -> None:
    """Block, X, Y, F and J of the report lead to the step at which the power failed."""
    report = build_report(scenario_run("sparks-power-loss"))
    assert report["spark"] is not None
    (lost,) = report["spark"]["events"]
    toolpath = parse_program(OPENING).toolpath
    steps, words = interpolate(toolpath), words_of(toolpath)
    shown = Counters(
        lost["block"] - 1, 0, int(lost["x_um"]), int(lost["y_um"]), lost["deviation"], lost["count_left_um"]
    )
    assert made_by(steps, words, shown) == lost["step"]


def test_lines_over_lines_that_were_cut_cut_nothing() -> None:
    toolpath = parse_program(OPENING).toolpath
    assert is_cut_again(toolpath).tolist() == [False] * 6 + [True]
    run = run_text(OPENING, spark=Spark())
    assert run.process is not None
    assert run.process.block_s[6] < run.process.block_s[0] / 3.0


def test_page_and_terminal_say_that_it_is_a_model_and_what_happened() -> None:
    run = scenario_run("sparks-wire-break")
    page = report_page(run, build_report(run), [])
    assert all(word in page for word in ("What happened under sparks", "放电切割中发生的事", "open spark model"))
    english = dict(summary_rows(run))
    chinese = dict(summary_rows(run, "zh"))
    assert "gap 11.8 µm" in english["under sparks"]
    assert english["  wire breaks"] == "1"
    assert chinese["  断丝"] == "1 次"
    assert "  shorts" not in english


def test_the_terminal_says_how_often_the_power_failed() -> None:
    run = scenario_run("sparks-power-loss")
    assert dict(summary_rows(run))["  events"] == "power loss × 1"
    assert dict(summary_rows(run, "zh"))["  事件"] == "断电 × 1"
