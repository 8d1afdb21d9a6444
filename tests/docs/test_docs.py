"""The documents against the code: what they name exists, and what exists is named."""

import copy
import json
import os
import re
import subprocess
import sys
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

import click
import numpy as np
import pytest
from command import run_inside, without_progress
from places import MACHINES, ROOT
from report_schema import complaints, validator
from runs import scenario_run

from controller.stepping.chunks import chunk_of
from controller.stepping.steps import interpolate
from parser.findings.catalogue import Language
from parser.findings.catalogue import page as catalogue_page
from parser.findings.codes import CODES, Check
from parser.program import read_program
from parser.text.encoding import encode_text
from sim.check.path_checks import PARSER_CHECKS, PATH_CHECKS
from sim.check.settings import read as check_settings
from sim.check.settings.search import SettingsSearch
from sim.cli.check.command import check
from sim.cut.kerf.stars import rays as kerf_rays
from sim.jobs.trace_file import trace_arrays
from sim.run.dryrun import DryRun
from sim.run.report import build_report
from sim.run.running import dry_run
from sim.setup import scenario
from sim.setup.key_tables import DOCUMENTS, renewed
from sim.setup.machine import machine
from sim.setup.scenario import load_scenario
from sim.setup.toml.kinds import Number
from sim.show.findings.catalogue_document import NAMES, anchor, count_of_codes, documents, findings_document
from sim.show.terminal.run import summary_rows

DOCS = ROOT / "docs"
PAGES = sorted([*ROOT.glob("*.md"), *DOCS.glob("*.md")])
TOURS: list[tuple[str, Language]] = [("start.md", "en"), ("start.zh.md", "zh")]
SCENARIOS = sorted(path.parent for path in (ROOT / "scenarios").glob("*/scenario.toml"))

OPEN_PART = """
B5000 B0 B5000 GX L1
B0 B5000 B4000 GY L2;5.000,5.000
B0 B0 B5000 GX NR1
B0 B5000 B0 GY L4
"""

PART = "B9900B0B9900GXL1\nB9900B0B39600GXNR1\nB9900B0B9900GXL3\nDD\n"
ISO_PART = """\
G92 X0 Y0
G91
G01 X20000 Y0
G01 X0 Y10000
G03 X-10000 Y10000 I-10000 J0
G01 X-10000 Y0
G01 X0 Y-20000
M02
"""
HEADED_4B = """
CAXAWEDM -Version 2.0 , Name : ring.4B
Conner R= 1.001 , Offset F= -0.10000 ,Length= 82.004 mm
B9900B0B9900B0GXL1
B9900B0B19800B9900GYDNR1
B9900B0B19800B9900GYDDNR3
B9900B0B9900B0GXL3
DD
"""


def read(path: Path) -> str:
    return path.read_text(encoding="utf-8")


@cache
def run_of(folder: Path) -> DryRun:
    if folder in SCENARIOS:
        return scenario_run(folder.name)
    case = load_scenario(folder)
    return dry_run(read_program(case.program), case, lambda stage, done, total: None)


@cache
def report_text(folder: Path) -> str:
    return json.dumps(build_report(run_of(folder)), allow_nan=False)


def report_of(folder: Path) -> Any:
    return json.loads(report_text(folder))


def test_report_of_a_bad_program_fits_the_schema(tmp_path: Path) -> None:
    (tmp_path / "bad.3b").write_text(OPEN_PART)
    report = report_of(tmp_path / "bad.3b")
    assert report["verdict"] == "fail"
    assert {entry["severity"] for entry in report["findings"]} == {"error", "warning", "note"}
    assert complaints(report) == []


def test_report_of_no_motion_fits_the_schema(tmp_path: Path) -> None:
    (tmp_path / "still.3b").write_text("B0 B5000 B0 GY L2 DD")
    report = report_of(tmp_path / "still.3b")
    assert report["deviation"]["steps"]["where"] is None
    assert complaints(report) == []


