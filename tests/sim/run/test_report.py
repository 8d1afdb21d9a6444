"""The report and the trace file say what was computed, against values worked out by hand for a small program."""

import json
import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from report_schema import complaints
from runs import plain_scenario, run_text

from parser.controller_words import Axis
from parser.program import parse_program
from sim.base.progress import silent
from sim.jobs.run_into import run_into
from sim.run.report import build_report
from sim.setup.wire import DEFAULT_WIRE
from sim.show.terminal.run import print_summary
from sim.table.losses import Loss, Peak

# A line of 3 mm, a half turn of R 2 mm to the left, back down by 3 mm, a pause, a jump: nothing lies on itself.
TEXT = (
    "Start Point = 10.0 , 20.0 ;\nN1: B3000B0B3000GXL1 ; 13.000, 20.000\nN2: B0B2000B4000GXNR4\nD\n"
    "B0B1000B1000GYL2\nD\nB30B40B400GYL3\nDD"
)
CUT, JUMP, RAMP = 43.75, 500.0, 1e5  # µm/s, µm/s, µm/s² of the shipped machine in 40 mm


@pytest.fixture(scope="module")
def report() -> dict:
    return build_report(run_text(TEXT, start_mm=(100.1, 64.1)))


def test_head_of_the_report(report: dict) -> None:
    assert report["schema"] == "drycut.report/1"
    machine = {"name": "DK7740 class, stepper drives", "engine": "compiled", "start_um": [100_100.0, 64_100.0]}
    assert report["machine"] == machine
    assert report["wire"] == {"diameter_um": 180.0, "spark_gap_um": 10.0, "kerf_um": 200.0, "lag_um": 0.0}
    assert report["work"] == {"thickness_mm": 40.0, "density_g_cm3": 7.85}
    half_turn = math.pi * 2000.0
    assert report["summary"] == {
        "blocks": 4,
        "length_um": pytest.approx(3000.0 + half_turn + 1000.0 + 500.0, abs=1e-5),
        "steps": 3000 + 8000 + 1000 + 700,
    }


def test_times_of_the_report(report: dict) -> None:
    cut = (3000.0 + math.pi * 2000.0) / CUT + CUT / RAMP
    jump, last = 1000.0 / JUMP + JUMP / RAMP, 500.0 / CUT + CUT / RAMP
    assert report["time_s"]["total"] == pytest.approx(cut + jump + last, abs=2e-6)
    assert report["time_s"]["by_block"] == pytest.approx(
        [3000.0 / CUT + CUT / RAMP / 2, math.pi * 2000.0 / CUT + CUT / RAMP / 2, jump, last], abs=2e-6
    )
    assert sum(report["time_s"]["by_block"]) == pytest.approx(report["time_s"]["total"], abs=3e-6)  # six digits each


def test_stops_and_contours_of_the_report(report: dict) -> None:
    assert report["stops"] == [
        {"kind": "pause", "after_block": 2, "line": 4},
        {"kind": "pause", "after_block": 3, "line": 6},
        {"kind": "end", "after_block": 4, "line": 8},
    ]
    first, second = report["contours"]
    assert (first["first_block"], first["last_block"]) == (1, 2)
    assert first["closure_exact_um"] == pytest.approx(math.hypot(3000.0, 4000.0))
    assert (second["first_block"], second["last_block"]) == (4, 4)
    assert second["closure_stepped_um"] == pytest.approx(500.0)


def test_blocks_of_the_report(report: dict) -> None:
    line, arc, jump, last = report["blocks"]
    assert [line["kind"], arc["kind"], jump["kind"], last["kind"]] == ["line", "arc", "jump", "line"]
    assert (arc["block"], arc["line"], arc["label"], arc["text"]) == (2, 3, "N2", "B0B2000B4000GXNR4")
    assert (jump["label"], last["line"]) == (None, 7)
    assert (arc["count_um"], arc["count_axis"]) == (4000, "X")
    assert (last["count_um"], last["count_axis"]) == (400, "Y")
    assert line["printed_end_um"] == [13_000.0, 20_000.0]
    assert arc["printed_end_um"] is None
    assert arc["exact"] == {
        "start_um": [13_000.0, 20_000.0],
        "end_um": [13_000.0, 24_000.0],
        "center_um": [13_000.0, 22_000.0],
        "radius_um": 2000.0,
        "sweep_deg": 180.0,
        "start_angle_deg": -90.0,
        "end_angle_deg": 90.0,
        "is_major": False,
        "length_um": pytest.approx(math.pi * 2000.0, abs=1e-6),
    }
    assert last["exact"]["end_um"] == [12_700.0, 24_600.0]
    assert last["exact"]["center_um"] is None
    assert last["stepped"]["end_um"] == [12_700, 24_600]
    assert [block["stepped"]["steps"] for block in report["blocks"]] == [3000, 8000, 1000, 700]


