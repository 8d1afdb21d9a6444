"""Where the steps of an arc end, beside where its words say that it ends.

A controller counts whole steps, point by point (docs/3b.md §3). On the count axis it goes from extreme to extreme of
whole µm; on the other axis it stands where its last counted step finds it. Both are told here for many arcs that end
in the same quadrant; `controller.stepping` walks any arc (tests hold the two together).
"""

import numpy as np

from parser.geometry.curves import Floats


def steps_off_um(start: Floats, end: Floats, radii: int, turn: float, counted: int) -> Floats:
    """(k, 2) by how much the steps of arcs end beside their decoded ends, µm.

    Parameters
    ----------
    start, end
        (k, 2) whole µm from the centre, and where the words end, near enough on the axis that is not counted.
    radii
        By how many radii arcs go on their count axis, beside whole µm, as in `LookedAt`.
    turn, counted
        +1 counter-clockwise or −1 clockwise; count axis, 0 for X and 1 for Y.
    """
    square = (start * start).sum(axis=1)
    to, free = end[:, counted], 1 - counted
    extreme = np.ceil(np.sqrt(np.maximum(square - 1.0, 0.0)))
    stepped = np.rint(to + radii * (extreme - np.sqrt(square)))
    side = np.sign(end[:, free])
    # The last counted step is made where F asks for it: before it, away from the centre within the circle, toward it
    # on the circle or outside of it.
    before = stepped - (turn if counted else -turn) * side
    least = np.ceil(np.sqrt(np.maximum(square - before * before, 0.0)))
    off = np.empty_like(end)
    off[:, counted] = stepped - to
    off[:, free] = side * (least - (np.abs(stepped) > np.abs(before)) - np.sqrt(np.maximum(square - to * to, 0.0)))
    return off
