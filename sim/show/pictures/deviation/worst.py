"""The worst places of a cut close up, down to the single steps, with a map of where they lie."""

from typing import Final, NamedTuple

import numpy as np

from controller.stepping.pulses import Pulses
from parser.units import mm
from sim.show.draw import style
from sim.show.draw.layout import Box
from sim.show.draw.paints import Paint
from sim.show.draw.sheet import AnyCanvas, Sheet
from sim.show.pictures.deviation.close_up import (
    IDEAL_WIDTH,
    STEPS_WIDTH,
    TABLE_WIDTH,
    WIRE_WIDTH,
    draw_close_up,
    grid_um,
    view_of,
)
from sim.show.pictures.deviation.frame import Entry, draw_legend, legend_of, stroke, titled, write_caption
from sim.show.pictures.deviation.inset import inset_of
from sim.show.pictures.deviation.key_map import BADGE, draw_badge, draw_key_map
from sim.show.pictures.deviation.places import worst_places
from sim.show.pictures.deviation.samples import Samples
from sim.show.words import Words
from sim.units import clock

MAP: Final = 0.24
"""Width of the key map, of the page's."""
GAP: Final = 26.0
CAPTION: Final = 72.0


class _Cells(NamedTuple):
    """Boxes of the insets and of the key map, and where the last of them ends, px."""

    insets: list[Box]
    key_map: Box
    bottom: float


def draw_worst(sheet: Sheet[AnyCanvas], samples: Samples, steps: Pulses) -> AnyCanvas:
    """Draw up to four of the worst places with the steps around them, `steps` being those of the whole run.

    ValueError where the sheet is narrower than 600 px.
    """
    say, unit = sheet.say, sheet.unit
    insets = [inset_of(samples, steps, at) for at in worst_places(samples).tolist()]
    cells = _cells(len(insets), sheet.width_px, unit)
    bows = samples.trace.wire_um is not samples.trace.table_um
    legend = legend_of(_entries(say, unit, bows=bows), sheet.width_px, unit)
    canvas = titled(sheet, samples, say("deviation.worst"), cells.bottom + legend.height + 0.3 * GAP * unit)
    for number, (box, inset) in enumerate(zip(cells.insets, insets, strict=True), start=1):
        above = Box(box.left, box.top - CAPTION * unit, box.right, box.top)
        draw_badge(canvas, np.array([box.left + BADGE * unit, (above.top + above.bottom) / 2.0]), number, unit)
        beside = above._replace(left=box.left + 2.6 * BADGE * unit)
        grid = grid_um(view_of(box, inset), unit)
        write_caption(canvas, beside, _caption(say, samples, inset.at, grid), unit)
        draw_close_up(canvas, box, inset, unit)
    places = np.array([inset.foot_um for inset in insets]).reshape(-1, 2)
    draw_key_map(canvas, cells.key_map, samples.run.toolpath, places, unit)
    name = (cells.key_map.left, cells.key_map.top - 0.3 * CAPTION * unit)
    canvas.text(name, say("deviation.key_map"), style.TEXT * unit, Paint.INK)
    draw_legend(canvas, legend)
    return canvas


def _cells(number: int, width_px: int, unit: float) -> _Cells:
    """Lay out insets, two in a row where there is more than one, with the key map to the right of them."""
    edge, gap, caption, top = style.EDGE * unit, GAP * unit, CAPTION * unit, style.HEAD * unit
    map_side = MAP * width_px
    free = width_px - 2.0 * edge - map_side - gap
    columns = min(max(number, 1), 2)
    side = min((free - (columns - 1) * gap) / columns, 0.6 * free)
    boxes = []
    for at in range(number):
        left, high = edge + at % 2 * (side + gap), top + at // 2 * (side + caption) + caption
        boxes.append(Box(left, high, left + side, high + side))
    left = edge + columns * (side + gap)
    key_map = Box(left, top + caption, left + map_side, top + caption + map_side)
    return _Cells(boxes, key_map, max(box.bottom for box in [*boxes, key_map]))


def _caption(say: Words, samples: Samples, at: int, grid: float) -> tuple[str, str]:
    """The block of a sample and when it was cut; where it lies, and the grid, µm, of its inset."""
    where = samples.where(at)
    x, y = (f"{mm(value):.3f}".replace("-", "−") for value in (where.x_um, where.y_um))
    return f"{say('common.block', number=where.block)} · {clock(where.t_s)}", say(
        "deviation.place", x=x, y=y, grid=f"{grid:g}"
    )


def _entries(say: Words, unit: float, *, bows: bool) -> list[Entry]:
    looks = [
        (Paint.IDEAL, IDEAL_WIDTH, "deviation.ideal"),
        (Paint.STEPS, STEPS_WIDTH, "deviation.staircase"),
        (Paint.ACTUAL, WIRE_WIDTH, "deviation.wire_samples"),
        *[(Paint.GREY, TABLE_WIDTH, "deviation.table")] * bows,
    ]
    return [Entry(stroke(paint, width * unit), say(key)) for paint, width, key in looks]