def test_report_of_4b_with_a_header_fits_the_schema(tmp_path: Path) -> None:
    (tmp_path / "four.4b").write_text(HEADED_4B)
    report = report_of(tmp_path / "four.4b")
    assert report["program"]["dialect"] == "4B"
    assert report["program"]["header"] == {
        "version": "2.0",
        "name": "ring.4B",
        "corner_radius_um": 1001.0,
        "offset_um": -100.0,
        "lengths_um": [82_004.0],
    }
    written = [(block["radius_um"], block["curve"]) for block in report["blocks"]]
    assert written == [(0, None), (9900, "convex"), (9900, "concave"), (0, None)]
    assert complaints(report) == []


def test_report_of_a_damaged_program_tells_its_coverage(tmp_path: Path) -> None:
    (tmp_path / "damaged.3b").write_text("B9900B0B9900GXL1\nB9900BOB39600GYNR1\nB9900B0B9900GXL3\nDD\n")
    report = report_of(tmp_path / "damaged.3b")
    assert report["coverage"]["blocks"] == {"found": 3, "read": 2, "decoded": 2, "stepped": 2}
    states = {entry["check"]: entry["state"] for entry in report["coverage"]["checks"]}
    assert {name: states[name] for name in ("grammar", "contours", "header")} == {
        "grammar": "complete",
        "contours": "incomplete",
        "header": "not asked",
    }
    assert complaints(report) == []


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16-le", "utf-16-be", "gb18030", "big5", "latin-1"])
def test_every_encoding_is_in_both_schemas(tmp_path: Path, encoding: str) -> None:
    remark = {"gb18030": "结束停机", "big5": "結束停機", "latin-1": "fin\u00e9 \u00ff"}.get(encoding, "结束")
    (tmp_path / "part.3b").write_bytes(encode_text(f"B0B5000B5000GYL2 DD // {remark}\n", encoding))
    report = report_of(tmp_path / "part.3b")
    assert report["program"]["encoding"] == encoding
    assert complaints(report) == []
    for name in ("report", "check"):
        assert f"`{encoding}`" in read(DOCS / f"{name}.md")
        assert f'"{encoding}"' in read(DOCS / f"{name}.schema.json")


def objects(node: object, path: tuple[str | int, ...] = ()) -> list[tuple[str | int, ...]]:
    """Paths of all objects inside a report."""
    inner: list[tuple[str | int, Any]] = []
    if isinstance(node, dict):
        inner = list(node.items())
    elif isinstance(node, list):
        inner = list(enumerate(node))
    here = [path] if isinstance(node, dict) else []
    return here + [found for key, value in inner for found in objects(value, (*path, key))]


def report_node(report: Any, path: tuple[str | int, ...]) -> dict[str, Any]:
    for key in path:
        report = report[key]
    assert isinstance(report, dict)
    return report


def changed(report: object, path: tuple[str | int, ...], change: Callable[[dict[str, Any]], None]) -> object:
    report = copy.deepcopy(report)
    change(report_node(report, path))
    return report


def is_refused(report: object) -> bool:
    return not validator().is_valid(report)


def shortened(node: Any) -> Any:
    """A report with no more than three entries in any list, which a schema looks at as at all others."""
    if isinstance(node, dict):
        return {key: shortened(value) for key, value in node.items()}
    return [shortened(value) for value in node[:3]] if isinstance(node, list) else node


@pytest.mark.deeper
def test_schema_refuses_a_key_more_or_less_anywhere() -> None:
    report = shortened(report_of(ROOT / "scenarios" / "round-hole"))
    assert complaints(report) == []
    paths = objects(report)
    assert len(paths) > 20
    for path in paths:
        assert is_refused(changed(report, path, lambda node: node.update(surplus=1))), path
        for key in report_node(report, path):
            assert is_refused(changed(report, path, lambda node, key=key: node.pop(key))), (*path, key)


@pytest.mark.deeper
def test_schema_refuses_wrong_types_anywhere() -> None:
    report = shortened(report_of(ROOT / "scenarios" / "round-hole"))
    for path in objects(report):
        for key, value in report_node(report, path).items():
            wrong = "text" if isinstance(value, int | float) else False if value is None else -1.5
            assert is_refused(changed(report, path, lambda node, key=key, wrong=wrong: node.update({key: wrong}))), (
                *path,
                key,
            )


