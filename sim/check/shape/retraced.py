"""Circles of which one part is cut there and back and the rest never: a part of it runs the wrong way."""

import numpy as np

from parser.geometry.curves import Ints
from parser.toolpath import Toolpath

_SAME_CIRCLE_UM = 10.0
_SLACK_UM, _SLACK_RAD = 20.0, 0.1  # at most; whole µm may miss as much where the counted axis stands still


def retraced_arcs(toolpath: Toolpath, contour_of_row: Ints) -> Ints:
    """Rows (k,) of the first arcs that run back, where arcs of one full turn in all only go there and back.

    Two passes there and back run round twice, and a slit that happens to be half a circle is not told from a fault.

    Parameters
    ----------
    contour_of_row
        (n,) contour number of each row, −1 on jumps; see `parser.shape.contours`.
    """
    row = np.flatnonzero(toolpath.is_arc & (contour_of_row >= 0))
    if len(row) < 2:
        return row[:0]
    center, radius, sweep = toolpath.center_um[row], toolpath.radius_um[row], toolpath.sweep_rad[row]
    off = np.fmax(np.hypot(*np.diff(center, axis=0).T), np.abs(np.diff(radius)))
    follows = (np.diff(row) == 1) & (np.diff(contour_of_row[row]) == 0) & (off <= _SAME_CIRCLE_UM)
    begins = np.append(True, ~follows)
    of = np.cumsum(begins) - 1
    turns_round = ~begins & (np.sign(sweep) != np.sign(np.roll(sweep, 1)))
    arc_um = sweep * radius
    first = np.flatnonzero(begins)
    slack = np.minimum(_SLACK_UM, _SLACK_RAD * radius[first])
    there_and_back = np.abs(np.bincount(of, arc_um)) <= slack
    one_turn = np.abs(np.bincount(of, np.abs(arc_um)) - 2.0 * np.pi * radius[first]) <= slack
    once = np.bincount(of, turns_round) == 1
    found: Ints = row[turns_round & (there_and_back & one_turn & once)[of]]
    return found
