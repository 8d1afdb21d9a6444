"""How a program is to be made of a drawing: what its maker is asked for, and how its text is written."""

from collections.abc import Mapping
from pathlib import Path
from typing import Literal, NamedTuple, get_args

from parser.findings.errors import SettingsError
from parser.toolpath import Point

Language = Literal["3b", "4b", "iso"]
SideWish = Literal["nesting", "inside", "outside"]
DirectionWish = Literal["one-side", "ccw", "cw"]
Returning = Literal["back", "one-way"]
LeadIn = Literal["perpendicular", "point", "arc", "tangent"]
Corners = Literal["sharp", "round"]
Form = Literal["compact", "aligned", "detailed"]
Encoding = Literal["utf-8", "gbk"]
Compensation = Literal["worked-in", "kept"]
LANGUAGES: tuple[str, ...] = get_args(Language)
SIDE_WISHES: tuple[str, ...] = get_args(SideWish)
DIRECTION_WISHES: tuple[str, ...] = get_args(DirectionWish)
RETURNINGS: tuple[str, ...] = get_args(Returning)
LEAD_INS: tuple[str, ...] = get_args(LeadIn)
CORNERS: tuple[str, ...] = get_args(Corners)
FORMS: tuple[str, ...] = get_args(Form)
ENCODINGS: tuple[str, ...] = get_args(Encoding)
COMPENSATIONS: tuple[str, ...] = get_args(Compensation)
SUFFIXES: Mapping[str, Language] = {".3b": "3b", ".4b": "4b", ".iso": "iso", ".nc": "iso", ".cnc": "iso"}
"""Languages of programs that are written, by the suffixes of their files."""
_MACHINE_UM = 8.0
"""What steps and table add to the path: up to 4 µm on the machines that are here, and twice that in a corner."""
DEFAULT_FIT_UM = 2.0
"""Usual in CAMs (HSMWorks' post for wire EDM has it by default)."""


class LayerWish(NamedTuple):
    """What is asked for the contours of one layer, in place of what holds for all.

    Attributes
    ----------
    layer
        Its name, in letters of either case.
    side
        On which side the wire runs; None for that of all.
    rank
        Contours of a lower rank are cut first, as far as nesting allows; None for none.
    passes_um
        Offset of each pass; that of all where empty.
    """

    layer: str
    side: SideWish | None = None
    rank: int | None = None
    passes_um: tuple[float, ...] = ()


class Making(NamedTuple):
    """How a program is to be made of a drawing.

    Attributes
    ----------
    tolerance_um
        How far the path may lie off the one that the drawing asks for.
    part_tolerance_um
        How far the edge as cut may lie off the drawing; None for the tolerance of the path and what a machine in order
        adds, 8 µm.
    layer
        The one layer whose contours are cut; all that are seen where None.
    gap_um
        Ends of the drawing that are no farther apart are joined.
    passes_um
        Offset of each pass, the first one first; 0 alone for the contour itself. The reach of the wire where empty.
    returning
        Whether passes run back and forth, or each the same way.
    side
        On which side the wire runs: by nesting inside of holes and outside of parts, or the same for all.
    direction
        ``one-side``: so that the wire is on the same side of all contours, the left; else as asked for.
    order
        Numbers of figures in the order in which they are cut; by nesting and the shortest way where empty.
    starts_um
        Thread points, each for the figure whose waste it lies in.
    thread_layer
        Layer whose points and circles are thread points.
    lead
        How the wire comes to the contour.
    lead_um
        How long the lead-in is where the thread point is chosen; None for what suits.
    overcut_um
        How far the last pass runs on behind its start.
    tab_um
        How much of each part's outline is left for a last cut behind a stop; 0 for none.
    corners
        How the wire goes round outside corners.
    layers
        What is asked for some layers.
    """

    tolerance_um: float = DEFAULT_FIT_UM
    part_tolerance_um: float | None = None
    layer: str | None = None
    gap_um: float = 10.0
    passes_um: tuple[float, ...] = ()
    returning: Returning = "back"
    side: SideWish = "nesting"
    direction: DirectionWish = "one-side"
    order: tuple[int, ...] = ()
    starts_um: tuple[Point, ...] = ()
    thread_layer: str | None = None
    lead: LeadIn = "perpendicular"
    lead_um: float | None = None
    overcut_um: float = 0.0
    tab_um: float = 0.0
    corners: Corners = "sharp"
    layers: tuple[LayerWish, ...] = ()

    @property
    def held_to_um(self) -> float:
        """How far the edge as cut may lie off the drawing."""
        return self.tolerance_um + _MACHINE_UM if self.part_tolerance_um is None else self.part_tolerance_um


class Writing(NamedTuple):
    """How a program that is made is written.

    Attributes
    ----------
    form
        Of 3B and 4B.
    end_code, pause_code
        Words of 3B and 4B in place of ``DD`` and ``D``; None for those.
    crlf
        Whether lines end as Windows does.
    encoding
        Of its bytes.
    compensation
        Whether offsets are worked into the path, or G41 and G42 of ISO leave them to the controller.
    decimals
        Digits behind the point, of ISO; None as its dialect has them.
    """

    form: Form = "compact"
    end_code: str | None = None
    pause_code: str | None = None
    crlf: bool = False
    encoding: Encoding = "utf-8"
    compensation: Compensation = "worked-in"
    decimals: int | None = None


class ToMake(NamedTuple):
    """A program that is made of a scenario's drawing: name of its file, what is asked of its maker and of its text."""

    file: Path = Path("program.3b")
    making: Making = Making()
    writing: Writing = Writing()

    @property
    def language(self) -> Language:
        """What the suffix of its file says. SettingsError where that says none."""
        return language_of(self.file)


def language_of(file: Path) -> Language:
    """The language that the suffix of a file says. SettingsError where it says none."""
    language = SUFFIXES.get(file.suffix.lower())
    if language is None:
        raise SettingsError("suffix-without-language", file=file, suffixes=", ".join(SUFFIXES))
    return language
