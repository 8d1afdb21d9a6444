"""The legend below a plot: samples of what shows, the scale bar, and what the codes of findings mean."""

from collections.abc import Callable
from typing import Final, NamedTuple

import numpy as np

from parser.findings.catalogue import page as page_of
from parser.findings.codes import Severity
from parser.findings.findings import Count, counted
from parser.geometry.curves import Floats
from parser.units import mm
from sim.show.draw import style
from sim.show.draw.canvas import Canvas
from sim.show.draw.layout import Box, Page, box_around, mm_text, nice_below
from sim.show.draw.legend import (
    DrawSample,
    Entry,
    across,
    dashes,
    draw_legend,
    in_columns,
    middle,
    rows_in_columns,
    stroke,
)
from sim.show.draw.style import TONES, Paint, paint_of_pass, tones_of
from sim.show.pictures.cut.lines import Line, draw_line, off_entries
from sim.show.pictures.cut.marks import (
    draw_end,
    draw_flag,
    draw_number,
    draw_pause,
    draw_start,
    number_size,
    pauses,
    places_um,
)
from sim.show.pictures.cut.subject import Cut, draw_clamp, draw_work
from sim.show.texts import Words

COLUMNS: Final = 3
FINDING_COLUMNS: Final = 2
MOST_CODES: Final = 6


class Surroundings(NamedTuple):
    """What of the surroundings shows in a plot, and how wide the kerf is drawn."""

    work: bool
    clamps: bool
    travel: bool
    kerf_px: float


def scale_bar_um(page: Page) -> float:
    """Length of the scale bar, a round one."""
    return nice_below(style.SCALE_BAR * page.unit / page.view.px_per_um)


class Drawn(NamedTuple):
    """What found its place in a plot: what the block numbers are, and how many of the pauses."""

    numbers: str = ""
    pauses: int = 0


def entries(cut: Cut, page: Page, say: Words, seen: Surroundings, drawn: Drawn) -> list[Entry]:
    """All that a legend explains, in its order."""
    kerf = say("cut.kerf" if cut.trace else "cut.kerf_programmed", width=f"{mm(cut.kerf_um):.3f}")
    wider = seen.kerf_px > cut.kerf_um * page.view.px_per_um
    bar_um = scale_bar_um(page)
    bar = bar_um * page.view.px_per_um / (style.SAMPLE * page.unit)
    kinds = {piece.kind for piece in cut.pieces.freed} if cut.pieces else set()
    path = "cut.offset_path" if cut.contour else "cut.programmed" if cut.kerf_um else "cut.contour"
    found = (
        (cut.kerf_um, Entry(_kerf(seen.kerf_px, Paint.KERF), say("cut.kerf_wider", kerf=kerf) if wider else kerf)),
        *((True, entry) for entry in _pass_entries(cut, say, seen.kerf_px)),
        (cut.leads is not None and cut.leads.any(), Entry(_kerf(seen.kerf_px, Paint.LEAD), say("cut.lead"))),
        (True, Entry(stroke(Paint.IDEAL, style.IDEAL_WIDTH), say(path))),
        (cut.contour, Entry(stroke(Paint.CONTOUR, style.CONTOUR_WIDTH), say("cut.contour"))),
        (cut.faces, Entry(stroke(Paint.TOP, style.ACTUAL_WIDTH), say("taper.upper-contour"))),
        (cut.faces, Entry(dashes(Paint.BOTTOM, style.ACTUAL_WIDTH), say("taper.lower-contour"))),
        (cut.trace, Entry(stroke(Paint.ACTUAL, style.ACTUAL_WIDTH), say("cut.actual"))),
        *((True, entry) for entry in off_entries(cut.off, page, say)),
        (cut.toolpath.is_jump.any(), Entry(dashes(Paint.JUMP, style.JUMP_WIDTH), say("cut.jump"))),
        (True, Entry(_arrow, say("cut.direction"))),
        (True, Entry(lambda canvas, box, unit: draw_start(canvas, middle(box), unit), say("cut.start"))),
        (True, Entry(lambda canvas, box, unit: draw_end(canvas, middle(box), unit), say("cut.end"))),
        (pauses(cut.toolpath), Entry(_pause, _pauses_text(cut, drawn.pauses, say))),
        (True, Entry(_number, drawn.numbers)),
        ("part" in kinds, Entry(_piece(Paint.PART, Paint.PART_EDGE), say("cut.part"))),
        ("slug" in kinds, Entry(_piece(Paint.SLUG, Paint.SLUG_EDGE), say("cut.slug"))),
        (seen.work, Entry(_body(draw_work), say("cut.work"))),
        (seen.clamps, Entry(_body(draw_clamp), say("cut.clamp"))),
        (seen.travel, Entry(dashes(Paint.TRAVEL, 1.5 * style.JUMP_WIDTH), say("cut.travel_border"))),
        (True, Entry(_scale_bar, mm_text(bar_um, bar_um) + " mm", bar)),
    )
    return [entry for is_there, entry in found if is_there]


def _pauses_text(cut: Cut, drawn: int, say: Words) -> str:
    """What the mark of a pause is, and how many have one where not all do."""
    count = len(pauses(cut.toolpath))
    return say("cut.pause") if drawn == count else say("cut.pause_some", drawn=drawn, count=count)


