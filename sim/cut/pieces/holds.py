"""Pauses at which a piece still hangs on its last bridge: there the operator can clamp it before the bridge is cut."""

from collections.abc import Sequence

import numpy as np

from sim.cut.kerf.makers import share_made
from sim.cut.kerf.swept import Swept
from sim.cut.pieces.kinds import Loose

_BRIDGE = 0.5  # of the outer edge of a piece, at most


def held_after(piece: Loose, swept: tuple[Swept, ...], pauses: Sequence[int], offset_um: float) -> int | None:
    """How many blocks run before the pause at which a piece can be clamped; None where there is none.

    It is the last pause before the piece comes free, if the wire has cut most of its outer edge by then. `pauses` tell
    how many blocks run before each pause, in order.
    """
    moment = piece.moment
    freeing = int(swept[moment.contour].way.row[moment.at])
    at = int(np.searchsorted(pauses, freeing, side="right")) - 1
    if at < 0:
        return None
    ways = [swept[contour].way for contour in piece.contours if contour <= moment.contour]
    before = [way.place_um[way.row < pauses[at]] for way in ways]
    was_cut = share_made(moment.piece_um.exterior, before, offset_um)
    return int(pauses[at]) if was_cut >= 1.0 - _BRIDGE else None