@pytest.mark.parametrize(
    "change",
    [
        pytest.param(lambda report: report.update(verdict="fail"), id="fail without an error"),
        pytest.param(lambda report: report["blocks"][1]["exact"].update(radius_um=None), id="arc without radius"),
        pytest.param(lambda report: report["blocks"][0]["exact"].update(radius_um=1.0), id="line with radius"),
        pytest.param(lambda report: report["blocks"][0].update(kind="arc"), id="line called arc"),
        pytest.param(lambda report: report["findings"][0].update(severity="error"), id="pass with an error"),
        pytest.param(lambda report: report["blocks"][0]["stepped"]["end_um"].append(0), id="three coordinates"),
        pytest.param(lambda report: report["time_s"].update(total=-1.0), id="negative time"),
    ],
)
def test_schema_refuses_contradictions(change: Callable[[dict[str, Any]], None]) -> None:
    report = report_of(ROOT / "scenarios" / "round-hole")
    change(report)
    assert complaints(report)


def test_schema_is_strict_everywhere() -> None:
    schema = json.loads(read(DOCS / "report.schema.json"))
    for path in objects(schema):
        node = report_node(schema, path)
        if "properties" in node and "type" in node:
            assert node["additionalProperties"] is False, path
            assert node["required"] == list(node["properties"]), path


def test_report_keys_are_documented() -> None:
    page = read(DOCS / "report.md")
    named = set(re.findall(r"\w+", " ".join(re.findall(r"`([^`]+)`", page))))
    report = report_of(ROOT / "scenarios" / "die")
    report.pop("drawing")  # docs/compare.md
    keys = {str(key) for path in objects(report) for key in report_node(report, path)}
    assert (keys | {"drawing"}) - named == set()


def test_trace_arrays_are_documented() -> None:
    arrays = trace_arrays(scenario_run("round-hole"))
    table = read(DOCS / "report.md").partition("## trace.npz")[2]
    rows = [row for row in table.splitlines() if row.startswith("| `")]
    dtypes = {name: row.split("|")[2].strip() for row in rows for name in re.findall(r"`(\w+)`", row.split("|")[1])}
    assert {name: str(array.dtype) for name, array in arrays.items()}.items() <= dtypes.items()
    assert {name for name in dtypes if name not in arrays} == {"step_x_um", "step_y_um", "step_block", "step_t_s"}


KEYS = {
    f"{section.header} {key.name}".strip(): key
    for section in (*scenario.SECTIONS, *machine.SECTIONS)
    for key in section.keys
}
"""Every key of scenario and machine files, as the documents write it."""


def test_tables_of_keys_are_those_of_the_keys() -> None:
    for language, path in DOCUMENTS:
        page = read(ROOT / path)
        assert renewed(page, language) == page, "renew them: make pages"
        assert renewed(page.replace("| `[wire] lag_um` |", "| `[wire] lagg_um` |"), language) == page


@pytest.mark.parametrize("name", [name for name, key in KEYS.items() if isinstance(key.kind, Number)])
def test_settings_are_documented_with_their_bounds(name: str) -> None:
    ((_, _, bounds, *_),) = rows_of_key(f"`{name}`")
    numbers = [float(text) for text in re.findall(r"-?\d+(?:\.\d+)?", bounds.replace("−", "-").replace(",", ""))]
    bound = KEYS[name].kind.bound
    assert bound
    assert tuple(numbers) == (tuple(bound) if "number of answers" not in bounds else (1.0,))


@pytest.mark.parametrize("name", [*KEYS, "[[clamps]]", "[[quiz]]", "[expect]"])
def test_scenario_and_machine_files_have_no_key_that_is_not_documented(name: str) -> None:
    assert len(rows_of_key(f"`{name}` |")) == 1


def test_shipped_machines_are_documented_with_their_figures() -> None:
    rows = {cells[0]: cells[1:] for cells in rows_of(DOCS / "scenarios.md", "`") if cells[1].endswith(" mm")}
    files = sorted(path.stem for path in MACHINES.glob("*.toml"))
    assert list(rows) == files
    for name, (travel, drives, jumps) in rows.items():
        table, controller = (of := machine.load_machine(name)).table, of.controller
        assert travel == f"{table.travel_x_mm:g} × {table.travel_y_mm:g} mm"
        assert drives.startswith(f"{table.motor.kind}s")
        assert drives.endswith(f"backlash {table.backlash_um[0]:g} µm")
        assert table.backlash_um[0] == table.backlash_um[1]
        assert ("motion card" in drives) == (controller.interpolation == "card")
        assert jumps == f"{controller.jump_feed_mm_s:g} mm/s"


