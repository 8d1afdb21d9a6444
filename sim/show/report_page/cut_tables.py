"""Tables of what a cut leaves: pieces, their sizes, and the worst places beside the drawing."""

from collections.abc import Mapping
from typing import Any

from parser.text.source import BlockNames
from sim.show.report_page.tables import (
    Column,
    ReportTable,
    called,
    column_of,
    counted,
    micrometres,
    millimetres,
    timed,
    worded,
    yes_or_no,
)
from sim.show.texts import bilingual


def piece_table(entries: list[dict[str, Any]], names: BlockNames) -> ReportTable:
    """Pieces in the order in which they come free."""
    return ReportTable(
        "pieces",
        (
            counted("number", list(range(1, len(entries) + 1))),
            worded("kind", column_of(entries, "kind")),
            Column(bilingual("report.area"), column_of(entries, "area_mm2"), unit="mm²", digits=3),
            Column(bilingual("report.mass"), column_of(entries, "mass_g"), unit="g", digits=3),
            called("freed-block", column_of(entries, "freed.block"), names.at),
            timed("freed-after", column_of(entries, "freed.t_s")),
            called("held-after", column_of(entries, "held_after_block"), names.at),
            micrometres("cut-after", column_of(entries, "cut_after_um")),
            micrometres("can-shift", [_farthest(entry["play"]["shifts"]) for entry in entries], digits=0),
            yes_or_no("early", column_of(entries, "early")),
        ),
    )


def _farthest(shifts: list[dict[str, Any]]) -> float | None:
    """How far a piece shifts in the direction in which it can shift farthest; None where nothing is in the way."""
    ways = [shift["by_um"] for shift in shifts]
    return None if None in ways else max(ways)


def size_tables(sizes: Mapping[str, list[dict[str, Any]]], names: BlockNames) -> list[ReportTable]:
    """Widths, radii and distances of what is kept, as cut and nominal."""
    boxes, radii, distances = sizes["boxes"], sizes["radii"], sizes["distances"]
    return [
        ReportTable("boxes", (*_of_what(boxes), counted("piece", column_of(boxes, "piece")), *_widths(boxes))),
        ReportTable(
            "radii",
            (
                *_of_what(radii),
                called("block", column_of(radii, "block"), names.at),
                millimetres("as-cut", column_of(radii, "cut_um")),
                millimetres("nominal", column_of(radii, "nominal_um")),
                _apart(radii),
                micrometres("form", column_of(radii, "form_um")),
            ),
        ),
        ReportTable(
            "distances",
            (
                *_of_what(distances),
                called("block", column_of(distances, "blocks.0"), names.at),
                called("other-block", column_of(distances, "blocks.1"), names.at),
                millimetres("as-cut", column_of(distances, "cut_um")),
                millimetres("nominal", column_of(distances, "nominal_um")),
                _apart(distances),
            ),
        ),
    ]


def worst_table(entries: list[dict[str, Any]], names: BlockNames) -> ReportTable:
    """Where edge and drawing are farthest apart."""
    return ReportTable(
        "worst",
        (
            worded("measured-from", column_of(entries, "from")),
            micrometres("distance", column_of(entries, "max_um"), digits=3),
            millimetres("at-x", column_of(entries, "where_um.0")),
            millimetres("at-y", column_of(entries, "where_um.1")),
            called("block", column_of(entries, "block"), names),
            counted("entity", column_of(entries, "entity")),
        ),
    )


def corner_table(entries: list[dict[str, Any]], names: BlockNames) -> ReportTable:
    """Sharp inside corners of the drawing that the wire cannot reach, and what it must leave in them."""
    return ReportTable(
        "corners",
        (
            micrometres("left-at-least", column_of(entries, "depth_um"), digits=3),
            Column(bilingual("report.angle"), column_of(entries, "angle_deg"), unit="°", digits=1),
            millimetres("at-x", column_of(entries, "where_um.0")),
            millimetres("at-y", column_of(entries, "where_um.1")),
            called("block", column_of(entries, "block"), names),
            counted("entity", column_of(entries, "entity")),
        ),
    )


def _of_what(entries: list[dict[str, Any]]) -> tuple[Column, ...]:
    return (worded("what", column_of(entries, "what")),)


def _widths(boxes: list[dict[str, Any]]) -> list[Column]:
    """As cut and nominal, along X and along Y."""
    return [
        millimetres(f"{head}-{axis}", column_of(boxes, f"{key}.{at}"))
        for at, axis in enumerate("xy")
        for head, key in (("as-cut", "cut_um"), ("nominal", "nominal_um"))
    ]


def _apart(entries: list[dict[str, Any]]) -> Column:
    """As cut less nominal."""
    return micrometres("apart", [entry["cut_um"] - entry["nominal_um"] for entry in entries])
