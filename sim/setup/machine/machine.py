"""Machine files: table, controller and cutting rates of one machine, read from TOML and written as it."""

from importlib import resources
from pathlib import Path
from typing import Literal, NamedTuple

from controller.host.entries import Interpolation
from controller.motion.limits import Feeds
from parser.findings.errors import SettingsError
from parser.units import from_mm
from sim.setup.machine.table_model import (
    CONTROLLER,
    MOTOR,
    TABLE,
    ControllerModel,
    TableModel,
    read_controller,
    read_table,
)
from sim.setup.obstacles import ARM, Outline
from sim.setup.toml.keys import Key, Section, WrittenSection
from sim.setup.toml.kinds import Keys, Number, Text
from sim.setup.toml.reader import AREA_RATE_MM2_MIN, load_toml

TOP = Section(
    "machine",
    (Key("name", Text()), Key("name_zh", Text(), default=None), Key("assumed", Keys(), default=())),
    form="top",
)
CUTTING = Section("cutting", (Key("area_rate_mm2_min", Number(AREA_RATE_MM2_MIN, "mm²/min")),))
SECTIONS = (TOP, TABLE, MOTOR, CONTROLLER, CUTTING, ARM)
"""Sections of a machine file."""


TableEngine = Literal["compiled", "pymunk"]
"""What works out the motion of a table: a compiled loop, or the same in Python with bodies that pymunk moves."""


class Machine(NamedTuple):
    """One machine as its file gives it; units as named.

    `arm_um` is the outline of the arm round the wire, if known. `assumed` are the keys of the values that nobody has
    measured. `name_zh` is its name in Chinese, None where that is the same. `engine` is what its table is worked out
    with, which is no matter of the file.
    """

    name: str
    table: TableModel
    controller: ControllerModel
    area_rate_mm2_min: float
    arm_um: Outline | None = None
    name_zh: str | None = None
    assumed: tuple[str, ...] = ()
    engine: TableEngine = "compiled"

    def stepping_by(self, interpolation: Interpolation) -> "Machine":
        """The machine with another interpolator."""
        return self._replace(controller=self.controller._replace(interpolation=interpolation))

    def feeds(self, thickness_mm: float) -> Feeds:
        """Feeds in a work of this thickness, of cuts at the machine's own area rate."""
        return Feeds(
            cut_um_s=self.cut_um_s(thickness_mm, self.area_rate_mm2_min),
            jump_um_s=from_mm(self.controller.jump_feed_mm_s),
        )

    def cut_um_s(self, thickness_mm: float, area_rate_mm2_min: float) -> float:
        """Feed of a cut at an area rate: that over the thickness, no faster than the controller steps."""
        return self.held_um_s(from_mm(area_rate_mm2_min / thickness_mm / 60.0))

    def held_um_s(self, feed_um_s: float) -> float:
        """A feed of cuts as the controller runs it: no faster than one step of 1 µm a tick of its limit."""
        return min(feed_um_s, self.controller.cut_step_limit_hz)


def machine_names() -> tuple[str, ...]:
    """Names of the machines that are shipped, in order."""
    shipped = resources.files("sim.setup.machine")
    return tuple(sorted(each.name.removesuffix(".toml") for each in shipped.iterdir() if each.name.endswith(".toml")))


def load_machine(name: str, folder: Path | None = None, own: Path | None = None) -> Machine:
    """Machine of a shipped name such as ``dk7740``, or of a ``.toml`` file (relative to `folder`).

    `own` is a folder of machine files, whose names without ``.toml`` count before those that are shipped. Raises
    FileUnreadableError and SettingsError with the file and the key.
    """
    if name.endswith(".toml"):
        return _read(Path(folder or "") / name)
    shipped = resources.files("sim.setup.machine")
    theirs = {file.stem: file for file in sorted(own.glob("*.toml"))} if own else {}
    if name in theirs:
        return _read(theirs[name])
    known = (*theirs, *machine_names())
    if name not in known:
        raise SettingsError("machine-not-shipped", name=name, known=", ".join(known))
    with resources.as_file(shipped / f"{name}.toml") as path:
        return _read(path)


def machine_sections(machine: Machine) -> list[WrittenSection]:
    """Sections of the machine file that makes the same machine."""
    return [written for section in SECTIONS for written in section.written(machine)]


def _read(path: Path) -> Machine:
    content, where = load_toml(path), str(path)
    arm = ARM.read_in(content, where) if ARM.name in content else {}
    top = TOP.read(content, where, others=(section.name for section in SECTIONS[1:]))
    machine = Machine(
        **top,
        table=read_table(content, where),
        controller=read_controller(content, where),
        **CUTTING.read_in(content, where),
        **arm,
    )
    known = {key.name for section in SECTIONS[1:] for key in section.keys}
    for name in machine.assumed:
        if name not in known:
            raise SettingsError("assumed-key-unknown", where=where, name=name)
    return machine
