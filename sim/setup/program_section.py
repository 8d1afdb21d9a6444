"""``[program]`` and ``[[layer]]`` of a scenario file, and what no program can be asked for."""

from collections.abc import Mapping
from itertools import pairwise
from typing import Any

from parser.findings.errors import Message, SettingsError
from parser.units import mm
from sim.setup.making import (
    COMPENSATIONS,
    CORNERS,
    DIRECTION_WISHES,
    ENCODINGS,
    FORMS,
    LEAD_INS,
    RETURNINGS,
    SIDE_WISHES,
    Language,
    LayerWish,
    Making,
    ToMake,
    Writing,
)
from sim.setup.part import GAP_UM, OFFSET_MM, PASSES, TOLERANCE_UM, DrawingTarget
from sim.setup.toml.keys import Key, Section
from sim.setup.toml.kinds import MM_AS_UM, FileName, Lengths, Name, Number, OneOf, Places, Text, Truth, Whole, Wholes
from sim.setup.toml.reader import PLACE_MM, Bound, number, tables

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
        Key("tolerance_um", Number(FIT_UM, "µm"), "making.tolerance_um", default=_USUAL.tolerance_um),
        Key("passes_mm", Lengths(OR_NONE_MM), "making.passes_um", default=()),
        Key("returning", OneOf(RETURNINGS), "making.returning", default=_USUAL.returning),
        Key("side", OneOf(SIDE_WISHES), "making.side", default=_USUAL.side),
        Key("direction", OneOf(DIRECTION_WISHES), "making.direction", default=_USUAL.direction),
        Key("order", Wholes(FIGURE), "making.order", default=()),
        Key("starts_mm", Places(PLACE_MM), "making.starts_um", default=()),
        Key("thread_layer", Text(), "making.thread_layer", default=None),
        Key("lead", OneOf(LEAD_INS), "making.lead", default=_USUAL.lead),
        Key("lead_mm", Number(LEAD_MM, "mm", MM_AS_UM), "making.lead_um", default=None),
        Key("overcut_mm", Number(OVERCUT_MM, "mm", MM_AS_UM), "making.overcut_um", default=0.0),
        Key("tab_mm", Number(OVERCUT_MM, "mm", MM_AS_UM), "making.tab_um", default=0.0),
        Key("corners", OneOf(CORNERS), "making.corners", default=_USUAL.corners),
        Key("form", OneOf(FORMS), "writing.form", default=_AS_USUAL.form),
        Key("end_code", Name(), "writing.end_code", default=None),
        Key("pause_code", Name(), "writing.pause_code", default=None),
        Key("crlf", Truth(), "writing.crlf", default=False),
        Key("encoding", OneOf(ENCODINGS), "writing.encoding", default=_AS_USUAL.encoding),
        Key("compensation", OneOf(COMPENSATIONS), "writing.compensation", default=_AS_USUAL.compensation),
        Key("decimals", Whole(DECIMALS), "writing.decimals", default=None),
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
    """What is asked, with layer, gap and tolerance of the part that a drawing is held to."""
    return making._replace(layer=drawing.layer, gap_um=drawing.gap_um, part_tolerance_um=drawing.tolerance_um)


def refuse_odd(making: Making, where: str) -> None:
    """SettingsError where numbers are out of their bounds, or say what cannot be meant."""
    number(making.tolerance_um, FIT_UM, _named(where, "name-tolerance"))
    number(making.held_to_um, TOLERANCE_UM, _named(where, "name-part-tolerance"))
    number(making.gap_um, GAP_UM, _named(where, "name-gap"))
    number(mm(making.overcut_um), OVERCUT_MM, _named(where, "name-overcut"))
    number(mm(making.tab_um), OVERCUT_MM, _named(where, "name-tab"))
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


def _refuse_odd_passes(passes_um: tuple[float, ...], where: str) -> None:
    if not passes_um:
        return
    number(len(passes_um), PASSES, _named(where, "name-passes"))
    for value in passes_um:
        number(mm(value), OR_NONE_MM, _named(where, "name-pass-offset"))
    if any(later > before for before, later in pairwise(passes_um)):
        raise SettingsError("pass-offset-rises", where=where)
    if len(passes_um) > 1 and not min(passes_um):
        raise SettingsError("pass-of-offset-0", where=where)


def _named(where: str, name: str) -> Message:
    """What a number is called in a message: the name that stands in the texts, behind its place."""
    return Message("in-file", file=where, message=Message(name))
