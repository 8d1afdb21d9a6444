"""The picture of a plan: parts and waste, contours, the ways of the passes, leads, thread points in their order.

The ways of a plan on a page: contours, passes and leads in px, and which way each figure is run.

The picture of a plan by its name, as those who write pictures ask for it.
"""

import math
from collections.abc import Iterator
from itertools import pairwise
from typing import Final, NamedTuple

import numpy as np

from parser.findings.catalogue import Language
from parser.geometry.curves import Curves, Floats, joined
from parser.toolpath import Point
from parser.units import mm
from sim.make.cam.model import CutPlan, FigureCut, Uncut
from sim.show.draw import style
from sim.show.draw.canvas import Canvas, dashes_along
from sim.show.draw.flatten import CHORD_PX, bounds_um, flatten, simplify
from sim.show.draw.layout import BESIDE_PLOT, Box, Page, View, page_for
from sim.show.draw.legend import (
    Entry,
    across,
    dashes,
    draw_at_foot,
    draw_axes,
    draw_frame,
    draw_header,
    in_rows,
    middle,
    stroke,
    swatch,
)
from sim.show.draw.sheet import AnyCanvas, Sheet
from sim.show.draw.style import TONES, Paint, paint_of_pass
from sim.show.texts import Words, bilingual
from sim.show.texts.phrases import numbered

_LEAST_UM = 100.0
_BACK_UM = 1.0
"""A wire that ends so near to its thread point is back there."""


class Heading(NamedTuple):
    """A place (2,) px of a way, and the unit vector (2,) on the page in which it is run there."""

    tip: Floats
    ahead: Floats


def line_px(curves: Curves, view: View) -> Floats:
    """Curves that follow each other as points (k, 2) px; none where there is no curve."""
    if not len(curves):
        return np.empty((0, 2))
    return simplify(view.to_px(flatten(curves, CHORD_PX / view.px_per_um)[0]), CHORD_PX)


def plan_bounds_um(plan: CutPlan) -> Floats:
    """Box around all that is shown, (2, 2), at least 0.1 mm wide."""
    boxes = [bounds_um(curve) for cut in plan.cuts for curve in _curves(cut) if len(curve)]
    boxes += [bounds_um(each.contour) for each in plan.uncut if each.why != "frame"]
    boxes += [bounds_um(each.upper) for each in plan.facings]
    places = np.array([cut.thread.place_um for cut in plan.cuts])
    low = np.min([*(box[0] for box in boxes), *places], axis=0)
    high = np.max([*(box[1] for box in boxes), *places], axis=0)
    missing = max(_LEAST_UM - float((high - low).max()), 0.0)
    box: Floats = np.stack([low, high]) + 0.5 * missing * np.array([[-1.0], [1.0]])
    return box


def heading_px(cut: FigureCut, view: View) -> Heading | None:
    """Which way the first pass runs, at the end of its first third; None where it has no length."""
    line = line_px(cut.passes[0].along, view)
    ways = np.diff(line, axis=0)
    lengths = np.hypot(ways[:, 0], ways[:, 1])
    if not lengths.sum():
        return None
    at = int(np.searchsorted(np.cumsum(lengths), lengths.sum() / 3.0))
    share = (lengths.sum() / 3.0 - lengths[:at].sum()) / lengths[at]
    return Heading(line[at] + share * ways[at], ways[at] / lengths[at])


def _curves(cut: FigureCut) -> list[Curves]:
    ways = [way for run in (*cut.passes, *cut.cut_off) for way in (run.into, run.along, run.out)]
    return [cut.figure.contour, *ways]


_PASS_WIDTH: Final = 3.6  # of the last one, which lies on top; each before it is wider, so that all show
_WIDER: Final = 1.6
_WIDEST: Final = 12.0
_LEAD_WIDTH: Final = 2.5
_TAB_WIDTH: Final = 4.5
_THREAD: Final = 17.0  # radius of the disc that has the number
_AXES: Final = 60.0  # labels of the X axis above the legend
_ABOVE: Final = 32.0  # the number of a figure above the middle of the disc
_UNCUT_WIDTH: Final = 2.5
_CROWDED: Final = 60  # figures; of more, the discs are smaller and have no numbers


def draw_plan(sheet: Sheet[AnyCanvas], plan: CutPlan) -> AnyCanvas:
    """Draw a plan; its height follows from the part, from half the width of the sheet to the whole."""
    say = sheet.say
    legend = in_rows(_entries(plan, say), sheet.width_px, sheet.unit)
    legend_box = BESIDE_PLOT._replace(bottom=_AXES + legend.foot / sheet.unit)
    page = page_for(plan_bounds_um(plan), sheet.width_px, legend_box)
    canvas = sheet.page(page.height_px)
    draw_header(canvas, page.unit, plan.drawing.name, _note(plan, say))
    draw_frame(canvas, page)
    _draw_areas(canvas, page, plan)
    draw_axes(canvas, page)
    _draw_ways(canvas, page, plan)
    _draw_order(canvas, page, plan, say)
    draw_at_foot(canvas, legend)
    return canvas


