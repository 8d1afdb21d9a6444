"""Where entities are placed: maps of 3-D places, one behind the other where blocks stand in blocks.

A map is (4, 3) float64: a place p of shape (3,) goes to ``p @ map[:3] + map[3]``.
"""

import numpy as np
from ezdxf.math import OCS, Matrix44, Vec3

from parser.geometry.curves import Floats


def scaled(factor: float) -> Floats:
    """The map that multiplies all lengths."""
    return np.vstack([factor * np.eye(3), np.zeros(3)])


def of_insert(matrix: Matrix44) -> Floats:
    """The map from a block to where an INSERT places it."""
    return np.array(list(matrix)).reshape(4, 4)[:, :3]


def of_extrusion(extrusion: Vec3) -> Floats | None:
    """The map from the coordinates of an entity with an extrusion to the world's; None where they are the same.

    The axes are as the DXF reference's arbitrary axis algorithm has them.
    """
    system = OCS(extrusion)
    if not system.transform:
        return None
    return np.array([*(tuple(axis) for axis in (system.ux, system.uy, system.uz)), (0.0, 0.0, 0.0)])


def behind(inner: Floats, outer: Floats) -> Floats:
    """The map that goes by `inner` first and by `outer` then."""
    return np.vstack([inner[:3] @ outer[:3], inner[3] @ outer[:3] + outer[3]])
