"""The passes over a figure: where each of them begins, and which way it runs."""

from sim.cam.leads.leads import lead_in, lead_out
from sim.cam.model import Figure, FigureCut, PassCut, Thread
from sim.cam.order.sides import way_of
from sim.cam.passes.beside import beside
from sim.cam.passes.turned import begun_at, run_back
from sim.setup.making import Making


def figure_cut(figure: Figure, thread: Thread, passes_um: tuple[float, ...], making: Making) -> FigureCut:
    """How a figure is cut; CannotCutError where the wire does not fit."""
    way = way_of(figure, making)
    passes = []
    for number, by_um in enumerate(passes_um):
        is_back = making.returning == "back" and number % 2 == 1
        around = begun_at(beside(figure, by_um, making.corners), thread.entry.place_um)
        along = around if way.is_ccw != is_back else run_back(around)
        into, out = lead_in(figure, thread, along, making), lead_out(figure, thread, along, making)
        passes.append(PassCut(by_um, is_back, into, along, out))
    return FigureCut(figure, thread, way.side, way.is_ccw, tuple(passes))
