"""The entities of the model space, blocks opened up: what stands where, on which layer, and whether it is seen."""

from collections.abc import Iterator
from typing import NamedTuple

from ezdxf.document import Drawing as Document
from ezdxf.entities.dxfentity import DXFEntity
from ezdxf.entities.insert import Insert

from parser.drawing.dxf.document import MOST_ENTITIES
from parser.drawing.dxf.forms import behind, of_insert
from parser.findings.errors import DrawingError
from parser.geometry.curves import Floats

MOST_NESTED = 50
"""Blocks within blocks: drawings of parts have a few."""


class Placed(NamedTuple):
    """An entity where it is placed once.

    Attributes
    ----------
    entity
        As it stands in the file.
    place
        (4, 3) map from its block to µm; the same object for all that one INSERT places.
    layer, block
        Layer that it is drawn on, block that it stands in.
    hidden
        Whether a layer that is off or frozen, or its own flag, keeps it from being seen.
    """

    entity: DXFEntity
    place: Floats
    layer: str
    block: str
    hidden: bool


class _Layers(NamedTuple):
    """Names of layers, in lower case, that are off and that are frozen."""

    off: frozenset[str]
    frozen: frozenset[str]


class _Into(NamedTuple):
    """Entities still to be looked at, at least so many: where they are placed, and by which INSERT."""

    entities: Iterator[DXFEntity]
    least: int
    place: Floats
    layer: str
    frozen: bool
    blocks: tuple[str, ...]


def placed_entities(document: Document, place: Floats) -> Iterator[Placed]:
    """Entities of the model space in file order, those of blocks in the place of the INSERT.

    An INSERT that cannot be opened, for want of its block or because the block inserts itself, is given as it is.
    Raises DrawingError, without the name of the file, where blocks multiply or nest beyond all bounds.
    """
    layers, number = _layers(document), 0
    stack = [_Into(iter(document.modelspace()), 0, place, "0", False, ())]
    while stack:
        inside = stack[-1]
        entity = next(inside.entities, None)
        if entity is None:
            stack.pop()
            continue
        number += 1
        placed = _placed(entity, inside, layers)
        opened = _opened(entity, placed.layer, inside, layers) if isinstance(entity, Insert) else None
        if number + (opened.least if opened else 0) > MOST_ENTITIES:
            raise DrawingError(f"holds more than {MOST_ENTITIES:,} entities once its blocks are inserted")
        if opened is not None:
            if len(opened.blocks) > MOST_NESTED:
                raise DrawingError(f"has blocks within blocks, more than {MOST_NESTED} deep; explode them")
            stack.append(opened)
        else:
            yield placed


def _layers(document: Document) -> _Layers:
    off = frozenset(layer.dxf.name.lower() for layer in document.layers if layer.is_off())
    return _Layers(off, frozenset(layer.dxf.name.lower() for layer in document.layers if layer.is_frozen()))


def _placed(entity: DXFEntity, inside: _Into, layers: _Layers) -> Placed:
    own = str(_attribute(entity, "layer", "0"))
    layer = inside.layer if own == "0" and inside.blocks else own
    unseen = layer.lower() in layers.off or layer.lower() in layers.frozen or bool(_attribute(entity, "invisible", 0))
    return Placed(entity, inside.place, layer, inside.blocks[-1] if inside.blocks else "", inside.frozen or unseen)


def _attribute(entity: DXFEntity, name: str, default: object) -> object:
    """An attribute of an entity; the default also for entities of other programs, which ezdxf keeps without any."""
    return entity.dxf.get(name, default) if entity.dxf.is_supported(name) else default


def _opened(insert: Insert, layer: str, inside: _Into, layers: _Layers) -> _Into | None:
    """What an INSERT places; an array of them is one INSERT after the other. None where it cannot be opened."""
    try:
        return _into(insert, layer, inside, layers)
    except Exception:  # damaged numbers, a block without its head
        return None


def _into(insert: Insert, layer: str, inside: _Into, layers: _Layers) -> _Into | None:
    if insert.mcount > 1:
        return _each_of(insert, layer, inside, layers)
    name, block = str(insert.dxf.get("name", "")), insert.block()
    if block is None or name.lower() in map(str.lower, inside.blocks):
        return None
    frozen = inside.frozen or layer.lower() in layers.frozen or bool(insert.dxf.get("invisible", 0))
    place = behind(of_insert(insert.matrix44()), inside.place)
    return _Into(iter(block), len(block), place, layer, frozen, (*inside.blocks, name))


def _each_of(insert: Insert, layer: str, inside: _Into, layers: _Layers) -> _Into:
    """The INSERTs of an array, counted before they are made: each of them opens what the first one does."""
    first = next(insert.multi_insert(), None)
    opened = _opened(first, layer, inside, layers) if first else None
    least = insert.mcount * (1 + (opened.least if opened else 0)) if first else 0
    return inside._replace(entities=iter(insert.multi_insert()), least=least)
