"""The worst places of a cut close up, down to the single steps, with a map of where they lie.

The worst places: where the wire is furthest off, no two of them in one view.
"""

from itertools import product
from typing import Final, NamedTuple

import numpy as np

from controller.stepping.pulses import Pulses
from parser.geometry.curves import Floats, Ints
from parser.toolpath import Toolpath
from parser.units import mm
from sim.show.draw import style
from sim.show.draw.canvas import Canvas
from sim.show.draw.flatten import CHORD_PX, bounds_um, cut_runs, flatten, simplify
from sim.show.draw.layout import Box, Ink, Room, View, box_around, centred
from sim.show.draw.legend import draw_at_foot, in_rows
from sim.show.draw.sheet import AnyCanvas, Sheet
from sim.show.draw.style import Paint
from sim.show.pictures.deviation.frame import Samples, titled, write_caption
from sim.show.pictures.deviation.insets import draw_inset, grid_um, inset_entries, inset_of, view_of
from sim.show.texts import Words
from sim.show.texts.phrases import lasting

MOST: Final = 4
APART_UM: Final = 80.0
"""No two places are closer together than this: a view is smaller."""
APART_OF_SIZE: Final = 0.05
"""While enough places keep it, no two are closer than this share of the path's longer side."""
STRETCH_UM: Final = 200.0
"""The worst place of each stretch of this length is a candidate, after the worst places of the blocks."""
CANDIDATES: Final = 1000
LEAST_UM: Final = 0.05
"""Places where the wire is off by less do not show, but for the worst one."""


def worst_places(samples: Samples) -> Ints:
    """Samples (≤ `MOST`,) of the worst places, the worst first: of different blocks while there are others.

    Empty where nothing was cut.
    """
    cut = np.flatnonzero(samples.cutting)
    of_blocks = worst_of(samples, cut, samples.trace.row[cut])
    of_stretches = worst_of(samples, cut, np.floor(samples.along_um[cut] / STRETCH_UM).astype(np.int64))
    candidates = [*of_blocks[:CANDIDATES].tolist(), *of_stretches[:CANDIDATES].tolist()]
    low, high = bounds_um(samples.run.toolpath)
    taken: list[int] = []
    for apart, at in product((max(APART_OF_SIZE * float((high - low).max()), APART_UM), APART_UM), candidates):
        if len(taken) < MOST and _clear(samples, taken, at, apart):
            taken.append(at)
    off = np.abs(samples.wire_um[taken])
    return np.array(taken, dtype=np.int64)[np.argsort(-off, kind="stable")]


def worst_of(samples: Samples, chosen: Ints, group: Ints) -> Ints:
    """Of samples (m,) in groups (m,), which never fall, the worst of each group: its first one; the worst first."""
    off = np.abs(samples.wire_um[chosen])
    first = np.flatnonzero(np.diff(group, prepend=-1))
    worst = np.maximum.reduceat(off, first) if len(first) else off
    among = np.flatnonzero(off == np.repeat(worst, np.diff(first, append=len(off))))
    best = among[np.flatnonzero(np.diff(group[among], prepend=-1))]
    return chosen[best[np.argsort(-off[best], kind="stable")]]


def _clear(samples: Samples, taken: list[int], at: int, apart_um: float) -> bool:
    """Whether a sample is the first, or the wire is off there and it stands apart from those taken."""
    if not taken:
        return True
    by = samples.trace.wire_um[taken] - samples.trace.wire_um[at]
    return bool(abs(samples.wire_um[at]) >= LEAST_UM and np.hypot(by[:, 0], by[:, 1]).min() >= apart_um)


