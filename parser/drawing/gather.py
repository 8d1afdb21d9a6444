"""Entities to curves in µm, and counts of what was left out."""

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
from ezdxf.entities.dxfentity import DXFEntity
from ezdxf.entities.insert import Insert

from parser.drawing.dxf.blocks import Placed
from parser.drawing.dxf.entities import (
    COLUMNS,
    ReadEntity,
    Spline,
    WrongNumbersError,
    behind,
    reader_of,
)
from parser.drawing.model import SAME_WITHIN_UM, refuse_many
from parser.drawing.plane import Flat, flat_forms, flat_splines, placed_spline
from parser.findings.catalogue import Remark
from parser.geometry.curves import Curves, Floats, Ints, joined
from parser.text.encoding import printable


class Missed(NamedTuple):
    """An entity that gives no curve, or not all of its curves.

    Attributes
    ----------
    entity
        Its number among those that were looked at.
    why
        ``unreadable``, ``beyond``, ``upright`` or ``short``, as `LeftOut` has it; empty where its kind is no curve.
    detail
        What is wrong with it, where that is known.
    """

    entity: int
    why: str = ""
    detail: Remark | None = None


@dataclass(slots=True)
class EntityCounts:
    """How many entities, by kind, are no curves or have numbers that cannot be; and how many curves were treated how.

    See `Flat` for the latter. `missed` is the entities themselves, in no order.
    """

    missed: list[Missed] = field(default_factory=list)
    no_curves: Counter[str] = field(default_factory=Counter)
    unreadable: Counter[str] = field(default_factory=Counter)
    flattened: int = 0
    slanted: int = 0
    upright: int = 0
    beyond: int = 0
    fit_max_um: float = 0.0


class Gathered(NamedTuple):
    """Curves (n,), which of the entities looked at each belongs to, never decreasing, and the counts."""

    curves: Curves
    entity: Ints
    counts: EntityCounts


class _Forms(NamedTuple):
    """Forms (k, 17), the number of the map and of the entity (k,) of each, and the maps (m, 4, 3)."""

    forms: Floats
    which: Ints
    entity: Ints
    maps: Floats


def gather(placed: Sequence[Placed], tolerance_um: float, fit_um: float | None = None) -> Gathered:
    """Curves of entities, ellipses and splines made lines within a tolerance, or arcs within `fit_um`.

    Raises DrawingError, without the name of the file, where they become too many.
    """
    counts = EntityCounts()
    read = [_read(at, each_placed.entity, counts) for at, each_placed in enumerate(placed)]
    forms = _forms(placed, read)
    refuse_many(len(forms.forms))
    flat = flat_forms(forms.forms, forms.maps, forms.which, tolerance_um, fit_um)
    _count(counts, flat, forms.entity)
    splined, spline_entity = _splines(placed, read, counts, tolerance_um, fit_um)
    refuse_many(len(flat.curves) + len(splined))
    parts, entity = [flat.curves, splined], [forms.entity[flat.form], spline_entity]
    order = np.argsort(np.concatenate(entity), kind="stable")
    curves = joined(parts).picked(order)
    long, of = curves.length_um > SAME_WITHIN_UM, np.concatenate(entity)[order]
    counts.missed.extend(Missed(number, "short") for number in np.setdiff1d(of[~long], of[long]).tolist())
    return Gathered(curves.picked(long), of[long], counts)


def _read(at: int, entity: DXFEntity, counts: EntityCounts) -> ReadEntity | None:
    reader = reader_of(entity)
    if reader is None:
        counts.no_curves[_kind(entity)] += 1
        counts.missed.append(Missed(at))
        return None
    detail = None
    try:
        return reader(entity)
    except WrongNumbersError as error:
        detail = error.remark
    except Exception:  # a number is a word, or there are too few  # noqa: S110
        pass
    counts.unreadable[entity.dxftype()] += 1
    counts.missed.append(Missed(at, "unreadable", detail))
    return None


def _kind(entity: DXFEntity) -> str:
    """What is left out; blocks that are not opened are missing or insert themselves."""
    if isinstance(entity, Insert):
        return f"INSERT of {printable(str(entity.dxf.get('name', '')))}"
    return "POLYLINE (mesh)" if entity.dxftype() == "POLYLINE" else printable(entity.dxftype())


def _forms(placed: Sequence[Placed], read: Sequence[ReadEntity | None]) -> _Forms:
    forms, number, which = [np.empty((0, COLUMNS))], [], []
    maps: list[Floats] = []
    known: dict[tuple[int, bytes], int] = {}
    for at, (each_placed, found) in enumerate(zip(placed, read, strict=True)):
        if found is None or isinstance(found.forms, Spline):
            continue
        key = (id(each_placed.place), b"" if found.own is None else found.own.tobytes())
        if key not in known:
            known[key] = len(maps)
            maps.append(each_placed.place if found.own is None else behind(found.own, each_placed.place))
        forms.append(found.forms)
        which.append(known[key])
        number.append(at)
    rows = [len(part) for part in forms[1:]]
    which_of, entity = (np.repeat(np.array(column, dtype=np.int64), rows) for column in (which, number))
    return _Forms(np.concatenate(forms), which_of, entity, np.array(maps).reshape(-1, 4, 3))


def _splines(
    placed: Sequence[Placed],
    read: Sequence[ReadEntity | None],
    counts: EntityCounts,
    tolerance_um: float,
    fit_um: float | None,
) -> tuple[Curves, Ints]:
    """Curves of splines, and the number of the entity of each."""
    drawn = [
        (number, placed_spline(found.forms, placed[number].place))
        for number, found in enumerate(read)
        if found is not None and isinstance(found.forms, Spline)
    ]
    flat = flat_splines([spline for _, spline in drawn], tolerance_um, fit_um)
    unreadable = [drawn[row][0] for row in np.flatnonzero(flat.unreadable).tolist()]
    if unreadable:
        counts.unreadable["SPLINE"] += len(unreadable)
        counts.missed.extend(Missed(number, "unreadable") for number in unreadable)
    counts.flattened += int((np.bincount(flat.of, minlength=1) > 1).sum())
    counts.slanted += flat.slanted
    counts.fit_max_um = max(counts.fit_max_um, flat.fit_max_um)
    return flat.curves, np.array([number for number, _ in drawn], dtype=np.int64)[flat.of]


def _count(counts: EntityCounts, flat: Flat, entity: Ints) -> None:
    """Take over what was done to forms (k,) of entities (k,)."""
    counts.flattened, counts.slanted, counts.fit_max_um = flat.ellipses, flat.slanted, flat.fit_max_um
    counts.upright, counts.beyond = len(flat.upright), len(flat.beyond)
    for why, forms in (("upright", flat.upright), ("beyond", flat.beyond)):
        counts.missed.extend(Missed(number, why) for number in np.unique(entity[forms]).tolist())
