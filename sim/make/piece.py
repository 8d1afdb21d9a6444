"""The standard piece of drycut: a drawing to make a program of, and limits to begin with.

Own design, after what a machining test wants (ISO 14137 names one; its figures are not taken): an octagon 20 mm across
flats for four directions, a square of 10 mm, a disc of R 10 mm, a rhomb with corners of 30° and 150°, and a plate with
slots of 1, 2 and 5 mm and a hole of the rhomb's form, whose corners of 150° tell how far the wire lags.
"""

import io
import math
from typing import Final

from ezdxf.filemanagement import new

from sim.setup.limits import FeatureLimits, Limits

OCTAGON_MM, SQUARE_MM, DISC_MM = 20.0, 10.0, 20.0
SLOTS_MM: Final = (1.0, 2.0, 5.0)
PLATE_MM: Final = (60.0, 14.0)
RHOMB_MM, RHOMB_HOLE_MM = 12.0, 10.0
"""Length of a side; half of it is the distance of the sides."""
_SLOT_LONG_MM: Final = 8.0
_SHARP_RAD: Final = math.radians(30.0)


def piece_dxf() -> str:
    """The drawing, in mm: its parts beside each other in a sheet."""
    document = new("R2010", units=4)
    space = document.modelspace()
    reach = 0.5 * OCTAGON_MM / math.cos(math.pi / 8.0)
    corners = [(reach * math.cos(angle), reach * math.sin(angle)) for angle in _eighths()]
    space.add_lwpolyline([(15.0 + x, 15.0 + y) for x, y in corners], close=True)
    space.add_lwpolyline(_box(35.0, 10.0, SQUARE_MM, SQUARE_MM), close=True)
    space.add_circle((65.0, 15.0), 0.5 * DISC_MM)
    space.add_lwpolyline(_rhomb(85.0, 12.0, RHOMB_MM), close=True)
    space.add_lwpolyline(_box(10.0, 35.0, *PLATE_MM), close=True)
    for at, slot in enumerate(SLOTS_MM):
        space.add_lwpolyline(_box(14.0 + 8.0 * at, 38.0, slot, _SLOT_LONG_MM), close=True)
    space.add_lwpolyline(_rhomb(43.0, 39.5, RHOMB_HOLE_MM), close=True)
    text = io.StringIO()
    document.write(text)
    return text.getvalue()


def piece_limits(limit_um: float = 10.0, uncertainty_um: float = 1.0) -> Limits:
    """Limits of the piece: the same for all sizes, to be set to what a shop needs."""
    widths = [
        *((f"octagon-{angle}", OCTAGON_MM, angle, False) for angle in (0, 45, 90, 135)),
        *((f"square-{angle}", SQUARE_MM, angle, False) for angle in (0, 90)),
        *((f"plate-{angle}", size, angle, False) for size, angle in zip(PLATE_MM, (0, 90), strict=True)),
        *((f"rhomb-{angle}", 0.5 * RHOMB_MM, angle, False) for angle in (90, 120)),
        *((f"slot-{slot:g}", slot, 0, True) for slot in SLOTS_MM),
        *((f"rhomb-hole-{angle}", 0.5 * RHOMB_HOLE_MM, angle, True) for angle in (90, 120)),
    ]
    features = [
        FeatureLimits(name, "width", nominal, -limit_um, limit_um, across_deg=angle, inside=inside)
        for name, nominal, angle, inside in widths
    ]
    return Limits(
        uncertainty_um, (*features, FeatureLimits("disc", "circle", DISC_MM, -limit_um, limit_um, form_um=limit_um))
    )


def piece_limits_text() -> str:
    """The limits as a file."""
    limits = piece_limits()
    rows = ["# Limits of drycut's own piece, of no standard: set them to what the work needs.\n"]
    rows.append(f"uncertainty_um = {limits.uncertainty_um:g}\n")
    for each in limits.features:
        rows.append(f'\n[[feature]]\nname = "{each.name}"\nkind = "{each.kind}"\nnominal_mm = {each.nominal_mm:g}\n')
        rows.append(f"across_deg = {each.across_deg:g}\n" if each.kind == "width" else "")
        rows.append(f"lower_um = {each.lower_um:g}\nupper_um = {each.upper_um:g}\n")
        rows.append("inside = true\n" if each.inside else "")
        rows.append("" if each.form_um is None else f"form_um = {each.form_um:g}\n")
    return "".join(rows)


def _eighths() -> list[float]:
    return [math.pi / 8.0 + at * math.pi / 4.0 for at in range(8)]


def _box(x: float, y: float, wide: float, high: float) -> list[tuple[float, float]]:
    return [(x, y), (x + wide, y), (x + wide, y + high), (x, y + high)]


def _rhomb(x: float, y: float, side: float) -> list[tuple[float, float]]:
    """Corners of a rhomb with a sharp corner at a place, a side along X."""
    by_x, by_y = side * math.cos(_SHARP_RAD), side * math.sin(_SHARP_RAD)
    return [(x, y), (x + side, y), (x + side + by_x, y + by_y), (x + by_x, y + by_y)]
