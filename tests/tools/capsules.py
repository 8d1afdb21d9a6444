"""Offsets with shapely as the judge: what lies within f of each curve, as polygons with fine chords, put together.

`shapely.buffer` thins out its input by up to 1 % of the distance; capsules, each of one line or arc, need no buffer.
"""

import math

import numpy as np
import shapely
from drawings import Line
from paths import Pen
from shapely.geometry import Polygon
from shapely.geometry.base import BaseGeometry
from sound_cam import drawn_sweep
from sound_shapes import Shape

from parser.geometry.curves import Curves, Floats

CHORD_UM = 0.01
"""Chords of arcs lie no farther than this from them."""


def contour_of(shape: Shape) -> Curves:
    pen = Pen(*shape.start)
    for move in shape.moves:
        if isinstance(move, Line):
            pen.to(*move.to)
        else:
            pen.arc(*move.center, move.turn * drawn_sweep((pen.x, pen.y), move))
    return pen.path().picked(slice(None))


def round_about(center: Floats, radius: float, start: float, sweep: float) -> Floats:
    """Places on an arc; the chords lie inside of it."""
    step = 2.0 * math.acos(max(1.0 - CHORD_UM / max(radius, CHORD_UM), 0.0))
    angle = start + sweep * np.linspace(0.0, 1.0, max(2, math.ceil(abs(sweep) / step) + 1))
    return center + radius * np.stack([np.cos(angle), np.sin(angle)], axis=1)


def flattened(curves: Curves) -> Floats:
    """Vertices (m, 2) of closed curves with fine chords."""
    parts = []
    for row in range(len(curves)):
        if curves.is_arc[row]:
            arc = curves.center_um[row], curves.radius_um[row], curves.start_angle_rad[row], curves.sweep_rad[row]
            parts.append(round_about(*arc)[:-1])
        else:
            parts.append(curves.start_um[row : row + 1])
    return np.concatenate(parts)


def capsules(curves: Curves, f: float) -> list[Polygon]:
    """What lies within f of each line, arc and joint."""
    made = []
    for row in range(len(curves)):
        made.append(Polygon(round_about(curves.start_um[row], f, 0.0, 2.0 * math.pi)))
        if curves.is_arc[row]:
            center, radius = curves.center_um[row], curves.radius_um[row]
            start, sweep = curves.start_angle_rad[row], curves.sweep_rad[row]
            for half in range(4):  # quarters: no sector closes upon itself
                part = start + half * sweep / 4.0, sweep / 4.0
                outer, inner = (round_about(center, max(r, 0.0), *part) for r in (radius + f, radius - f))
                made.append(Polygon(np.concatenate([outer, inner[::-1]])))
        else:
            by = curves.end_um[row] - curves.start_um[row]
            across = f * np.array([-by[1], by[0]]) / math.hypot(*by)
            start, end = curves.start_um[row], curves.end_um[row]
            made.append(Polygon([start + across, end + across, end - across, start - across]))
    return made


def judged(curves: Curves, f: float, inside: bool) -> BaseGeometry:
    """What lies f and more from a counter-clockwise contour, inside of it; or, outside, all that does not."""
    within = shapely.union_all(capsules(curves, f), grid_size=1e-4)
    part = Polygon(flattened(curves))
    return part.difference(within) if inside else part.union(within)
