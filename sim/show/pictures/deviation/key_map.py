"""The key map: where on the part some numbered places lie."""

from itertools import product
from typing import Final

import numpy as np

from parser.geometry.curves import Floats
from parser.toolpath import Toolpath
from sim.show.draw import style
from sim.show.draw.canvas import Canvas
from sim.show.draw.chart import CHORD_PX
from sim.show.draw.flatten import bounds_um, cut_runs, flatten
from sim.show.draw.labels import Ink, Room
from sim.show.draw.layout import Box, View, box_around
from sim.show.draw.paints import Paint
from sim.show.draw.simplify import simplify

PAD: Final = 44.0
"""Free border, room for the numbers."""
BADGE: Final = 17.0
DOT: Final = 5.0
AWAY: Final = (30.0, 50.0, 80.0, 120.0)
"""How far from its place a number may stand."""
ANGLES: Final = tuple(np.radians([45.0, 135.0, 225.0, 315.0, 0.0, 90.0, 180.0, 270.0]).tolist())


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


def draw_badge(canvas: Canvas, at: Floats, number: int, unit: float) -> None:
    """Draw the number of a place in a disc."""
    canvas.disc(at, BADGE * unit, Paint.ERROR)
    canvas.text((float(at[0]), float(at[1])), str(number), style.TEXT * unit, Paint.PAGE, align=0.5)


def _view(box: Box, bounds: Floats, pad: float) -> View:
    wide, tall = np.maximum(bounds[1] - bounds[0], 1.0).tolist()
    scale = min((box.right - box.left - 2.0 * pad) / wide, (box.bottom - box.top - 2.0 * pad) / tall)
    x, y = (bounds.mean(axis=0) * scale).tolist()
    return View(scale, (box.left + box.right) / 2.0 - x, (box.top + box.bottom) / 2.0 + y)


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
