"""How the tolerance of a path is shared out between what the path is made by."""

_ROUNDING_UM = 0.5
"""What whole µm add at most: 0.49 µm, written as 3B over an ellipse of 40 × 20 mm fitted within 0.5 … 5 µm."""
_LEAST_SHARE = 0.5
"""Of the tolerance: with less of it, a fit takes ever more arcs, each of them rounded."""


def fit_share_um(tolerance_um: float) -> float:
    """How far arcs may lie off the curves that are drawn, where the written path may lie off by a tolerance."""
    return max(tolerance_um - _ROUNDING_UM, _LEAST_SHARE * tolerance_um)