def test_findings_are_documented_with_severity_and_title() -> None:
    rows = [
        row.split("|")
        for row in read(DOCS / "findings.md").splitlines()
        if row.startswith(("| [3B", "| [GEC", "| [ISO", "| [PMC"))
    ]
    written = {code[2:].partition("]")[0]: (severity.strip(), title.strip()) for _, code, severity, title, *_ in rows}
    assert written == {code: (str(of.severity), catalogue_page(code).title) for code, of in CODES.items()}


def rows_of_key(beginning: str) -> list[list[str]]:
    """Rows of a key in the documents of scenario files: those of sparks and taper have ones of their own."""
    return [row for page in ("scenarios.md", "sparks.md", "taper.md") for row in rows_of(DOCS / page, beginning)]


def rows_of(page: Path, beginning: str) -> list[list[str]]:
    """Cells of the table rows of a page whose first cell begins so."""
    rows = [row for row in read(page).splitlines() if row.startswith(f"| {beginning}")]
    return [[cell.strip().strip("`") for cell in re.split(r"(?<!\\)\|", row)[1:-1]] for row in rows]


def test_options_of_the_check_are_documented() -> None:
    written = {cells[0].split()[0] for cells in rows_of(DOCS / "check.md", "`--")}
    assert written == {
        option.opts[0] for option in check.get_params(click.Context(check))[:-1] if isinstance(option, click.Option)
    }


def test_settings_of_the_check_are_documented_with_their_bounds() -> None:
    page = read(DOCS / "check.md").partition("## Settings\n")[2].partition("### Patterns\n")[0]
    written = re.findall(r"^\| `([^`]+)` \|", page, flags=re.MULTILINE)
    *plain, wire, by_file = check_settings.KEYS
    assert written == [*plain, *(f"[{wire}] {key}" for key in check_settings._WIRE), f"[{by_file}]"]
    for name, key in check_settings._WIRE.items():
        ((_, _, bounds, *_),) = rows_of(DOCS / "check.md", f"`[wire] {name}`")
        assert tuple(float(text) for text in bounds.replace("−", "-").split(" to ")) == tuple(key.kind.bound)


def test_settings_shown_are_settings(tmp_path: Path) -> None:
    (shown,) = re.findall(r"```toml\n(.*?)```", read(DOCS / "check.md"), flags=re.DOTALL)
    (tmp_path / "drycut.toml").write_text(shown)
    found = SettingsSearch().near(tmp_path)
    near = found.settings_of(tmp_path / "jigs" / "a.3b")
    assert near.ignore_here == ("3B301",)
    assert near.machine is not None
    assert (near.start_mm, near.fail_on, near.ignore, near.marks.end) == ((120.0, 200.0), "warning", ("3B102",), ("E",))
    assert near.wire_diameter_um == 180.0


def test_checks_are_documented_with_their_findings() -> None:
    rows = rows_of(DOCS / "check.md", "`check-")
    assert {cells[0] for cells in rows} == {*PARSER_CHECKS, *PATH_CHECKS, Check.COMPENSATION, Check.TAPER} == set(Check)
    of_checks = {code: of.check for code, of in CODES.items() if of.check}
    assert {code: cells[0] for cells in rows for code in cells[2].split(", ")} == of_checks


SHOWN_PROGRAMS = {"part.3b": PART, "part.iso": ISO_PART}
SHOWN_DRAWINGS = {"plate.dxf": read(ROOT / "scenarios" / "plate" / "drawing.dxf")}
SHOWN = [
    (page, command, output)
    for page in PAGES
    for command, output in re.findall(r"^```\n\$ drycut (.*?)\n(.*?)^```$", read(page), flags=re.MULTILINE | re.DOTALL)
]


