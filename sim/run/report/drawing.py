"""A comparison as data, schema ``drycut.compare/1`` (docs/compare.md); what is said of it is in English."""

import json
from collections.abc import Sequence
from typing import Any, Final

import numpy as np

from parser import __version__
from parser.findings.remarks import remark_text
from sim.measure.compare.result import Comparison, WorstPlace
from sim.measure.compare.tables import by_block, by_entity, worst_places

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
        "tolerance_um": _round(of.tolerance_um),
        "max_um": _round(of.max_um),
        "rms_um": _round(max(of.edge_to_drawing.rms_um, of.drawing_to_edge.rms_um)),
        "where_um": [_round(by) for by in max([*blocks, *entities], key=lambda place: place.deviation_um).where_um],
        "offset_um": None if of.edge.offset_um is None else _round(of.edge.offset_um),
        "edge_to_drawing": _direction(blocks, of.edge_to_drawing.rms_um),
        "drawing_to_edge": _direction(entities, of.drawing_to_edge.rms_um),
        "fit": {
            "fitted": of.fitted,
            "turn_deg": round(float(np.degrees(placement.turn_rad)), _DEG_DIGITS) + 0.0,
            "shift_um": [_round(by) for by in placement.shift_um],
            "mirror": placement.mirror,
            "scale": _round(of.scale),
        },
        "names": [{"name": named.name, "text": remark_text(named)} for named in of.names],
        "worst": [_place(place) for place in worst_places(of)],
        "blocks": [_place(place) for place in blocks],
        "entities": [{**_entity(of, place.entity), **_place(place)} for place in entities],
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


def _entity(of: Comparison, number: int) -> dict[str, Any]:
    entity = of.drawing.entities[number]
    return {"kind": entity.kind, "handle": entity.handle, "layer": entity.layer}


def _round(value: float) -> float:
    return round(float(value), _DIGITS) + 0.0
