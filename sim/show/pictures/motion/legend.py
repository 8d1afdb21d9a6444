"""The legend below the panels: the curves of both axes, and the signs on the time axis."""

from functools import partial
from typing import Final

import numpy as np

from parser.told.step_words import Axis
from sim.run.dryrun import DryRun
from sim.show.draw import style
from sim.show.draw.canvas import Canvas
from sim.show.draw.chart import AxisRange, Chart
from sim.show.draw.labels import number_stride
from sim.show.draw.layout import Box
from sim.show.draw.legend import Entry, Legend, LegendSizes, in_rows, middle
from sim.show.draw.letters import Letters
from sim.show.draw.paints import Paint
from sim.show.pictures.motion.curves import draw_envelope
from sim.show.pictures.motion.events import BAND, TimeMark, draw_pass
from sim.show.words import Words
from sim.table.record.bins import Envelope

SIZES: Final = LegendSizes(apart=40.0)
CURVE_HEIGHT: Final = 0.72
"""Height of the sample of a curve, of its row."""


def legend_of(run: DryRun, marks: list[TimeMark], say: Words, width_px: int, unit: float) -> Legend:
    """The legend on a page of a width."""
    stride = number_stride(len(run.toolpath))
    number = say({1: "motion.number", 2: "motion.number_2"}.get(stride, "motion.number_every"), stride=stride)
    entries = [
        *(Entry(partial(_draw_curve, axis), say("motion.axis", axis=axis.name)) for axis in (Axis.X, Axis.Y)),
        Entry(partial(_draw_sign, "12", Paint.GREY), number),
        *([Entry(_draw_pass, say("motion.pass"))] if run.has_trims else []),
        *(Entry(partial(_draw_sign, *looks), say(name), _share(looks[0], unit)) for name, looks in _kinds(marks)),
    ]
    return in_rows(entries, width_px, unit, SIZES)


def _share(sign: str, unit: float) -> float:
    """Width of the sample of a sign, of the usual one: no less than that."""
    return max(1.0, Letters().width(sign, style.NUMBER * unit) / (SIZES.sample * unit))


def _kinds(marks: list[TimeMark]) -> list[tuple[str, tuple[str, Paint]]]:
    """Kinds of marks by their names, each with the sign and the paint of the first."""
    first = {mark.name: mark for mark in reversed(marks)}
    return [(name, (first[name].sign, first[name].paint)) for name in sorted(first)]


def _draw_curve(axis: Axis, canvas: Canvas, box: Box, unit: float) -> None:
    free = (1.0 - CURVE_HEIGHT) / 2.0 * (box.bottom - box.top)
    frame = box._replace(top=box.top + free, bottom=box.bottom - free)
    chart = Chart(frame, AxisRange(0.0, 1.0), AxisRange(-1.0, 1.0), unit)
    ones = np.ones((1, 2))
    draw_envelope(canvas, chart, np.array([0.0, 1.0]), Envelope(-ones, ones, 0.0 * ones), [axis])


def _draw_pass(canvas: Canvas, box: Box, unit: float) -> None:
    free = (box.bottom - box.top - BAND * unit) / 2.0
    draw_pass(canvas, box._replace(top=box.top + free, bottom=box.bottom - free), 1, style.NUMBER * unit)


def _draw_sign(text: str, paint: Paint, canvas: Canvas, box: Box, unit: float) -> None:
    x, y = middle(box).tolist()
    canvas.text((x, y), text, style.NUMBER * unit, paint, align=0.5)
