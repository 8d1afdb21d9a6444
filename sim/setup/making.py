"""How a program is to be made of a drawing, and the sections ``[program]`` and ``[[layer]]`` that say so.

How a program is to be made of a drawing: what its maker is asked for, and how its text is written.

``[program]`` and ``[[layer]]`` of a scenario file, and what no program can be asked for.
"""

from collections.abc import Mapping
from itertools import pairwise
from pathlib import Path
from typing import Any, Literal, NamedTuple, get_args

from parser.findings.errors import Message, SettingsError
from parser.toolpath import Point
from parser.units import mm
from sim.setup.part import GAP_UM, OFFSET_MM, PASSES, TOLERANCE_UM, DrawingTarget
from sim.setup.picks import Pick, Picks
from sim.setup.toml.keys import Key, Section
from sim.setup.toml.kinds import MM_AS_UM, FileName, Lengths, Name, Number, OneOf, Places, Text, Truth, Whole, Wholes
from sim.setup.toml.reader import PLACE_MM, Bound, number, tables
from sim.setup.wire import WIRE_LAG_UM

Language = Literal["3b", "4b", "iso"]
SideWish = Literal["nesting", "inside", "outside"]
DirectionWish = Literal["one-side", "ccw", "cw"]
Returning = Literal["back", "one-way"]
LeadIn = Literal["perpendicular", "point", "arc", "tangent"]
Corners = Literal["sharp", "round", "chamfer"]
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
    unit
        The unit that it is drawn in; the one that the file names where None.
    picks
        What of the contours is cut; all of them where empty.
    spared
        Curves on which no cut starts: those that fit others, or are looked at.
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
    entries_um
        Where the wire comes to contours, each for the one that lies nearest; where it suits, for all others.
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
    slug_tab_um
        How much of each hole's contour is left, so that its slug stays until a round of cuts at the end; 0 for none.
    rough_first
        Whether the first passes of all figures come before the others, behind a stop; else figure after figure.
    corners
        How the wire goes round outside corners.
    no_core
        Whether small holes are cut without a core: the wire takes the slug away, and nothing falls.
    common_edges
        Whether edges that parts have in common are cut once; parts that touch are moved apart by a kerf for that.
    lag_um
        How far the wire lags behind its guides: the program leads these so that the wire cuts the part; 0 for a wire
        that stays straight.
    layers
        What is asked for some layers.
    upper
        Drawing of the contours at the top of the work; those of the drawing itself are at the bottom then. None for
        one drawing. Beside an angle of all contours it is only compared.
    """

    tolerance_um: float = DEFAULT_FIT_UM
    part_tolerance_um: float | None = None
    layer: str | None = None
    unit: str | None = None
    picks: tuple[Pick, ...] = ()
    spared: tuple[Pick, ...] = ()
    gap_um: float = 10.0
    passes_um: tuple[float, ...] = ()
    returning: Returning = "back"
    side: SideWish = "nesting"
    direction: DirectionWish = "one-side"
    order: tuple[int, ...] = ()
    starts_um: tuple[Point, ...] = ()
    entries_um: tuple[Point, ...] = ()
    thread_layer: str | None = None
    lead: LeadIn = "perpendicular"
    lead_um: float | None = None
    overcut_um: float = 0.0
    tab_um: float = 0.0
    slug_tab_um: float = 0.0
    rough_first: bool = False
    corners: Corners = "sharp"
    no_core: bool = False
    common_edges: bool = False
    lag_um: float = 0.0
    layers: tuple[LayerWish, ...] = ()
    upper: Path | None = None

    @property
    def in_rounds(self) -> bool:
        """Whether the wire comes to figures again, in rounds over all of them."""
        return self.rough_first or self.slug_tab_um > 0.0

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


FIT_UM = Bound(0.1, 1000.0)
"""Of a fit of arcs: less than a tenth of a step asks for what no program holds."""
LEAD_MM = Bound(0.001, 1000.0)
OVERCUT_MM = Bound(0.0, 100.0)
RANK = Bound(-1000, 1000)
FIGURE = Bound(1, 1e6)
DECIMALS = Bound(1, 6)
OR_NONE_MM = Bound(0.0, OFFSET_MM.high)
"""Offset of a pass; 0 for the contour itself."""
_USUAL, _AS_USUAL = Making(), Writing()

PROGRAM = Section(
    "program",
    (
        Key("file", FileName(), default="program.3b"),
        Key(
            "tolerance_um",
            Number(FIT_UM, "µm"),
            "making.tolerance_um",
            default=_USUAL.tolerance_um,
            option="--tolerance",
        ),
        Key("pick", Picks(), "making.picks", default=(), option="--pick"),
        Key("spare", Picks(), "making.spared", default=(), option="--spare"),
        Key("passes_mm", Lengths(OR_NONE_MM), "making.passes_um", default=(), option="--pass"),
        Key("returning", OneOf(RETURNINGS), "making.returning", default=_USUAL.returning),
        Key("side", OneOf(SIDE_WISHES), "making.side", default=_USUAL.side, option="--side"),
        Key("direction", OneOf(DIRECTION_WISHES), "making.direction", default=_USUAL.direction, option="--direction"),
        Key("order", Wholes(FIGURE), "making.order", default=(), option="--order"),
        Key("starts_mm", Places(PLACE_MM), "making.starts_um", default=(), option="--start"),
        Key("entries_mm", Places(PLACE_MM), "making.entries_um", default=(), option="--enter"),
        Key("thread_layer", Text(), "making.thread_layer", default=None, option="--thread-layer"),
        Key("lead", OneOf(LEAD_INS), "making.lead", default=_USUAL.lead, option="--lead"),
        Key("lead_mm", Number(LEAD_MM, "mm", MM_AS_UM), "making.lead_um", default=None, option="--lead-length"),
        Key("overcut_mm", Number(OVERCUT_MM, "mm", MM_AS_UM), "making.overcut_um", default=0.0, option="--overcut"),
        Key("tab_mm", Number(OVERCUT_MM, "mm", MM_AS_UM), "making.tab_um", default=0.0, option="--tab"),
        Key("slug_tab_mm", Number(OVERCUT_MM, "mm", MM_AS_UM), "making.slug_tab_um", default=0.0, option="--slug-tab"),
        Key("rough_first", Truth(), "making.rough_first", default=False, option="--rough-first"),
        Key(
            "corners",
            OneOf(CORNERS),
            "making.corners",
            default=_USUAL.corners,
            option="--corner",
            older="--corners",
        ),
        Key("no_core", Truth(), "making.no_core", default=False, option="--no-core"),
        Key("common_edges", Truth(), "making.common_edges", default=False, option="--common-edges"),
        Key("lag_um", Number(WIRE_LAG_UM, "µm"), "making.lag_um", default=0.0, option="--lag"),
        Key("form", OneOf(FORMS), "writing.form", default=_AS_USUAL.form, option="--form"),
        Key("end_code", Name(), "writing.end_code", default=None, option="--end-code"),
        Key("pause_code", Name(), "writing.pause_code", default=None, option="--pause-code"),
        Key("crlf", Truth(), "writing.crlf", default=False, option="--crlf"),
        Key("encoding", OneOf(ENCODINGS), "writing.encoding", default=_AS_USUAL.encoding, option="--encoding"),
        Key(
            "compensation",
            OneOf(COMPENSATIONS),
            "writing.compensation",
            default=_AS_USUAL.compensation,
            option="--compensation",
        ),
        Key("decimals", Whole(DECIMALS), "writing.decimals", default=None, option="--decimals"),
    ),
    fills="to_make",
)
LAYER = Section(
    "layer",
    (
        Key("name", Name(), "layer"),
        Key("side", OneOf(SIDE_WISHES), default=None),
        Key("rank", Whole(RANK), default=None),
        Key("passes_mm", Lengths(OR_NONE_MM), "passes_um", default=()),
    ),
    fills="layer_wishes",
    form="list",
)


def read_to_make(scenario: Mapping[str, Any], where: str, drawing: DrawingTarget | None) -> ToMake | None:
    """The program of ``[program]``, with wishes of ``[[layer]]``; None where it is left out or names a file alone.

    Layer, gap and tolerance of the part are those of the drawing. SettingsError names file and key.
    """
    wishes = tuple(
        LayerWish(**LAYER.read(table, f"{where}: {LAYER.header} {at}"))
        for at, table in enumerate(tables(scenario, "layer", where), start=1)
    )
    if not isinstance(scenario.get("program"), Mapping):
        if wishes:
            raise SettingsError("layer-needs-program", where=where)
        return None
    if drawing is None:
        raise SettingsError("program-needs-drawing", where=where)
    value = PROGRAM.read_in(scenario, where)
    making = of_drawing(Making(**value["making"])._replace(layers=wishes), drawing)
    refuse_odd(making, f"{where}: [program]")
    found = ToMake(value["file"], making, Writing(**value["writing"]))
    refuse_misfits(found.writing, found.language, f"{where}: [program]")
    return found


def of_drawing(making: Making, drawing: DrawingTarget) -> Making:
    """What is asked, with layer, unit, gap and tolerance of the part that a drawing is held to, and that of its top."""
    return making._replace(
        layer=drawing.layer,
        unit=drawing.unit,
        gap_um=drawing.gap_um,
        part_tolerance_um=drawing.tolerance_um,
        upper=drawing.upper,
    )


def refuse_odd(making: Making, where: str | Message) -> None:
    """SettingsError where numbers are out of their bounds, or say what cannot be meant."""
    number(making.tolerance_um, FIT_UM, _named(where, "name-tolerance"))
    number(making.held_to_um, TOLERANCE_UM, _named(where, "name-part-tolerance"))
    number(making.gap_um, GAP_UM, _named(where, "name-gap"))
    number(mm(making.overcut_um), OVERCUT_MM, _named(where, "name-overcut"))
    number(mm(making.tab_um), OVERCUT_MM, _named(where, "name-tab"))
    number(mm(making.slug_tab_um), OVERCUT_MM, _named(where, "name-slug-tab"))
    number(making.lag_um, WIRE_LAG_UM, _named(where, "name-lag"))
    if making.lead_um is not None:
        number(mm(making.lead_um), LEAD_MM, _named(where, "name-lead"))
    for passes_um in (making.passes_um, *(wish.passes_um for wish in making.layers)):
        _refuse_odd_passes(passes_um, where)


def refuse_misfits(writing: Writing, language: Language, where: str) -> None:
    """SettingsError for what the language that is written has nothing for, and for codes that nobody can tell."""
    _refuse_odd_codes(writing, where)
    usual = Writing()
    others = {
        "3B and 4B": ("form", "end_code", "pause_code") if language == "iso" else (),
        "ISO": ("decimals",) if language != "iso" else (),
        "4B and ISO": ("compensation",) if language == "3b" else (),
    }
    for languages, names in others.items():
        for name in names:
            if getattr(writing, name) != getattr(usual, name):
                raise SettingsError(
                    "key-not-for-language", where=where, name=name, languages=languages, language=language
                )


def _refuse_odd_codes(writing: Writing, where: str) -> None:
    for code in (writing.end_code, writing.pause_code):
        if code is not None and (not code.isprintable() or len(code.split()) != 1 or code != code.strip()):
            raise SettingsError("end-code-no-word", where=where, found=code)
    if (writing.end_code or "DD") == (writing.pause_code or "D"):
        raise SettingsError("same-end-and-pause", where=where)


def _refuse_odd_passes(passes_um: tuple[float, ...], where: str | Message) -> None:
    if not passes_um:
        return
    number(len(passes_um), PASSES, _named(where, "name-passes"))
    for value in filter(None, passes_um):
        number(mm(value), OFFSET_MM, _named(where, "name-pass-offset"))
    if any(later > before for before, later in pairwise(passes_um)):
        raise SettingsError("pass-offset-rises", where=where)
    if len(passes_um) > 1 and not min(passes_um):
        raise SettingsError("pass-of-offset-0", where=where)


def _named(where: str | Message, name: str) -> Message:
    """What a number is called in a message: the name that stands in the texts, behind its place."""
    return Message("in-file", file=where, message=Message(name))
