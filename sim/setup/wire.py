"""The wire at the table: what it removes round its centre, and how far it bows back behind its guides."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, NamedTuple

from parser.findings.errors import SettingsError
from parser.units import from_mm, mm
from sim.setup.toml.keys import Key, Section
from sim.setup.toml.kinds import MM_AS_UM, Number
from sim.setup.toml.reader import Bound

WIRE_DIAMETER_MM = Bound(0.01, 1.0)
SPARK_GAP_MM = Bound(-0.05, 0.5)
WIRE_LAG_UM = Bound(0.0, 1000.0)
USUAL_LAG_UM = 10.0, 50.0
"""How far wires usually hang behind their guides in the work (docs/program.md)."""
CUT_OFF_OF_90 = 0.482
"""Of the lag, by which a wire cuts a corner of 90° off, by the law of `sim.cut.wire_lag`: 19.3 µm of 40."""


class WireForces(NamedTuple):
    """What bows the wire: discharges press it back evenly over the thickness of the work, its tension holds it.

    Attributes
    ----------
    tension_n
        Tension of the wire.
    pressure_n_mm
        Force of the discharges on each mm of wire within the work.
    guide_span_mm
        Distance of the guides, with the work midway; that of the work's thickness where None.
    """

    tension_n: float
    pressure_n_mm: float
    guide_span_mm: float | None = None

    def lag_um(self, thickness_mm: float) -> float:
        """How far the middle of the wire stands behind its guides. SettingsError where the work is thicker than these.

        A string of tension T under q per length over the middle h of its span L is a parabola within the load and
        straight outside: T w'' = −q, so w = q h (2 L − h) / (8 T) in the middle, q h² / (8 T) with L = h
        (S. Timoshenko, Strength of Materials; a wire lag from gap force and tension: S. Sarkar et al., Precision
        Engineering 35 (2011) 339).
        """
        span_mm = self._span_mm(thickness_mm)
        return from_mm(self.pressure_n_mm * thickness_mm * (2.0 * span_mm - thickness_mm) / (8.0 * self.tension_n))

    def face_share(self, thickness_mm: float) -> float:
        """The lag at the upper and lower face of the work, as a share of that in its middle. SettingsError as above.

        There the same string stands q h (L − h) / (4 T) behind.
        """
        span_mm = self._span_mm(thickness_mm)
        return 2.0 * (span_mm - thickness_mm) / (2.0 * span_mm - thickness_mm)

    def _span_mm(self, thickness_mm: float) -> float:
        span_mm = thickness_mm if self.guide_span_mm is None else self.guide_span_mm
        if span_mm < thickness_mm:
            raise SettingsError("guides-closer-than-work", thickness_mm=thickness_mm, span_mm=span_mm)
        return span_mm


@dataclass(frozen=True, slots=True)
class Wire:
    """A wire and its spark gap, µm. SettingsError where they leave no kerf.

    Attributes
    ----------
    diameter_um
        Molybdenum wire of 100 to 200 µm, 180 usual (docs/3b.md §7).
    spark_gap_um
        Gap on one side; may be negative in some shops' books (docs/3b.md §5).
    lag
        How far the wire bows back behind its guides, µm, or the forces that tell; 0 for a wire that stays straight.
    """

    diameter_um: float
    spark_gap_um: float
    lag: float | WireForces = 0.0

    def __post_init__(self) -> None:
        """Check that there is a wire, and that it cuts a kerf."""
        if not self.diameter_um > 0.0:
            raise SettingsError("wire-without-diameter", diameter_um=self.diameter_um)
        if self.kerf_um <= 0.0:
            raise SettingsError("wire-cuts-no-kerf", diameter_um=self.diameter_um, spark_gap_um=self.spark_gap_um)

    @property
    def radius_um(self) -> float:
        """Radius of the wire itself."""
        return self.diameter_um / 2.0

    @property
    def reach_um(self) -> float:
        """Distance of the cut edge from the wire's centre: radius plus spark gap."""
        return self.radius_um + self.spark_gap_um

    @property
    def kerf_um(self) -> float:
        """Width of the slot that the wire leaves."""
        return 2.0 * self.reach_um

    def lag_um(self, thickness_mm: float) -> float:
        """Lag in work of this thickness. SettingsError where forces bow the wire by more than a lag may be."""
        if not isinstance(self.lag, WireForces):
            return self.lag
        lag_um = self.lag.lag_um(thickness_mm)
        if lag_um > WIRE_LAG_UM.high:
            raise SettingsError(
                "wire-bows-too-far",
                pressure_n_mm=self.lag.pressure_n_mm,
                thickness_mm=thickness_mm,
                tension_n=self.lag.tension_n,
                lag_um=lag_um,
                most_um=WIRE_LAG_UM.high,
            )
        return lag_um

    def face_share(self, thickness_mm: float) -> float | None:
        """The lag at the faces of the work as a share of that in its middle; None where nothing tells."""
        return self.lag.face_share(thickness_mm) if isinstance(self.lag, WireForces) else None


