"""Frames of drawing sheets: rectangles about all else, as large as paper or as the field within its margins.

A frame that is taken for a contour makes holes of the parts in it, with the wire inside. So a rectangle about all other
contours is a frame where it has the size of one and text stands in it, as a title block has.

Sizes are those of ISO 216 A0 to A4 for the sheet; for the frame within, ISO 5457 (20 mm on the left, 10 mm else) and
GB/T 14689 (25 mm on the left and 10 or 5 mm else, or 20 or 10 mm all round).
"""

from typing import Final, NamedTuple

import numpy as np

from parser.drawing.model import Drawing
from parser.geometry.curves import Bools, Floats
from parser.units import from_mm
from sim.make.cam.contours import Contours

_SHEETS_MM: Final = ((841, 1189), (594, 841), (420, 594), (297, 420), (210, 297))
_MARGINS_MM: Final = ((0, 0, 0), (20, 10, 10), (25, 10, 10), (25, 5, 5), (20, 20, 20), (10, 10, 10))
"""On the left, on the right, above and below."""
_NEAR_UM: Final = 500.0  # of its size, a side: sheets are drawn in whole mm


class Boxes(NamedTuple):
    """Areas (l,) µm² and boxes (l, 2) µm of contours."""

    area_um2: Floats
    low_um: Floats
    high_um: Floats


def frames(drawing: Drawing, contours: Contours, boxes: Boxes) -> Bools:
    """(l,) which contours are frames about all that are none; none of them where there is nothing else."""
    size = boxes.high_um - boxes.low_um
    is_line = np.bincount(contours.loop, contours.curves.is_arc, len(size)) == 0
    is_box = is_line & (np.abs(boxes.area_um2 - size.prod(axis=1)) <= 1e-6 * size.prod(axis=1))
    is_sheet = is_box & np.any(np.all(np.abs(size[:, None] - _sizes_um()[None]) <= _NEAR_UM, axis=2), axis=1)
    found = np.zeros(len(size), dtype=np.bool_)
    places = [each.place_um for each in drawing.left_out if each.why == "text" and each.place_um]
    if not places:
        return found
    for at in sorted(np.flatnonzero(is_sheet).tolist(), key=lambda each: -float(boxes.area_um2[each])):
        low, high = boxes.low_um[at] - _NEAR_UM, boxes.high_um[at] + _NEAR_UM
        others = ~found
        others[at] = False
        is_around = others.any() and bool(((boxes.low_um >= low) & (boxes.high_um <= high))[others].all())
        found[at] = is_around and bool(((np.array(places) >= low) & (np.array(places) <= high)).all(axis=1).any())
    return found


def _sizes_um() -> Floats:
    """Widths and heights (k, 2) of sheets and of the frames in them, upright and lying."""
    sizes = {
        (wide - left - right, high - 2 * above)
        for sheet in _SHEETS_MM
        for wide, high in (sheet, sheet[::-1])
        for left, right, above in _MARGINS_MM
    }
    return from_mm(1.0) * np.array(sorted(sizes), dtype=np.float64)
