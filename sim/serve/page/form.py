"""The form of the page as a scenario: its texts are read here, and held to the bounds of every other door."""

import math
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Final, NamedTuple

from controller.motion.limits import Feeds
from parser.findings.catalogue import Bilingual
from parser.findings.errors import Message, SettingsError
from parser.text.encoding import narrow
from parser.units import from_mm
from sim.serve.page.child import PageRequest
from sim.serve.page.machines import machine_of, technology_of
from sim.setup.machine.guides import ANGLE_DEG
from sim.setup.machine.machine import Machine, machine_names
from sim.setup.part import (
    DEFAULT_THICKNESS_MM,
    MATERIAL,
    OFFSET_MM,
    PASSES,
    SIDES,
    THICKNESS_MM,
    DrawingTarget,
    Offset,
    OffsetPass,
)
from sim.setup.scenario import DEFAULT_MACHINE, Scenario, load_scenario, with_values
from sim.setup.settable import FIELDS
from sim.setup.taper import PLANE_MM, TaperSettings
from sim.setup.toml.keys import Key
from sim.setup.toml.kinds import Number
from sim.setup.toml.reader import Bound, number
from sim.show.texts.phrases import machine_name

_NAMES: Final = {
    "thickness_mm": Message("name-thickness"),
    "wire_mm": Message("name-wire"),
    "gap_mm": Message("name-spark-gap"),
    "lag_um": Message("name-lag"),
    "taper_deg": Message("name-taper"),
    "plane_mm": Message("name-program-plane"),
}
"""What the fields are called where something is wrong with them."""


def scenario_of(request: PageRequest, file: Path) -> Scenario:
    """The scenario of a file with the values of the page; empty texts leave the usual ones.

    SettingsError for a value out of its bounds, or one that is no number.
    """
    scenario = load_scenario(file)
    if request["machine"]:
        files = request.get("machine_files")
        machine = machine_of(request["machine"], Path(files) if files else None)
        scenario = replace(scenario, machine=machine, machine_by_default=False)
    given: dict[str, object] = {key.name: _setting(request[form], key) for form, key in FIELDS.items() if request[form]}
    technology = None
    if request["technology"]:
        own, _, given[MATERIAL.name] = request["technology"].partition("/")
        files = request.get("machine_files")
        technology = technology_of(own, Path(files) if files else None)
    scenario = with_values(scenario, given, technology)
    if request["drawing_file"]:
        scenario = replace(scenario, drawing=DrawingTarget(Path(request["drawing_file"])))
    return replace(scenario, offset=_offset(request), taper=_taper(request) or scenario.taper, kerf=True)


def _taper(request: PageRequest) -> TaperSettings | None:
    """The lean that the page asks for, or where the program plane lies; None where it says nothing of either."""
    angle, plane = request["taper_deg"], request["plane_mm"]
    if not angle and not plane:
        return None
    return TaperSettings(
        angle_rad=math.radians(number_of(angle, ANGLE_DEG, _NAMES["taper_deg"])) if angle else None,
        side=SIDES["left" if request["taper_side"] == "left" else "right"],
        corner="cone" if request["taper_corner"] == "cone" else "sharp",
        program_plane_um=from_mm(number_of(plane, PLANE_MM, _NAMES["plane_mm"])) if plane else 0.0,
    )


def _setting(text: str, key: Key) -> float:
    assert isinstance(key.kind, Number)  # noqa: S101 - no other kind has a field
    return key.kind.inside(number_of(text, key.kind.bound, _NAMES[key.form]))


def offsets_um(request: PageRequest, bound: Bound) -> tuple[float, ...]:
    """The offsets of the passes; none where nothing is said. SettingsError where one is out of its bounds."""
    words = narrow(request["offset_mm"]).replace(",", " ").split()  # digits and commas of a Chinese keyboard, too
    if words:
        number(len(words), PASSES, Message("name-passes"))
    return tuple(from_mm(number_of(word, bound, Message("name-offset"))) for word in words)


def number_of(text: str, bound: Bound, name: str) -> float:
    """A number that the page says. SettingsError where it is none, or out of its bounds."""
    try:
        value = float(text)
    except ValueError:
        raise SettingsError("text-is-no-number", name=name, found=text[:40]) from None
    return number(value, bound, name)


def _offset(request: PageRequest) -> Offset | None:
    """The offset that the controller is to add, a pass for each number; none where it is left out, or 0 alone."""
    if request["offset_mm"].strip() in {"", "0"}:
        return None
    passes = tuple(OffsetPass(by_um) for by_um in offsets_um(request, OFFSET_MM))
    return Offset(passes, SIDES["left" if request["side"] == "left" else "right"])


class Chosen(NamedTuple):
    """What the form of the page chooses for its run: a machine, empty for the default one, and a thickness.

    `files` is the folder of the machine files that came to the page.
    """

    name: str = ""
    thickness_mm: float = DEFAULT_THICKNESS_MM
    files: Path | None = None

    @property
    def machine(self) -> Machine | None:
        """The machine that is chosen; None where none is."""
        return _machine(self.name, self.files) if self.name else None

    @property
    def known_as(self) -> str:
        """What a run's machine is called: name of its file, or the one in the file that came to the page."""
        return self._of_run.name if self.name and self.name not in machine_names() else self.name or DEFAULT_MACHINE

    @property
    def feeds(self) -> Feeds:
        """Feeds of cuts and jumps, µm/s, as a run would have them: settings of checks name no machine of a run."""
        return self._of_run.feeds(self.thickness_mm)

    @property
    def title(self) -> Bilingual:
        """What people call a run's machine."""
        return machine_name(self._of_run)

    @property
    def _of_run(self) -> Machine:
        return _machine(self.name or DEFAULT_MACHINE, self.files)


USUAL: Final = Chosen()
"""What a run has that chooses nothing."""


def chosen(machine: str, thickness_mm: str, files: Path | None = None) -> Chosen:
    """What the texts of the form choose; what is wrong in them leaves what is usual, and is told at the form."""
    name = machine
    try:
        _machine(machine, files)
    except SettingsError:
        name = ""
    try:
        return Chosen(name, number_of(thickness_mm, THICKNESS_MM, _NAMES["thickness_mm"]), files)
    except SettingsError:
        return Chosen(name, files=files)


@cache
def _machine(name: str, files: Path | None) -> Machine:
    return machine_of(name, files)
