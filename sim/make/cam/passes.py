"""The passes over a figure: back and forth or one way, all round it or up to a tab.

Passes up to a tab that holds the part, and the cut-off behind a stop.

All passes run back and forth over the open stretch, since the wire comes from its end to its start by no other way.
From one to the next it steps aside, in its own kerf. Behind the stop it runs on over the tab as it came: from the end
of the open stretch to its start, or back from its start to its end. It does so once, at the offset of the last pass:
a part that has been cut off is loose, and what a second pass would leave of it is left to chance. So the tab, too, is
as large as the drawing has it, and what the rough cut leaves rough there is what is left to be ground.

A slug, too, may hang by a tab for a while. It is cut off at the offset of the first pass: the others come once the slug
is out, and run all round. Where the wire comes back to a tab, it is threaded anew and comes to it from the entry.

Ways all round a contour at the offset of each pass, begun where the wire comes to it.

Closed ways begun elsewhere, ways parted, and ways run back.
"""

import math
from dataclasses import replace
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from controller.offset.shifted import Side
from parser.geometry.along import places_at
from parser.geometry.curves import Curves, curves_between, joined, total_before
from parser.geometry.distance import lengths_to
from parser.toolpath import Point
from sim.make.cam.guides import OVERLAP_LAGS, before_corner_um
from sim.make.cam.leads import lead_in, lead_out, run_back
from sim.make.cam.model import CannotCutError, Figure, FigureCut, PassCut, Refusal, Thread
from sim.make.cam.offset_path import SHORT_UM, offset_path
from sim.setup.making import Making


class Way(NamedTuple):
    """Which way round a first pass runs, and on which side of it the contour's wire is then."""

    is_ccw: bool
    side: Side


def way_of(figure: Figure, making: Making) -> Way:
    """Which way the first pass over a figure runs.

    ``one-side`` has the wire on its left: counter-clockwise within a contour, clockwise around one.
    """
    is_ccw = figure.runs_inside if making.direction == "one-side" else making.direction == "ccw"
    return Way(is_ccw, Side.LEFT if is_ccw == figure.runs_inside else Side.RIGHT)


def length_to(way: Curves, place_um: Point) -> float:
    """How far µm along a way its place nearest to another lies."""
    return float(lengths_to(way, np.array([place_um]))[0])


def begun_at(way: Curves, place_um: Point) -> Curves:
    """A closed way that begins and ends at its place nearest to another; at an end of a curve within 3 µm of that.

    A circle stays one curve.
    """
    if len(way) == 1:
        return _circle_at(way, place_um)
    first, last = parted(way, length_to(way, place_um))
    return joined([last, first])


def parted(way: Curves, length_um: float) -> tuple[Curves, Curves]:
    """A way in two, parted at a length along it; at an end of a curve within 3 µm of that, so that no sliver is left.

    Either may be empty.
    """
    before = total_before(way.length_um)
    nearest = int(np.argmin(np.abs(before - length_um)))
    if abs(float(before[nearest]) - length_um) < SHORT_UM:
        return way.picked(slice(nearest)), way.picked(slice(nearest, None))
    row = int(np.searchsorted(before, length_um)) - 1
    early, late = _halves(way.picked(slice(row, row + 1)), length_um - float(before[row]))
    return joined([way.picked(slice(row)), early]), joined([late, way.picked(slice(row + 1, None))])


def _circle_at(circle: Curves, place_um: Point) -> Curves:
    (x, y), radius = circle.center_um[0].tolist(), float(circle.radius_um[0])
    angle = math.atan2(place_um.y - y, place_um.x - x)
    start = np.array([[x + radius * math.cos(angle), y + radius * math.sin(angle)]])
    return replace(circle, start_um=start, end_um=start, start_angle_rad=np.array([angle]))


def _halves(curves: Curves, on_um: float) -> tuple[Curves, Curves]:
    """One curve in two."""
    place = places_at(curves, np.array([0]), np.array([on_um]))
    share = on_um / float(curves.length_um[0])
    turned = share * curves.sweep_rad
    early = replace(curves, end_um=place, sweep_rad=turned, length_um=share * curves.length_um)
    late = replace(
        curves,
        start_um=place,
        start_angle_rad=curves.start_angle_rad + turned,
        sweep_rad=curves.sweep_rad - turned,
        length_um=(1.0 - share) * curves.length_um,
    )
    return early, late


_FARTHEST = 1.5  # times the offset: how far from a corner of the contour the way turns round it; √2 at 90°


def offsets_of(figure: Figure, passes_um: tuple[float, ...], making: Making) -> tuple[float, ...]:
    """Offset of each pass over a figure: as its layer asks for, else as for all. CannotCutError where one rises."""
    layer = figure.layer.lower()
    chosen = next(
        (wish.passes_um for wish in making.layers if wish.layer.lower() == layer and wish.passes_um), passes_um
    )
    for number, (by_um, next_um) in enumerate(pairwise(chosen), start=2):
        if next_um > by_um:
            values = (("number", str(number)), ("offset_mm", f"{next_um / 1000:g}"), ("before_mm", f"{by_um / 1000:g}"))
            raise CannotCutError(Refusal("offset-rises", (), values))
    return chosen


