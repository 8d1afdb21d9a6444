"""report.html: it says what report.json says, in both languages, whatever a program or a scenario holds."""

import hashlib
import json
import re
import tomllib
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from long_replays import rippled_spiral
from page_types import types_of, unlike
from places import ROOT, SCENARIOS
from report_pages import PART, SMALL, Made, Outline, hostile, made
from runs import run_folder, run_text, scenario_run

from parser.findings.catalogue import Bilingual
from parser.program import load_program, read_program
from sim.run.report import build_report, report_text
from sim.setup.expectations import EXPECT, read_expectation
from sim.setup.machine.machine import machine_sections
from sim.setup.part import SIDES, Offset, OffsetPass
from sim.setup.quiz import QUIZ
from sim.setup.scenario import MACHINE_FILE, Scenario, load_scenario, scenario_sections
from sim.setup.toml.keys import toml_text, toml_value
from sim.show.report_page.figures import why
from sim.show.report_page.findings import MOST, prose
from sim.show.report_page.page import reproduction, setting_groups
from sim.show.report_page.results import block_table
from sim.show.report_page.tables import micrometres, reached
from sim.show.texts.phrases import lasting


@pytest.fixture(scope="module")
def part() -> Made:
    return made(PART, kerf=True)


def test_figures_at_the_top_are_those_of_the_report(part: Made) -> None:
    figures = [element.attributes for element in Outline(part.html).of("data") if "data-entry" in element.attributes]
    shown = {figure["data-entry"]: float(figure["value"] or "") for figure in figures}
    assert shown == {entry: reached(part.report, entry) for entry in shown}
    assert {"time_s.total", "summary.blocks", "summary.length_um", "summary.steps"} < shown.keys()
    assert {"deviation.wire.max_um", "contours.0.closure_stepped_um"} < shown.keys()


def test_figures_are_shown_in_the_units_that_stand_beside_them(part: Made) -> None:
    figures = re.findall(
        r'data-entry="([\w.]+)" value="([\d.]+)">([\d,.]+)</data>(?: <span class="unit">([^<]+)<)?', part.html
    )
    per = {"mm": 1000.0, "µm": 1.0, "": 1.0}
    assert len(figures) == 5
    for entry, value, shown, unit in figures:
        digits = len(shown.partition(".")[2])
        assert float(shown.replace(",", "")) == round(float(value) / per[unit], digits), entry
        assert digits == {"mm": 3, "µm": 2, "": 0}[unit], entry


BLOCK_COLUMNS = {
    "line": "line",
    "text": "text",
    "kind": "kind",
    "J": "count_um",
    "from X": "exact.start_um.0",
    "from Y": "exact.start_um.1",
    "to X": "exact.end_um.0",
    "to Y": "exact.end_um.1",
    "radius": "exact.radius_um",
    "length": "exact.length_um",
    "steps": "stepped.steps",
    "deviation, steps": "stepped.max_deviation_um",
    "deviation, table": "table.max_deviation_um",
}


def test_the_table_of_blocks_holds_what_the_report_holds(part: Made) -> None:
    blocks = part.report["blocks"]
    for head, entry in BLOCK_COLUMNS.items():
        assert part.column("blocks", head) == [reached(block, entry) for block in blocks], head
    assert part.column("blocks", "block") == [block["label"] or str(block["block"]) for block in blocks]
    assert part.column("blocks", "time") == part.report["time_s"]["by_block"]
    assert part.column("blocks", "G") == [f"G{block['count_axis']}" for block in blocks]
    heads = {*BLOCK_COLUMNS, "block", "G", "time", "findings"}
    assert {column["head"]["en"] for column in part.tables["blocks"]} == heads


@pytest.mark.parametrize(
    ("table", "entries", "columns"),
    [
        ("contours", "contours", {"closure, exact": "closure_exact_um", "time": "time_s", "last block": "last_block"}),
        ("limits", "limits", {"met": "value", "limit": "limit", "share": "share", "block": "block", "after": "t_s"}),
        ("pieces", "remains.pieces", {"area": "area_mm2", "mass": "mass_g", "free in block": "freed.block"}),
        ("boxes", "remains.sizes.boxes", {"X as cut": "cut_um.0", "Y nominal": "nominal_um.1", "piece": "piece"}),
        ("radii", "remains.sizes.radii", {"as cut": "cut_um", "nominal": "nominal_um", "form": "form_um"}),
        ("distances", "remains.sizes.distances", {"as cut": "cut_um", "and block": "blocks.1"}),
    ],
)
def test_tables_hold_what_the_report_holds(part: Made, table: str, entries: str, columns: dict[str, str]) -> None:
    of = reached(part.report, entries)
    assert of
    for head, entry in columns.items():
        assert part.column(table, head) == [reached(one, entry) for one in of], head


