"""What is asked of the part: an offset that the controller is to add, its kerf, and a drawing to hold it against."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any, NamedTuple

from controller.offset.sections import Side
from parser.drawing.model import DEFAULT_GAP_UM
from parser.findings.errors import SettingsError
from parser.units import from_mm
from sim.setup.toml.reader import Bound, number, refuse_unknown, section, text, truth

OFFSET_MM = Bound(0.0001, 10.0)
TOLERANCE_UM = Bound(0.001, 1e6)
GAP_UM = Bound(0.001, 1e4)
DENSITY_G_CM3 = Bound(0.01, 30.0)

SIDES: Mapping[str, Side] = {side.name.lower(): side for side in Side}
DEFAULT_TOLERANCE_UM = 5.0
"""What a first cut is usually held to (assumed)."""
DEFAULT_DENSITY_G_CM3 = 7.85
"""Steel: C45 and Cr12 lie within 0.1 of it (any table of materials)."""


class Offset(NamedTuple):
    """Offset that the controller adds to a program on the drawing's contour, as for 4B (docs/3b.md §6).

    Attributes
    ----------
    by_um
        Distance of the wire's centre from the contour, µm.
    side
        Side of the contour, along the cutting direction.
    """

    by_um: float
    side: Side


class DrawingAsked(NamedTuple):
    """Drawing that the cut is held against.

    Attributes
    ----------
    file
        A DXF file.
    layer
        Layer of the contour; all where None.
    tolerance_um
        Distance that edge and drawing may be apart.
    gap_um
        Gap that joins ends of the drawing.
    fit
        Whether position and turn are fitted; else the drawing is taken as it lies.
    """

    file: Path
    layer: str | None = None
    tolerance_um: float = DEFAULT_TOLERANCE_UM
    gap_um: float = DEFAULT_GAP_UM
    fit: bool = True


def read_offset(scenario: Mapping[str, Any], where: str) -> Offset | None:
    """Offset of ``[offset]``, None where it is left out. SettingsError names file and key."""
    if "offset" not in scenario:
        return None
    table, where = section(scenario, "offset", where), f"{where}: [offset]"
    refuse_unknown(table, ("by_mm", "side"), where)
    if "by_mm" not in table:
        raise SettingsError(f"{where}: by_mm is missing")
    return Offset(
        from_mm(number(table["by_mm"], OFFSET_MM, f"{where}: by_mm")),
        side_named(text(table, "side", where), f"{where}: side"),
    )


def side_named(name: str, where: str) -> Side:
    """The side ``left`` or ``right``. SettingsError for anything else."""
    if name not in SIDES:
        raise SettingsError(f"{where} is {' or '.join(SIDES)}; found {name!r}")
    return SIDES[name]


def read_drawing_asked(scenario: Mapping[str, Any], where: str, folder: Path) -> DrawingAsked | None:
    """Drawing of ``[drawing]``, None where it is left out; its file lies in the folder. SettingsError names the key."""
    if "drawing" not in scenario:
        return None
    table, where = section(scenario, "drawing", where), f"{where}: [drawing]"
    refuse_unknown(table, DrawingAsked._fields, where)
    return DrawingAsked(
        file=folder / text(table, "file", where),
        layer=text(table, "layer", where) if "layer" in table else None,
        tolerance_um=number(table.get("tolerance_um", DEFAULT_TOLERANCE_UM), TOLERANCE_UM, f"{where}: tolerance_um"),
        gap_um=number(table.get("gap_um", DEFAULT_GAP_UM), GAP_UM, f"{where}: gap_um"),
        fit=truth(table, "fit", where, default=True),
    )
