"""The standard piece of drycut: a drawing to make a program of, and limits to begin with.

Own design, after what a machining test wants (ISO 14137 names one; its figures are not taken): an octagon 20 mm across
flats for four directions, a square of 10 mm, a disc of R 10 mm, and a plate with slots of 1, 2 and 5 mm.
"""

import io
import math
from typing import Final

from ezdxf.filemanagement import new

OCTAGON_MM, SQUARE_MM, DISC_MM = 20.0, 10.0, 20.0
SLOTS_MM: Final = (1.0, 2.0, 5.0)
_PLATE_MM, _SLOT_LONG_MM = (30.0, 14.0), 8.0


def piece_dxf() -> str:
    """The drawing, in mm: its parts beside each other in a sheet."""
    document = new("R2010", units=4)
    space = document.modelspace()
    reach = 0.5 * OCTAGON_MM / math.cos(math.pi / 8.0)
    corners = [(reach * math.cos(angle), reach * math.sin(angle)) for angle in _eighths()]
    space.add_lwpolyline([(15.0 + x, 15.0 + y) for x, y in corners], close=True)
    space.add_lwpolyline(_box(35.0, 10.0, SQUARE_MM, SQUARE_MM), close=True)
    space.add_circle((65.0, 15.0), 0.5 * DISC_MM)
    wide, high = _PLATE_MM
    space.add_lwpolyline(_box(10.0, 35.0, wide, high), close=True)
    for at, slot in enumerate(SLOTS_MM):
        space.add_lwpolyline(_box(14.0 + 8.0 * at, 38.0, slot, _SLOT_LONG_MM), close=True)
    text = io.StringIO()
    document.write(text)
    return text.getvalue()


def piece_limits(limit_um: float = 10.0, uncertainty_um: float = 1.0) -> str:
    """Limits of the piece as a file: the same for all sizes, to be set to what a shop needs."""
    rows = ["# Limits of drycut's own piece, of no standard: set them to what the work needs.\n"]
    rows.append(f"uncertainty_um = {uncertainty_um:g}\n")
    limits = f"lower_um = {-limit_um:g}\nupper_um = {limit_um:g}\n"
    widths = [*((f"octagon-{angle}", OCTAGON_MM, angle, "") for angle in (0, 45, 90, 135))]
    widths += [(f"square-{angle}", SQUARE_MM, angle, "") for angle in (0, 90)]
    widths += [(f"slot-{slot:g}", slot, 0, "inside = true\n") for slot in SLOTS_MM]
    for name, nominal, angle, more in widths:
        what = f'name = "{name}"\nkind = "width"\nnominal_mm = {nominal:g}\nacross_deg = {angle}\n'
        rows.append(f"\n[[feature]]\n{what}{limits}{more}")
    form = f"form_um = {limit_um:g}\n"
    rows.append(f'\n[[feature]]\nname = "disc"\nkind = "circle"\nnominal_mm = {DISC_MM:g}\n{limits}{form}')
    return "".join(rows)


def _eighths() -> list[float]:
    return [math.pi / 8.0 + at * math.pi / 4.0 for at in range(8)]


def _box(x: float, y: float, wide: float, high: float) -> list[tuple[float, float]]:
    return [(x, y), (x + wide, y), (x + wide, y + high), (x, y + high)]