@pytest.mark.parametrize(("page", "command", "output"), SHOWN, ids=[f"{page.name} {what}" for page, what, _ in SHOWN])
def test_shown_output_is_what_is_printed(tmp_path: Path, page: Path, command: str, output: str) -> None:
    name = command.split()[1]
    assert name in SHOWN_DRAWINGS or f"```\n{SHOWN_PROGRAMS[name]}```" in read(page)
    (tmp_path / name).write_text({**SHOWN_PROGRAMS, **SHOWN_DRAWINGS}[name])
    done = run_inside(*command.split(), cwd=tmp_path, COLUMNS="80")
    printed = (without_progress(done.stderr) + done.stdout).decode("utf-8")
    # A line that ends in … was cut off for the page.
    pairs = zip(output.splitlines(), printed.splitlines(), strict=True)
    for shown, real in pairs:
        assert real == shown or (shown.endswith("…") and real.startswith(shown.removesuffix("…")))


def test_outputs_and_the_number_of_codes_are_shown() -> None:
    for page, language in TOURS:
        assert count_of_codes(language) in " ".join(read(DOCS / page).split())
    assert {"check part.3b", "check part.3b --fix"} <= {command for _, command, _ in SHOWN}


def test_python_shown_runs(tmp_path: Path) -> None:
    (code,) = re.findall(r"```python\n(.*?)```", read(DOCS / "check.md"), flags=re.DOTALL)
    (tmp_path / "part.3b").write_text(PART)
    done = subprocess.run(
        [sys.executable, "-c", code],
        cwd=tmp_path,
        env={**os.environ, "PYTHONPATH": str(ROOT), "PYTHONUTF8": "1"},
        capture_output=True,
        encoding="utf-8",
        check=True,
    )
    assert done.stdout.startswith("2 14 3B204 the block counts on X")
    assert "direction NR1 2 16" in done.stdout


@pytest.mark.parametrize("language", NAMES)
def test_findings_documents_are_those_of_the_pages(language: Language) -> None:
    assert read(DOCS / NAMES[language]) == findings_document(language), "renew them: make pages"


def test_pages_that_tell_of_codes_are_renewed() -> None:
    renewed = documents(ROOT)
    assert {path.name for path in renewed} == {*NAMES.values(), *dict(TOURS), "check.md"}
    for path, text in renewed.items():
        assert read(path) == text, "renew it: make pages"


def anchors(page: Path) -> list[str]:
    """Anchors of a page's headings; what stands in a fence is none."""
    text = re.sub(r"^```.*?^```$", "", read(page), flags=re.MULTILINE | re.DOTALL)
    return [anchor(heading) for heading in re.findall(r"^#+ (.+)$", text, flags=re.MULTILINE)]


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_links_lead_somewhere(page: Path) -> None:
    for target in re.findall(r"\]\(([^)\s]+)\)", read(page)):
        if not target.startswith("https://"):
            name, _, place = target.partition("#")
            led_to = page.parent / name if name else page
            assert led_to.exists(), target
            assert not place or anchors(led_to).count(place) == 1, target


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_lines_are_wrapped(page: Path) -> None:
    long = [line for line in read(page).splitlines() if len(line) > 120 and not line.startswith("|")]
    assert long == []


def test_quoted_commands_are_make_targets() -> None:
    targets = set(re.findall(r"^([a-z]+):", read(ROOT / "Makefile"), flags=re.MULTILINE))
    for page in PAGES:
        quoted = re.findall(r"(?:`|^)make (?:[A-Z]+=\S+ )?([a-z]+)", read(page), flags=re.MULTILINE)
        assert set(quoted) <= targets, page.name
    assert {"demo", "test"} == set(re.findall(r"make ([a-z]+)", read(ROOT / "README.md")))
    assert "bench" in re.findall(r"make ([a-z]+)", read(DOCS / "speed.md"))


def test_code_flow_names_what_exists() -> None:
    page = read(DOCS / "code-flow.md")
    for path, name in re.findall(r"`((?:parser|controller|sim)/[\w/]+\.py)`\s+`([A-Za-z_.]+)`", page):
        source = read(ROOT / path)
        for one in name.split("."):
            assert re.search(rf"^\s*(?:class|def) {one}\b", source, flags=re.MULTILINE), f"{path} {name}"
    for path in re.findall(r"(?:parser|controller|sim)/[\w/]+\.py", page):
        assert (ROOT / path).exists(), path