def test_deviations_of_the_report_are_those_of_the_run() -> None:
    # On the wrong count axis the second circle begins 140 µm off: the kinds of deviation differ clearly.
    run = run_text("B9900B0B39600GXNR1 B9900B0B39600GYNR1 DD")
    report = build_report(run)
    kinds = {"interpolation": (1.0, 1), "steps": (140.0, 2), "table": (140.0, 2), "wire": (140.0, 2)}
    for kind, (largest, block) in kinds.items():
        found, entry = getattr(run.deviations, kind), report["deviation"][kind]
        assert entry["max_um"] == pytest.approx(largest, abs=2.0)
        assert [entry["max_um"], entry["rms_um"], entry["p95_um"]] == pytest.approx(
            [found.max_um, found.rms_um, found.p95_um], abs=1e-6
        )
        assert entry["rms_um"] < entry["p95_um"] < entry["max_um"] + 1e-9
        where = entry["where"]
        assert [where["block"], where["x_um"], where["y_um"], where["t_s"]] == pytest.approx(
            list(found.where), abs=1e-6
        )
        assert where["block"] == block
    block = report["blocks"][1]
    assert block["stepped"]["max_deviation_um"] == pytest.approx(run.deviations.steps.by_row_um[1], abs=1e-6)
    assert block["stepped"]["interpolation_um"] == pytest.approx(1.0, abs=0.1)
    assert block["table"]["max_deviation_um"] == pytest.approx(run.deviations.table.by_row_um[1], abs=1e-6)
    assert block["stepped"]["max_deviation_um"] != block["table"]["max_deviation_um"]


def test_causes_of_the_report_are_those_of_the_run() -> None:
    run = run_text("B9900B0B39600GXNR1 B9900B0B39600GYNR1 DD", wire=replace(DEFAULT_WIRE, lag=25.0))
    report = build_report(run)
    assert report["wire"]["lag_um"] == 25.0
    causes = report["deviation"]["by_cause"]
    assert list(causes) == ["interpolation", "carried", "planning", "table", "wire"]
    for name, entry in causes.items():
        part = getattr(run.deviations.by_cause, name)
        assert entry["max_um"] == pytest.approx(part.max_um, abs=1e-6)
        assert (entry["where"] is None) == (part.where is None)
        if part.where is not None:
            assert list(entry["where"].values()) == pytest.approx(list(part.where), abs=1e-6)
    assert causes["planning"] == {"max_um": 0.0, "where": None}
    assert (causes["carried"]["where"]["block"], causes["wire"]["max_um"] > 0.0) == (2, True)


PEAKS = (
    Peak("force", Axis.X, 240.0, 2000.0, row=1, t_s=3.25, x_um=13_000.0, y_um=24_000.0),
    Peak("speed", Axis.Y, 500.0, 10_000.0, row=2, t_s=80.0, x_um=12_999.5, y_um=22_123.4567891),
    Peak("lag", Axis.X, 1.5, math.inf, row=0, t_s=0.5, x_um=10_001.0, y_um=20_000.0),
    Peak("lag", Axis.Y, 4.0, 5.0, row=3, t_s=90.0, x_um=12_700.0, y_um=-0.0001),
    Peak("force", Axis.Y, 20.0, 1500.0, row=3, t_s=91.0, x_um=0.0, y_um=0.0),
)
LOSSES = (Loss("lost-steps", Axis.Y, row=2, t_s=80.5, amount_um=-12.0, x_um=13_000.0, y_um=22_500.0),)


def test_limits_and_losses_of_the_report() -> None:
    report = build_report(replace(run_text(TEXT), peaks=PEAKS, losses=LOSSES))
    assert complaints(report) == []
    assert [report["limits"][0], report["limits"][2]] == [
        {
            **{"quantity": "force", "axis": "X", "value": 240.0, "limit": 2000.0, "share": 0.12},
            **{"block": 2, "t_s": 3.25, "x_um": 13_000.0, "y_um": 24_000.0},
        },
        {
            **{"quantity": "lag", "axis": "X", "value": 1.5, "limit": None, "share": None},
            **{"block": 1, "t_s": 0.5, "x_um": 10_001.0, "y_um": 20_000.0},
        },
    ]
    assert report["limits"][1]["y_um"] == 22_123.456789
    assert report["losses"] == [
        {
            **{"kind": "lost-steps", "axis": "Y", "amount_um": -12.0, "least_um": -12.0, "most_um": -12.0},
            **{"block": 3, "t_s": 80.5, "x_um": 13_000.0, "y_um": 22_500.0},
        }
    ]


