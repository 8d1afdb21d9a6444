"""The drawings that a cut is held against, read."""

from typing import Final, NamedTuple

from parser.drawing.model import Drawing
from sim.setup.part import DrawingTarget


class Drawings(NamedTuple):
    """What a cut is held against: drawings of the part at the program plane, and at the top; None without one."""

    plane: Drawing | None = None
    top: Drawing | None = None


NO_DRAWINGS: Final = Drawings()


def drawings_of(target: DrawingTarget | None) -> Drawings:
    """The drawings that a cut is held against. DrawingError where one cannot be read."""
    return Drawings(_drawing_of(target), _drawing_of(target and target.of_top))


def _drawing_of(target: DrawingTarget | None) -> Drawing | None:
    if target is None:
        return None
    from parser.drawing.read import read_drawing  # noqa: PLC0415 - most runs have no drawing, and ezdxf loads for 0.3 s

    return read_drawing(target.file, layer=target.layer, gap_um=target.gap_um, unit=target.unit)
