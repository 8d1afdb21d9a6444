"""The wire at the table: what it removes round its centre."""

from dataclasses import dataclass

from parser.errors import SettingsError
from sim.settings import Bound

WIRE_DIAMETER_MM = Bound(0.01, 1.0)
SPARK_GAP_MM = Bound(-0.05, 0.5)


@dataclass(frozen=True, slots=True)
class Wire:
    """A wire and its spark gap, µm. SettingsError where they leave no kerf.

    Attributes
    ----------
    diameter_um
        Molybdenum wire of 100 to 200 µm, 180 usual (docs/3b.md §7).
    spark_gap_um
        Gap on one side; may be negative in some shops' books (docs/3b.md §5).
    """

    diameter_um: float
    spark_gap_um: float

    def __post_init__(self) -> None:
        """Check that the wire cuts a kerf."""
        if self.kerf_um <= 0.0:
            raise SettingsError(
                f"a wire of {self.diameter_um:g} µm with a spark gap of {self.spark_gap_um:g} µm cuts no kerf; "
                "the diameter and twice the gap must come to more than 0"
            )

    @property
    def offset_um(self) -> float:
        """Distance of the cut edge from the wire's centre: radius plus spark gap."""
        return self.diameter_um / 2.0 + self.spark_gap_um

    @property
    def kerf_um(self) -> float:
        """Width of the slot that the wire leaves."""
        return 2.0 * self.offset_um


DEFAULT_WIRE = Wire(diameter_um=180.0, spark_gap_um=10.0)
"""Usual wire, with the gap that the trade's offset of 0.1 mm leaves it (docs/3b.md §5)."""