def _note(plan: CutPlan, say: Words) -> str:
    offsets = ", ".join(f"{mm(by):g}" for by in plan.passes_um)
    passes = say("program.passes", passes=offsets) if any(plan.passes_um) else say("program.passes-none")
    figures = getattr(numbered({"figure": len(plan.cuts)}), say.language)
    return f"{say('program.plan-not-run', figures=figures)} · {passes}"


def _draw_areas(canvas: Canvas, page: Page, plan: CutPlan) -> None:
    """Parts and waste, the outer ones below."""
    for cut in sorted(plan.cuts, key=lambda each_cut: each_cut.figure.depth):
        ring = line_px(cut.figure.contour, page.view)
        if len(ring) > 2:
            canvas.polygon(ring, Paint.PART if cut.figure.kind == "outline" else Paint.SLUG)


def _draw_ways(canvas: Canvas, page: Page, plan: CutPlan) -> None:
    """Passes, the later ones on top, their contours, leads and tabs; what is not cut, and the jumps between figures."""
    unit = page.unit
    for uncut in (each for each in plan.uncut if each.why != "frame"):
        ring = line_px(uncut.contour, page.view)
        for line in dashes_along(ring, style.DASH * unit, style.DASH_GAP * unit):
            canvas.polyline(line, _paint_of(plan, uncut), _UNCUT_WIDTH * unit)
    for cut in plan.cuts:
        for number, pass_ in enumerate(cut.passes, start=1):
            width = min(_PASS_WIDTH * _WIDER ** (len(cut.passes) - number), _WIDEST)
            _stroke(canvas, line_px(pass_.along, page.view), paint_of_pass(number), width * unit)
        for each in cut.cut_off:
            _stroke(canvas, line_px(each.along, page.view), Paint.PAUSE, _TAB_WIDTH * unit)
        for pass_ in (*cut.passes, *cut.cut_off):
            for lead in (pass_.into, pass_.out):
                _stroke(canvas, line_px(lead, page.view), Paint.ACTUAL, _LEAD_WIDTH * unit)
        _stroke(canvas, line_px(cut.figure.contour, page.view), Paint.IDEAL, style.IDEAL_WIDTH * unit)
    for faced in plan.facings:
        _stroke(canvas, line_px(faced.upper, page.view), Paint.TOP, style.ACTUAL_WIDTH * unit)
    for places in (each for each in _jumps(plan) if len(each) > 1):
        line = page.view.to_px(np.array(places))
        canvas.dashed(line, Paint.JUMP, style.JUMP_WIDTH * unit, style.DASH * unit, style.DASH_GAP * unit)


def _jumps(plan: CutPlan) -> Iterator[list[Point]]:
    """Ways in the air between figures, those in one go that begin at thread points again: the wire came back to these.

    Each is there but once: in rounds the wire comes the same way again.
    """
    cuts, drawn = plan.cuts, set[frozenset[Point]]()
    places = [cuts[plan.visits[0].cut].thread.place_um]
    for before, visit in pairwise(plan.visits):
        if not visit.is_threaded:
            continue
        last = before.passes_of(cuts[before.cut])[-1]
        end, thread = Point(*joined([last.along, last.out]).end_um[-1].tolist()), cuts[before.cut].thread.place_um
        begin = thread if math.dist(end, thread) <= _BACK_UM else end
        to = cuts[visit.cut].thread.place_um
        if places[-1] != begin or {begin, to} in drawn:
            yield places
            places = [begin]
        if {begin, to} in drawn:
            places = [to]
        else:
            drawn.add(frozenset((begin, to)))
            places.append(to)
    yield places


def _paint_of(plan: CutPlan, uncut: Uncut) -> Paint:
    return Paint.WARNING if plan.is_to_check(uncut.why) else Paint.GREY


def _draw_order(canvas: Canvas, page: Page, plan: CutPlan, say: Words) -> None:
    """Which way each figure is run, and where the wire is threaded, with the number of its turn."""
    is_crowded = len(plan.cuts) > _CROWDED
    is_other = not is_crowded and not _is_by_number(plan)
    for turn, cut in enumerate(plan.cuts, start=1):
        heading = heading_px(cut, page.view)
        if heading is not None:
            canvas.arrow(heading.tip, heading.ahead, style.ARROW * page.unit, Paint.IDEAL)
        place = page.view.to_px(np.array(cut.thread.place_um))
        _draw_thread(canvas, place, "" if is_crowded else str(turn), page.unit * (0.4 if is_crowded else 1.0))
        if is_other:
            _draw_number(canvas, place, say("program.plan-number", number=cut.figure.number), page.unit)


