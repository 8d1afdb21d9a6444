"""Splines to arcs."""

from collections.abc import Mapping, Sequence

import numpy as np

from parser.drawing.dxf.forms import Spline
from parser.drawing.fit.curves.batches import in_batches, several
from parser.drawing.fit.curves.fit import Drawn, arcs_of_pieces
from parser.drawing.fit.curves.pieces import Spans, pieces_of_spans, spans_of
from parser.drawing.fit.fitted import Fitted
from parser.geometry.curves import Floats, Ints


def arcs_of_splines(splines: Sequence[Spline], tolerance_um: float) -> tuple[Fitted, Ints]:
    """Lines and arcs for placed splines within a tolerance of them, from end to end; their corners stay corners.

    Behind them the splines that have none, as their numbers make no curve, or one that needs arcs without number.
    """
    origins = np.array([spline.control[:, :2].mean(axis=0) for spline in splines]).reshape(-1, 2)
    spans: dict[int, Spans] = {}
    for row, spline in enumerate(splines):
        try:
            spans[row] = spans_of(spline, origins[row])
        except ValueError:
            continue
    parts = [
        _of_degree({row: span for row, span in spans.items() if splines[row].degree == degree}, origins, tolerance_um)
        for degree in sorted({splines[row].degree for row in spans})
    ]
    return several(parts, np.array([row for row in range(len(splines)) if row not in spans], dtype=np.int64))


def _of_degree(spans: Mapping[int, Spans], origins: Floats, tolerance_um: float) -> tuple[Fitted, Ints]:
    rows = np.array(list(spans), dtype=np.int64)

    def fitted(which: Ints) -> Fitted:
        return _fitted([spans[row] for row in rows[which].tolist()], origins[rows[which]], tolerance_um)

    made, refused = in_batches(len(rows), fitted)
    return made._replace(of=rows[made.of]), rows[refused]


def _fitted(spans: Sequence[Spans], origin_um: Floats, tolerance_um: float) -> Fitted:
    pieces = pieces_of_spans(spans)
    first = np.searchsorted(pieces.of, np.arange(len(spans)))
    last = np.searchsorted(pieces.of, np.arange(len(spans)), side="right") - 1
    ends = np.stack([pieces.control[first, 0], pieces.control[last, -1]], axis=1)
    ends_um = ends[:, :, :2] / ends[:, :, 2:] + origin_um[:, None]
    return arcs_of_pieces(pieces, Drawn(origin_um, ends_um), tolerance_um)
