"""Where things stand on a frame: title, plot, read-outs and strip; and which part of the plane the plot shows."""

from typing import Final, NamedTuple

import numpy as np

from parser.geometry.curves import Floats
from sim.show.draw import style
from sim.show.draw.layout import Box, View

WIDE: Final = 1.15
"""Width over height from which on the read-outs stand beside the plot, else below it."""
PANEL: Final = 400.0
PANEL_ROWS: Final = 6.5  # of the read-outs below a plot
HEAD: Final = 66.0
STRIP: Final = 74.0
AXIS: Final = 44.0
SHAPE: Final = (1600.0, 900.0)
"""Sizes of `sim.show.draw.style` are those of a frame like this."""
FINEST_PX_PER_UM: Final = 60.0
COARSEST: Final = 0.25
"""Of the scale at which the whole fits."""


class Layout(NamedTuple):
    """Boxes of a frame, px, with the factor on all sizes; `beside` where the read-outs stand beside the plot."""

    width_px: int
    height_px: int
    unit: float
    head: Box
    plot: Box
    panel: Box
    strip: Box
    beside: bool


def layout_for(width_px: int, height_px: int) -> Layout:
    """Layout of a frame, px."""
    beside = width_px >= WIDE * height_px
    wide, tall = SHAPE if beside else (0.6 * SHAPE[0], 0.6 * SHAPE[0])
    unit = max(min(width_px / wide, height_px / tall), style.LEAST_UNIT)
    edge, head, strip = style.EDGE * unit, HEAD * unit, STRIP * unit
    bottom = height_px - strip
    left = style.LEFT * unit
    if beside:
        panel = Box(width_px - edge - PANEL * unit, head, width_px - edge, bottom)
        plot = Box(left, head, panel.left - edge, bottom - AXIS * unit)
    else:
        panel = Box(edge, bottom - PANEL_ROWS * style.LEGEND_ROW * unit, width_px - edge, bottom)
        plot = Box(left, head, width_px - edge, panel.top - AXIS * unit)
    return Layout(
        width_px,
        height_px,
        unit,
        head=_whole(Box(edge, 0.0, width_px - edge, head)),
        plot=_whole(plot),
        panel=_whole(panel),
        strip=_whole(Box(edge, bottom, width_px - edge, height_px)),
        beside=beside,
    )


def _whole(box: Box) -> Box:
    """The box with its sides on whole pixels."""
    return Box(*(float(round(side)) for side in box))


def fitted(bounds_um: Floats, plot: Box, pad: float) -> View:
    """The view that shows a box (2, 2) µm in the middle of a plot, with `pad` px free at its sides."""
    wide_um, tall_um = np.maximum(bounds_um[1] - bounds_um[0], 1e-9).tolist()
    wide, tall = plot.right - plot.left - 2.0 * pad, plot.bottom - plot.top - 2.0 * pad
    return centred(bounds_um.mean(axis=0), min(wide / wide_um, tall / tall_um), plot)


def centred(place_um: Floats, px_per_um: float, plot: Box) -> View:
    """The view of a scale with a place (2,) µm in the middle of a plot."""
    x, y = (place_um * px_per_um).tolist()
    return View(px_per_um, (plot.left + plot.right) / 2 - x, (plot.top + plot.bottom) / 2 + y)


def zoomed(view: View, factor: float, at: tuple[float, float], whole: View) -> View:
    """The view enlarged about a place on the page, px, between the coarsest and the finest scale."""
    scale = min(max(view.px_per_um * factor, COARSEST * whole.px_per_um), FINEST_PX_PER_UM)
    factor = scale / view.px_per_um
    return View(scale, at[0] + (view.x_px - at[0]) * factor, at[1] + (view.y_px - at[1]) * factor)


def shifted(view: View, by: tuple[float, float]) -> View:
    """The view moved on the page, px."""
    return view._replace(x_px=view.x_px + by[0], y_px=view.y_px + by[1])


def near_runs(points: Floats, box: Box) -> list[Floats]:
    """Stretches of a line (n, 2) px whose chords may meet a box, each (k, 2) with k ≥ 2."""
    low, high = np.minimum(points[:-1], points[1:]), np.maximum(points[:-1], points[1:])
    meets = ((high >= (box.left, box.top)) & (low <= (box.right, box.bottom))).all(axis=1)
    edges = np.flatnonzero(np.diff(meets, prepend=False, append=False))
    return [points[first : past + 1] for first, past in edges.reshape(-1, 2).tolist()]