@pytest.mark.parametrize(
    ("entries", "change"),
    [
        ("limits", {"limit": None}),
        ("limits", {"share": None}),
        ("limits", {"quantity": "heat"}),
        ("limits", {"axis": "Z"}),
        ("limits", {"value": -1.0}),
        ("limits", {"unit": "N"}),
        ("losses", {"kind": "wear"}),
        ("losses", {"block": 0}),
        ("losses", {"amount_um": None}),
        ("losses", {"lost": 1.0}),
    ],
)
def test_schema_refuses_wrong_limits_and_losses(entries: str, change: dict) -> None:
    report = build_report(replace(run_text(TEXT), peaks=PEAKS, losses=LOSSES))
    report[entries][0] |= change
    assert complaints(report)


def test_the_summary_shows_causes_and_the_nearest_limits(capsys: pytest.CaptureFixture[str]) -> None:
    run = run_text(TEXT, wire=replace(DEFAULT_WIRE, lag=20.0))
    print_summary(replace(run, peaks=PEAKS, findings=()), None)
    shown = capsys.readouterr().out
    rows = {
        name.strip(): value.strip()
        for _, name, value, _ in (line.split("│") for line in shown.splitlines() if "│" in line)
    }
    assert rows["wire lag"] == "20 µm"
    deviations = run.deviations
    for name, part in {"deviation, at most": deviations.wire, "by the wire": deviations.by_cause.wire}.items():
        assert rows[name].startswith(f"{part.max_um:.2f} µm in block {part.where.block} at ")  # type: ignore[union-attr]
    assert rows["by planning"] == "none"
    assert rows["limits, nearest"] == "lag Y 80 % of 5 µm, block 4 at 12.7, 0.0 mm"
    assert "│ force X 12 % of 2,000 N, block N2 at 13.0, 24.0 mm" in shown
    assert "│ speed Y 5 % of 10 mm/s, block 3 at 13.0, 22.1 mm" in shown
    assert "1,500 N" not in shown
    assert max(map(len, shown.splitlines())) <= 80


def test_the_summary_leaves_out_what_there_is_not(capsys: pytest.CaptureFixture[str]) -> None:
    print_summary(replace(run_text("B0 B5000 B0 GY L2 DD"), peaks=()), None)
    shown = capsys.readouterr().out
    assert "deviation, at most" in shown
    assert "no motion" in shown
    assert not [word for word in ("limits", "by the table", "wire lag") if word in shown]


def test_trace_file_is_the_trace(tmp_path: Path) -> None:
    run = run_into(
        tmp_path, parse_program(TEXT), plain_scenario(wire=replace(DEFAULT_WIRE, lag=10.0)), silent, trace=True
    )
    arrays, trace = np.load(tmp_path / "trace.npz"), run.trace
    assert np.array_equal(arrays["t_s"], trace.t_s)
    assert np.array_equal(np.stack([arrays["x_um"], arrays["y_um"]], axis=1), trace.wire_um)
    assert np.array_equal(np.stack([arrays["table_x_um"], arrays["table_y_um"]], axis=1), trace.table_um)
    assert not np.array_equal(trace.table_um, trace.wire_um)
    assert np.array_equal(np.stack([arrays["commanded_x_um"], arrays["commanded_y_um"]], axis=1), trace.commanded_um)
    assert np.array_equal(arrays["block"], trace.row + 1)
    assert (arrays["step_x_um"][0], arrays["step_y_um"][0]) == (10_000, 20_000)
    assert np.diff(arrays["step_t_s"]).min() >= 0.0
    # What was commanded by a sample is where the steps stood by then.
    stood = np.searchsorted(arrays["step_t_s"], trace.t_s + 1e-9, side="right")
    assert np.array_equal(arrays["step_x_um"][stood], trace.commanded_um[:, 0])
    assert np.array_equal(arrays["step_y_um"][stood], trace.commanded_um[:, 1])
    assert json.loads((tmp_path / "report.json").read_text("utf-8"))["summary"]["steps"] == len(arrays["step_t_s"])
