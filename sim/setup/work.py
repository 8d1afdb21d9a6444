"""The work: its thickness, its density and its outline; and what a shop writes of it on the sheet of the job."""

from typing import Final, NamedTuple

from sim.setup.obstacles import OutlineMm
from sim.setup.toml.keys import Key, Section
from sim.setup.toml.kinds import Name, Number
from sim.setup.toml.reader import Bound

THICKNESS_MM = Bound(0.01, 2000.0)
DENSITY_G_CM3 = Bound(0.01, 30.0)
DEFAULT_THICKNESS_MM = 40.0
DEFAULT_DENSITY_G_CM3 = 7.85
"""Steel: C45 and Cr12 lie within 0.1 of it (any table of materials)."""

THICKNESS = Key(
    "thickness_mm", Number(THICKNESS_MM, "mm"), default=DEFAULT_THICKNESS_MM, option="--thickness", form="thickness_mm"
)
WORK = Section(
    "work",
    (
        THICKNESS,
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