def around(figure: Figure, thread: Thread, by_um: float, making: Making) -> Curves:
    """The closed way counter-clockwise at an offset, begun across from the entry; CannotCutError where it has none."""
    way = offset_path(figure, by_um, making.corners)
    return begun_at(way, _begin(figure, thread, by_um, way))


def _begin(figure: Figure, thread: Thread, by_um: float, way: Curves) -> Point:
    """Where a way begins: across from the entry, or where the way turns round the corner that the entry lies at.

    From there on the wire does not touch the part: a mark of it stays off the corner.
    """
    entry = thread.entry
    across = Point(entry.place_um.x + by_um * entry.out.x, entry.place_um.y + by_um * entry.out.y)
    length = float(figure.contour.length_um[entry.row])
    if SHORT_UM < entry.along_um < length - SHORT_UM:
        return across
    off = np.hypot(*(way.start_um - np.array(entry.place_um)).T)
    beside_um = np.hypot(*(way.start_um - np.array(across)).T)
    near = (off >= by_um - SHORT_UM) & (off <= _FARTHEST * by_um)
    if not near.any():
        return across
    return Point(*way.start_um[int(np.argmin(np.where(near, beside_um, np.inf)))].tolist())


_MOST_SHARE = 0.5  # of the contour: how wide a tab may be
_MOST_OF_SLUG = 0.2  # the same of a slug: readers take a pass that leaves more open for one that is meant so
_STEP_UM = 1e-6


class Rounds(NamedTuple):
    """Closed ways round a figure, one a pass, all run as the first pass runs, from across the entry.

    Attributes
    ----------
    figure, thread
        The figure, and where the wire of it is threaded.
    is_ccw
        Whether they run counter-clockwise.
    offsets_um
        The offset of each.
    ahead
        The ways.
    """

    figure: Figure
    thread: Thread
    is_ccw: bool
    offsets_um: tuple[float, ...]
    ahead: tuple[Curves, ...]


class _Parted(NamedTuple):
    """A way up to the tab, and over it."""

    open: Curves
    tab: Curves


def tab_passes(rounds: Rounds, making: Making) -> tuple[tuple[PassCut, ...], tuple[PassCut, ...]]:
    """The passes over the open stretch, and the cut-off.

    CannotCutError where the tab is no wider than the kerfs beside it, or most of the contour, or passes run one way.
    """
    if making.returning == "one-way" and len(rounds.ahead) > 1:
        raise CannotCutError(Refusal("one-way-tab"))
    ways = _parted_at_tab(rounds, making.tab_um)
    passes: list[PassCut] = []
    for number, (by_um, way) in enumerate(zip(rounds.offsets_um, ways, strict=True)):
        is_back = number % 2 == 1
        along = run_back(way.open) if is_back else way.open
        into = _step(passes[-1].along, along) if passes else lead_in(rounds.thread, along)
        passes.append(PassCut(by_um, is_back, into, along, along.picked(slice(0))))
    return tuple(passes), (_cut_off(rounds, ways[-1], passes[-1], making),)


def slug_passes(rounds: Rounds, making: Making) -> tuple[tuple[PassCut, ...], tuple[PassCut, ...]]:
    """The first pass up to the tab that the slug hangs by, the others all round, and the cut-off behind the first one.

    CannotCutError as of `tab_passes`.
    """
    way, by_um = _parted_at_tab(rounds, making.slug_tab_um)[0], rounds.offsets_um[0]
    first = PassCut(by_um, False, lead_in(rounds.thread, way.open), way.open, way.open.picked(slice(0)))
    cut_off = _cut_off(rounds, way, first, making)
    over, _ = parted(way.open, _overcut_um(making))
    cut_off = cut_off._replace(out=joined([run_back(over), run_back(first.into)]))
    return (first, *_whole_passes(rounds, making)[1:]), (cut_off,)


def cut_off_anew(cut: FigureCut, making: Making) -> PassCut:
    """The cut-off from the thread point: back over the tab, past the end of the open stretch, and back the same way.

    It ends before the next corner: the first pass has cut that already, and on to the other side guides of a wire that
    lags would run past it into the part.
    """
    by_um = cut.cut_off[0].by_um
    closed = around(cut.figure, cut.thread, by_um, making)
    ahead = closed if cut.is_ccw else run_back(closed)
    rounds = Rounds(cut.figure, cut.thread, cut.is_ccw, (by_um,), (ahead,))
    (way,) = _parted_at_tab(rounds, making.slug_tab_um if cut.figure.runs_inside else making.tab_um)
    open_ = run_back(way.open)
    over, _ = parted(open_, min(_overcut_um(making), before_corner_um(open_, making.lag_um)))
    there = joined([run_back(way.tab), over])
    into = cut.passes[0].into if cut.figure.runs_inside else lead_in(cut.thread, there)
    return PassCut(by_um, True, into, joined([there, run_back(there)]), run_back(into))