def finding_entries(cut: Cut, say: Words) -> list[Entry]:
    """What the codes of the findings mean; where there are many of them, how many there are of each severity."""
    counts = counted(cut.findings)
    if len(counts) > MOST_CODES:
        by = {severity: sum(count.n for count in counts if count.severity is severity) for severity in Severity}
        text = say("cut.count", errors=by[Severity.ERROR], warnings=by[Severity.WARNING], notes=by[Severity.NOTE])
        return [Entry(_flag(counts[0].severity), text)]
    has_mark = np.isfinite(places_um(cut.toolpath, cut.findings, 0.0)[:, 0]).tolist()
    marked, others = (
        counted([found for found, has in zip(cut.findings, has_mark, strict=True) if has is wanted])
        for wanted in (True, False)
    )
    by_key = [("cut.finding", count) for count in marked] + [("cut.finding_unmarked", count) for count in others]
    order = tuple(Severity)
    return [
        _finding_entry(key, count, say)
        for key, count in sorted(by_key, key=lambda each: (order.index(each[1].severity), each[1].code))
    ]


def _finding_entry(key: str, count: Count, say: Words) -> Entry:
    """What a code means; a finding of the whole program has no place on the drawing."""
    text = say(key, code=count.text, title=page_of(count.code, say.language).title)
    return Entry(_flag(count.severity), text)


def rows_for(plain: int, findings: int) -> int:
    """Rows that a legend of so many entries takes."""
    return rows_in_columns(plain, COLUMNS) + rows_in_columns(findings, FINDING_COLUMNS)


def draw_legends(canvas: Canvas, page: Page, plain: list[Entry], findings: list[Entry]) -> None:
    """Draw the legend below the plot, column by column, and below it what the codes mean."""
    left, unit = style.EDGE * page.unit, page.unit
    top = page.height_px - (rows_for(len(plain), len(findings)) + 0.5) * style.LEGEND_ROW * unit
    for part, columns in ((plain, COLUMNS), (findings, FINDING_COLUMNS)):
        legend = in_columns(part, columns, page.width_px - 2 * left, unit)
        draw_legend(canvas, legend, left, top)
        top += legend.height


def _pass_entries(cut: Cut, say: Words, kerf_px: float) -> list[Entry]:
    """Tones of passes with the offsets of those that have them, where any edge is cut more than once."""
    passes = () if cut.passes is None else cut.passes.passes
    entries = []
    for tone in tones_of(passes):
        offsets = [
            mm(pass_.offset_um(cut.kerf_um / 2)) for pass_ in passes if paint_of_pass(pass_.number) is tone.paint
        ]
        by = dict.fromkeys(f"{offset:.3f}" for offset in (min(offsets), max(offsets)))
        text = say("cut.pass", name=tone.name, by="–".join(by))
        entries.append(Entry(_pass(kerf_px, TONES.index(tone.paint) + 1), text))
    return entries


def _pass(kerf_px: float, tone: int) -> DrawSample:
    """The kerf of a pass, and the line of its way."""

    def draw(canvas: Canvas, box: Box, unit: float) -> None:
        _kerf(kerf_px, TONES[tone - 1])(canvas, box, unit)
        draw_line(canvas, Line(across(box), tone), Paint.IDEAL, style.IDEAL_WIDTH, unit)

    return draw


def _kerf(kerf_px: float, paint: Paint) -> DrawSample:
    def draw(canvas: Canvas, box: Box, unit: float) -> None:
        width = min(kerf_px, 0.6 * style.LEGEND_ROW * unit)
        canvas.polyline(across(box) + np.array([[width / 2, 0.0], [-width / 2, 0.0]]), paint, width)

    return draw


def _arrow(canvas: Canvas, box: Box, unit: float) -> None:
    line, size, ahead = across(box), style.ARROW * unit, np.array([1.0, 0.0])
    canvas.polyline(line, Paint.IDEAL, style.IDEAL_WIDTH * unit)
    canvas.arrow(middle(box) + ahead * size / 2, ahead, size, Paint.IDEAL)


def _pause(canvas: Canvas, box: Box, unit: float) -> None:
    side = style.PAUSE * unit
    draw_pause(canvas, box_around(middle(box), side, side), "", unit)


def _number(canvas: Canvas, box: Box, unit: float) -> None:
    draw_number(canvas, box_around(middle(box), *number_size("12", unit)), "12", unit)


def _piece(fill: Paint, edge: Paint) -> DrawSample:
    def draw(canvas: Canvas, box: Box, unit: float) -> None:
        corners = _corners(box)
        canvas.polygon(corners, fill)
        canvas.polyline(np.concatenate([corners, corners[:1]]), edge, style.EDGE_WIDTH * unit)

    return draw


def _body(draw_body: Callable[[Canvas, Floats, float], None]) -> DrawSample:
    return lambda canvas, box, unit: draw_body(canvas, _corners(box), unit)


def _flag(severity: Severity) -> DrawSample:
    return lambda canvas, box, unit: draw_flag(canvas, middle(box), severity, 0.9 * unit)


def _scale_bar(canvas: Canvas, box: Box, unit: float) -> None:
    line, tick, width = across(box), np.array([0.0, 0.25 * style.LEGEND_ROW * unit]), 2 * unit
    canvas.polyline(line, Paint.INK, width)
    for end in line:
        canvas.polyline(np.stack([end - tick, end + tick]), Paint.INK, width)


def _corners(box: Box) -> Floats:
    """Corners (4, 2) px of a filled sample."""
    half, centre = 0.3 * (box.bottom - box.top), (box.top + box.bottom) / 2
    top, bottom = centre - half, centre + half
    return np.array([[box.left, top], [box.right, top], [box.right, bottom], [box.left, bottom]])
