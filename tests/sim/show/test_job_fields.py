"""What a shop writes on the job sheet: filled from the scenario where it says so, else left to be written by hand."""

from pathlib import Path

from runs import run_folder

from sim.run.recording import pieces_of_run
from sim.run.report.document import build_report
from sim.setup.part import JobFields
from sim.setup.scenario import load_scenario
from sim.show.report_page.sheet import sheet_of

SCENARIO = """\
program = "a.3b"
[sheet]
part_number = "凸模 A-17"
pulse_on = "32 µs"
"""


def test_fields_are_those_of_the_scenario_and_blank_elsewhere(tmp_path: Path) -> None:
    (tmp_path / "a.3b").write_text("B3000B0B3000GXL1\nB5000B0B20000GYNR1\nB3000B0B3000GXL3\nDD\n", "ascii")
    (tmp_path / "scenario.toml").write_text(SCENARIO, "utf-8")
    assert load_scenario(tmp_path).sheet == JobFields(part_number="凸模 A-17", pulse_on="32 µs")
    run = run_folder(tmp_path)
    by_hand = sheet_of(run, build_report(run), pieces_of_run(run)).by_hand
    assert [(fact.name.zh, fact.value.zh) for fact in by_hand] == [
        *(
            ("图号", "凸模 A-17"),
            ("材料", ""),
            ("件数", ""),
            ("脉宽", "32 µs"),
            ("脉间", ""),
            ("电流", ""),
            ("丝速", ""),
        ),
    ]
