"""Where things stand on a frame: title, plot, read-outs and the strip of the run."""

from typing import Final, NamedTuple

from sim.show.draw import style
from sim.show.draw.layout import Box

WIDE: Final = 1.15
"""Width over height from which on the read-outs stand beside the plot, else below it."""
PANEL: Final = 400.0
PANEL_ROWS: Final = 6.5  # of the read-outs below a plot
HEAD: Final = 66.0
STRIP: Final = 74.0
AXIS: Final = 44.0
SHAPE: Final = (1600.0, 900.0)
"""Sizes of `sim.show.draw.style` are those of a frame like this."""


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