def test_deviations_of_every_stage_and_cause_are_shown(part: Made) -> None:
    deviation = part.report["deviation"]
    assert part.column("deviation", "largest") == [deviation[of]["max_um"] for of in part.column("deviation", "of")]
    causes = part.column("causes", "cause")
    assert part.column("causes", "largest") == [deviation["by_cause"][cause]["max_um"] for cause in causes]
    assert causes == list(deviation["by_cause"])


def test_cutting_and_jumps_add_up_to_the_time(part: Made) -> None:
    values = [float(value) for value in re.findall(r'<div><dt>.*?</dt>.*?<data[^>]* value="([\d.]+)"', part.html)[-3:]]
    jump = part.report["time_s"]["by_block"][7]
    assert values == [
        pytest.approx(part.report["time_s"]["total"] - jump),
        pytest.approx(jump),
        part.report["time_s"]["total"],
    ]


def test_the_same_run_gives_the_same_bytes(part: Made) -> None:
    assert made(PART, kerf=True).html == part.html


def test_what_others_wrote_is_text_and_nothing_else() -> None:
    page = Outline(hostile().html)
    scripts = [script for script in page.of("script") if script.attributes.get("type") != "application/json"]
    assert {element.tag for element in page.elements}.isdisjoint({"img", "b", "iframe", "object", "form", "base"})
    assert len(scripts) == 2, "the page, and what tells a browser that it is too old"
    assert not any(name.startswith("on") for element in page.elements for name in element.attributes)


def test_codes_of_blocks_lead_to_their_findings() -> None:
    page = hostile()
    found = page.report["findings"]
    links = {
        (block, code, address)
        for block, codes in enumerate(page.column("blocks", "findings"), 1)
        for code, address in codes
    }
    told = {(one["block"], one["code"], f"finding-{at}") for at, one in enumerate(found, 1) if one["block"]}
    assert links == told
    ids = {element.attributes.get("id") for element in Outline(page.html).elements}
    assert {address for *_, address in links} <= ids
    assert {f"code-{one['code']}" for one in found} <= ids


def test_of_many_findings_the_first_are_shown_and_the_rest_counted() -> None:
    page = made("B500B0B400GXL1\n" * (MOST + 7) + "DD\n", may_stay_open=True)
    assert len(page.run.findings) == MOST + 7, "one a block"
    assert len([one for one in Outline(page.html).of("li") if "id" in one.attributes]) == MOST
    assert f"and {len(page.run.findings) - MOST} more" in page.html


def test_findings_stand_with_their_line_and_carets_as_on_the_command_line() -> None:
    html = made("B0 B500 B500 GYL2\nB500B0B500GXL2\nDD\n", may_stay_open=True).html
    row = re.search(r"   2 │ </span>B500B0B500GXL2</span><span[^>]*>(.*?)</span>", html)
    assert row is not None
    assert row[1] == "     │ " + " " * len("B500B0B500GX") + "^^"


@pytest.mark.parametrize(
    ("text", "en", "zh"),
    [
        (PART, "Nothing was found against this program.", "没有发现问题。"),
        ("B500B0B500GXL2\nDD\n", "No error; 1 warning to look at.", "没有错误；有1 个警告，请查看。"),
        (
            "B500B0B490GXL1\nDD\n",
            "1 error. The first error is 3B208 in block 1: J does not fit the line.",
            "1 个错误。第一个错误是第 1 段的 3B208：J 与直线不符。",
        ),
    ],
)
def test_the_verdict_is_told_in_a_sentence(text: str, en: str, zh: str) -> None:
    assert why(run_text(text, may_stay_open=True))[0] == Bilingual(en, zh)


def test_a_tripped_drive_is_told_with_the_verdict() -> None:
    run = scenario_run("servo-trip")
    time = lasting(run.ended.t_s)
    assert why(run)[1].en.startswith(f"The X drive tripped in block 5 after {time.en}: nothing after it is cut")
    assert time.zh in why(run)[1].zh


def test_the_end_of_the_travel_is_told_with_the_verdict() -> None:
    run = run_text("B100B0B100GXL1 B60B0B60GXL1 DD", start_mm=(399.85, 250.0), may_stay_open=True)
    time = lasting(run.ended.t_s)
    assert why(run)[1].en.startswith(f"The path leaves the travel in X in block 2 after {time.en}.")
    assert time.zh in why(run)[1].zh


