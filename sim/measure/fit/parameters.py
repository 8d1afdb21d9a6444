"""What a fit tells: parameters with their intervals, and the rows that it is of."""

from typing import Final, NamedTuple

from parser.geometry.curves import Bools, Floats

LEVEL: Final = 0.95
"""Of all intervals."""


class Parameter(NamedTuple):
    """What a circle tells of a machine.

    Attributes
    ----------
    name, unit
        Of its text for people, ``fit.name-…``, and its unit.
    value, least, most
        With its interval; None where it is not determined.
    why
        Why not: name of a text ``fit.why-…``; empty where it is.
    """

    name: str
    unit: str
    value: float | None = None
    least: float | None = None
    most: float | None = None
    why: str = ""

    @property
    def is_determined(self) -> bool:
        """Whether the circle tells it."""
        return not self.why


class FittedRows(NamedTuple):
    """What was measured row by row, n of them, and what the model has there.

    Attributes
    ----------
    at
        (n,) where: the direction in degrees, the way along an edge in µm, or the number of a size.
    off_um, model_um
        (n,) by how much the measured place is off, and by the model.
    is_back
        (n,) whether it was run the other way, clockwise.
    is_used
        (n,) whether it was fitted.
    """

    at: Floats
    off_um: Floats
    model_um: Floats
    is_back: Bools
    is_used: Bools
