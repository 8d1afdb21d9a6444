"""The order of figures: as it is asked for, else deepest first, and by the shortest way between thread points."""

from collections.abc import Sequence

import numpy as np

from sim.cam.model import CannotCutError, Figure, Refusal, Thread
from sim.cam.order.levels import levels
from sim.cam.order.nested import around
from sim.cam.order.route import route
from sim.setup.making import Making


def in_order(figures: Sequence[Figure], threads: Sequence[Thread], making: Making) -> tuple[int, ...]:
    """Indices of the figures as they are cut.

    CannotCutError where the order that is asked for does not name each figure once, ``order-incomplete``, or would cut
    out what has still to be cut within, ``order-falls``.
    """
    outer = around(figures)
    if making.order:
        return _asked(figures, outer, making.order)
    place = np.array([thread.place_um for thread in threads], dtype=np.float64).reshape(-1, 2)
    order: list[int] = []
    for level in levels(figures, outer, making):
        if order:
            # The way goes on from where the level before it ends.
            from_there = route(np.concatenate([place[order[-1:]], place[level]]), 0)[1:] - 1
            order += level[from_there].tolist()
        else:
            order += level[route(place[level])].tolist()
    return tuple(order)


def _asked(figures: Sequence[Figure], outer: Sequence[int], wanted: tuple[int, ...]) -> tuple[int, ...]:
    """The order of the numbers that are asked for."""
    index = {figure.number: at for at, figure in enumerate(figures)}
    if sorted(wanted) != sorted(index):
        missing, unknown = sorted(set(index) - set(wanted)), sorted(set(wanted) - set(index))
        twice = sorted({number for number in wanted if wanted.count(number) > 1})
        values = (("all", str(len(index))), ("wrong", ", ".join(map(str, [*missing, *unknown, *twice][:20]))))
        raise CannotCutError(Refusal("order-incomplete", (), values))
    order = tuple(index[number] for number in wanted)
    when = {at: number for number, at in enumerate(order)}
    for at in order:
        if outer[at] >= 0 and when[outer[at]] < when[at]:
            values = (("number", str(figures[at].number)), ("around", str(figures[outer[at]].number)))
            raise CannotCutError(Refusal("order-falls", (), values))
    return order
