"""A comparison as data, schema ``drycut.compare/1`` (docs/compare.md); what is said of it is in English."""

import json
from collections.abc import Sequence
from operator import attrgetter
from typing import Final

import numpy as np

from parser import __version__
from parser.findings.catalogue import Remark, remark_text
from parser.units import from_mm
from sim.base.rounded import DEG_DIGITS, known, place, rounded
from sim.measure.compare.findings import by_block, by_entity, corner_places, worst_places
from sim.measure.compare.result import Comparison, CornerPlace, WorstPlace
from sim.run.report.drawing_model import (
    CompareDocument,
    CornerEntry,
    DirectionEntry,
    EntityEntry,
    NameEntry,
    PlaceEntry,
)

_DEVIATION_UM: Final = attrgetter("deviation_um")


def comparison_document(of: Comparison) -> CompareDocument:
    """The comparison as plain lists, dicts, numbers and None; the order of keys is fixed."""
    placement, drawing = of.placement, of.drawing
    blocks, entities = by_block(of), by_entity(of)
    return {
        "schema": "drycut.compare/1",
        "drycut": __version__,
        "verdict": "pass" if of.passes else "fail",
        "tolerance_um": rounded(of.request.tolerance_um),
        "max_um": rounded(of.max_um),
        "rms_um": rounded(max(of.edge_to_drawing.rms_um, of.drawing_to_edge.rms_um)),
        "where_um": place(max([*blocks, *entities], key=_DEVIATION_UM).where_um),
        "offset_um": known(of.edge.offset_um),
        "edge_to_drawing": _direction(blocks, of.edge_to_drawing.rms_um),
        "drawing_to_edge": _direction(entities, of.drawing_to_edge.rms_um),
        "fit": {
            "fitted": of.request.fitted,
            "turn_deg": round(float(np.degrees(placement.turn_rad)), DEG_DIGITS) + 0.0,
            "shift_um": place(placement.shift_um),
            "mirror": placement.mirror,
            "scale": rounded(of.scale),
        },
        "names": [_named(named) for named in of.names],
        "worst": [_place(worst) for worst in worst_places(of)],
        "blocks": [_place(worst) for worst in blocks],
        "entities": [_entity(of, worst) for worst in entities],
        "sharp_corners": of.request.sharp_corners,
        "unreachable": [_corner(corner) for corner in corner_places(of)],
        "drawing": {"name": drawing.name, "version": drawing.version, "unit": drawing.unit},
        "notes": [remark_text(note) for note in of.notes],
    }


def document_text(of: Comparison) -> str:
    """The document as JSON; the same comparison gives the same bytes."""
    return json.dumps(comparison_document(of), ensure_ascii=False, allow_nan=False, indent=2) + "\n"


def _direction(places: Sequence[WorstPlace], rms_um: float) -> DirectionEntry:
    worst = max(places, key=_DEVIATION_UM)
    return {
        "max_um": rounded(worst.deviation_um),
        "rms_um": rounded(rms_um),
        "signed_um": _signed(worst),
        "where_um": place(worst.where_um),
        "block": worst.block,
        "entity": _number(worst),
    }


def _place(worst: WorstPlace) -> PlaceEntry:
    return {
        "from": worst.measured_from,
        "max_um": rounded(worst.deviation_um),
        "signed_um": _signed(worst),
        "where_um": place(worst.where_um),
        "block": worst.block,
        "entity": _number(worst),
    }


def _signed(worst: WorstPlace) -> float | None:
    """Positive where material is left, negative where the part is gouged; None where no side is known."""
    return rounded(worst.side * worst.deviation_um) if worst.side else None


def _number(worst: WorstPlace) -> int | None:
    return worst.entity if worst.entity >= 0 else None


def _named(named: Remark) -> NameEntry:
    """What is wrong, with the blocks and the shift of the one contour that it is wrong of."""
    of = named.values
    shift_mm = [float(of[key]) for key in ("shift_x_mm", "shift_y_mm") if key in of]
    return {
        "name": named.name,
        "text": remark_text(named),
        "blocks": [int(of["first"]), int(of["last"])] if "first" in of else None,
        "shift_um": place(map(from_mm, shift_mm)) or None,
    }


def _corner(corner: CornerPlace) -> CornerEntry:
    return {
        "where_um": place(corner.where_um),
        "depth_um": rounded(corner.depth_um),
        "angle_deg": round(float(np.degrees(corner.angle_rad)), DEG_DIGITS),
        "block": corner.block,
        "entity": corner.entity,
    }


def _entity(of: Comparison, worst: WorstPlace) -> EntityEntry:
    entity = of.drawing.entities[worst.entity]
    return {"kind": entity.kind, "handle": entity.handle, "layer": entity.layer, **_place(worst)}
