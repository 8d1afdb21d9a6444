"""A wire that leans: what is told of it beside the program, in ``[taper]`` of a scenario."""

import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any, Final, NamedTuple, get_args

from controller.offset.shifted import Side
from controller.taper.shifted_contour import Corner
from controller.taper.tilted import Heights
from parser.files import read_bytes
from parser.findings.errors import SettingsError
from parser.text.encoding import printable
from parser.units import from_mm, mm
from sim.setup.machine.guides import ANGLE_DEG, Guides
from sim.setup.part import SideWord
from sim.setup.toml.keys import Key, Section
from sim.setup.toml.kinds import DEGREES_AS_RAD, MM_AS_UM, FileName, Number, OneOf
from sim.setup.toml.reader import Bound

PLANE_MM: Final = Bound(0.0, 2000.0)


class UpperProgram(NamedTuple):
    """The program of an upper contour: the name of its file, and its bytes, so that it goes where its scenario goes."""

    name: str
    data: bytes


class TaperSettings(NamedTuple):
    """What is told of the lean beside the program.

    Attributes
    ----------
    angle_rad
        Of a whole figure, whose program says none; None where the program is to say it.
    side
        To which side of travel the upper end leans.
    corner
        Whether both planes keep corners, or an arc goes round them in the outer plane.
    program_plane_um
        Height of the program plane above the bottom of the work.
    upper
        Program of the upper contour, matched block by block; it is at the top of the work.
    """

    angle_rad: float | None = None
    side: Side = Side.RIGHT
    corner: Corner = "sharp"
    program_plane_um: float = 0.0
    upper: UpperProgram | None = None


TAPER: Final = Section(
    "taper",
    (
        Key("angle_deg", Number(ANGLE_DEG, "°", DEGREES_AS_RAD), "angle_rad", default=None),
        Key("side", SideWord(("left", "right")), default="right"),
        Key("corner", OneOf(get_args(Corner)), default=TaperSettings().corner),
        Key("program_plane_mm", Number(PLANE_MM, "mm", MM_AS_UM), "program_plane_um", default=0.0),
        Key("upper", FileName(), default=None, get=lambda taper: taper.upper and Path(taper.upper.name)),
    ),
    fills="taper",
)


def read_taper(content: Mapping[str, Any], where: str, folder: Path) -> TaperSettings | None:
    """``[taper]`` of a scenario; None without it.

    SettingsError names file and key, and what does not go together; FileUnreadableError the program that is not there.
    """
    if TAPER.name not in content:
        return None
    values = TAPER.read_in(content, where)
    upper = values.pop("upper")
    if upper is not None and values["angle_rad"] is not None:
        raise SettingsError("taper-angle-and-upper", where=where)
    return TaperSettings(**values, upper=None if upper is None else read_upper(folder / upper))


def read_upper(path: Path) -> UpperProgram:
    """The program of an upper contour. FileUnreadableError where there is no such file."""
    return UpperProgram(printable(path.name), read_bytes(path))


def heights_of(taper: TaperSettings, guides: Guides, thickness_mm: float) -> Heights:
    """Planes and guides about work of a thickness. SettingsError where the program plane lies outside of it."""
    work_um = from_mm(thickness_mm)
    if taper.program_plane_um > work_um:
        raise SettingsError("plane-outside-work", plane_mm=mm(taper.program_plane_um), thickness_mm=thickness_mm)
    return Heights(work_um, taper.program_plane_um, -guides.lower_um, work_um + guides.upper_um)


def refuse_one_height(plane_um: float, work_um: float) -> None:
    """SettingsError where the planes of two contours lie at one height."""
    if plane_um >= work_um:
        raise SettingsError("contours-at-one-height", plane_mm=mm(plane_um))


def angle_of(text: str, where: str) -> float:
    """An angle in rad of degrees, with or without their sign: ``3``, ``3deg``, ``3°``. SettingsError for others."""
    number = text.strip().removesuffix("°").removesuffix("deg").strip()
    try:
        degrees = float(number)
    except ValueError:
        degrees = math.nan
    if not ANGLE_DEG.low <= degrees <= ANGLE_DEG.high:
        raise SettingsError("no-angle", where=where, found=text, most=ANGLE_DEG.high)
    return math.radians(degrees)