MAP: Final = 0.24
"""Width of the key map, of the page's."""
GAP: Final = 26.0
CAPTION: Final = 72.0
PAD: Final = 44.0
"""Free border of the key map, room for its numbers."""
BADGE: Final = 17.0
DOT: Final = 5.0
"""Radii of the disc behind a number, and of the dot at its place."""
AWAY: Final = (30.0, 50.0, 80.0, 120.0)
"""How far from its place a number may stand."""
ANGLES: Final = tuple(np.radians([45.0, 135.0, 225.0, 315.0, 0.0, 90.0, 180.0, 270.0]).tolist())


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
    legend = in_rows(inset_entries(say, bows=bows), sheet.width_px, unit)
    canvas = titled(sheet, samples, say("deviation.worst"), cells.bottom + legend.foot + 0.3 * GAP * unit)
    for number, (box, inset) in enumerate(zip(cells.insets, insets, strict=True), start=1):
        above = Box(box.left, box.top - CAPTION * unit, box.right, box.top)
        draw_badge(canvas, np.array([box.left + BADGE * unit, (above.top + above.bottom) / 2.0]), number, unit)
        side_box = above._replace(left=box.left + 2.6 * BADGE * unit)
        grid = grid_um(view_of(box, inset), unit)
        write_caption(canvas, side_box, _caption(say, samples, inset.at, grid), unit)
        draw_inset(canvas, box, inset, unit)
    places = np.array([inset.foot_um for inset in insets]).reshape(-1, 2)
    draw_key_map(canvas, cells.key_map, samples.run.toolpath, places, unit)
    name = (cells.key_map.left, cells.key_map.top - 0.3 * CAPTION * unit)
    canvas.text(name, say("deviation.key_map"), style.TEXT * unit, Paint.INK)
    draw_at_foot(canvas, legend)
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
    return f"{say('common.block', number=samples.block_name(at))} · {getattr(lasting(where.t_s), say.language)}", say(
        "deviation.place", x=x, y=y, grid=f"{grid:g}"
    )


def draw_key_map(canvas: Canvas, box: Box, toolpath: Toolpath, places_um: Floats, unit: float) -> None:
    """Draw the path small into a box, with numbers from 1 at places (k, 2)."""
    view = _view(box, bounds_um(toolpath), PAD * unit)
    canvas.box(box, Paint.PAGE, Paint.FRAME, style.GRID_WIDTH * unit)
    points_um, row = flatten(toolpath, CHORD_PX / view.px_per_um)
    runs = [simplify(view.to_px(run), CHORD_PX) for run in cut_runs(points_um, row, toolpath.is_jump)]
    for run in runs:
        canvas.polyline(run, Paint.IDEAL, style.IDEAL_WIDTH * unit)
    room = Room(box, Ink(runs, canvas.width_px, canvas.height_px), [])
    for number, place in enumerate(view.to_px(places_um), start=1):
        _draw_number(canvas, room, place, number, unit)


def _view(box: Box, bounds: Floats, pad: float) -> View:
    wide, tall = np.maximum(bounds[1] - bounds[0], 1.0).tolist()
    scale = min((box.right - box.left - 2.0 * pad) / wide, (box.bottom - box.top - 2.0 * pad) / tall)
    return centred(bounds.mean(axis=0), scale, box)


def _draw_number(canvas: Canvas, room: Room, place: Floats, number: int, unit: float) -> None:
    """Draw a dot at a place and its number near it, where it covers neither another one nor, if it can, the path."""
    ways = [np.array([np.cos(angle), np.sin(angle)]) for angle in ANGLES]
    side = 2.0 * BADGE * unit
    tries = [box_around(place + away * unit * way, side, side) for away, way in product(AWAY, ways)]
    found = room.take(tries)
    canvas.disc(place, DOT * unit, Paint.ERROR)
    if found is None:
        return
    at = np.array([(found.left + found.right) / 2.0, (found.top + found.bottom) / 2.0])
    canvas.polyline(np.stack([place, at]), Paint.ERROR, style.GRID_WIDTH * 1.5 * unit)
    draw_badge(canvas, at, number, unit)


def draw_badge(canvas: Canvas, at: Floats, number: int, unit: float) -> None:
    """Draw the number of a place in a disc."""
    canvas.disc(at, BADGE * unit, Paint.ERROR)
    canvas.text((float(at[0]), float(at[1])), str(number), style.TEXT * unit, Paint.PAGE, align=0.5)