def _is_by_number(plan: CutPlan) -> bool:
    """Whether each figure's turn is its number, which `--order` takes."""
    return all(cut.figure.number == turn for turn, cut in enumerate(plan.cuts, start=1))


def _draw_number(canvas: Canvas, place: Floats, text: str, unit: float) -> None:
    """The number of a figure, above its thread point."""
    at = (float(place[0]), float(place[1]) - _ABOVE * unit)
    canvas.text(at, text, style.NUMBER * unit, Paint.INK, align=0.5)


def _draw_thread(canvas: Canvas, place: Floats, text: str, unit: float) -> None:
    canvas.disc(place, _THREAD * unit, Paint.START)
    if text:
        size = style.NUMBER * unit * min(1.0, 2.4 / len(text))
        canvas.text((float(place[0]), float(place[1])), text, size, Paint.PAGE, align=0.5)


def _stroke(canvas: Canvas, line: Floats, paint: Paint, width: float) -> None:
    if len(line):
        canvas.polyline(line, paint, width)


def _entries(plan: CutPlan, say: Words) -> list[Entry]:
    """What a legend explains, of what is there."""
    kinds = {cut.figure.kind for cut in plan.cuts}
    found = (
        ("outline" in kinds, Entry(swatch(Paint.PART, Paint.PART_EDGE, style.EDGE_WIDTH), say("cut.part"))),
        ("hole" in kinds, Entry(swatch(Paint.SLUG, Paint.SLUG_EDGE, style.EDGE_WIDTH), say("program.plan-waste"))),
        (True, Entry(stroke(Paint.IDEAL, style.IDEAL_WIDTH), say("program.plan-contour"))),
        (bool(plan.facings), Entry(stroke(Paint.TOP, style.ACTUAL_WIDTH), say("taper.upper-contour"))),
        *((True, entry) for entry in _pass_entries(plan.cuts, say)),
        *(
            (any(_paint_of(plan, uncut) is paint for uncut in plan.uncut), Entry(dashes(paint, _UNCUT_WIDTH), say(key)))
            for paint, key in ((Paint.GREY, "program.plan-not-picked"), (Paint.WARNING, "program.plan-uncut"))
        ),
        (any(map(_has_leads, plan.cuts)), Entry(stroke(Paint.ACTUAL, _LEAD_WIDTH), say("program.plan-lead"))),
        (any(cut.cut_off for cut in plan.cuts), Entry(stroke(Paint.PAUSE, _TAB_WIDTH), say("program.plan-tab"))),
        (len(plan.cuts) > 1, Entry(dashes(Paint.JUMP, style.JUMP_WIDTH), say("cut.jump"))),
        (True, Entry(_arrow, say("cut.direction"))),
        (True, Entry(_thread, say("program.plan-thread"))),
    )
    return [entry for is_there, entry in found if is_there]


def _pass_entries(cuts: tuple[FigureCut, ...], say: Words) -> list[Entry]:
    """The passes by their numbers, with their offsets where these are the same for all figures."""
    entries = []
    for number in range(1, min(max(len(cut.passes) for cut in cuts), len(TONES)) + 1):
        offsets = sorted({cut.passes[number - 1].by_um for cut in cuts if len(cut.passes) >= number})
        by = "–".join(f"{mm(fromkey):.3f}" for fromkey in dict.fromkeys((offsets[0], offsets[-1])))
        name = say("cut.pass", name=bilingual("phrases.one-pass", number=number), by=by)
        entries.append(Entry(stroke(paint_of_pass(number), _PASS_WIDTH), name))
    return entries


def _has_leads(cut: FigureCut) -> bool:
    return any(len(pass_.into) or len(pass_.out) for pass_ in cut.passes)


def _arrow(canvas: Canvas, box: Box, unit: float) -> None:
    size, ahead = style.ARROW * unit, np.array([1.0, 0.0])
    canvas.polyline(across(box), Paint.IDEAL, style.IDEAL_WIDTH * unit)
    canvas.arrow(middle(box) + ahead * size / 2, ahead, size, Paint.IDEAL)


def _thread(canvas: Canvas, box: Box, unit: float) -> None:
    _draw_thread(canvas, middle(box), "1", 0.85 * unit)


PLAN: Final = "plan"


class PlanShown(NamedTuple):
    """A plan of which `PLAN` is to be drawn; see `sim.show.pictures.files.Drawable`."""

    plan: CutPlan

    def title_in(self, language: Language) -> str:
        """Name of the drawing, the same in each language."""
        return self.plan.drawing.name

    def least_px(self, name: str) -> int:
        """How narrow the picture can be."""
        return style.LEAST_WIDTH

    def draw(self, name: str, sheet: Sheet[AnyCanvas]) -> AnyCanvas:
        """The page, drawn."""
        return draw_plan(sheet, self.plan)
