"""When pieces come free: the first place of the wire at which the kerf parts them from the frame.

Take the wire back, stretch by stretch. What it took last comes back first, and at some stretch a part hangs together
with the frame again, through cells (`cells`) that come back at that stretch or before: there it came free. So of all
ways from the part to the frame the one counts whose earliest cell is cut last. It is found as a tree of least weight
grows from one node (R. C. Prim, Bell System Technical Journal 36 (1957) 1389): of the cells beside what hangs together
already, the one that is cut last is next. A way that comes upon a part that is known already ends there.

Within that stretch, the first place is looked for at which what the wire has swept parts the two sides.

A part that other contours cut free with more in a larger body comes free when it comes off that: a slug falls out of a
part, whenever that part came free itself.
"""

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np
import shapely

from parser.geometry.curves import Floats, Ints
from sim.cut.kerf.swept import Box, Swept
from sim.cut.pieces.cells import Cells, joined_um
from sim.cut.pieces.gap import FOREVER, OWN, Gap, Uncut, When
from sim.cut.pieces.hanging import Break, Came, Hanging

_FRAME = 0
_EXACT = 2  # places on from where a wider wire closes a gap, at which the wire itself does, but for grazing kerfs


class FreeMoment(NamedTuple):
    """When a piece comes free.

    Attributes
    ----------
    contour
        Index of the contour.
    at
        Index of the place on the wire's way through it.
    piece_um
        The piece at that moment; what is cut later may still take from it.
    """

    contour: int
    at: int
    piece_um: shapely.Polygon

    @property
    def when(self) -> tuple[int, int]:
        """Contour and place, in the order they are cut."""
        return self.contour, self.at


class Cutting(NamedTuple):
    """What is cut.

    Attributes
    ----------
    stock_um, frame_um
        The stock, and what of it stays.
    parts_um
        What else is left of it, p parts.
    contours
        (p,) of each: indices of the contours whose kerfs have a share in its outer edge, in order.
    crumbs_um
        What is left besides, and is no part.
    swept
        What the wire swept on each contour.
    """

    stock_um: shapely.Polygon
    frame_um: shapely.Polygon
    parts_um: list[shapely.Polygon]
    contours: list[list[int]]
    crumbs_um: list[shapely.Polygon]
    swept: Sequence[Swept]


class _Way(NamedTuple):
    """The way out of a part: what hangs on it in the end, and the stretches that parted that, the last cut first."""

    hanging: Hanging
    came: list[Came]

    def parting(self, at: int) -> Break:
        """What hung together before such a stretch."""
        stretch, parts, cells = self.came[at]
        return Break(stretch, self.hanging.parts[:parts], self.hanging.cells[:cells])


def moments_of(cutting: Cutting) -> list[FreeMoment | None]:
    """When each of the parts comes free; None where nothing parts them from the frame."""
    whole = [cutting.frame_um, *cutting.parts_um, *cutting.crumbs_um]
    cells = Cells(cutting.stock_um, whole, cutting.swept)
    frees = _Frees(cells, cutting)
    # Those that close last come first: what they may have hung on is known then.
    first = {part: Hanging(cells, [part], lambda _: False).next for part in range(1, len(cutting.parts_um) + 1)}
    for part in sorted(first, key=lambda part: -first[part]):
        frees.look_at(part)
    return [frees.moments.get(part) for part in range(1, len(cutting.parts_um) + 1)]


