"""The whole report of a run, as data and as text.

Entries of the report on each pass over an edge.

Entries of the report on where the wire is threaded, and taken out again.

Entries of the report on each block.
"""

import json
from collections.abc import Mapping
from typing import Any, cast

import numpy as np

from parser import __version__
from parser.controller_words import Axis
from parser.dialect.reader import HeaderValue
from parser.findings.catalogue import texts
from parser.findings.findings import Finding
from parser.geometry.curves import CurveKind, Floats
from parser.shape.contours import Contour
from parser.toolpath import Toolpath
from sim.base.units import (
    DEG_DIGITS,
    column,
    moment,
    numbers,
    place,
    points,
    rounded,
    rows,
)
from sim.check.result import Coverage
from sim.measure.passes import PassFigures, Stock
from sim.measure.threadings import Threading, threadings
from sim.run.dryrun import DryRun, assumptions_of
from sim.run.findings import to_check, verdict
from sim.run.report.drawing import comparison_entry
from sim.run.report.figures import (
    deviation_entries,
    ended_entry,
    limit_entry,
    loss_entry,
    offset_entry,
    remains_entry,
    spark_entry,
)
from sim.run.report.model import (
    AssumptionsEntry,
    BlockEntry,
    CoverageEntry,
    FindingEntry,
    GradedEntry,
    HeaderEntry,
    IntervalEntry,
    MachineEntry,
    NoHeaderEntry,
    PassTechnologyEntry,
    ProgramEntry,
    ReportDocument,
    SteppedEntry,
    TableEntry,
    TechnologyEntry,
    WireEntry,
)
from sim.run.report.run_model import ContourEntry, InterpolatorEntry, PassEntry, StockEntry, ThreadPointEntry
from sim.run.report.taper import taper_entry
from sim.setup.scenario import Scenario
from sim.setup.technology import Figure, PassTechnology

_CURVES = (None, "convex", "concave")


def block_entries(run: DryRun) -> list[BlockEntry]:
    """All of ``blocks[]``."""
    toolpath = run.toolpath
    columns = {
        "block": list(range(1, len(toolpath) + 1)),
        "line": toolpath.source.line.tolist(),
        "label": [label or None for label in toolpath.source.label],
        "text": [toolpath.source.text[low:high] for low, high in toolpath.source.span.tolist()],
        "kind": [CurveKind(kind).name.lower() for kind in toolpath.kind.tolist()],
        **_words(toolpath),
        "exact": rows(dict, _exact(toolpath)),
        "stepped": rows(SteppedEntry, _stepped(run)),
        "table": rows(TableEntry, {"max_deviation_um": column(run.deviations.table.by_row_um)}),
        "printed_end_um": points(toolpath.printed_end_um),
    }
    return rows(BlockEntry, columns)


def _words(toolpath: Toolpath) -> dict[str, list[Any]]:
    """What the blocks say of steps; None where the dialect has no words for that."""
    words = toolpath.words
    if words is None:
        return dict.fromkeys(("count_um", "radius_um", "curve", "count_axis"), [None] * len(toolpath))
    return {
        "count_um": words.count_um.tolist(),
        "radius_um": [None if radius < 0 else radius for radius in words.radius_um.tolist()],
        "curve": [_CURVES[curve] for curve in words.curve.tolist()],
        "count_axis": [Axis(axis).name for axis in words.count_axis.tolist()],
    }


def _exact(toolpath: Toolpath) -> dict[str, list[Any]]:
    arc = toolpath.is_arc
    degrees = np.where(arc, np.degrees(toolpath.sweep_rad), np.nan)
    return {
        "start_um": points(toolpath.start_um),
        "end_um": points(toolpath.end_um),
        "center_um": points(toolpath.center_um),
        "radius_um": column(toolpath.radius_um),
        "sweep_deg": column(degrees, DEG_DIGITS),
        "start_angle_deg": column(np.degrees(toolpath.start_angle_rad), DEG_DIGITS),
        "end_angle_deg": column(np.degrees(toolpath.end_angle_rad), DEG_DIGITS),
        "is_major": toolpath.is_major.tolist(),
        "length_um": column(toolpath.length_um),
    }


def _stepped(run: DryRun) -> dict[str, list[Any]]:
    return {
        "end_um": run.stepped.corner_um[1:].tolist(),
        "steps": run.stepped.count.tolist(),
        "max_deviation_um": column(run.deviations.steps.by_row_um),
        "interpolation_um": column(run.deviations.interpolation.by_row_um),
    }


def thread_entries(run: DryRun) -> list[ThreadPointEntry]:
    """All of ``thread_points[]``; times are None where the run ended before."""
    return [_thread(threading, run) for threading in threadings(run.toolpath, run.border_s)]


