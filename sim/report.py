"""``report.json``: the run as data, schema ``drycut.report/1`` (docs/report.md)."""

import json
from typing import Any

import numpy as np
from numpy.typing import NDArray

from parser.catalogue import term, texts
from parser.findings import Finding
from parser.header import Header
from parser.toolpath import Axis, Floats, Kind, Toolpath
from sim import __version__
from sim.check.result import CheckState, Coverage
from sim.contours import Contour
from sim.deviation import Deviation
from sim.dryrun import DryRun, verdict

SCHEMA = "drycut.report/1"

_UM_DIGITS = 6
_DEG_DIGITS = 9
_CURVES = (None, "convex", "concave")


def build_report(run: DryRun) -> dict[str, Any]:
    """Report of a run as plain lists, dicts, numbers and None; the order of keys is fixed."""
    scenario, toolpath = run.scenario, run.toolpath
    return {
        "schema": SCHEMA,
        "drycut": __version__,
        "verdict": verdict(run.findings),
        "program": {
            "name": run.program.name,
            "title": scenario.title,
            "provenance": scenario.provenance,
            "encoding": run.program.encoding,
            "dialect": run.program.reading.dialect,
            "header": _header(run.program.header),
        },
        "machine": {"name": scenario.machine.name, "start_um": [_round(place) for place in scenario.start_um]},
        "wire": {
            "diameter_um": _round(scenario.wire.diameter_um),
            "spark_gap_um": _round(scenario.wire.spark_gap_um),
            "kerf_um": _round(scenario.wire.kerf_um),
        },
        "work": {"thickness_mm": scenario.thickness_mm},
        "summary": {
            "blocks": len(toolpath),
            "length_um": _round(float(toolpath.length_um.sum())),
            "steps": len(run.stepped),
        },
        "time_s": {"total": _round(run.plan.duration_s), "by_block": _column(run.block_time_s)},
        "contours": [_contour(contour, run.block_time_s) for contour in run.contours],
        "interpolator": _interpolator(run),
        "deviation": {
            "interpolation": _deviation(run.deviations.interpolation),
            "steps": _deviation(run.deviations.steps),
            "table": _deviation(run.deviations.table),
        },
        "coverage": _coverage(run.coverage),
        "findings": [finding_entry(finding) for finding in run.findings],
        "stops": [{"kind": s.kind, "after_block": s.after, "line": s.line} for s in toolpath.stops],
        "blocks": _blocks(run),
    }


def report_text(report: dict[str, Any]) -> str:
    """The report as JSON text, one line for each entry and for each member of a list of entries; no NaN.

    Compact lines keep to json's fast encoder; indenting a hundred thousand blocks takes ten times as long.
    """
    return "{\n" + ",\n".join(f"{_line(key)}: {_lines(value)}" for key, value in report.items()) + "\n}\n"


def _lines(value: Any) -> str:
    if isinstance(value, list) and value and isinstance(value[0], dict):
        return "[\n" + ",\n".join(map(_line, value)) + "\n]"
    return _line(value)


def _line(value: Any) -> str:
    return json.dumps(value, ensure_ascii=False, allow_nan=False)


def finding_entry(finding: Finding) -> dict[str, Any]:
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
    }


def _header(header: Header) -> dict[str, Any]:
    return {
        "version": header.version or None,
        "name": header.name or None,
        "corner_radius_um": _known(header.corner_radius_um),
        "offset_um": _known(header.offset_um),
        "lengths_um": [_round(length.um) for length in header.lengths],
    }


def _coverage(coverage: Coverage) -> dict[str, Any]:
    return {
        "blocks": {
            "found": coverage.found,
            "read": coverage.read,
            "decoded": coverage.decoded,
            "stepped": coverage.stepped,
        },
        "checks": [
            {"check": check.name.removeprefix("check-"), "state": check.state, "reason": _reason(check)}
            for check in coverage.checks
        ],
    }


def _reason(check: CheckState) -> str | None:
    return term(check.reason) if check.reason else None