def test_durations_are_told_in_both_languages() -> None:
    assert lasting(8820.0) == Bilingual("2 h 27 min", "2 小时 27 分")
    assert lasting(12.4) == Bilingual("12.4 s", "12.4 秒")


def test_expectations_are_shown_with_those_that_are_missed() -> None:
    expect = read_expectation({"verdict": "pass", "summary.blocks": {"min": 20}}, "test")
    page = made(PART, expect=expect)
    assert page.column("expectations", "entry of report.json") == ["verdict", "summary.blocks"]
    assert page.column("expectations", "expected") == ['"pass"', "{ min = 20.0 }"]
    assert page.column("expectations", "met") == ["yes", "no"]


def test_the_page_of_an_offset_names_findings_by_their_blocks_of_the_program() -> None:
    page = made("B500B0B500GXL2\n" + "B0B900B900GYL2\nB900B0B900GXL1\nB0B900B900GYL4\nB900B0B900GXL3\nDD\n",
                offset=Offset((OffsetPass(100.0),), SIDES["left"]), may_stay_open=True)  # fmt: skip
    sources = page.run.toolpath.source.block.tolist()
    assert len(sources) > 5, "the controller adds blocks"
    labelled = [source for source, codes in zip(sources, page.column("blocks", "findings"), strict=True) if codes]
    assert set(labelled) == {one["block"] for one in page.report["findings"] if one["block"]} & set(sources)
    assert labelled


def same_but_files(scenario: Scenario) -> Scenario:
    """A scenario whose files stand without their folders."""
    drawing, to_make = scenario.drawing, scenario.to_make
    upper = drawing and drawing.upper and Path(drawing.upper.name)
    drawing = drawing and drawing._replace(file=Path(drawing.file.name), upper=upper)
    to_make = to_make and to_make._replace(making=to_make.making._replace(upper=upper))
    quiz = tuple(question._replace(where="") for question in scenario.quiz)
    return replace(scenario, program=Path(scenario.program.name), drawing=drawing, quiz=quiz, to_make=to_make)


@pytest.mark.parametrize("name", sorted(path.name for path in SCENARIOS.iterdir() if path.is_dir()))
def test_the_files_in_the_page_make_the_scenario_that_ran(name: str, tmp_path: Path) -> None:
    scenario = load_scenario(SCENARIOS / name)
    assert same_but_files(written(scenario, tmp_path)) == same_but_files(scenario)


FULL_MACHINE = """
name = "every \\"setting\\""
assumed = ["saddle_mass_kg", "force_at_rate"]
[table]
travel_x_mm = 400.3
travel_y_mm = 500.7
saddle_mass_kg = 180.1
carriage_mass_kg = 140.2
drive_stiffness_n_um = 50.3
drive_damping_ratio = 0.7
drive_force_limit_n = 16000.1
friction_x_n = 30.1
friction_y_n = 20.3
viscous_x_n_s_mm = 5.1
viscous_y_n_s_mm = 4.7
backlash_x_um = 2.3
backlash_y_um = 1.1
[motor]
kind = "servo"
step_time_ms = 1.7
following_error_limit_um = 33.3
force_at_rate = [[500.1, 13000.0], [4000.0, 2500.7]]
[controller]
path_acceleration_mm_s2 = 100.1
cut_step_limit_hz = 180.3
jump_feed_mm_s = 0.7
axis_feed_x_mm_s = 10.1
axis_feed_y_mm_s = 11.3
axis_acceleration_x_mm_s2 = 90.7
axis_acceleration_y_mm_s2 = 80.9
start_feed_mm_s = 0.03
corner_angle_deg = 7.7
corner_wait_ms = 150
jerk_mm_s3 = 1234.7
servo_period_us = 250.3
interpolator = "card"
registers_mm = { D0 = 0.1, H12 = -0.02 }
{junction}
[cutting]
area_rate_mm2_min = 105.3
[arm]
outline_mm = [[-1.1, -1.3], [1.7, -1.3], [0.1, 2.9]]
"""
FULL_SCENARIO = """
title = "\\"<b>\\" \\\\ 零件"
provenance = "a\\nb"
start_mm = [12.3, 45.7]
open = true
dialect = "robofil"
unit = "inch"
registers_mm = { D1 = 0.11 }
trace_spacing_um = 3.3
machine = "own.toml"
kerf = true
[wire]
diameter_mm = 0.123
spark_gap_mm = -0.007
tension_n = 30.1
pressure_n_mm = 0.03
guide_span_mm = 77.7
[work]
thickness_mm = 33.3
density_g_cm3 = 8.93
outline_mm = [[-1.1, -1.3], [1.7, -1.3], [0.1, 2.9]]
[offset]
side = "right"
[[pass]]
by_mm = 0.161
feed_mm_min = 3.1
[[pass]]
by_mm = 0.117
direction = "back"
area_rate_mm2_min = 61.7
[drawing]
file = "part.dxf"
layer = "<i>"
tolerance_um = 7.7
gap_um = 3.3
fit = false
[[clamps]]
outline_mm = [[-4.1, 2.5], [2.0, 2.5], [2.0, 6.0]]
[[clamps]]
name = "vice \\"2\\""
outline_mm = [[-4.1, 2.5], [2.0, 2.5], [2.0, 6.0]]
[[quiz]]
block = 2
about = "turn"
[[quiz]]
block = 3
ask = "which?"
ask_zh = "哪个？"
answers = ["<a>", "b"]
right = 2
why = "so"
[expect]
"summary.steps" = {min = 3, max = 7.5}
"findings.code" = []
verdict = "pass"
"""
JUNCTIONS = (
    'junction = "stop"',
    'junction = "slow"\ncorner_feed_mm_s = 0.3',
    'junction = "deviation"\njunction_deviation_um = 1.7',
    "",
)


