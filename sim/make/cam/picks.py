"""Which contours of a drawing are picked: by entity, place, window, layer or colour.

Which of their curves are spared: no cut starts on them.
"""

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from parser.drawing.model import Drawing, Entity
from parser.findings.catalogue import Remark
from parser.geometry.curves import Bools, Curves, Floats, extents, is_inside, joined
from parser.geometry.distance import distance_to_curves
from sim.make.cam.contours import Contours, Nesting
from sim.make.cam.model import CannotCutError, Figure, Refusal, Thread
from sim.setup.picks import OfColor, OfEntity, OfLayer, OfPart, OfWindow, Pick


class Pickable(NamedTuple):
    """Contours (l,) that may be picked.

    Attributes
    ----------
    contours, nested, area_um2
        The contours, how they lie within each other, and their areas.
    entities
        Of each.
    is_whole
        Whether each closes; those that do not lie around others, and nobody can pick them.
    """

    contours: Contours
    nested: Nesting
    area_um2: Floats
    entities: tuple[tuple[Entity, ...], ...]
    is_whole: Bools


def picked(among: Pickable, picks: Sequence[Pick]) -> Bools:
    """(l,) which contours are picked, by any of some picks.

    CannotCutError, ``no-pick``, where one of them picks nothing: it may be a slip.
    """
    chosen = np.zeros(len(among.entities), dtype=np.bool_)
    for pick in picks:
        of_pick = _picked(among, pick) & among.is_whole
        if not of_pick.any():
            raise CannotCutError(Refusal("no-pick", (), (("pick", str(pick)),)))
        chosen[of_pick] = True
    return chosen


def _picked(among: Pickable, pick: Pick) -> Bools:
    match pick:
        case OfEntity(handle):
            return _any(among, [{each.handle.casefold() for each in own} for own in among.entities], handle.casefold())
        case OfLayer(layer):
            return _any(among, [{each.layer.casefold() for each in own} for own in among.entities], layer.casefold())
        case OfColor(color):
            return _any(among, [{each.color for each in own} for own in among.entities], color)
        case OfPart(place_um):
            return _part_at(among, np.array([place_um]))
        case OfWindow(low_um, high_um):
            low, high = _boxes(among)
            within: Bools = np.all((low >= low_um) & (high <= high_um), axis=1)
            return within


def spared(drawing: Drawing, figures: Sequence[Figure], picks: Sequence[Pick]) -> Bools:
    """(n,) which curves of the contours of figures no cut is to start on, all contours one behind the other.

    A place spares the curve that is nearest to it. CannotCutError, ``no-spare``, where one of the picks spares nothing.
    """
    curves = joined([each.contour for each in figures])
    found = np.zeros(len(curves), dtype=np.bool_)
    if not picks:
        return found
    entities = [drawing.entities[at] for figure in figures for at in figure.entity.tolist()]
    for pick in picks:
        of_pick = _spared(curves, entities, pick)
        if not of_pick.any():
            raise CannotCutError(Refusal("no-spare", (), (("pick", str(pick)),)))
        found |= of_pick
    return found


def spare_notes(drawing: Drawing, cuts: Sequence[tuple[Figure, Thread]], picks: Sequence[Pick]) -> Iterator[Remark]:
    """Cuts that start on curves that are to be spared all the same: no other one has room."""
    if picks:
        is_spared = spared(drawing, [figure for figure, _ in cuts], picks)
        first = np.cumsum([0, *(len(figure.contour) for figure, _ in cuts)])
        rows = [int(before) + thread.entry.row for before, (_, thread) in zip(first, cuts, strict=False)]
        on = [str(figure.number) for row, (figure, _) in zip(rows, cuts, strict=True) if is_spared[row]]
        if on:
            yield Remark("starts-on-spared", {"figures": ", ".join(on)})


def _spared(curves: Curves, entities: Sequence[Entity], pick: Pick) -> Bools:
    match pick:
        case OfEntity(handle):
            return np.array([each.handle.casefold() == handle.casefold() for each in entities], dtype=np.bool_)
        case OfLayer(layer):
            return np.array([each.layer.casefold() == layer.casefold() for each in entities], dtype=np.bool_)
        case OfColor(color):
            return np.array([each.color == color for each in entities], dtype=np.bool_)
        case OfPart((x, y)):
            rows = np.arange(len(curves))
            off = distance_to_curves(curves, rows, np.full(len(rows), x), np.full(len(rows), y))[0]
            nearest: Bools = rows == int(np.argmin(off))
            return nearest
        case OfWindow(low_um, high_um):
            low, high = extents(curves)
            within: Bools = np.all((low >= low_um) & (high <= high_um), axis=1)
            return within


def _boxes(among: Pickable) -> tuple[Floats, Floats]:
    """Lowest and highest x and y (l, 2) of each contour, µm."""
    low, high = extents(among.contours.curves)
    first = np.searchsorted(among.contours.loop, np.arange(len(among.entities)))
    return np.minimum.reduceat(low, first), np.maximum.reduceat(high, first)


def _any(among: Pickable, names: Sequence[set[str]] | Sequence[set[int]], name: str | int) -> Bools:
    return np.array([name in own for own in names], dtype=np.bool_).reshape(len(among.entities))


def _part_at(among: Pickable, place_um: Floats) -> Bools:
    """The part in whose material a place (1, 2) lies, with its holes; or the hole in which it lies.

    None where the smallest contour around it is not whole.
    """
    chosen = np.zeros(len(among.entities), dtype=np.bool_)
    low, high = _boxes(among)
    near = np.flatnonzero(np.all((low <= place_um) & (high >= place_um), axis=1)).tolist()
    around = [at for at in near if bool(is_inside(among.contours.contour(at), place_um)[0])]
    inner = min(around, key=lambda at: float(among.area_um2[at]), default=-1)
    if inner < 0 or not among.is_whole[inner]:
        return chosen
    chosen[inner] = True
    if among.nested.depth[inner] % 2 == 0:
        holes = (among.nested.around == inner) & (among.nested.depth == among.nested.depth[inner] + 1)
        chosen[holes] = True
    return chosen
