"""Drawings as DXF files, made with ezdxf, for the tests of what reads them."""

from collections.abc import Callable, Sequence
from pathlib import Path

import ezdxf
import numpy as np
import shapely
from ezdxf.document import Drawing as Document
from ezdxf.layouts import Modelspace

from parser.geometry.curves import Curves, Floats

VERSIONS = ("R12", "R2000", "R2004", "R2007", "R2010", "R2013", "R2018")
MM = 4
"""$INSUNITS of mm."""


def new(version: str = "R2010", units: int = MM) -> Document:
    return ezdxf.new(version, units=units)


def saved(document: Document, folder: Path, name: str = "part.dxf", fmt: str = "asc") -> Path:
    path = folder / name
    document.saveas(path, fmt=fmt)
    return path


def drawn(folder: Path, draw: Callable[[Modelspace], object], version: str = "R2010") -> Path:
    """A file of what `draw` adds to the model space."""
    document = new(version)
    draw(document.modelspace())
    return saved(document, folder)


def every_entity(document: Document) -> None:
    """One of each entity that is read, in different places, some in blocks and mirrored."""
    space = document.modelspace()
    space.add_line((0, 0), (10, 0))
    space.add_arc((5, 5), 3, 30, 200)
    space.add_circle((20, 5), 4)
    space.add_polyline2d([(0, 20, 0.5), (10, 20, -0.3), (10, 30, 0)], format="xyb", close=True)
    space.add_polyline3d([(30, 20, 0), (40, 20, 0), (40, 25, 0)])
    block = document.blocks.new("TAB", base_point=(1, 0))
    block.add_line((0, 0), (5, 0))
    block.add_arc((0, 0), 5, 0, 90)
    space.add_blockref("TAB", (60, 0), dxfattribs={"rotation": 30, "xscale": -2, "yscale": 2})
    if document.dxfversion > "AC1009":
        space.add_lwpolyline([(0, 40, 1.0), (10, 40, 0.2), (10, 50, 0)], format="xyb", close=True)
        space.add_ellipse((30, 45), major_axis=(6, 2), ratio=0.4)
        space.add_spline([(40, 40), (45, 50), (50, 40), (55, 48)])


def points_on(curves: Curves, number: int = 64) -> Floats:
    """Places (n·number, 2) µm on the curves, ends included."""
    share = np.linspace(0.0, 1.0, number)[None, :]
    angle = curves.start_angle_rad[:, None] + share * curves.sweep_rad[:, None]
    out = curves.radius_um[:, None, None] * np.stack([np.cos(angle), np.sin(angle)], axis=2)
    by = (curves.end_um - curves.start_um)[:, None, :] * share[:, :, None]
    on = np.where(curves.is_arc[:, None, None], curves.center_um[:, None, :] + out, curves.start_um[:, None, :] + by)
    return on.reshape(-1, 2)


def polylines(curves: Curves) -> list[Floats]:
    """Places (m, 2) µm along each curve; arcs in steps of 0.003 rad and less."""
    return [
        points_on(curves.picked(slice(row, row + 1)), 2048 if arc else 2)
        for row, arc in enumerate(curves.is_arc.tolist())
    ]


def farthest_um(places: Floats, from_places: Sequence[Floats]) -> float:
    """Largest distance of places (k, 2) from the nearest of polylines through rows of places (m, 2)."""
    ends = [np.stack([line[:-1], line[1:]], axis=1) for line in from_places]
    tree = shapely.STRtree(shapely.linestrings(np.concatenate(ends)))
    _, distance = tree.query_nearest(shapely.points(places), return_distance=True, all_matches=False)
    return float(distance.max())
