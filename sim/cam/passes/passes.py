"""The passes over a figure: back and forth or one way, all round it or up to a tab."""

from parser.geometry.curves import joined
from sim.cam.leads.leads import lead_in, lead_out
from sim.cam.model import Figure, FigureCut, PassCut, Thread
from sim.cam.order.sides import way_of
from sim.cam.passes.around import around, offsets_of
from sim.cam.passes.tab import Rounds, tab_passes
from sim.cam.passes.turned import parted, run_back
from sim.setup.making import Making


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
