"""What the page asks of a program that is to be made of a drawing, and how its controls are named in messages."""

import re
from pathlib import Path
from typing import Final, NamedTuple, cast

from parser.findings.catalogue import LANGUAGES, Bilingual
from parser.findings.errors import Message, SettingsError
from parser.text.encoding import narrow
from parser.toolpath import Point
from parser.units import from_mm, mm
from sim.make.cam.of_scenario import wanted_of
from sim.make.wanted import Wanted
from sim.serve.page.child import PageRequest
from sim.serve.page.form import number_of, offsets_um, scenario_of
from sim.setup.making import (
    DIRECTION_WISHES,
    FIGURE,
    OR_NONE_MM,
    OVERCUT_MM,
    SIDE_WISHES,
    DirectionWish,
    Making,
    SideWish,
    ToMake,
    refuse_odd,
)
from sim.setup.making import LANGUAGES as PROGRAM_LANGUAGES
from sim.setup.part import DRAWING_UNITS, GAP_UM, DrawingTarget
from sim.setup.picks import pick_of
from sim.setup.scenario import Scenario
from sim.setup.toml.reader import PLACE_MM, Bound
from sim.setup.wire import WIRE_LAG_UM
from sim.show.texts import Words

_JOIN_MM: Final = Bound(mm(GAP_UM.low), mm(GAP_UM.high))
"""Of the gap whose ends are joined."""

_PROGRAM: Final = Message("name-the-program")


class ProgramRequest(NamedTuple):
    """A program that is asked for: of which drawing, how it is made and written, and on whose machine."""

    drawing: Path
    making: Making
    wanted: Wanted
    scenario: Scenario


def asked_of(request: PageRequest) -> ProgramRequest:
    """What is asked for. SettingsError for what cannot be."""
    drawing, written = Path(request["drawing_file"]), request["language"]
    if written not in PROGRAM_LANGUAGES:
        raise SettingsError("no-program-language", languages=", ".join(PROGRAM_LANGUAGES), found=written[:40])
    file = drawing.with_suffix(f".{written}")
    to_make = ToMake()._replace(file=file, making=_making(request))
    scenario = scenario_of({**request, "offset_mm": "", "drawing_file": ""}, file)
    return ProgramRequest(drawing, to_make.making, wanted_of(to_make, to_make.language, scenario), scenario)


def target_of(request: PageRequest) -> DrawingTarget:
    """The drawing as the page has it read. SettingsError for a gap or a unit that is none."""
    target = DrawingTarget(Path(request["drawing_file"]), unit=request["unit"] or None)
    if target.unit not in {None, *DRAWING_UNITS}:
        raise SettingsError("no-drawing-unit", units=", ".join(DRAWING_UNITS), found=request["unit"][:40])
    join = request["join_mm"].strip()
    return target._replace(gap_um=from_mm(number_of(join, _JOIN_MM, Message("name-gap")))) if join else target


def _making(request: PageRequest) -> Making:
    """How it is to be made. SettingsError for numbers out of their bounds."""
    passes, lag = offsets_um(request, OR_NONE_MM), request["led_um"]
    tab_um, slug_tab_um = (_length_um(request[key], name) for key, name in _TABS)
    making = Making(
        unit=target_of(request).unit,
        gap_um=target_of(request).gap_um,
        picks=tuple(pick_of(each.strip(), _PROGRAM) for each in request["picks"].split(";") if each.strip()),
        entries_um=tuple(_place_um(each) for each in request["entries"].split(";") if each.strip()),
        starts_um=tuple(_place_um(each) for each in request["starts"].split(";") if each.strip()),
        passes_um=passes,
        tab_um=tab_um,
        slug_tab_um=slug_tab_um,
        rough_first=request["rough_first"] == "yes",
        lag_um=number_of(lag, WIRE_LAG_UM, Message("name-lag")) if lag else 0.0,
        no_core=request["no_core"] == "yes",
        common_edges=request["common_edges"] == "yes",
        side=cast(SideWish, _one_of(request["wire_side"], SIDE_WISHES)),
        direction=cast(DirectionWish, _one_of(request["direction"], DIRECTION_WISHES)),
        order=tuple(_whole(each) for each in narrow(request["order"]).replace(",", " ").split()),
    )
    refuse_odd(making, _PROGRAM)
    return making


_TABS: Final = (("tab_mm", "name-tab"), ("slug_tab_mm", "name-slug-tab"))
"""Keys of tabs, and what they are called in messages."""


def _length_um(text: str, name: str) -> float:
    """A length as the page says it, mm; none where it says nothing. SettingsError for one out of its bounds."""
    return from_mm(number_of(text, OVERCUT_MM, Message(name))) if text else 0.0


def _one_of(word: str, words: tuple[str, ...]) -> str:
    """A word that the page says; the usual one, which comes first, where it says none."""
    if word and word not in words:
        raise SettingsError("none-of", name=word[:40], names=", ".join(words))
    return word or words[0]


def _whole(text: str) -> int:
    return int(number_of(text, FIGURE, Message("name-order")))


def _place_um(text: str) -> Point:
    """A thread point as the page says it, mm. SettingsError where it is no place."""
    numbers = [number_of(each, PLACE_MM, Message("name-start")) for each in narrow(text).split(",")]
    if len(numbers) != 2:
        raise SettingsError("no-thread-point", found=text.strip()[:40])
    return Point(*map(from_mm, numbers))


_CONTROLS: Final = {
    "--gap": "open.join",
    "--pick": "open.picks",
    "--drawing-unit": "open.unit",
    "--lag": "open.lag",
    "--tab": "open.tab",
    "--slug-tab": "open.slug-tab",
    "--rough-first": "open.rough-first",
    "--no-core": "open.no-core",
    "--common-edges": "open.common-edges",
    "--pass": "open.passes",
    r"--start X,Y \S+ --thread-layer": "open.starts",
    r"--start(?: X,Y)?": "open.starts",
    "--enter": "open.entries",
    "--side": "open.wire-side",
    "--direction": "open.direction",
    "--order": "open.order",
}
"""Options of the command line that the page has a control for, as they are named in texts, and its label."""


def by_controls(said: Bilingual) -> Bilingual:
    """What is said, with the labels of the page's controls in place of options."""
    for option, label in _CONTROLS.items():
        said = Bilingual(
            *(
                re.sub(rf"{option}(?![\w-])", f"“{Words(language)(label)}”", text)
                for text, language in zip(said, LANGUAGES, strict=True)
            )
        )
    return said
