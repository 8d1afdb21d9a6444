"""A comparison as data, schema ``drycut.compare/1`` (docs/compare.md); what is said of it is in English."""

import json
from collections.abc import Sequence
from typing import Any, Final

import numpy as np

from parser import __version__
from parser.findings.catalogue import Remark, remark_text
from parser.units import from_mm
from sim.measure.compare.findings import by_block, by_entity, corner_places, worst_places
from sim.measure.compare.result import Comparison, CornerPlace, WorstPlace

SCHEMA: Final = "drycut.compare/1"
_DIGITS: Final = 6
_DEG_DIGITS: Final = 9


def comparison_document(of: Comparison) -> dict[str, Any]:
    """The comparison as plain lists, dicts, numbers and None; the order of keys is fixed."""
    placement, drawing = of.placement, of.drawing
    blocks, entities = by_block(of), by_entity(of)
    return {
        "schema": SCHEMA,
        "drycut": __version__,
        "verdict": "pass" if of.passes else "fail",
        "tolerance_um": _round(of.asked.tolerance_um),
        "max_um": _round(of.max_um),
        "rms_um": _round(max(of.edge_to_drawing.rms_um, of.drawing_to_edge.rms_um)),
        "where_um": [_round(by) for by in max([*blocks, *entities], key=lambda place: place.deviation_um).where_um],
        "offset_um": None if of.edge.offset_um is None else _round(of.edge.offset_um),
        "edge_to_drawing": _direction(blocks, of.edge_to_drawing.rms_um),
        "drawing_to_edge": _direction(entities, of.drawing_to_edge.rms_um),
        "fit": {
            "fitted": of.asked.fitted,
            "turn_deg": round(float(np.degrees(placement.turn_rad)), _DEG_DIGITS) + 0.0,
            "shift_um": [_round(by) for by in placement.shift_um],
            "mirror": placement.mirror,
            "scale": _round(of.scale),
        },
        "names": [_named(named) for named in of.names],
        "worst": [_place(place) for place in worst_places(of)],
        "blocks": [_place(place) for place in blocks],
        "entities": [{**_entity(of, place.entity), **_place(place)} for place in entities],
        "sharp_corners": of.asked.sharp_corners,
        "unreachable": [_corner(corner) for corner in corner_places(of)],
        "drawing": {"name": drawing.name, "version": drawing.version, "unit": drawing.unit},
        "notes": [remark_text(note) for note in of.notes],
    }


def document_text(of: Comparison) -> str:
    """The document as JSON; the same comparison gives the same bytes."""
    return json.dumps(comparison_document(of), ensure_ascii=False, allow_nan=False, indent=2) + "\n"


def _direction(places: Sequence[WorstPlace], rms_um: float) -> dict[str, Any]:
    worst = max(places, key=lambda place: place.deviation_um)
    return {
        "max_um": _round(worst.deviation_um),
        "rms_um": _round(rms_um),
        **{key: value for key, value in _place(worst).items() if key in ("where_um", "block", "entity", "signed_um")},
    }


def _place(place: WorstPlace) -> dict[str, Any]:
    return {
        "from": place.measured_from,
        "max_um": _round(place.deviation_um),
        "signed_um": _round(place.side * place.deviation_um) if place.side else None,
        "where_um": [_round(by) for by in place.where_um],
        "block": place.block,
        "entity": place.entity if place.entity >= 0 else None,
    }


def _named(named: Remark) -> dict[str, Any]:
    """What is wrong, with the blocks and the shift of the one contour that it is wrong of."""
    of = named.values
    shift_mm = [float(of[key]) for key in ("shift_x_mm", "shift_y_mm") if key in of]
    return {
        "name": named.name,
        "text": remark_text(named),
        "blocks": [of["first"], of["last"]] if "first" in of else None,
        "shift_um": [_round(from_mm(by)) for by in shift_mm] or None,
    }


def _corner(corner: CornerPlace) -> dict[str, Any]:
    return {
        "where_um": [_round(by) for by in corner.where_um],
        "depth_um": _round(corner.depth_um),
        "angle_deg": round(float(np.degrees(corner.angle_rad)), _DEG_DIGITS),
        "block": corner.block,
        "entity": corner.entity,
    }


def _entity(of: Comparison, number: int) -> dict[str, Any]:
    entity = of.drawing.entities[number]
    return {"kind": entity.kind, "handle": entity.handle, "layer": entity.layer}


def _round(value: float) -> float:
    return round(float(value), _DIGITS) + 0.0
