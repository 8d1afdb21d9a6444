"""Guides of a wire that leans, and the head that moves the upper one: ``[guides]`` of machine or scenario."""

import math
from collections.abc import Mapping
from typing import Any, Final, NamedTuple

from parser.findings.errors import SettingsError
from parser.units import from_mm, mm
from sim.setup.machine.table import Geometry, TableModel
from sim.setup.toml.keys import Key, Section
from sim.setup.toml.kinds import DEGREES_AS_RAD, MM_AS_UM, Number
from sim.setup.toml.reader import Bound

ANGLE_DEG: Final = Bound(0.0, 60.0)
"""Heads of fast wire tilt by 3 to 6°, large ones by 45° (recalled)."""
_GUIDE = Number(Bound(0.01, 2000.0), "mm", MM_AS_UM)
_TRAVEL = Number(Bound(0.0, 2000.0), "mm", MM_AS_UM)
_FEED = Number(Bound(1e-3, 1e3), "mm/s", MM_AS_UM)
_ACCELERATION = Number(Bound(0.01, 1e5), "mm/s²", MM_AS_UM)
_MASS = Number(Bound(0.01, 100_000.0), "kg")
_FRICTION = Number(Bound(0.0, 1e6), "N")
_BACKLASH = Number(Bound(0.0, 1e4), "µm")
USUAL_LOWER_MM, USUAL_UPPER_MM = 60.0, 100.0
"""From the work to the guides, where nobody says: a usual head over work of 40 mm (assumed)."""


class Guides(NamedTuple):
    """Guides of the wire, and how far the upper one can be moved against the lower one.

    Attributes
    ----------
    lower_um, upper_um
        From the bottom of the work to the lower guide, and from its top to the upper one.
    travel_u_um, travel_v_um
        Whole travel, half to each side; 0 on a machine without U and V, None where nobody says.
    most_rad
        Most by which the wire may be tilted; None where nobody says.
    speed_um_s, acceleration_um_s2
        Highest of U and V.
    mass_kg, friction_n, backlash_um
        What the drives of U and V move, where U carries V, and what resists and slackens them; those of the table where
        None.
    """

    lower_um: float = from_mm(USUAL_LOWER_MM)
    upper_um: float = from_mm(USUAL_UPPER_MM)
    travel_u_um: float | None = None
    travel_v_um: float | None = None
    most_rad: float | None = None
    speed_um_s: tuple[float, float] = (math.inf, math.inf)
    acceleration_um_s2: tuple[float, float] = (math.inf, math.inf)
    mass_kg: tuple[float | None, float | None] = (None, None)
    friction_n: tuple[float | None, float | None] = (None, None)
    backlash_um: tuple[float | None, float | None] = (None, None)

    def head(self, table: TableModel) -> TableModel:
        """What moves the upper guide: drives as those of the table, but for what is said of the head."""
        mass_u, mass_v = _own_or(self.mass_kg, table.moved_kg)
        travel = [table.travel_x_mm, table.travel_y_mm]
        for axis, travel_um in enumerate((self.travel_u_um, self.travel_v_um)):
            travel[axis] = mm(travel_um) if travel_um else travel[axis]
        return table._replace(
            travel_x_mm=travel[0],
            travel_y_mm=travel[1],
            saddle_mass_kg=mass_u - mass_v,
            carriage_mass_kg=mass_v,
            friction_n=_own_or(self.friction_n, table.friction_n),
            backlash_um=_own_or(self.backlash_um, table.backlash_um),
            geometry=Geometry(),
        )


GUIDES: Final = Section(
    "guides",
    (
        Key("lower_guide_mm", _GUIDE, "lower_um", default=USUAL_LOWER_MM),
        Key("upper_guide_mm", _GUIDE, "upper_um", default=USUAL_UPPER_MM),
        Key("travel_u_mm", _TRAVEL, "travel_u_um", default=None),
        Key("travel_v_mm", _TRAVEL, "travel_v_um", default=None),
        Key("most_angle_deg", Number(ANGLE_DEG, "°", DEGREES_AS_RAD), "most_rad", default=None),
        Key("feed_u_mm_s", _FEED, "speed_um_s.0", default=math.inf),
        Key("feed_v_mm_s", _FEED, "speed_um_s.1", default=math.inf),
        Key("acceleration_u_mm_s2", _ACCELERATION, "acceleration_um_s2.0", default=math.inf),
        Key("acceleration_v_mm_s2", _ACCELERATION, "acceleration_um_s2.1", default=math.inf),
        Key("mass_u_kg", _MASS, "mass_kg.0", default=None),
        Key("mass_v_kg", _MASS, "mass_kg.1", default=None),
        Key("friction_u_n", _FRICTION, "friction_n.0", default=None),
        Key("friction_v_n", _FRICTION, "friction_n.1", default=None),
        Key("backlash_u_um", _BACKLASH, "backlash_um.0", default=None),
        Key("backlash_v_um", _BACKLASH, "backlash_um.1", default=None),
    ),
    fills="guides",
)


def _own_or(own: tuple[float | None, float | None], other: tuple[float, float]) -> tuple[float, float]:
    """Values of U and V, each of the other pair where it is None."""
    first, second = (value if value is not None else instead for value, instead in zip(own, other, strict=True))
    return first, second


def read_guides(content: Mapping[str, Any], where: str) -> Guides | None:
    """``[guides]`` of a machine or scenario; None without it. SettingsError names file and key."""
    if GUIDES.name not in content:
        return None
    guides = Guides(**GUIDES.read_in(content, where))
    mass_u, mass_v = guides.mass_kg
    if (mass_u is None) != (mass_v is None) or (mass_u is not None and mass_v is not None and mass_u <= mass_v):
        raise SettingsError("masses-of-head", where=where)
    return guides
