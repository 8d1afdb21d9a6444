"""The entities of the model space, blocks opened up: what stands where, on which layer, and whether it is seen."""

from collections.abc import Iterator, Mapping
from typing import Any, NamedTuple

from ezdxf.document import Drawing as Document
from ezdxf.entities.dxfentity import DXFEntity
from ezdxf.entities.dxfgfx import DXFGraphic
from ezdxf.entities.insert import Insert
from ezdxf.entities.layer import Layer

from parser.drawing.dxf.document import MOST_ENTITIES
from parser.drawing.dxf.entities import behind, of_insert
from parser.findings.errors import DrawingError
from parser.geometry.curves import Floats

MOST_NESTED = 50
"""Blocks within blocks: drawings of parts have a few."""
_BY_BLOCK, _BY_LAYER = 0, 256  # colours that say where the colour is from, by the DXF reference, group code 62


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
    unseen
        What keeps it from being seen: ``off`` or ``frozen``, as its layer is, or ``hidden``, by itself; else empty.
    color
        By the AutoCAD index, that of its layer or its INSERT where it says so; 0 where it has none of these.
    linetype
        Name of its linetype in small letters, that of its layer or its INSERT where it says so.
    """

    entity: DXFEntity
    place: Floats
    layer: str
    block: str
    unseen: str
    color: int
    linetype: str


class _Layer(NamedTuple):
    """What a layer gives to what is drawn on it; see `Placed`."""

    unseen: str = ""
    color: int = 0
    linetype: str = "continuous"


_Layers = Mapping[str, _Layer]  # by their names in small letters
_NONE = _Layer()


class _Into(NamedTuple):
    """Entities still to be looked at, at least so many: where they are placed, and what their INSERT gives to them."""

    entities: Iterator[DXFEntity]
    least: int
    place: Floats
    layer: str
    gives: _Layer
    blocks: tuple[str, ...]


def placed_entities(document: Document, place: Floats) -> Iterator[Placed]:
    """Entities of the model space in file order, those of blocks in the place of the INSERT.

    An INSERT that cannot be opened, for want of its block or because the block inserts itself, is given as it is.
    Raises DrawingError, without the name of the file, where blocks multiply or nest beyond all bounds.
    """
    layers, number = _layers(document), 0
    stack = [_Into(iter(document.modelspace()), 0, place, "0", _NONE, ())]
    while stack:
        inside = stack[-1]
        entity = next(inside.entities, None)
        if entity is None:
            stack.pop()
            continue
        number += 1
        placed = _placed(entity, inside, layers)
        opened = _opened(entity, placed, inside, layers) if isinstance(entity, Insert) else None
        if number + (opened.least if opened else 0) > MOST_ENTITIES:
            raise DrawingError("too-many-entities-inserted", most=MOST_ENTITIES)
        if opened is not None:
            if len(opened.blocks) > MOST_NESTED:
                raise DrawingError("blocks-nested-too-deep", most=MOST_NESTED)
            stack.append(opened)
        else:
            yield placed


def _layers(document: Document) -> _Layers:
    return {layer.dxf.name.lower(): _layer(layer) for layer in document.layers}


def _layer(layer: Layer) -> _Layer:
    unseen = "frozen" if layer.is_frozen() else "off" if layer.is_off() else ""
    color, linetype = layer.dxf.get("color", 0), layer.dxf.get("linetype", _NONE.linetype)
    return _Layer(unseen, abs(int(color)), str(linetype).lower())  # a colour below 0 is that of a layer that is off


def _placed(entity: DXFEntity, inside: _Into, layers: _Layers) -> Placed:
    get = entity.dxf.get if isinstance(entity, DXFGraphic) else _nothing  # others are kept without any attributes
    own = str(get("layer", "0"))
    layer = inside.layer if own == "0" and inside.blocks else own
    on = layers.get(layer.lower(), _NONE)
    unseen = inside.gives.unseen or on.unseen or ("hidden" if get("invisible", 0) else "")
    color, linetype = int(get("color", _BY_LAYER)), str(get("linetype", "bylayer")).lower()
    if color == _BY_LAYER:
        color = 0 if entity.dxf.hasattr("true_color") else on.color
    elif color == _BY_BLOCK:
        color = inside.gives.color
    linetype = {"bylayer": on.linetype, "byblock": inside.gives.linetype}.get(linetype, linetype)
    return Placed(entity, inside.place, layer, inside.blocks[-1] if inside.blocks else "", unseen, color, linetype)


def _nothing(name: str, default: Any) -> Any:
    """What an entity without attributes has of one."""
    return default


def _opened(insert: Insert, placed: Placed, inside: _Into, layers: _Layers) -> _Into | None:
    """What an INSERT places; an array of them is one INSERT after the other. None where it cannot be opened."""
    try:
        return _into(insert, placed, inside, layers)
    except Exception:  # damaged numbers, a block without its head
        return None


def _into(insert: Insert, placed: Placed, inside: _Into, layers: _Layers) -> _Into | None:
    if insert.mcount > 1:
        return _each_of(insert, placed, inside, layers)
    name, block = str(insert.dxf.get("name", "")), insert.block()
    if block is None or name.lower() in map(str.lower, inside.blocks):
        return None
    # A layer that is off hides what lies on it alone, and not what a block on it places on other layers.
    gives = _Layer("" if placed.unseen == "off" else placed.unseen, placed.color, placed.linetype)
    place = behind(of_insert(insert.matrix44()), inside.place)
    return _Into(iter(block), len(block), place, placed.layer, gives, (*inside.blocks, name))


def _each_of(insert: Insert, placed: Placed, inside: _Into, layers: _Layers) -> _Into | None:
    """The INSERTs of an array, counted before they are made: each of them opens what the first one does.

    So none is made where that places nothing. None where it cannot be opened.
    """
    first = next(insert.multi_insert(), None)
    opened = _opened(first, placed, inside, layers) if first else None
    if opened is None or not opened.least:
        return opened
    return inside._replace(entities=iter(insert.multi_insert()), least=insert.mcount * (1 + opened.least))
