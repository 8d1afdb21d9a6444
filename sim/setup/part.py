"""What is asked of the part and its work: an offset, a drawing to hold the cut against, thickness and outline.

The work: its thickness, its density and its outline; and what a shop writes of it on the sheet of the job.
"""

import operator
from collections.abc import Mapping
from itertools import accumulate
from pathlib import Path
from typing import Any, Final, Literal, NamedTuple, get_args

from controller.offset.shifted import Side
from parser.drawing.model import DEFAULT_GAP_UM, UNITS
from parser.findings.errors import Message, SettingsError
from parser.text.encoding import printable
from sim.setup.obstacles import OutlineMm
from sim.setup.toml.keys import Key, Section
from sim.setup.toml.kinds import MM_AS_UM, MM_MIN_AS_UM_S, FileName, Name, Number, OneOf, Text, Truth
from sim.setup.toml.reader import AREA_RATE_MM2_MIN, Bound, number, tables, text

OFFSET_MM = Bound(0.0001, 10.0)
PASSES = Bound(1, 20)
"""Of one contour; a precise part takes up to eight (assumed)."""
FEED_MM_MIN = Bound(0.001, 1e4)
TOLERANCE_UM = Bound(0.001, 1e6)
GAP_UM = Bound(0.001, 1e4)

DRAWING_UNITS = tuple(unit.word for unit in UNITS.values())
SIDES: Mapping[str, Side] = {side.name.lower(): side for side in Side}
SharpCorners = Literal["tell", "fail"]
"""What a sharp inside corner of the drawing does, which no wire can cut: it is told apart, or it fails as drawn."""
SHARP_CORNERS: tuple[str, ...] = get_args(SharpCorners)
DEFAULT_TOLERANCE_UM = 5.0
"""What a first cut is usually held to (assumed)."""


Direction = Literal["same", "back"]


class OffsetPass(NamedTuple):
    """One pass over each contour.

    Attributes
    ----------
    by_um
        Distance of the wire's centre from the contour, µm.
    direction
        Whether it runs as the pass before it does, or back; the first one runs as the program does.
    feed_um_s, area_rate_mm2_min
        Its feed, or its area rate, which makes a feed in the thickness of the work; the area rate of the machine where
        neither is given.
    """

    by_um: float
    direction: Direction = "same"
    feed_um_s: float | None = None
    area_rate_mm2_min: float | None = None


class Offset(NamedTuple):
    """Offset that the controller adds to a program on the drawing's contour, as for 4B (docs/3b.md §6).

    Attributes
    ----------
    passes
        The passes over each contour, one or more, in order.
    side
        Side of the contour in the first pass, along its cutting direction. A pass that runs back keeps to the same side
        of the material.
    """

    passes: tuple[OffsetPass, ...]
    side: Side

    @property
    def by_um(self) -> float:
        """Least distance from the contour: of the pass that makes the edge."""
        return min(pass_.by_um for pass_ in self.passes)

    @property
    def nearest(self) -> int:
        """The first pass at the least distance, from 0."""
        return [pass_.by_um for pass_ in self.passes].index(self.by_um)

    @property
    def back(self) -> tuple[bool, ...]:
        """Whether each pass runs against the program."""
        turns = [pass_.direction == "back" for pass_ in self.passes]
        return tuple(accumulate(turns, operator.ne))

    @property
    def is_plain(self) -> bool:
        """Whether it is one pass at the feed of the machine."""
        return self.passes == (OffsetPass(self.by_um),)


