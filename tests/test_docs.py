"""The documents against the code: what they name exists, and what exists is named."""

import copy
import json
import re
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from jsonschema import Draft202012Validator

from controller.point_by_point import interpolate
from parser.findings import CATALOGUE
from parser.program import read_program
from sim import machine, scenario
from sim.dryrun import dry_run
from sim.outcome import trace_arrays
from sim.report import build_report
from sim.scenario import load_scenario

ROOT = Path(__file__).parent.parent
DOCS = ROOT / "docs"
PAGES = sorted([*ROOT.glob("*.md"), *DOCS.glob("*.md")])
SCENARIOS = sorted(path.parent for path in (ROOT / "scenarios").glob("*/scenario.toml"))

OPEN_PART = """
B5000 B0 B5000 GX L1
B0 B5000 B4000 GY L2;5.000,5.000
B0 B0 B5000 GX NR1
B0 B5000 B0 GY L4
"""


def read(path: Path) -> str:
    return path.read_text(encoding="utf-8")


@cache
def validator() -> Draft202012Validator:
    schema = json.loads(read(DOCS / "report.schema.json"))
    Draft202012Validator.check_schema(schema)
    return Draft202012Validator(schema)


def complaints(report: object) -> list[str]:
    return [f"{error.json_path}: {error.message}" for error in validator().iter_errors(report)]


@cache
def report_text(folder: Path) -> str:
    case = load_scenario(folder)
    run = dry_run(read_program(case.program), case, lambda stage, done, total: None)
    return json.dumps(build_report(run), allow_nan=False)


def report_of(folder: Path) -> Any:
    return json.loads(report_text(folder))


@pytest.mark.parametrize("folder", SCENARIOS, ids=lambda folder: folder.name)
def test_report_fits_its_schema(folder: Path) -> None:
    assert complaints(report_of(folder)) == []


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


def test_schema_refuses_a_key_more_or_less_anywhere() -> None:
    report = report_of(ROOT / "scenarios" / "round-hole")
    paths = objects(report)
    assert len(paths) > 20
    for path in paths:
        assert complaints(changed(report, path, lambda node: node.update(surplus=1))), path
        for key in report_node(report, path):
            assert complaints(changed(report, path, lambda node, key=key: node.pop(key))), (*path, key)


def test_schema_refuses_wrong_types_anywhere() -> None:
    report = report_of(ROOT / "scenarios" / "round-hole")
    for path in objects(report):
        for key, value in report_node(report, path).items():
            wrong = "text" if isinstance(value, int | float) else -1.5
            assert complaints(changed(report, path, lambda node, key=key, wrong=wrong: node.update({key: wrong}))), (
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
    report = report_of(ROOT / "scenarios" / "round-hole")
    keys = {str(key) for path in objects(report) for key in report_node(report, path)}
    assert keys - named == set()


def test_trace_arrays_are_documented() -> None:
    case = load_scenario(ROOT / "scenarios" / "round-hole")
    arrays = trace_arrays(dry_run(read_program(case.program), case, lambda stage, done, total: None))
    table = read(DOCS / "report.md").partition("## trace.npz")[2]
    rows = [row for row in table.splitlines() if row.startswith("| `")]
    dtypes = {name: row.split("|")[2].strip() for row in rows for name in re.findall(r"`(\w+)`", row.split("|")[1])}
    assert {name: str(array.dtype) for name, array in arrays.items()}.items() <= dtypes.items()
    assert {name for name in dtypes if name not in arrays} == {"step_x_um", "step_y_um", "step_block", "step_t_s"}


def settings() -> dict[str, Any]:
    """Every key with bounds, as the documents write it."""
    tables = {
        "table": machine._TABLE,
        "controller": machine._CONTROLLER,
        "cutting": machine._CUTTING,
        "wire": scenario._WIRE,
        "work": scenario._WORK,
    }
    return {f"[{table}] {key}": bound for table, keys in tables.items() for key, bound in keys.items()}


@pytest.mark.parametrize("key", settings())
def test_settings_are_documented_with_their_bounds(key: str) -> None:
    rows = [row for row in read(DOCS / "scenarios.md").splitlines() if row.startswith(f"| `{key}` |")]
    assert len(rows) == 1
    numbers = [
        float(text) for text in re.findall(r"-?\d+(?:\.\d+)?", rows[0].split("|")[3].replace("−", "-").replace(",", ""))
    ]
    assert tuple(numbers) == tuple(settings()[key])


def test_scenario_and_machine_files_have_no_key_that_is_not_documented() -> None:
    page = read(DOCS / "scenarios.md")
    plain = [key for key in scenario._KEYS if key not in ("wire", "work", "expect")]
    for key in [*plain, "name", "[expect]"]:
        assert f"| `{key}` |" in page, key


def test_findings_are_documented_with_severity_and_title() -> None:
    rows = [row.split("|") for row in read(DOCS / "findings.md").splitlines() if row.startswith("| 3B")]
    written = {code.strip(): (severity.strip(), title.strip()) for _, code, severity, title, *_ in rows}
    assert written == {code: (str(severity), title) for code, (severity, title) in CATALOGUE.items()}


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_links_lead_somewhere(page: Path) -> None:
    for target in re.findall(r"\]\(([^)\s]+)\)", read(page)):
        if not target.startswith("https://"):
            assert (page.parent / target).exists(), target


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_lines_are_wrapped(page: Path) -> None:
    long = [line for line in read(page).splitlines() if len(line) > 120 and not line.startswith("|")]
    assert long == []


def test_quoted_commands_are_make_targets() -> None:
    targets = set(re.findall(r"^([a-z]+):", read(ROOT / "Makefile"), flags=re.MULTILINE))
    for page in PAGES:
        quoted = re.findall(r"(?:`|^)make (?:[A-Z]+=\S+ )?([a-z]+)", read(page), flags=re.MULTILINE)
        assert set(quoted) <= targets, page.name
    assert {"demo", "test", "bench"} <= set(re.findall(r"make ([a-z]+)", read(ROOT / "README.md")))


def test_code_flow_names_what_exists() -> None:
    page = read(DOCS / "code-flow.md")
    for path, name in re.findall(r"`((?:parser|controller|sim)/\w+\.py)`\s+`([A-Za-z_.]+)`", page):
        source = read(ROOT / path)
        for part in name.split("."):
            assert re.search(rf"^\s*(?:class|def) {part}\b", source, flags=re.MULTILINE), f"{path} {name}"
    for path in re.findall(r"(?:parser|controller|sim)/\w+\.py", page):
        assert (ROOT / path).exists(), path


def test_code_flow_quotes_the_numbers_of_the_code() -> None:
    page = read(DOCS / "code-flow.md")
    toolpath = read_program(ROOT / "scenarios" / "keyhole" / "program.3b").toolpath
    block, steps = toolpath.block(3), interpolate(toolpath)
    low, high = int(steps.before[3]), int(steps.before[4])
    first = steps.chunk(low, low + 6)
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


def test_readme_shows_the_keyhole() -> None:
    page = read(ROOT / "README.md")
    report = report_of(ROOT / "scenarios" / "keyhole")
    assert f"{report['summary']['steps']:,} of 1 µm" in page
    assert f"{report['summary']['length_um'] / 1000:.3f} mm" in page
    for kind in ("steps", "interpolation", "table"):
        assert (
            f"{report['deviation'][kind]['max_um']:.2f} µm in block {report['deviation'][kind]['where']['block']}"
            in page
        )
