"""Parts of a drawing: closed loops by how deep they lie within each other."""

import numpy as np

from parser.drawing.model import Drawing, DrawnLoop, Entity, LeftOut, running
from parser.geometry.curves import Bools, Curves, Floats
from parser.toolpath import Point
from sim.cam.model import CannotCutError, Figure, Parts, Refusal
from sim.cam.parts.inside import is_inside


def parts_of(drawing: Drawing) -> Parts:
    """Figures of the closed loops of a drawing; open ones are left out. CannotCutError where none is closed."""
    closed = [loop for loop in drawing.loops if loop.closed]
    if not closed:
        raise CannotCutError(Refusal("no-contour", _ends(drawing)))
    contours = [_contour(drawing, loop) for loop in closed]
    within = _within(contours)
    depth = within.sum(axis=0)
    outlines = np.flatnonzero(depth % 2 == 0)
    part = np.full(len(closed), 0)
    part[outlines] = np.arange(1, len(outlines) + 1)
    for hole in np.flatnonzero(depth % 2 == 1).tolist():
        around = np.flatnonzero(within[:, hole] & (depth == depth[hole] - 1))
        part[hole] = part[around[0]]
    figures = tuple(
        Figure(
            number=at + 1,
            kind="hole" if depth[at] % 2 else "outline",
            part=int(part[at]),
            depth=int(depth[at]),
            contour=contour,
            entity=drawing.entity[loop.row],
            layer=_entity(drawing, loop).layer,
            runs_inside=bool(depth[at] % 2),
        )
        for at, (loop, contour) in enumerate(zip(closed, contours, strict=True))
    )
    return Parts(figures, (*drawing.left_out, *_open(drawing)), ())


def _contour(drawing: Drawing, loop: DrawnLoop) -> Curves:
    return running(drawing.curves, loop.row, loop.backwards)


def _within(contours: list[Curves]) -> Bools:
    """(k, k) whether a contour lies around another."""
    places = np.array([contour.start_um[0] for contour in contours])
    within = np.stack([is_inside(contour, places) for contour in contours])
    np.fill_diagonal(within, val=False)
    return within


def _open(drawing: Drawing) -> tuple[LeftOut, ...]:
    """Open loops, each by its first entity."""
    loops = [loop for loop in drawing.loops if not loop.closed]
    return tuple(LeftOut(_entity(drawing, loop), "open", _xy(_start(drawing, loop))) for loop in loops)


def _entity(drawing: Drawing, loop: DrawnLoop) -> Entity:
    return drawing.entities[int(drawing.entity[loop.row[0]])]


def _start(drawing: Drawing, loop: DrawnLoop) -> Floats:
    start: Floats = running(drawing.curves, loop.row[:1], loop.backwards[:1]).start_um[0]
    return start


def _ends(drawing: Drawing) -> tuple[Point, ...]:
    return tuple(Point(*_xy(_start(drawing, loop))) for loop in drawing.loops)


def _xy(place: Floats) -> tuple[float, float]:
    return float(place[0]), float(place[1])
