"""Deviation of every sample of a cut, and what the pictures of it share: title, marks, scale.

Deviation of every sample of a cut, left of the path positive: the numbers that the pictures of deviation show.

What the pictures of deviation share: title and figures above them, marks and captions, scale and texts.
"""

from dataclasses import dataclass
from typing import Final

import numpy as np

from parser.geometry.curves import Bools, Floats
from sim.measure.deviation import Where, across, across_um, farthest
from sim.run.dryrun import DryRun
from sim.setup.part import DEFAULT_TOLERANCE_UM
from sim.show.draw import style
from sim.show.draw.canvas import Canvas
from sim.show.draw.chart import AxisRange, Chart, range_of
from sim.show.draw.layout import Box
from sim.show.draw.legend import draw_header, elide
from sim.show.draw.letters import text_width
from sim.show.draw.sheet import AnyCanvas, Sheet
from sim.show.draw.style import Paint
from sim.show.texts import Words
from sim.table.trace import Trace


@dataclass(frozen=True, slots=True, eq=False)
class Samples:
    """Deviations at the n ≥ 1 samples of a run's trace, as far as the machine ran.

    They are the distances that the report sums up, left of the direction of travel positive.

    Attributes
    ----------
    run
        The run.
    trace
        Its trace, up to a trip where there was one.
    along_um
        (n,) float64, path length that was planned by each sample, jumps included; never falling.
    cutting
        (n,) whether the wire was cutting, not on a jump.
    steps_um, table_um, wire_um
        (n,) float64, deviation of the place commanded, of the table and of the wire.
    foot_um
        (n, 2) float64, places on the path that the deviation of the wire is measured from.
    """

    run: DryRun
    trace: Trace
    along_um: Floats
    cutting: Bools
    steps_um: Floats
    table_um: Floats
    wire_um: Floats
    foot_um: Floats

    def __len__(self) -> int:
        return len(self.along_um)

    @property
    def tolerance_um(self) -> float:
        """What the cut is held to: the tolerance of its drawing, or of a first cut."""
        drawing = self.run.scenario.drawing
        return DEFAULT_TOLERANCE_UM if drawing is None else drawing.tolerance_um

    @property
    def worst(self) -> int | None:
        """Sample of the wire's largest deviation in the cut; None where nothing was cut."""
        off = np.where(self.cutting, np.abs(self.wire_um), -1.0)
        at = farthest(off)
        return at if off[at] >= 0.0 else None

    @property
    def max_um(self) -> float:
        """The wire's largest deviation in the cut."""
        return float(np.abs(self.wire_um[self.cutting]).max(initial=0.0))

    @property
    def p95_um(self) -> float:
        """95 % of the cut deviate no more than this."""
        off = np.abs(self.wire_um[self.cutting])
        return float(np.quantile(off, 0.95, method="inverted_cdf")) if len(off) else 0.0

    def where(self, at: int) -> Where:
        """Place of the wire at a sample."""
        x, y = self.trace.wire_um[at].tolist()
        return Where(int(self.trace.row[at]) + 1, x, y, float(self.trace.t_s[at]))

    def block_name(self, at: int) -> str:
        """What the block is called that the wire was in at a sample."""
        return self.run.block_names.of_row(int(self.trace.row[at]))


def samples_of(run: DryRun) -> Samples:
    """Deviations of all samples of a run."""
    trace = run.cut
    along = np.asarray(run.plan.at(trace.t_s).along_um)
    wire = across(run.toolpath, trace, trace.wire_um, along)
    bows = trace.wire_um is not trace.table_um
    return Samples(
        run=run,
        trace=trace,
        along_um=along,
        cutting=~run.toolpath.is_jump[trace.row],
        steps_um=across_um(run.toolpath, trace, trace.commanded_um, along),
        table_um=across_um(run.toolpath, trace, trace.table_um, along) if bows else wire.off_um,
        wire_um=wire.off_um,
        foot_um=wire.foot_um,
    )


LEAST_UM: Final = 0.5
SEEN: Final = 0.25
"""The scale reaches to the tolerance if deviations come to this share of it: else it would make them a flat line."""


