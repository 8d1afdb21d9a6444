"""Where a cut is off its drawing: strips between the edge and the drawing, filled by what is wrong there.

A strip that would be too thin to be seen is drawn so many times as wide, and its legend says how many.
"""

from collections.abc import Iterator
from typing import TYPE_CHECKING, Final

import numpy as np

from parser.geometry.curves import Floats
from sim.show.draw import style
from sim.show.draw.canvas import Canvas
from sim.show.draw.flatten import CHORD_PX, flatten, simplify
from sim.show.draw.layout import Page, View, nice_below
from sim.show.draw.legend import Entry, stroke
from sim.show.draw.style import Paint
from sim.show.texts import Words

if TYPE_CHECKING:  # of a path no comparison is known
    from sim.measure.compare.result import Strips

_SEEN: Final = 7.0
"""Units that the widest strip is drawn wide, at least."""
_PAINTS: Final = {-1: Paint.OVERCUT, 1: Paint.LEFT_OVER}


def times_wider(strips: "Strips", page: Page) -> int:
    """How many times as wide as they are the strips are drawn, to be seen."""
    wanted = _SEEN * page.unit / max(strips.widest_um * page.view.px_per_um, 1e-9)
    return 1 if wanted <= 1.0 else int(np.ceil(nice_below(2.0 * wanted)))


def draw_off(canvas: Canvas, page: Page, strips: "Strips") -> None:
    """Fill the strips, and draw the drawing beside them."""
    for side, ring in _rings_px(strips, page.view, times_wider(strips, page)):
        canvas.polygon(ring, _PAINTS[side])
    for loop in strips.drawn:
        points, _ = flatten(loop, CHORD_PX / page.view.px_per_um)
        line = simplify(page.view.to_px(points), CHORD_PX)
        canvas.polyline(line, Paint.DRAWING, style.CONTOUR_WIDTH * page.unit)


def _rings_px(strips: "Strips", view: View, times: int) -> Iterator[tuple[int, Floats]]:
    """The side of each strip, and its outline on the page."""
    edge = view.to_px(strips.foot_um + times * (strips.edge_um - strips.foot_um))
    foot = view.to_px(strips.foot_um)
    first = np.flatnonzero(np.diff(strips.strip, prepend=-1))
    for low, past in zip(first.tolist(), [*first[1:].tolist(), len(strips.strip)], strict=True):
        yield int(strips.side[low]), np.concatenate([edge[low:past], foot[low:past][::-1]])


def off_entries(strips: "Strips | None", page: Page, say: Words) -> Iterator[Entry]:
    """What a legend says of them."""
    if strips is None:
        return
    times = times_wider(strips, page)
    wider = say("cut.times", times=times) if times > 1 else ""
    for side, key in ((-1, "cut.overcut"), (1, "cut.left-over")):
        if (strips.side == side).any():
            yield Entry(stroke(_PAINTS[side], 4.0 * style.CONTOUR_WIDTH), say(key) + wider)
    yield Entry(stroke(Paint.DRAWING, style.CONTOUR_WIDTH), say("cut.drawing"))
