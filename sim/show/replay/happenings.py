"""What a replay's document says of what happens in a run: stops, findings, contours, passes and losses."""

import math
from collections.abc import Iterable
from typing import Any

from parser.findings.catalogue import LANGUAGES, texts
from parser.findings.findings import Finding
from parser.shape.contours import Contour
from parser.toolpath import Stop
from parser.units import from_mm
from sim.base.rounded import rounded
from sim.run.course import Happening, PassOf
from sim.run.ending import Ending
from sim.show.draw.paints import paint_of_pass
from sim.show.texts.phrases import named_pass
from sim.table.record.losses import Loss


def stop_entry(stop: Stop) -> dict[str, Any]:
    """A pause or the end: `after` so many blocks."""
    return {"kind": stop.kind, "after": stop.after, "line": stop.line}


def finding_entry(happening: Happening[Finding]) -> dict[str, Any]:
    """A finding with its texts in both languages.

    It has its row and time, and its place where it knows that; None where no block that ran is meant.
    """
    finding = happening.what
    place_mm = finding.place_mm
    return {
        "code": finding.code,
        "severity": str(finding.severity),
        "line": finding.line or None,
        "block": finding.block or None,
        "block_name": finding.block_name,
        "row": None if happening.row < 0 else happening.row,
        "t_s": None if math.isnan(happening.t_s) else rounded(happening.t_s),
        "place_um": None if place_mm is None else [rounded(from_mm(along)) for along in place_mm],
        "texts": {language: texts(finding, language)._asdict() for language in LANGUAGES},
    }


def contour_entries(contours: Iterable[Contour]) -> list[dict[str, Any]]:
    """Contours by the rows of their first and last blocks."""
    return [
        {
            "first_row": contour.first - 1,
            "last_row": contour.last - 1,
            "closure_exact_um": rounded(contour.closure_exact_um),
            "closure_stepped_um": rounded(contour.closure_stepped_um),
        }
        for contour in contours
    ]


def ending_entry(ended: Ending) -> dict[str, Any]:
    """Where the machine stopped before its program was through, and why."""
    return {
        "cause": ended.cause,
        "axis": ended.axis.name,
        "row": ended.row,
        "t_s": rounded(ended.t_s),
        "place_um": [rounded(ended.x_um), rounded(ended.y_um)],
    }


def pass_entries(passes: Iterable[PassOf]) -> list[dict[str, Any]]:
    """Passes by the rows of their first and last blocks, with the paint of their tone, and their names."""
    return [
        {
            "first_row": each.first,
            "last_row": each.last,
            "number": each.number,
            "paint": str(paint_of_pass(each.number)),
            "name": named_pass(each, among)._asdict(),
        }
        for each, among in passes
    ]


def loss_entry(loss: Loss) -> dict[str, Any]:
    """Steps that a stepper lost, or where a servo tripped."""
    return {
        "kind": loss.kind,
        "axis": loss.axis.name,
        "row": loss.row,
        "t_s": rounded(loss.t_s),
        "amount_um": rounded(loss.amount_um),
        "place_um": [rounded(loss.x_um), rounded(loss.y_um)],
    }