def _parted_at_tab(rounds: Rounds, tab_um: float) -> list[_Parted]:
    """The ways at all offsets, parted where the tab begins. CannotCutError where there can be no such tab."""
    place = _end_of_open(rounds, tab_um)
    return [_Parted(*parted(ahead, length_to(ahead, place))) for ahead in rounds.ahead]


def _cut_off(rounds: Rounds, way: _Parted, last: PassCut, making: Making) -> PassCut:
    """On over the tab from where the last pass ended; from the entry out, with the overcut there on the way.

    Where it comes out at the far end of the tab, it goes back in its own kerf.
    """
    nothing = way.tab.picked(slice(0))
    over, _ = parted(way.open, _overcut_um(making))
    out = joined([run_back(over), lead_out(rounds.thread, way.tab)])
    if last.is_back:
        return PassCut(last.by_um, True, nothing, run_back(way.tab), joined([way.tab, over, out]))
    return PassCut(last.by_um, False, nothing, joined([way.tab, over]), out)


def _end_of_open(rounds: Rounds, tab_um: float) -> Point:
    """The place on the contour where the tab begins, as far before the entry as it is wide."""
    contour, entry = rounds.figure.contour, rounds.thread.entry
    before = total_before(contour.length_um)
    least, most = 2.0 * rounds.offsets_um[0], _MOST_SHARE * float(before[-1])
    if not least < tab_um <= most:
        why, bound = ("tab-too-short", least) if tab_um <= least else ("tab-too-long", most)
        values = (("figure", str(rounds.figure.number)), ("tab_mm", _mm(tab_um)), ("bound_mm", _mm(bound)))
        raise CannotCutError(Refusal(why, (entry.place_um,), values))
    at = np.mod(before[entry.row] + entry.along_um + (-tab_um if rounds.is_ccw else tab_um), before[-1])
    row = np.minimum(np.searchsorted(before, [at], side="right") - 1, len(contour) - 1)
    return Point(*places_at(contour, row, at - before[row])[0].tolist())


def _mm(length_um: float) -> str:
    return f"{round(length_um) / 1000.0:g}"


def _step(before: Curves, behind: Curves) -> Curves:
    """A line from the end of one way to the start of another; none where they are one place."""
    start, end = before.end_um[-1:], behind.start_um[:1]
    away = np.hypot(*(end - start).T) > _STEP_UM
    return curves_between(start[away], end[away], np.full((int(away.sum()), 2), np.nan), np.zeros(int(away.sum())))


def figure_cut(figure: Figure, thread: Thread, passes_um: tuple[float, ...], making: Making) -> FigureCut:
    """How a figure is cut; CannotCutError where the wire does not fit, or what is asked for does not go together.

    A tab is left where the wire runs outside of the contour, since what falls there is the part; one of slugs, where
    that is asked for, within contours that are long enough for it.
    """
    way = way_of(figure, making)
    offsets = offsets_of(figure, passes_um, making)
    closed = [around(figure, thread, by_um, making) for by_um in offsets]
    ahead = tuple(each if way.is_ccw else run_back(each) for each in closed)
    rounds = Rounds(figure, thread, way.is_ccw, offsets, ahead)
    if making.tab_um and not figure.runs_inside:
        return FigureCut(figure, thread, way.side, way.is_ccw, *tab_passes(rounds, making))
    if has_slug_tab(figure, making):
        return FigureCut(figure, thread, way.side, way.is_ccw, *slug_passes(rounds, making))
    return FigureCut(figure, thread, way.side, way.is_ccw, _whole_passes(rounds, making))


def has_slug_tab(figure: Figure, making: Making) -> bool:
    """Whether the slug of a figure hangs by a tab for a while: where that is a fifth of its contour at most."""
    length_um = float(figure.contour.length_um.sum())
    return figure.runs_inside and 0.0 < making.slug_tab_um <= _MOST_OF_SLUG * length_um


def _whole_passes(rounds: Rounds, making: Making) -> tuple[PassCut, ...]:
    """Passes all round, each from the thread point and back to it."""
    passes = []
    for number, (by_um, ahead) in enumerate(zip(rounds.offsets_um, rounds.ahead, strict=True)):
        is_back = making.returning == "back" and number % 2 == 1
        along = run_back(ahead) if is_back else ahead
        into, out = (lead(rounds.thread, along) for lead in (lead_in, lead_out))
        if (over_um := _overcut_um(making)) and number == len(rounds.ahead) - 1:
            over, _ = parted(along, over_um)
            along, out = joined([along, over]), joined([run_back(over), out])
        passes.append(PassCut(by_um, is_back, into, along, out))
    return tuple(passes)


def _overcut_um(making: Making) -> float:
    """How far the last pass runs on over its start: as is asked for, and until a wire that lags is on its way."""
    return max(making.overcut_um, OVERLAP_LAGS * making.lag_um)
