"""Thread points that stand in the drawing: points and circles on the layer of thread points, points in holes."""

import numpy as np

from parser.drawing.model import Drawing
from parser.geometry.curves import Floats
from sim.cam.model import CannotCutError, Refusal

_SAME_UM = 1.0


def marks_of_layer(drawing: Drawing, layer: str) -> Floats:
    """Places (m, 2) of points, and centres of circles, on a layer, each once.

    CannotCutError, ``no-marks``, where there is none.
    """
    asked = layer.casefold()
    found = [mark.place_um for mark in drawing.marks if mark.layer.casefold() == asked]
    on_layer = [at for at, one in enumerate(drawing.entities) if one.layer.casefold() == asked and one.kind == "CIRCLE"]
    row = np.isin(drawing.entity, np.array(on_layer, dtype=np.int64)) & drawing.curves.is_arc
    place = _each_once(np.concatenate([np.array(found).reshape(-1, 2), drawing.curves.center_um[row]]))
    if not len(place):
        raise CannotCutError(Refusal("no-marks", (), (("layer", layer),)))
    return place


def points_of(drawing: Drawing) -> Floats:
    """Places (m, 2) of the points of a drawing, each once."""
    return _each_once(np.array([mark.place_um for mark in drawing.marks if not mark.radius_um]).reshape(-1, 2))


def _each_once(place: Floats) -> Floats:
    """Places (m, 2) in whole µm, those that are one but once."""
    once: Floats = np.unique(np.round(place / _SAME_UM) * _SAME_UM + 0.0, axis=0)
    return once
