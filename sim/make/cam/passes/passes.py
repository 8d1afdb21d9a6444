"""The passes over a figure: back and forth or one way, all round it or up to a tab.

Passes up to a tab that holds the part, and the cut-off behind a stop.

All passes run back and forth over the open stretch, since the wire comes from its end to its start by no other way.
From one to the next it steps aside, in its own kerf. Behind the stop it runs on over the tab as it came: from the end
of the open stretch to its start, or back from its start to its end. It does so once, at the offset of the last pass:
a part that has been cut off is loose, and what a second pass would leave of it is left to chance. So the tab, too, is
as large as the drawing has it, and what the rough cut leaves rough there is what is left to be ground.
"""

from typing import NamedTuple

import numpy as np

from parser.geometry.along import places_at
from parser.geometry.curves import Curves, curves_between, joined, total_before
from parser.toolpath import Point
from sim.make.cam.leads.leads import lead_in, lead_out
from sim.make.cam.model import CannotCutError, Figure, FigureCut, PassCut, Refusal, Thread
from sim.make.cam.order.sides import way_of
from sim.make.cam.passes.around import around, offsets_of
from sim.make.cam.passes.turned import length_to, parted, run_back
from sim.setup.making import Making

_MOST_SHARE = 0.5  # of the contour
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
    place = _end_of_open(rounds, making.tab_um)
    ways = [_Parted(*parted(ahead, length_to(ahead, place))) for ahead in rounds.ahead]
    nothing = ways[0].open.picked(slice(0))
    passes: list[PassCut] = []
    for number, (by_um, way) in enumerate(zip(rounds.offsets_um, ways, strict=True)):
        is_back = number % 2 == 1
        along = run_back(way.open) if is_back else way.open
        into = _step(passes[-1].along, along) if passes else lead_in(rounds.thread, along)
        passes.append(PassCut(by_um, is_back, into, along, nothing))
    return tuple(passes), (_cut_off(rounds, ways[-1], passes[-1], making),)


def _cut_off(rounds: Rounds, way: _Parted, last: PassCut, making: Making) -> PassCut:
    """On over the tab from where the last pass ended; from the entry out, with the overcut there on the way.

    Where it comes out at the far end of the tab, it goes back in its own kerf.
    """
    nothing = way.tab.picked(slice(0))
    over, _ = parted(way.open, making.overcut_um)
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

    A tab is left where the wire runs outside of the contour: what falls there is the part.
    """
    way = way_of(figure, making)
    offsets = offsets_of(figure, passes_um, making)
    closed = [around(figure, thread, by_um, making) for by_um in offsets]
    ahead = tuple(one if way.is_ccw else run_back(one) for one in closed)
    rounds = Rounds(figure, thread, way.is_ccw, offsets, ahead)
    if making.tab_um and not figure.runs_inside:
        return FigureCut(figure, thread, way.side, way.is_ccw, *tab_passes(rounds, making))
    return FigureCut(figure, thread, way.side, way.is_ccw, _whole_passes(rounds, making))


def _whole_passes(rounds: Rounds, making: Making) -> tuple[PassCut, ...]:
    """Passes all round, each from the thread point and back to it."""
    passes = []
    for number, (by_um, ahead) in enumerate(zip(rounds.offsets_um, rounds.ahead, strict=True)):
        is_back = making.returning == "back" and number % 2 == 1
        along = run_back(ahead) if is_back else ahead
        into, out = (lead(rounds.thread, along) for lead in (lead_in, lead_out))
        if making.overcut_um and number == len(rounds.ahead) - 1:
            over, _ = parted(along, making.overcut_um)
            along, out = joined([along, over]), joined([run_back(over), out])
        passes.append(PassCut(by_um, is_back, into, along, out))
    return tuple(passes)