def _interpolator(run: DryRun) -> dict[str, Any]:
    controller, sampling = run.scenario.machine.controller, run.deviations.sampling
    return {
        "name": controller.interpolation,
        "servo_period_s": None if sampling is None else controller.servo_period_s,
        "axis_um": None if sampling is None else [_round(axis) for axis in sampling.axis_um],
        "chord_um": None if sampling is None else _round(sampling.chord_um),
    }


def _contour(contour: Contour, block_time_s: Floats) -> dict[str, Any]:
    return {
        "first_block": contour.first,
        "last_block": contour.last,
        "closure_exact_um": _round(contour.closure_exact_um),
        "closure_stepped_um": _round(contour.closure_stepped_um),
        "time_s": _round(float(block_time_s[contour.first - 1 : contour.last].sum())),
    }


def _deviation(deviation: Deviation) -> dict[str, Any]:
    where = deviation.where
    return {
        "max_um": _round(deviation.max_um),
        "rms_um": _round(deviation.rms_um),
        "p95_um": _round(deviation.p95_um),
        "where": where
        and {"block": where.block, "x_um": _round(where.x_um), "y_um": _round(where.y_um), "t_s": _round(where.t_s)},
    }


def _blocks(run: DryRun) -> list[dict[str, Any]]:
    toolpath = run.toolpath
    columns = {
        "block": list(range(1, len(toolpath) + 1)),
        "line": toolpath.source.line.tolist(),
        "label": [label or None for label in toolpath.source.label],
        "text": [toolpath.source.text[low:high] for low, high in toolpath.source.span.tolist()],
        "kind": [Kind(kind).name.lower() for kind in toolpath.kind.tolist()],
        "count_um": toolpath.words.count_um.tolist(),
        "radius_um": [None if radius < 0 else radius for radius in toolpath.words.radius_um.tolist()],
        "curve": [_CURVES[curve] for curve in toolpath.words.curve.tolist()],
        "count_axis": [Axis(axis).name for axis in toolpath.words.count_axis.tolist()],
        "exact": _rows(_exact(toolpath)),
        "stepped": _rows(_stepped(run)),
        "table": _rows({"max_deviation_um": _column(run.deviations.table.by_row_um)}),
        "printed_end_um": _points(toolpath.printed_end_um),
    }
    return _rows(columns)


def _exact(toolpath: Toolpath) -> dict[str, list[Any]]:
    arc = toolpath.is_arc
    degrees = np.where(arc, np.degrees(toolpath.sweep_rad), np.nan)
    return {
        "start_um": _points(toolpath.start_um),
        "end_um": _points(toolpath.end_um),
        "center_um": _points(toolpath.center_um),
        "radius_um": _column(toolpath.radius_um),
        "sweep_deg": _column(degrees, _DEG_DIGITS),
        "start_angle_deg": _column(np.degrees(toolpath.start_angle_rad), _DEG_DIGITS),
        "end_angle_deg": _column(np.degrees(toolpath.end_angle_rad), _DEG_DIGITS),
        "is_major": toolpath.is_major.tolist(),
        "length_um": _column(toolpath.length_um),
    }


def _stepped(run: DryRun) -> dict[str, list[Any]]:
    return {
        "end_um": run.stepped.corner_um[1:].tolist(),
        "steps": run.stepped.count.tolist(),
        "max_deviation_um": _column(run.deviations.steps.by_row_um),
        "interpolation_um": _column(run.deviations.interpolation.by_row_um),
    }


def _rows(columns: dict[str, list[Any]]) -> list[dict[str, Any]]:
    names = tuple(columns)
    return [dict(zip(names, row, strict=True)) for row in zip(*columns.values(), strict=True)]


def _column(values: Floats, digits: int = _UM_DIGITS) -> list[float | None]:
    """Rounded numbers; None for NaN."""
    rounded = (np.round(values, digits) + 0.0).tolist()
    return [None if value != value else value for value in rounded]  # noqa: PLR0124 - NaN


def _points(pairs: NDArray[np.float64]) -> list[list[float] | None]:
    rounded = (np.round(pairs, _UM_DIGITS) + 0.0).tolist()
    return [None if pair[0] != pair[0] else pair for pair in rounded]


def _known(length_um: float | None) -> float | None:
    return None if length_um is None else _round(length_um)


def _round(value: float) -> float:
    return round(value, _UM_DIGITS) + 0.0