def test_code_flow_quotes_the_numbers_of_the_code() -> None:
    page = read(DOCS / "code-flow.md")
    toolpath = read_program(ROOT / "scenarios" / "keyhole" / "program.3b").toolpath
    block, steps = toolpath.block(3), interpolate(toolpath)
    low, high = int(steps.before[3]), int(steps.before[4])
    first = chunk_of(steps, low, low + 6)
    x, y = first.x_um - np.int32(block.center_um.x), first.y_um - np.int32(block.center_um.y)
    deviation = x.astype(np.int64) ** 2 + y.astype(np.int64) ** 2 - 43243**2 - 24900**2
    shown = [
        f"({block.end_um.x:.6f}, {block.end_um.y:.6f})",
        f"{block.radius_um:.6f} µm",
        f"+{np.degrees(block.sweep_rad):.6f}°",
        f"{block.length_um:.6f} µm",
        f"{high - low:,}",
        f"steps {low + 1:,} to {high:,}",
        f"({steps.corner_um[4][0]}, {steps.corner_um[4][1]})",
        *(f"| {a} | {b} | {f} |" for a, b, f in zip(x.tolist(), y.tolist(), deviation.tolist(), strict=True)),
    ]
    flat = " ".join(page.replace("−", "-").split())
    assert [text for text in shown if text.replace("−", "-") not in flat] == []


def test_code_flow_quotes_what_is_left() -> None:
    run = run_of(ROOT / "scenarios" / "keyhole")
    assert run.remains is not None
    assert run.comparison is not None
    (piece,), (_, radius) = run.remains.pieces.freed, run.remains.sizes.radii
    shown = [
        f"{piece.area_mm2:,.2f} mm²",
        f"{piece.mass_g / 1000.0:.2f} kg",
        f"{piece.freed.t_s:,.2f} s after the start, in block {piece.freed.block}",
        f"({piece.freed.wire_um.x:.1f}, {piece.freed.wire_um.y:.1f})",
        f"{radius.cut_um:,.2f} µm, where its path means {radius.nominal_um:,.2f} µm",
        f"by {np.hypot(*run.comparison.placement.shift_um):.2f} µm",
        f"{abs(np.degrees(run.comparison.placement.turn_rad)):.4f}°",
        f"at most {run.comparison.max_um:.2f} µm, in block 2",
        f"{len(kerf_rays(run.remains.kerf.offset_um))} rays",
    ]
    flat = " ".join(read(DOCS / "code-flow.md").split())
    assert [text for text in shown if text not in flat] == []


def test_code_flow_quotes_the_samples_of_the_table() -> None:
    rows = re.findall(r"^\| (\d\d,\d{3}) \|.*\|$", read(DOCS / "code-flow.md"), flags=re.MULTILINE)
    assert len(rows) >= 5
    trace = run_of(ROOT / "scenarios" / "keyhole").trace
    page = read(DOCS / "code-flow.md").replace("−", "-")
    assert f"{int((trace.row == 3).sum()):,} samples" in page
    for row in rows:
        sample = int(row.replace(",", ""))
        (asked_x, asked_y), (x, y) = trace.commanded_um[sample], trace.table_um[sample]
        shown = f"| {asked_x:.0f}, {asked_y:.0f} | {x:.2f}, {y:.2f} | {asked_x - x:.2f}, {asked_y - y:.2f} |"
        assert f"| {row} | {trace.t_s[sample]:.6f} {shown}" in page


@pytest.mark.parametrize(("page", "language"), TOURS)
def test_the_tour_shows_what_the_demo_prints(page: str, language: Language) -> None:
    run = scenario_run("keyhole")
    block = re.search(r"^```\n(.+)\n┌.*\n((?:│.*\n)+)└", read(DOCS / page), flags=re.MULTILINE)
    assert block
    title, rows = block.groups()
    assert title == run.scenario.title
    cells = [cell for row in rows.splitlines() for cell in row.split("│")[1:-1]]
    assert "".join("".join(cells).split()) == "".join("".join(map("".join, summary_rows(run, language))).split())