class DrawingTarget(NamedTuple):
    """Drawing that the cut is held against.

    Attributes
    ----------
    file
        A DXF file: the part at the program plane.
    upper
        Another one: the part at the top of the work, cut by a wire that leans; it lies on the sheet as the first does.
    layer
        Layer of the contour; all where None.
    unit
        Unit that it is drawn in; the one that the file names where None.
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
    unit: str | None = None
    upper: Path | None = None

    @property
    def of_top(self) -> "DrawingTarget | None":
        """The drawing of the top, held as the other is, where that lies; None where there is none."""
        return None if self.upper is None else self._replace(file=self.upper, upper=None, fit=False)


class SideWord(OneOf):
    """A side by its word."""

    def checked(self, table: Mapping[str, Any], key: str, where: str) -> str:
        """The word."""
        name = text(table, key, where)
        if name not in SIDES:
            raise SettingsError("no-side", where=where, key=key, sides=" or ".join(SIDES), found=name)
        return name

    def inside(self, value: Any) -> Side:
        """The side."""
        return SIDES[value]

    def written(self, value: Any) -> str:
        """Its word."""
        return next(name for name, side in SIDES.items() if side is value)


_BY_MM = Number(OFFSET_MM, "mm", MM_AS_UM)
SIDE = Key("side", SideWord(tuple(SIDES)), option="--side")
OFFSET = Section(
    "offset",
    (
        Key("by_mm", _BY_MM, "by_um", default=None, get=lambda offset: offset.by_um if offset.is_plain else None),
        SIDE,
    ),
    fills="offset",
)
PASS = Section(
    "pass",
    (
        Key("by_mm", _BY_MM, "by_um"),
        Key("direction", OneOf(("same", "back")), default="same"),
        Key("feed_mm_min", Number(FEED_MM_MIN, "mm/min", MM_MIN_AS_UM_S), "feed_um_s", default=None),
        Key("area_rate_mm2_min", Number(AREA_RATE_MM2_MIN, "mm²/min"), default=None),
    ),
    fills="pass_tables",
    form="list",
)
TOLERANCE = Key("tolerance_um", Number(TOLERANCE_UM, "µm"), default=DEFAULT_TOLERANCE_UM, option="--tolerance")
GAP = Key("gap_um", Number(GAP_UM, "µm"), default=DEFAULT_GAP_UM, option="--gap")
LAYER = Key(
    "layer", Text(), default=None, get=lambda drawing: drawing.layer and printable(drawing.layer), option="--layer"
)
UNIT = Key("unit", OneOf(DRAWING_UNITS), default=None, option="--drawing-unit")
FIT = Key("fit", Truth(), default=True, option="--no-fit")
CORNERS = Key("sharp_corners", OneOf(SHARP_CORNERS), default="tell", option="--sharp-corners")
DRAWING = Section(
    "drawing",
    (
        Key("file", FileName()),
        Key("upper", FileName(), default=None),
        LAYER,
        UNIT,
        TOLERANCE,
        GAP,
        FIT,
        CORNERS,
    ),
    fills="drawing",
)


def read_offset(scenario: Mapping[str, Any], where: str) -> Offset | None:
    """Offset of ``[offset]``, in one pass or in those of ``[[pass]]``; None where it is left out.

    SettingsError names file and key.
    """
    passes = tables(scenario, "pass", where)
    if "offset" not in scenario:
        if "pass" in scenario:
            raise SettingsError("pass-needs-offset", where=where)
        return None
    value = OFFSET.read_in(scenario, where)
    by_um, side = value["by_um"], value["side"]
    if "pass" not in scenario:
        if by_um is None:
            raise SettingsError("offset-missing", where=where)
        return Offset((OffsetPass(by_um),), side)
    if by_um is not None:
        raise SettingsError("offset-given-twice", where=where)
    number(len(passes), PASSES, Message("name-number", where=where, key="[[pass]]"))
    return Offset(tuple(_pass(table, at, f"{where}: [[pass]] {at}") for at, table in enumerate(passes, start=1)), side)


def _pass(table: Mapping[str, Any], at: int, where: str) -> OffsetPass:
    offset_pass = OffsetPass(**PASS.read(table, where))
    if at == 1 and offset_pass.direction == "back":
        raise SettingsError("first-pass-runs-back", where=where)
    if offset_pass.feed_um_s is not None and offset_pass.area_rate_mm2_min is not None:
        raise SettingsError("feed-and-area-rate", where=where)
    return offset_pass


def read_drawing_target(scenario: Mapping[str, Any], where: str, folder: Path) -> DrawingTarget | None:
    """Drawing of ``[drawing]``, None where it is left out; its file lies in the folder. SettingsError names the key."""
    if "drawing" not in scenario:
        return None
    drawing = DrawingTarget(**DRAWING.read_in(scenario, where))
    return drawing._replace(file=folder / drawing.file, upper=drawing.upper and folder / drawing.upper)


THICKNESS_MM = Bound(0.01, 2000.0)
DENSITY_G_CM3 = Bound(0.01, 30.0)
DEFAULT_THICKNESS_MM = 40.0
DEFAULT_DENSITY_G_CM3 = 7.85
"""Steel: C45 and Cr12 lie within 0.1 of it (any table of materials)."""

THICKNESS = Key(
    "thickness_mm",
    Number(THICKNESS_MM, "mm"),
    default=DEFAULT_THICKNESS_MM,
    option="--thickness",
    older="--height",
    form="thickness_mm",
)
MATERIAL = Key("material", Name(), default=None, option="--material")
WORK = Section(
    "work",
    (
        THICKNESS,
        MATERIAL,
        Key("density_g_cm3", Number(DENSITY_G_CM3, "g/cm³"), default=DEFAULT_DENSITY_G_CM3),
        Key("outline_mm", OutlineMm(), "work_um", default=None),
    ),
)


class JobFields(NamedTuple):
    """Fields of the job sheet as they are written there; None of those that are left to be filled in by hand."""

    part_number: str | None = None
    material: str | None = None
    pieces: str | None = None
    pulse_on: str | None = None
    pulse_off: str | None = None
    current: str | None = None
    wire_speed: str | None = None


SHEET: Final = Section("sheet", tuple(Key(name, Name(), default=None) for name in JobFields._fields), fills="sheet")
