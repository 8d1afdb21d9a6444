"""What is asked of the part: an offset that the controller is to add, its kerf, and a drawing to hold it against."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any, Literal, NamedTuple, get_args

from controller.offset.sections import Side
from parser.drawing.model import DEFAULT_GAP_UM
from parser.findings.errors import SettingsError
from parser.text.encoding import printable
from sim.setup.toml.keys import Key, Section
from sim.setup.toml.kinds import MM_AS_UM, FileName, Number, OneOf, Text, Truth
from sim.setup.toml.reader import Bound, text

OFFSET_MM = Bound(0.0001, 10.0)
TOLERANCE_UM = Bound(0.001, 1e6)
GAP_UM = Bound(0.001, 1e4)
DENSITY_G_CM3 = Bound(0.01, 30.0)

SIDES: Mapping[str, Side] = {side.name.lower(): side for side in Side}
SharpCorners = Literal["tell", "fail"]
"""What a sharp inside corner of the drawing does, which no wire can cut: it is told apart, or it fails as drawn."""
SHARP_CORNERS: tuple[str, ...] = get_args(SharpCorners)
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


class DrawingTarget(NamedTuple):
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
    sharp_corners
        Whether what the wire must leave in sharp inside corners is told apart, or fails.
    """

    file: Path
    layer: str | None = None
    tolerance_um: float = DEFAULT_TOLERANCE_UM
    gap_um: float = DEFAULT_GAP_UM
    fit: bool = True
    sharp_corners: SharpCorners = "tell"


class _SideWord(OneOf):
    """A side by its word."""

    def checked(self, table: Mapping[str, Any], key: str, where: str) -> str:
        """The word."""
        name = text(table, key, where)
        if name not in SIDES:
            raise SettingsError(f"{where}: {key} is {' or '.join(SIDES)}; found {name!r}")
        return name

    def kept(self, value: Any) -> Side:
        """The side."""
        return SIDES[value]

    def written(self, value: Any) -> str:
        """Its word."""
        return next(name for name, side in SIDES.items() if side is value)


OFFSET = Section(
    "offset",
    (Key("by_mm", Number(OFFSET_MM, "mm", MM_AS_UM), "by_um"), Key("side", _SideWord(tuple(SIDES)))),
    fills="offset",
)
DRAWING = Section(
    "drawing",
    (
        Key("file", FileName()),
        Key("layer", Text(), default=None, get=lambda drawing: drawing.layer and printable(drawing.layer)),
        Key("tolerance_um", Number(TOLERANCE_UM, "µm"), default=DEFAULT_TOLERANCE_UM),
        Key("gap_um", Number(GAP_UM, "µm"), default=DEFAULT_GAP_UM),
        Key("fit", Truth(), default=True),
        Key("sharp_corners", OneOf(SHARP_CORNERS), default="tell"),
    ),
    fills="drawing",
)


def read_offset(scenario: Mapping[str, Any], where: str) -> Offset | None:
    """Offset of ``[offset]``, None where it is left out. SettingsError names file and key."""
    return Offset(**OFFSET.read_in(scenario, where)) if "offset" in scenario else None


def read_drawing_target(scenario: Mapping[str, Any], where: str, folder: Path) -> DrawingTarget | None:
    """Drawing of ``[drawing]``, None where it is left out; its file lies in the folder. SettingsError names the key."""
    if "drawing" not in scenario:
        return None
    drawing = DrawingTarget(**DRAWING.read_in(scenario, where))
    return drawing._replace(file=folder / drawing.file)
