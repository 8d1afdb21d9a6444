"""How the tolerance of a path is shared out between what the path is made by."""

_ROUNDING_UM = 0.5
"""Ends of arcs in whole µm and centres chosen around: 1.5 µm of fit gave 1.59 as 3B of an ellipse, 2.0 gave 2.08."""
_LEAST_SHARE = 0.5
"""Of the tolerance: with less of it, a fit takes ever more arcs, each of them rounded."""


def fit_share_um(tolerance_um: float) -> float:
    """How far arcs may lie off the curves that are drawn, where the written path may lie off by a tolerance."""
    return max(tolerance_um - _ROUNDING_UM, _LEAST_SHARE * tolerance_um)