def _thread(threading: Threading, run: DryRun) -> ThreadPointEntry:
    begins, ends = threading.at_s <= run.ran_s, run.ended is None or threading.last < run.ended.row
    return {
        "blocks": [threading.first + 1, threading.last + 1],
        "at_um": place(threading.at_um),
        "at_s": moment(threading.at_s, run.ran_s) if begins else None,
        "out_um": place(threading.out_um),
        "out_s": moment(threading.out_s, run.ran_s) if ends else None,
        "left_um": rounded(threading.left_um),
        "right_um": rounded(threading.right_um),
        "down_um": rounded(threading.down_um),
        "up_um": rounded(threading.up_um),
    }


def pass_entries(run: DryRun) -> list[PassEntry]:
    """All of ``passes[]``."""
    return [_pass(figures) for figures in run.pass_figures]


def _pass(figures: PassFigures) -> PassEntry:
    pass_, worst = figures.of, figures.worst
    return {
        "contour": pass_.edge + 1,
        "number": pass_.number,
        "blocks": [pass_.first + 1, pass_.last + 1],
        "offset_um": rounded(figures.offset_um),
        "direction": "back" if pass_.is_back else "forward",
        "cuts_tab": pass_.is_tab,
        "length_um": rounded(figures.length_um),
        "time_s": rounded(figures.time_s),
        "stock_um": _stock(figures.stock),
        "deviation": {
            "max_um": 0.0 if worst is None else rounded(worst.deviation_um),
            "where_um": None if worst is None else place(worst.place_um),
        },
    }


def _stock(stock: Stock | None) -> StockEntry | None:
    if stock is None:
        return None
    return {"least": rounded(stock.least_um), "most": rounded(stock.most_um), "mean": rounded(stock.mean_um)}


def build_report(run: DryRun) -> ReportDocument:
    """Report of a run as plain lists, dicts, numbers and None; the order of keys is fixed.

    ``card`` is of a program for the card, and filled by who ran it.
    """
    scenario, toolpath = run.scenario, run.toolpath
    return {
        "schema": "drycut.report/1",
        "drycut": __version__,
        "verdict": verdict(run.findings),
        "to_check": to_check(run.findings),
        "program": _program(run),
        "machine": _machine(scenario),
        "assumptions": _assumptions(run),
        "wire": _wire(scenario),
        "technology": _technology(scenario),
        "work": {"thickness_mm": scenario.thickness_mm, "density_g_cm3": scenario.density_g_cm3},
        "offset": offset_entry(run),
        "summary": {
            "blocks": len(toolpath),
            "length_um": rounded(run.ran_um),
            "steps": len(run.stepped),
        },
        "time_s": {
            "total": rounded(run.ran_s),
            "interval": _interval(run),
            "by_block": numbers(run.block_time_s),
        },
        "ended": ended_entry(run),
        "contours": [_contour(contour, run.block_time_s) for contour in run.whole_contours],
        "thread_points": thread_entries(run),
        "passes": pass_entries(run),
        "interpolator": _interpolator(run),
        "deviation": deviation_entries(run.deviations, run.ran_s),
        "limits": [limit_entry(peak, run.ran_s) for peak in run.peaks],
        "losses": [loss_entry(loss, run.ran_s) for loss in run.losses],
        "spark": spark_entry(run.process),
        "taper": taper_entry(run),
        "remains": remains_entry(run.remains, run.ran_s),
        "drawing": comparison_entry(run.comparison),
        "coverage": _coverage(run.coverage),
        "findings": [finding_entry(finding) for finding in run.findings],
        "stops": [{"kind": s.kind, "after_block": s.after, "line": s.line} for s in toolpath.stops],
        "card": None,
        "blocks": block_entries(run),
    }


def _program(run: DryRun) -> ProgramEntry:
    return {
        "name": run.program.name,
        "title": run.scenario.title,
        "provenance": run.scenario.provenance,
        "encoding": run.program.encoding,
        "dialect": run.program.reading.dialect,
        "header": _header(run.program.header),
    }


def _wire(scenario: Scenario) -> WireEntry:
    return {
        "diameter_um": rounded(scenario.wire.diameter_um),
        "spark_gap_um": rounded(scenario.wire.spark_gap_um),
        "kerf_um": rounded(scenario.wire.kerf_um),
        "lag_um": rounded(scenario.wire_lag_um),
    }


def _technology(scenario: Scenario) -> TechnologyEntry:
    technology = scenario.technology
    return {
        "name": None if technology is None else technology.name,
        "material": scenario.cut_material,
        "passes": [_pass_technology(of_pass) for of_pass in scenario.pass_technologies],
    }