def written(scenario: Scenario, folder: Path) -> Scenario:
    """The scenario of a folder with the files that the page shows."""
    (folder / "scenario.toml").write_text(toml_text(scenario_sections(scenario)), "utf-8")
    (folder / MACHINE_FILE).write_text(toml_text(machine_sections(scenario.machine)), "utf-8")
    if scenario.taper is not None and scenario.taper.upper is not None:
        (folder / scenario.taper.upper.name).write_bytes(scenario.taper.upper.data)
    return load_scenario(folder)


@pytest.fixture(params=JUNCTIONS)
def full(request: pytest.FixtureRequest, tmp_path: Path) -> Scenario:
    """A scenario with every setting there is."""
    (tmp_path / "own.toml").write_text(FULL_MACHINE.replace("{junction}", request.param), "utf-8")
    (tmp_path / "scenario.toml").write_text(FULL_SCENARIO, "utf-8")
    return load_scenario(tmp_path)


def test_the_files_in_the_page_tell_every_setting(full: Scenario, tmp_path: Path) -> None:
    assert same_but_files(written(full, tmp_path)) == same_but_files(full)


def test_every_setting_has_a_name_and_its_unit(full: Scenario) -> None:
    program = load_program(PART.encode(), "part.3b")
    shown = {setting.key: setting for group in setting_groups(full, program) for setting in group.settings}
    assert (shown["jerk_mm_s3"].value.en, shown["jerk_mm_s3"].unit) == ("1234.7", "mm/s³")
    assert (shown["drive_stiffness_n_um"].unit, shown["viscous_x_n_s_mm"].unit) == ("N/µm", "N s/mm")
    assert (shown["pressure_n_mm"].unit, shown["tension_n"].unit, shown["density_g_cm3"].unit) == ("N/mm", "N", "g/cm³")
    assert shown["force_at_rate"].value.en == "500.1, 13000; 4000, 2500.7"
    assert shown["kind"].value == Bilingual("servo", "伺服电机")
    sections = [*scenario_sections(full), *machine_sections(full.machine)]
    keys = {key for section, values in sections if section not in (EXPECT, QUIZ) for key in values}
    assert keys - {"machine"} == shown.keys() - {"encoding"}
    assert (shown["unit"].value, shown["registers_mm"].value.en) == (
        Bilingual("inches", "英寸"),
        "D0 = 0.1, H12 = -0.02",
    )


def test_the_title_and_assumed_values_are_in_the_language_of_the_page() -> None:
    scenario = load_scenario(SCENARIOS / "keyhole")
    program = load_program(PART.encode(), "part.3b")
    shown = {setting.key: setting.value for group in setting_groups(scenario, program) for setting in group.settings}
    assert shown["title"] == Bilingual(scenario.title, "钥匙孔：R 24.9 半圆和 R 49.9 优弧")
    assert shown["assumed"].en.startswith("mass of the saddle, mass of the carriage, ")
    assert "_" not in shown["assumed"].zh
    assert not {"title_zh", "name_zh"} & shown.keys()


