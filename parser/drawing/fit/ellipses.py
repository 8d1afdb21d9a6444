"""Ellipses to arcs."""

import numpy as np

from parser.drawing.dxf.forms import CENTER, END, START
from parser.drawing.fit.curves.batches import in_batches
from parser.drawing.fit.curves.fit import Drawn, arcs_of_pieces
from parser.drawing.fit.curves.pieces import pieces_of_ellipses
from parser.drawing.fit.fitted import Fitted
from parser.geometry.curves import Floats, Ints


def arcs_of_ellipses(forms: Floats, tolerance_um: float) -> tuple[Fitted, Ints]:
    """Arcs for placed arcs of ellipses (k, 17) within a tolerance of them, each from end to end.

    Behind them the ellipses that have none, as they would need arcs without number.
    """

    def fitted(which: Ints) -> Fitted:
        some = forms[which]
        ends = np.stack([some[:, START], some[:, END]], axis=1)[:, :, :2]
        return arcs_of_pieces(pieces_of_ellipses(some), Drawn(some[:, CENTER][:, :2], ends), tolerance_um)

    return in_batches(len(forms), fitted)
