"""The order in which the wire comes to figures: all passes over each in turn, or in rounds over all of them.

In rounds the first passes over all figures come first, and the stop behind them is for taking the slugs out. Then come
the other passes, and what is cut off. But nothing falls with work in it that is still to be done: what frees a slug or
a part waits for all that lies within it, and a tab of a part for the passes over that part.

Which rows of a written path each figure has.
"""

import math
from collections.abc import Iterator, Sequence
from typing import Final, Literal, NamedTuple

from parser.shape.contours import runs
from parser.toolpath import Toolpath
from sim.make.cam.model import CutPlan, FigureCut, Visit
from sim.make.cam.order import around
from sim.make.cam.passes import cut_off_anew
from sim.setup.making import Making

Spans = list[tuple[int, int]]
"""Rows of a path: the first one of each of some contours, and one past its last."""
_Kind = Literal["rough", "slug", "rest", "part"]
_ROUNDS: Final[tuple[_Kind, ...]] = ("rough", "slug", "rest", "part")
"""Rounds in turn: first passes, slugs that hang by tabs, other passes, parts that hang by tabs.

The passes over a part that hangs by a tab run back and forth, and are cut in one go in the last round but one.
"""


class _Task(NamedTuple):
    """What is cut of a figure in one round: the index of its cut, and which of its passes."""

    cut: int
    kind: _Kind
    first: int
    past: int


class Visited(NamedTuple):
    """Cuts in the order of their figures, and the visits in that in which the wire runs over them."""

    cuts: tuple[FigureCut, ...]
    visits: tuple[Visit, ...]


def visited(cuts: Sequence[FigureCut], making: Making) -> Visited:
    """The visits of figures that are cut in an order, and how each is cut then."""
    if not making.in_rounds:
        return Visited(tuple(cuts), tuple(visit for at, cut in enumerate(cuts) for visit in _whole(at, cut)))
    keeps_order = bool(making.order or any(each.rank is not None for each in making.layers))
    keeps_order |= any(cut.thread.by == "kerf" for cut in cuts)
    made, visits = list(cuts), list[Visit]()
    rounds = list(_rounds(cuts))
    for in_plan, behind in zip(rounds, [*rounds[1:], []], strict=True):
        tasks = in_plan
        if visits:
            is_back = not keeps_order and _is_nearer_back(cuts, in_plan, cuts[visits[-1].cut])
            tasks = _apart(in_plan[::-1] if is_back else in_plan, visits[-1].cut, behind)
        for at, task in enumerate(tasks):
            cut, goes_on = made[task.cut], bool(visits) and visits[-1].cut == task.cut
            if task.first == len(cut.passes) and not goes_on:
                made[task.cut] = cut._replace(cut_off=(cut_off_anew(cut, making),))
            has_stop = bool(visits) and (at == 0 or not goes_on)
            visits.append(Visit(task.cut, task.first, task.past, not goes_on, has_stop))
    return Visited(tuple(made), tuple(visits))


def _whole(at: int, cut: FigureCut) -> Iterator[Visit]:
    """All passes over a figure, and then what is cut off, behind a stop."""
    yield Visit(at, 0, len(cut.passes), is_threaded=True, has_stop=at > 0)
    if cut.cut_off:
        yield Visit(at, len(cut.passes), len(cut.all_passes), is_threaded=False, has_stop=True)


def _rounds(cuts: Sequence[FigureCut]) -> Iterator[list[_Task]]:
    """Tasks round after round, each as soon as nothing that it waits for is left."""
    left = {(task.cut, task.kind): task for at, cut in enumerate(cuts) for task in _tasks(at, cut)}
    inner = _within(cuts)
    while left:
        for kind in _ROUNDS:
            tasks = [task for task in left.values() if task.kind == kind and not _waits(task, left, inner, cuts)]
            for task in tasks:
                del left[task.cut, kind]
            if tasks:
                yield tasks


def _tasks(at: int, cut: FigureCut) -> Iterator[_Task]:
    number, past = len(cut.passes), len(cut.all_passes)
    if _freed_by(cut) == "part":
        yield _Task(at, "rest" if number > 1 else "rough", 0, number)
        yield _Task(at, "part", number, past)
        return
    yield _Task(at, "rough", 0, 1)
    if cut.cut_off:
        yield _Task(at, "slug", number, past)
    if number > 1:
        yield _Task(at, "rest", 1, number)


def _freed_by(cut: FigureCut) -> _Kind:
    """What of a cut lets its slug or its part fall."""
    if not cut.cut_off:
        return "rough"
    return "slug" if cut.figure.runs_inside else "part"


def _waits(
    task: _Task, left: dict[tuple[int, _Kind], _Task], inner: Sequence[set[int]], cuts: Sequence[FigureCut]
) -> bool:
    """Whether something has to be cut before: of the same figure, or within what the task lets fall."""
    before = _ROUNDS[: _ROUNDS.index(task.kind)]
    if any((task.cut, kind) in left for kind in before):
        return True
    frees = task.kind == _freed_by(cuts[task.cut])
    return frees and any((each, kind) in left for each in inner[task.cut] for kind in _ROUNDS)


def _within(cuts: Sequence[FigureCut]) -> list[set[int]]:
    """Indices of the cuts whose figures lie within each one's."""
    outer, inner = around([cut.figure for cut in cuts]), [set[int]() for _ in cuts]
    for at in range(len(cuts)):
        each = outer[at]
        while each >= 0:
            inner[each].add(at)
            each = outer[each]
    return inner


def _apart(tasks: list[_Task], cut: int, behind: list[_Task]) -> list[_Task]:
    """Tasks in an order in which no other passes over a figure come at once behind its cut-off, if that may be.

    Both would be one contour, of which nobody can tell what is a tab. `cut` is the last one before the tasks, `behind`
    the round behind them.
    """
    is_one = tasks[0].kind == "slug" and [task.cut for task in behind] == [tasks[-1].cut]
    meets = tasks[0].kind == "rest" and tasks[0].cut == cut
    return [*tasks[1:2], tasks[0], *tasks[2:]] if meets else tasks[::-1] if is_one else tasks


def _is_nearer_back(cuts: Sequence[FigureCut], tasks: Sequence[_Task], cut: FigureCut) -> bool:
    """Whether the last of some tasks begins nearer to the thread point of a cut than the first one does."""
    place_um = cut.thread.place_um
    first, last = (math.dist(place_um, cuts[task.cut].thread.place_um) for task in (tasks[0], tasks[-1]))
    return last < first


def figure_rows(toolpath: Toolpath, plan: CutPlan) -> list[Spans]:
    """Of each cut of a plan the rows of a path that it takes.

    Empty where the path has not as many contours as the plan.
    """
    found = runs(toolpath).tolist()
    if len(found) != len(plan.of_contour):
        return []
    rows: list[Spans] = [[] for _ in plan.cuts]
    for at, (first, past) in zip(plan.of_contour, found, strict=True):
        rows[at].append((first, past))
    return rows