def test_a_folder_made_from_the_page_writes_the_same_report(tmp_path: Path) -> None:
    run = run_text(SMALL, title="part", kerf=True, thickness_mm=12.5)
    again = reproduction(run)
    for name, content in again.files:
        (tmp_path / name).write_text(content, "utf-8")
    (tmp_path / "test.3b").write_text(SMALL, "utf-8")
    repeated = build_report(run_folder(tmp_path))
    repeated["program"]["name"] = run.program.name
    assert report_text(repeated) == report_text(build_report(run))


def test_the_check_sum_is_that_of_the_bytes_of_the_file(tmp_path: Path) -> None:
    data = "B500B0B500GXL1 // 零件\r\nDD\r\n".encode("gb18030")
    (tmp_path / "part.3b").write_bytes(data)
    program = read_program(tmp_path / "part.3b")
    run = replace(run_text(PART), program=program)
    assert reproduction(run).sha256 == hashlib.sha256(data).hexdigest()


_values = st.recursive(
    st.text() | st.booleans() | st.integers(-(2**62), 2**62) | st.floats(allow_nan=False),
    lambda inner: st.lists(inner) | st.dictionaries(st.text(), inner),
    max_leaves=8,
)


@given(_values)
def test_toml_reads_back_what_is_written(value: Any) -> None:
    assert tomllib.loads(f"value = {toml_value(value)}") == {"value": value}


def test_prose_of_the_catalogue_becomes_paragraphs() -> None:
    told = prose("One `<a>` **b\nc**\n\ntwo\n```toml\nx = 1\n```\n圆弧\n终点 `G`\n")
    assert told == (
        "<p>One <code>&lt;a&gt;</code> <strong>b\nc</strong></p><p>two</p>"
        "<pre>x = 1\n</pre><p>圆弧终点 <code>G</code></p>"
    )


def test_the_page_names_every_key_of_its_tables(part: Made) -> None:
    assets = ROOT / "sim" / "show" / "report_page" / "assets"
    types = types_of(assets / "data.js", assets.parents[1] / "html" / "assets" / "language.js")
    tables = [{"name": name, "columns": columns} for name, columns in part.tables.items()]
    assert [complaint for table in tables for complaint in unlike(types, "TableData", table)] == []
    assert list(unlike(types, "TableData", {"name": "t", "columns": [{"head": {"en": "h"}}]})) != []


def test_each_table_has_its_place_where_nothing_falls_out_of_an_opening() -> None:
    """The slug of a hole this small is a crumb: sizes, and no pieces. The page stopped short of its tables."""
    page = made("B110B0B110GXL1\nB110B0B440GYNR1\nB110B0B110GXL3\nDD\n", kerf=True)
    assert (len(page.report["remains"]["pieces"]), "boxes" in page.tables) == (0, True)
    assert [name for name in page.tables if f'data-table="{name}"' not in page.html] == []


@pytest.mark.deeper
def test_a_page_of_many_blocks_stays_small() -> None:
    """25 bytes a block in its tables make 2.5 MB of 100,000 blocks; pictures are no larger for more blocks."""
    blocks = 8_000
    page = made(rippled_spiral(blocks), may_stay_open=True).html
    (tables,) = re.findall(r'id="tables">(.*?)</script>', page, re.DOTALL)
    assert len(json.loads(tables)) >= 5
    assert len(tables.encode()) < 25 * blocks + 10_000
    pictures = re.findall(r'<figure class="picture".*?</figure>', page, re.DOTALL)
    assert len(pictures) >= 5
    assert max(map(len, pictures)) < 600_000


def test_blocks_without_words_have_no_columns_for_them(part: Made) -> None:
    text = "G92 X0 Y0\nG90\nG01 X5000 Y0\nG03 X5000 Y0 I-5000 J0\nG01 X0 Y0\nM02\n"
    run = run_text(text)
    heads = [column.head.en for column in block_table(run, build_report(run)).columns]
    worded = [column.head.en for column in block_table(part.run, part.report).columns]
    assert [head for head in worded if head not in heads] == ["J", "G"]
    assert [head for head in heads if head not in worded] == []


@pytest.mark.parametrize(("worst_um", "unit", "per"), [(999.99, "µm", 1.0), (-1000.0, "mm", 1000.0), (None, "µm", 1.0)])
def test_a_column_of_small_lengths_turns_to_mm_where_one_is_large(
    worst_um: float | None, unit: str, per: float
) -> None:
    column = micrometres("largest", [0.5, worst_um])
    assert (column.unit, column.per, column.digits) == (unit, per, 2 if unit == "µm" else 3)
    assert column.values == [0.5, worst_um], "as the report has them"