DEFAULT_WIRE = Wire(diameter_um=180.0, spark_gap_um=10.0)
"""Usual wire, with the gap that the trade's offset of 0.1 mm leaves it (docs/3b.md §5)."""


def _force(attribute: str) -> Callable[[Wire], float | None]:
    """How one of the forces that tell a lag is found; there are none where an amount is set."""
    return lambda wire: getattr(wire.lag, attribute, None)


_FORCES = (
    Key("tension_n", Number(Bound(0.1, 100.0), "N"), default=None, get=_force("tension_n")),
    Key("pressure_n_mm", Number(Bound(0.0, 10.0), "N/mm"), default=None, get=_force("pressure_n_mm")),
    Key("guide_span_mm", Number(Bound(0.01, 5000.0), "mm"), default=None, get=_force("guide_span_mm")),
)
DIAMETER = Key(
    "diameter_mm",
    Number(WIRE_DIAMETER_MM, "mm", MM_AS_UM),
    "diameter_um",
    mm(DEFAULT_WIRE.diameter_um),
    option="--wire-diameter",
    form="wire_mm",
)
SPARK_GAP = Key(
    "spark_gap_mm",
    Number(SPARK_GAP_MM, "mm", MM_AS_UM),
    "spark_gap_um",
    mm(DEFAULT_WIRE.spark_gap_um),
    option="--gap",
    form="gap_mm",
)
LAG = Key(
    "lag_um",
    Number(WIRE_LAG_UM, "µm"),
    "lag",
    default=None,
    get=lambda wire: None if isinstance(wire.lag, WireForces) else wire.lag,
    option="--wire-lag",
    form="lag_um",
)
LAG_KEYS = (LAG, *_FORCES)
"""Keys that tell a lag."""
WIRE = Section(
    "wire",
    (
        DIAMETER,
        SPARK_GAP,
        *LAG_KEYS,
    ),
    fills="wire",
)


def read_wire(table: Mapping[str, Any], where: str) -> Wire:
    """Wire of a ``[wire]`` table. SettingsError names the file and the key."""
    value = WIRE.read(table, where)
    lag_um = value.pop(LAG.path)
    forces = {key.name: value.pop(key.name) for key in _FORCES}
    return Wire(**value, lag=_lag(lag_um, {name: force for name, force in forces.items() if force is not None}, where))


def _lag(lag_um: float | None, forces: Mapping[str, float], where: str) -> float | WireForces:
    """Lag as it is set: an amount, or forces."""
    if not forces:
        return lag_um or 0.0
    if lag_um is not None:
        raise SettingsError("lag-given-twice", where=where, name=LAG.name, forces=" and ".join(forces))
    for key in ("tension_n", "pressure_n_mm"):
        if key not in forces:
            raise SettingsError("lag-force-missing", where=where, force=next(iter(forces)), key=key)
    return WireForces(**forces)