class _Frees:
    """Parts that are known: when they part from the frame, which of them do not, and when they come free."""

    def __init__(self, cells: Cells, cutting: Cutting) -> None:
        self._cells = cells
        self._contours = [set[int](), *map(set, cutting.contours)]
        self._swept = cutting.swept
        self._parted: dict[int, FreeMoment | None] = {_FRAME: None}
        self.moments: dict[int, FreeMoment] = {}

    def look_at(self, part: int) -> None:
        """Find out when a part comes free."""
        way = self._way_out(part)
        reached = way.hanging.reached
        if not reached:
            return
        on = max(reached, key=self._hangs_until)
        parted = self._parted[on]
        if parted is None or parted.when >= self._span(way.came[-1].stretch)[0]:
            own = self._moment(part, way.parting(-1), self._known_until)
            same = (self._parted[other] for other in reached if self._hangs_until(other) == own.when)
            parted = next(same, own) or own
        self._parted[part] = parted
        is_own = parted.contour in self._contours[part]
        self.moments[part] = parted if is_own else self._by_own(part, way, on) or parted

    def _hangs_until(self, part: int) -> When:
        """Contour and place at which a known part parts from the frame; the frame itself never does."""
        moment = self._parted[part]
        return FOREVER if moment is None else moment.when

    def _known_until(self, part: int) -> When | None:
        """The same of a part that may not be known."""
        return self._hangs_until(part) if part in self._parted else None

    def _by_own(self, part: int, way: _Way, on: int) -> FreeMoment | None:
        """When a part that other contours part from the frame comes off a body that they freed; None without such."""
        own = self._contours[part]
        if self._contours[on] == own and self._parted[part] is self._parted[on]:
            return self.moments[on]
        parts_then = [*(later.parts for later in way.came[1:]), np.inf]
        for at in range(len(way.came) - 1, -1, -1):
            if parts_then[at] == way.came[at].parts:
                continue
            parting = way.parting(at)
            round_it = set[int]().union(*(self._contours[each] for each in parting.parts if each < len(self._contours)))
            if round_it <= own:
                return self._moment(part, parting, lambda _: FOREVER)
        return None

    def _way_out(self, part: int) -> _Way:
        hanging, came = Hanging(self._cells, [part], self._parted.__contains__), list[Came]()
        while not hanging.reached and hanging.next >= 0:
            before = Came(hanging.next, len(hanging.parts), len(hanging.cells))
            if hanging.take_back() and (not came or before.stretch < came[-1].stretch):
                came.append(before)
        return _Way(hanging, came)

    def _hung_um(self, part: int, parting: Break, left: list[shapely.Polygon]) -> shapely.Polygon:
        """What hung together with a part, with some more that is left of the stretch that parted it."""
        outlines = [self._cells.parts_um[each] for each in parting.parts]
        cells = [self._cells.cell(each).outline_um for each in parting.cells]
        return joined_um([*outlines, *cells, *left], self._cells.parts_um[part].representative_point())

    def _span(self, stretch: int) -> tuple[tuple[int, int], tuple[int, int]]:
        """First and last place of a stretch, each with its contour."""
        contour, own = self._cells.place_of(stretch)
        first, past = self._swept[contour].border[own : own + 2].tolist()
        return (contour, first), (contour, past - 1)

    def _moment(self, part: int, parting: Break, holds_until: Callable[[int], When | None]) -> FreeMoment:
        """The first place of a stretch at which it parts what hung together from all that holds it then."""
        (contour, first), (_, last) = self._span(parting.stretch)
        gap, swept = Gap(self._cells, parting, holds_until), self._swept[contour]
        if not gap.whole:  # it holds by less than a contact
            return FreeMoment(contour, last, self._hung_um(part, parting, []))
        place = swept.way.place_um[first : last + 1]
        offset_um = float(swept.offset_um[self._cells.place_of(parting.stretch)[1]])
        reaching = first + _reaching(place, gap.box, offset_um)
        since, past = int(reaching[0]), int(reaching[-1])
        at, stride = first + gap.closes_about(place, offset_um), 1
        low, high = first - 1, past
        # In strides that double, from where the wire first comes upon what was cut before: most gaps close there.
        while high - low > 1:
            at = min(max(at, low + 1), high - 1)
            if gap.is_open(gap.uncut(at, since), (contour, at)):
                low, at = at, at + stride
            else:
                high, at = at, at - stride
            at, stride = (at, 2 * stride) if low < at < high else ((low + high) // 2, stride)
        at, uncut = self._closed(gap, (contour, high), since, past)
        own = [each.cell_um for each in uncut if OWN in each.groups]
        return FreeMoment(contour, at, self._hung_um(part, parting, own))

    def _closed(self, gap: Gap, when: tuple[int, int], since: int, past: int) -> tuple[int, list[Uncut]]:
        """The place at which a gap is closed, and what is left of it: that of a wider wire, or one of the next few."""
        contour, high = when
        for at in range(high, min(high + _EXACT, past) + 1):
            uncut = gap.uncut(at, since, wider_um=0.0)
            if not gap.is_open(uncut, (contour, at)):
                return at, uncut
        return high, gap.uncut(high, since)


def _reaching(place_um: Floats, box: Box, offset_um: float) -> Ints:
    """Indices of the places (m, 2) whose discs come near a box; of the first where none does."""
    x, y = place_um.T
    near_x = (x >= box[0] - offset_um) & (x <= box[2] + offset_um)
    near = np.flatnonzero(near_x & (y >= box[1] - offset_um) & (y <= box[3] + offset_um))
    return near if len(near) else np.zeros(1, dtype=np.int64)
