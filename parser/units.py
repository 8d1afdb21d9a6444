"""The factor between the inside, µm, and the millimetres that programs, settings and people use."""

UM_PER_MM = 1000.0


def mm(length_um: float) -> float:
    """µm to mm."""
    return length_um / UM_PER_MM


def from_mm(length_mm: float) -> float:
    """Mm to µm."""
    return length_mm * UM_PER_MM
