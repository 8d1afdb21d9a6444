"""The pieces that a cut frees, as filled areas, and what is written on them.

It is loaded where pieces are known: a path by itself is drawn without shapely, which comes with the extra ``run``.
"""

from collections.abc import Iterator
from itertools import chain
from typing import Final, NamedTuple

import numpy as np
import shapely

from parser.geometry.curves import Floats
from parser.toolpath import Toolpath
from sim.cut.pieces.kept_edges import kept_shapes
from sim.cut.pieces.kinds import Kind
from sim.cut.pieces.pieces import Piece, Pieces
from sim.cut.regions import simpler
from sim.show.draw import style
from sim.show.draw.canvas import Canvas
from sim.show.draw.flatten import CHORD_PX, simplify
from sim.show.draw.layout import Box, View, box_around
from sim.show.draw.letters import text_width
from sim.show.draw.style import Paint
from sim.show.pictures.cut.subject import Board
from sim.show.texts import Words

MOST_LABELS: Final = 40
_TRIES: Final = 9  # places for a label along each side of a piece
_FILLS: Final = {"part": Paint.PART, "slug": Paint.SLUG}
_EDGES: Final = {"part": Paint.PART_EDGE, "slug": Paint.SLUG_EDGE}


class Areas(NamedTuple):
    """Rings on the page, px, each (k, 2) and closed: of each piece with its kind, and of openings in the frame."""

    pieces: list[tuple[Kind, list[Floats]]]
    openings: list[list[Floats]]


def areas_of(pieces: Pieces, view: View) -> Areas:
    """What comes free, and the openings that slugs leave in the frame, in a view."""
    openings = [shape.outline_um for shape in kept_shapes(pieces) if shape.what == "opening"]
    return Areas(
        [(piece.kind, _rings_px(piece.outline_um, view)) for piece in pieces.freed],
        [_rings_px(opening, view) for opening in openings],
    )


def draw_areas(canvas: Canvas, unit: float, areas: Areas) -> None:
    """Fill what comes free, and draw its edges and those of the openings."""
    width = style.EDGE_WIDTH * unit
    for kind, rings in areas.pieces:
        if rings:
            canvas.region(rings, _FILLS[kind])
        for ring in rings:
            canvas.polyline(ring, _EDGES[kind], width)
    for ring in chain.from_iterable(areas.openings):
        canvas.polyline(ring, Paint.PART_EDGE, width)


def _rings_px(polygon: shapely.Polygon, view: View) -> list[Floats]:
    """Outline and holes on the page, each closed; none that could not be seen."""
    rings = (polygon.exterior, *polygon.interiors)
    drawn = [simplify(view.to_px(shapely.get_coordinates(ring)), CHORD_PX) for ring in rings]
    return [ring for ring in drawn if len(ring) > 2]


def draw_labels(board: Board, toolpath: Toolpath, pieces: Pieces) -> None:
    """Write on pieces what they are, their area, and which block frees them, as far as there is room."""
    largest = sorted(pieces.freed, key=lambda piece: -piece.area_mm2)[:MOST_LABELS]
    for piece in largest:
        _label(board, list(_texts(board.say, toolpath, piece)), piece.outline_um)


def _label(board: Board, choices: list[list[str]], outline_um: shapely.Polygon) -> None:
    """Write the first of some texts that finds its place."""
    canvas, page = board.canvas, board.page
    size = style.SIZE * page.unit
    polygon = simpler(outline_um, 0.5 / page.view.px_per_um)
    places = _places(polygon, page.view)
    for lines in choices:
        wide = max(text_width(line, size) for line in lines) + size
        box = board.room.take_clear(_within(polygon, page.view, places, (wide, _tall(lines, size))))
        if box:
            _write(canvas, box, lines, size)
            return


def _texts(say: Words, toolpath: Toolpath, piece: Piece) -> Iterator[list[str]]:
    """What may be written on a piece, most first."""
    what, area = say(f"cut.{piece.kind}"), area_text(piece.area_mm2)
    block = toolpath.source.names.at(piece.freed.block)
    yield [what, area, say("cut.freed", block=block)]
    yield [what, area]
    yield [f"{what} {area}"]
    yield [what]


def area_text(area_mm2: float) -> str:
    """An area with four digits or more, such as ``12.35 mm²``."""
    decimals = int(np.clip(3 - np.floor(np.log10(max(area_mm2, 1e-3))), 0, 3))
    return f"{area_mm2:,.{decimals}f} mm²"


def _tall(lines: list[str], size: float) -> float:
    return (len(lines) * style.LINE_STEP + 0.4) * size


def _places(polygon: shapely.Polygon, view: View) -> Floats:
    """Places (n, 2) px for the middle of a label: a grid over the piece, those nearest to its middle first."""
    low, high = np.reshape(polygon.bounds, (2, 2))
    share = (np.arange(_TRIES) + 0.5) / _TRIES
    grid = np.stack(np.meshgrid(*(low + share[:, None] * (high - low)).T), axis=-1).reshape(-1, 2)
    middle = shapely.get_coordinates([polygon.centroid, polygon.representative_point()])
    order = np.argsort(np.hypot(*(grid - middle[0]).T), kind="stable")
    return view.to_px(np.concatenate([middle, grid[order]]))


def _within(polygon: shapely.Polygon, view: View, places: Floats, size: tuple[float, float]) -> list[Box]:
    """Boxes of a size around places that lie wholly in a piece."""
    boxes = [box_around(place, *size) for place in places]
    sides = view.to_um(np.array(boxes).reshape(-1, 2, 2)).reshape(-1, 4).T
    shapely.prepare(polygon)
    inside = np.asarray(shapely.contains(polygon, shapely.box(*sides)))
    return [boxes[at] for at in np.flatnonzero(inside).tolist()]


def _write(canvas: Canvas, box: Box, lines: list[str], size: float) -> None:
    middle, step = (box.left + box.right) / 2, style.LINE_STEP * size
    top = (box.top + box.bottom - len(lines) * step) / 2
    for at, line in enumerate(lines):
        canvas.text((middle, top + (at + 0.5) * step), line, size, Paint.INK, align=0.5)
