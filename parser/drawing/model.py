"""What a drawing holds once it is read: curves, the entities they come from, and the loops that they form."""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from parser.findings.catalogue import Remark
from parser.findings.errors import DrawingError
from parser.geometry.curves import CurveKind, Curves, Ints
from parser.units import UM_PER_MM

DEFAULT_GAP_UM = 10.0
"""Ends of a drawing this near are joined: more than the rounding of any CAD, less than what anyone draws (assumed)."""
SAME_WITHIN_UM = 1e-3
"""What files lose by printing decimals: places so near are one, curves so short are none, so flat are straight."""
BESIDE_UM = 1.0
"""Curves that run this near beside each other are one drawn twice: a step of a machine, less than any wall is thick."""
DEFAULT_FLATTEN_UM = 0.1
"""How far lines lie off ellipses and splines at most: little beside the 5 µm that a cut is usually held to."""

MOST_CURVES = 300_000
"""Lines and arcs that a drawing becomes, those of ellipses and splines among them."""


class Unit(NamedTuple):
    """A unit of length by its name, and µm in one of it."""

    name: str
    um: float

    @property
    def word(self) -> str:
        """The name as settings have it, in letters that every keyboard has."""
        return "micron" if self.name == "µm" else self.name


_INCH_UM = 25.4 * UM_PER_MM
# Codes as the DXF reference gives them for $INSUNITS.
UNITS = {
    1: Unit("inch", _INCH_UM),
    2: Unit("foot", 12.0 * _INCH_UM),
    4: Unit("mm", UM_PER_MM),
    5: Unit("cm", 10.0 * UM_PER_MM),
    6: Unit("m", 1000.0 * UM_PER_MM),
    8: Unit("microinch", _INCH_UM / 1e6),
    9: Unit("mil", _INCH_UM / 1e3),
    10: Unit("yard", 3.0 * 12.0 * _INCH_UM),
    12: Unit("nm", 1e-3),
    13: Unit("µm", 1.0),
    14: Unit("dm", 100.0 * UM_PER_MM),
}
"""Units of drawings, by their codes in a file."""


class Entity(NamedTuple):
    """An entity of the drawing as it is placed once; one inside a block occurs as often as the block is inserted.

    Attributes
    ----------
    kind
        Its DXF name, such as ``LWPOLYLINE``.
    handle
        Its handle in the file, hexadecimal; files without handles get theirs on reading, in file order.
    layer
        The layer that it is drawn on; for layer 0 inside a block that of the INSERT.
    block
        The block that it belongs to, empty in the model space itself.
    color
        Its colour by the AutoCAD index, that of its layer where it says so; 0 where that is not known.
    """

    kind: str
    handle: str
    layer: str
    block: str
    color: int = 0


class LeftOut(NamedTuple):
    """An entity, or a curve of one, that is no part of any contour, and why.

    Attributes
    ----------
    entity
        The entity.
    why
        Name of a text for people, ``program.left-out-…``: such as ``text``, ``dimension``, ``broken-line``, ``frozen``.
    place_um
        Where it is, so that it can be found; None where it has no place.
    gap_um
        How far the nearest loose end of another curve lies from an end of an open one; None where none is near.
    detail
        What is wrong with it, where that is known.
    values
        What fills the text.
    """

    entity: Entity
    why: str
    place_um: tuple[float, float] | None = None
    gap_um: float | None = None
    detail: Remark | None = None
    values: tuple[tuple[str, str], ...] = ()


class Mark(NamedTuple):
    """A point of the drawing, or the centre of a circle, with the layer that it is drawn on; radius 0 for a point."""

    place_um: tuple[float, float]
    layer: str
    radius_um: float


class FitFigures(NamedTuple):
    """What a fit of arcs came to.

    Attributes
    ----------
    tolerance_um
        How far the fitted curves may lie off those that are drawn.
    max_um
        How far they lie off at most: a bound that is proved, no sample.
    arcs, lines
        How many arcs and lines the fitted curves are.
    """

    tolerance_um: float
    max_um: float
    arcs: int
    lines: int


@dataclass(frozen=True, slots=True, eq=False)
class DrawnLoop:
    """Curves that follow each other, closed or open.

    Attributes
    ----------
    row
        (k,) rows of the drawing's curves in running order.
    backwards
        (k,) True where the curve is run from its end to its start.
    closed
        Whether the last curve ends where the first one starts. Closed loops run counter-clockwise.
    gap_um
        Largest distance bridged between the end of a curve and the start of the next; 0 where none is.
    """

    row: Ints
    backwards: NDArray[np.bool_]
    closed: bool
    gap_um: float


@dataclass(frozen=True, slots=True, eq=False)
class Drawing:
    """A drawing of one part.

    Attributes
    ----------
    name
        The file's name, for messages.
    version
        Release of the file format, such as ``R2010``.
    unit
        Unit of the file, such as ``mm``; the curves are in µm whatever it is.
    curves
        n lines and arcs in file order; a full circle is one arc of 2π.
    entity
        (n,) which of `entities` each curve belongs to.
    entities
        Entities that gave curves.
    loops
        Every curve in exactly one loop, the loop of the first curve first.
    flattened, flatten_um
        How many ellipses and splines were made lines, and how far these lie off them at most.
    notes
        What was left out, assumed or mended.
    left_out
        What of the drawing is in none of its loops, entity by entity.
    marks
        Points and circles of all layers, seen or not: their layer is asked for by name where they are thread points.
    fit
        What the fit of arcs came to; None where curves were flattened to lines.
    """

    name: str
    version: str
    unit: str
    curves: Curves
    entity: Ints
    entities: tuple[Entity, ...]
    loops: tuple[DrawnLoop, ...]
    flattened: int
    flatten_um: float
    notes: tuple[Remark, ...]
    left_out: tuple[LeftOut, ...] = ()
    marks: tuple[Mark, ...] = ()
    fit: FitFigures | None = None


def refuse_many(curves: int) -> None:
    """DrawingError, without the name of the file, for more curves than are compared."""
    if curves > MOST_CURVES:
        raise DrawingError("too-many-curves", most=MOST_CURVES)


def running(curves: Curves, row: Ints, backwards: NDArray[np.bool_]) -> Curves:
    """Rows (k,) of curves in running order, those turned round that are run backwards."""
    ahead = curves.picked(row)
    sign = np.where(backwards, -1.0, 1.0)
    turn = backwards[:, None]
    return Curves(
        kind=ahead.kind,
        start_um=np.where(turn, ahead.end_um, ahead.start_um),
        end_um=np.where(turn, ahead.start_um, ahead.end_um),
        center_um=ahead.center_um,
        radius_um=ahead.radius_um,
        start_angle_rad=ahead.start_angle_rad + np.where(backwards, ahead.sweep_rad, 0.0),
        sweep_rad=ahead.sweep_rad * np.where(ahead.kind == CurveKind.ARC, sign, 1.0),
        length_um=ahead.length_um,
    )