def titled(sheet: Sheet[AnyCanvas], samples: Samples, title: str, height_px: float, note: str = "") -> AnyCanvas:
    """An empty page with a title, and the figures of the run below it, or another note.

    ValueError where the sheet is narrower than 600 px.
    """
    if sheet.width_px < style.LEAST_WIDTH:
        raise ValueError(f"a picture is at least {style.LEAST_WIDTH} px wide, not {sheet.width_px}")
    canvas = sheet.page(round(height_px))
    scenario = samples.run.scenario.title_in(sheet.language)
    draw_header(canvas, sheet.unit, f"{title} · {scenario}", note or figures_text(sheet.say, samples))
    return canvas


def range_shown(samples: Samples) -> AxisRange:
    """Range of the deviations of wire and steps in the cut, of 0, and of the tolerance where they come near it."""
    values = [samples.wire_um[samples.cutting], samples.steps_um[samples.cutting], np.zeros(1)]
    reached = max(float(np.abs(each).max(initial=0.0)) for each in values)
    if reached >= SEEN * samples.tolerance_um:
        values.append(samples.tolerance_um * np.array([-1.0, 1.0]))
    return range_of(*values, least=LEAST_UM)


def write_names(canvas: Canvas, chart: Chart, x_name: str, y_name: str) -> None:
    """Write the names of the axes inside their ends, on the page's own colour: nothing runs through them."""
    frame, size = chart.frame, style.TICK * chart.unit
    for name, align, y in ((x_name, 1.0, frame.bottom - 0.9 * size), (y_name, 0.0, frame.top + 0.9 * size)):
        wide = text_width(name, size)
        left = frame.left + 0.5 * size if align == 0.0 else frame.right - 0.5 * size - wide
        plate = Box(left - 0.2 * size, y - 0.65 * size, left + wide + 0.2 * size, y + 0.65 * size)
        canvas.box(plate, Paint.PAGE, Paint.PAGE, 0.0)
        canvas.text((left, y), name, size, Paint.GREY)


def mark_place(canvas: Canvas, frame: Box, place: Floats, text: str, unit: float) -> None:
    """Ring a place (2,) px and write beside it, on the side where the frame has more room."""
    canvas.ring(place, style.MARK * unit, Paint.ERROR, style.MARK_WIDTH * unit)
    size, gap = style.TEXT * unit, 2.0 * style.MARK * unit
    wide, (x, y) = text_width(text, size) + 0.8 * size, place.tolist()
    left = x - gap - wide if x > (frame.left + frame.right) / 2.0 else x + gap
    canvas.box(Box(left, y - 0.75 * size, left + wide, y + 0.75 * size), Paint.PAGE, Paint.ERROR, unit)
    canvas.text((left + wide / 2.0, y), text, size, Paint.INK, align=0.5)


def write_caption(canvas: Canvas, box: Box, lines: tuple[str, str], unit: float, *, align: float = 0.0) -> None:
    """Write two lines into a box, the middle of what is too long left out; `align` as that of a text."""
    looks = ((lines[0], style.TEXT, 0.28, Paint.INK), (lines[1], style.NUMBER, 0.72, Paint.GREY))
    for text, size, share, paint in looks:
        line = elide(text, size * unit, box.right - box.left)
        at = box.left + align * (box.right - box.left), box.top + share * (box.bottom - box.top)
        canvas.text(at, line, size * unit, paint, align=align)


def figures_text(say: Words, samples: Samples) -> str:
    """The figures of a run in a line: the largest deviation of its wire, where it was, and what 95 % keep to."""
    at = samples.worst
    if at is None:
        return say("deviation.nothing_cut")
    most = say("deviation.most", most=um(samples.max_um), block=samples.block_name(at))
    return f"{most} · {say('deviation.p95', p95=um(samples.p95_um))}"


def tolerance_text(say: Words, samples: Samples) -> str:
    """What the legend says of the tolerance."""
    key = "deviation.tolerance_default" if samples.run.scenario.drawing is None else "deviation.tolerance"
    return say(key, tolerance=f"{samples.tolerance_um:g}")


def um(length_um: float, *, signed: bool = False) -> str:
    """A deviation in µm: two decimals, fewer where it is large, never −0."""
    decimals = 2 if abs(length_um) < 100.0 else 1
    value = round(length_um, decimals) + 0.0
    return f"{value:{'+' if signed and value else ''},.{decimals}f} µm".replace("-", "−")
