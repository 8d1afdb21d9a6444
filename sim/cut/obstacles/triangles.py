"""Outlines cut up into triangles, by ears: the engine knows convex shapes alone.

pymunk's own `convex_decomposition` is not used: Chipmunk marks it as beta, and corners in one line, of a plate that
lies askew for one, make it return wrong pieces or crash the process.
"""

import numpy as np

from parser.geometry.curves import Floats
from sim.setup.obstacles import Outline

_FLAT_UM = 1e-6


def triangles(outline_um: Outline) -> Floats:
    """Triangles (m, 3, 2) µm, counter-clockwise, that fill an outline and do not overlap."""
    left, found = np.array(outline_um), []
    while len(left) > 3:
        ear = int(np.argmax(_clearances_um(left)))
        found.append(left[[ear - 1, ear, (ear + 1) % len(left)]])
        left = np.delete(left, ear, axis=0)
    cut = np.array([*found, left])
    side = np.roll(cut, -1, axis=1) - cut
    height = _cross(side[:, 0], side[:, 1]) / np.hypot(side[..., 0], side[..., 1]).max(axis=1)
    kept: Floats = cut[height > _FLAT_UM]
    return kept


def _clearances_um(corners: Floats) -> Floats:
    """How far the nearest other corner lies outside the ear at each corner of (n, 2); −inf where that is reflex.

    A polygon has two ears or more (G. H. Meisters, "Polygons have ears", 1975): the clearest corner is one.
    """
    ear = np.stack([np.roll(corners, 1, axis=0), corners, np.roll(corners, -1, axis=0)], axis=1)
    side = np.roll(ear, -1, axis=1) - ear
    unit = side / np.hypot(side[..., 0], side[..., 1])[..., None]
    to = corners[None, None, :] - ear[:, :, None]
    outside = -_cross(unit[:, :, None], to).min(axis=1)  # beyond any one of three sides is outside
    own = np.eye(len(corners), dtype=np.bool_)
    outside[own | np.roll(own, 1, axis=1) | np.roll(own, -1, axis=1)] = np.inf
    clearance: Floats = outside.min(axis=1)
    clearance[_cross(side[:, 0], side[:, 1]) <= 0.0] = -np.inf
    return clearance


def _cross(one: Floats, other: Floats) -> Floats:
    product: Floats = one[..., 0] * other[..., 1] - one[..., 1] * other[..., 0]
    return product