def _pass_technology(of_pass: PassTechnology) -> PassTechnologyEntry:
    return {
        "number": of_pass.number,
        "gap_um": _graded(of_pass.gap_um),
        "feed_mm_min": None if of_pass.feed_mm_min is None else _graded(of_pass.feed_mm_min),
        "lag_um": None if of_pass.lag_um is None else _graded(of_pass.lag_um),
        "offset_um": None if of_pass.offset_um is None else _graded(of_pass.offset_um),
        "roughness_um": None if of_pass.roughness_um is None else _graded(of_pass.roughness_um),
    }


def _graded(figure: Figure) -> GradedEntry:
    return {
        "value": rounded(figure.value),
        "least": rounded(figure.least),
        "most": rounded(figure.most),
        "grade": figure.grade,
        "source": figure.source,
    }


def report_text(report: Mapping[str, Any]) -> str:
    """The report as JSON text, one line for each entry and for each member of a list of entries; no NaN.

    Compact lines keep to json's fast encoder; indenting a hundred thousand blocks takes ten times as long.
    """
    return "{\n" + ",\n".join(f"{_line(key)}: {_lines(value)}" for key, value in report.items()) + "\n}\n"


def _machine(scenario: Scenario) -> MachineEntry:
    return {
        "name": scenario.machine.name,
        "engine": scenario.machine.engine,
        "start_um": place(scenario.start_um),
    }


def _assumptions(run: DryRun) -> AssumptionsEntry:
    found = assumptions_of(run)
    return {
        "program": [each.entry("en") for each in found.program],
        "machine_by_default": found.by_default,
        "machine_values": list(found.values),
        "machine_measured": [{"key": key, "value": value, "within": within} for key, value, within in found.measured],
        "drawing_compared": found.compared,
        "wire_bows": found.wire_bows,
    }


def finding_entry(finding: Finding) -> FindingEntry:
    """One entry of ``findings[]``, its texts in English."""
    said = texts(finding)
    return {
        "code": finding.code,
        "severity": str(finding.severity),
        "title": said.title,
        "found": said.found,
        "expected": said.expected,
        "machine": said.machine,
        "hint": said.hint,
        "line": finding.line or None,
        "column": finding.column or None,
        "block": finding.block or None,
        "block_name": finding.block_name or None,
    }


def _header(header: Mapping[str, HeaderValue]) -> HeaderEntry | NoHeaderEntry:
    """What the header lines say, whose names are those of the entry."""
    return cast("HeaderEntry | NoHeaderEntry", {key: _header_value(value) for key, value in header.items()})


def _header_value(value: HeaderValue) -> Any:
    """What a header says of one thing; None where it does not say it."""
    if isinstance(value, tuple):
        return [rounded(each) for each in value]
    return rounded(value) if isinstance(value, float) else value or None


def _coverage(coverage: Coverage) -> CoverageEntry:
    return {
        "blocks": {
            "found": coverage.found,
            "read": coverage.read,
            "decoded": coverage.decoded,
            "stepped": coverage.stepped,
        },
        "checks": [
            {"check": check.name.removeprefix("check-"), "state": check.state, "reason": check.because("en") or None}
            for check in coverage.checks
        ],
    }


def _interpolator(run: DryRun) -> InterpolatorEntry:
    controller, sampling = run.scenario.machine.controller, run.deviations.sampling
    return {
        "name": controller.interpolation,
        "servo_period_s": None if sampling is None else controller.servo_period_s,
        "axis_um": None if sampling is None else [rounded(axis) for axis in sampling.axis_um],
        "chord_um": None if sampling is None else rounded(sampling.chord_um),
    }


def _interval(run: DryRun) -> IntervalEntry | None:
    if run.time_s is None:
        return None
    least, _, most, level = run.time_s
    return {"least": rounded(least), "most": rounded(most), "level": level, "from_cuts": 0}


def _contour(contour: Contour, block_time_s: Floats) -> ContourEntry:
    return {
        "first_block": contour.first,
        "last_block": contour.last,
        "closure_exact_um": rounded(contour.closure_exact_um),
        "closure_stepped_um": rounded(contour.closure_stepped_um),
        "time_s": rounded(float(block_time_s[contour.first - 1 : contour.last].sum())),
    }


def _lines(value: Any) -> str:
    if isinstance(value, list) and value and isinstance(value[0], dict):
        return "[\n" + ",\n".join(map(_line, value)) + "\n]"
    return _line(value)


def _line(value: Any) -> str:
    return json.dumps(value, ensure_ascii=False, allow_nan=False)
