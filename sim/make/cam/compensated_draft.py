"""A plan to a draft whose offsets the controller adds: the contours of the drawing; ISO says so by G41 and G42.

A plan to a draft: visit after visit, with a jump and a pause between figures, and a pause before a tab.
"""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from parser.controller_words import Compensation, CompensationRules
from parser.geometry.along import directions
from parser.geometry.curves import Curves, joined, jump_between
from parser.toolpath import Point, Stop
from parser.write.draft import Draft
from sim.make.cam.guides import guided
from sim.make.cam.model import CannotCutError, CutPlan, FigureCut, PassCut, Refusal, Visit


def draft_of_plan(plan: CutPlan) -> Draft:
    """The draft of a plan, its offsets worked into the path, and the lag of the wire where one is asked for."""
    lag_um = plan.making.lag_um
    return draft_of_cuts(plan.visits, [guided(cut, lag_um) for cut in plan.cuts] if lag_um else plan.cuts)


def draft_of_cuts(visits: Sequence[Visit], cuts: Sequence[FigureCut]) -> Draft:
    """The draft of visits of figures, one behind the other, with a jump where the wire is threaded anew."""
    parts: list[Curves] = []
    stops: list[Stop] = []
    rows = 0
    for at, visit in enumerate(visits):
        cut = cuts[visit.cut]
        if visit.has_stop:
            stops.append(Stop("pause", rows, 0))
        if at and visit.is_threaded:
            jump = jump_between(parts[-1].end_um[-1], np.array(cut.thread.place_um))
            parts.append(jump)
            rows += len(jump)
        ways = [way for pass_ in visit.passes_of(cut) for way in (pass_.into, pass_.along, pass_.out) if len(way)]
        parts += ways
        rows += sum(map(len, ways))
    stops.append(Stop("end", rows, 0))
    nowhere = np.full((rows, 2), np.nan)
    return Draft(joined(parts), tuple(stops), np.zeros(rows, dtype=np.bool_), nowhere, is_meant=True)


_TANGENT_RAD = np.radians(0.5)
"""At f = 0.1 mm the neighbours then miss each other by 0.9 µm; `drycut check` tells larger turns (3B214)."""


class _Sided(NamedTuple):
    """So many rows with a side, 1 for left and −1 for right, 0 for none; the offset, and its register."""

    rows: int
    side: int
    by_um: float
    register: str


def kept_draft(plan: CutPlan, on_contour: Sequence[FigureCut], rules: CompensationRules) -> Draft:
    """The draft of a plan of which `on_contour` are the same cuts on the contours themselves.

    Compensation is set up by the first line of a lead-in and ended by the lead-out (docs/iso.md §9). CannotCutError
    where that cannot be.
    """
    _refuse_misfits(plan, on_contour)
    draft = draft_of_cuts(plan.visits, on_contour)
    sided = list(_sided(plan, on_contour))
    rows = [each.rows for each in sided]
    compensation = Compensation(
        side=np.repeat(np.array([each.side for each in sided], dtype=np.int64), rows),
        by_um=np.repeat(np.array([each.by_um for each in sided], dtype=np.float64), rows),
        register=tuple(each.register for each in sided for _ in range(each.rows)),
        rules=rules,
    )
    return replace(draft, compensation=compensation)


def added_draft(plan: CutPlan, on_contour: Sequence[FigureCut]) -> Draft:
    """The same without a word of it: f of a 4B controller, which lengthens and shortens the radii of arcs.

    It has one offset, on one side, for all, and moves the neighbours of tangent joints alone (docs/3b.md §6).
    CannotCutError where the plan needs more.
    """
    _refuse_misfits(plan, on_contour)
    if len({pass_.by_um for cut in plan.cuts for pass_ in cut.passes}) > 1 or len({cut.side for cut in plan.cuts}) > 1:
        raise CannotCutError(Refusal("kept-several"))
    for cut in on_contour:
        for pass_ in cut.passes:
            _refuse_corners(cut, pass_.along)
    return draft_of_cuts(plan.visits, on_contour)


def _refuse_corners(cut: FigureCut, along: Curves) -> None:
    leaving, arriving = directions(along)
    onward = np.roll(leaving, -1, axis=0)
    turn = np.arctan2(arriving[:, 0] * onward[:, 1] - arriving[:, 1] * onward[:, 0], (arriving * onward).sum(axis=1))
    sharp = np.flatnonzero(np.abs(turn) > _TANGENT_RAD)
    if len(sharp):
        places = tuple(Point(*place) for place in along.end_um[sharp].tolist())
        values = (("figure", str(cut.figure.number)), ("degrees", f"{np.degrees(np.abs(turn).max()):.1f}"))
        raise CannotCutError(Refusal("kept-corner", places, values))


def _sided(plan: CutPlan, on_contour: Sequence[FigureCut]) -> Iterator[_Sided]:
    """The rows of the draft in order: jumps, ways in and along, ways out."""
    registers: dict[float, str] = {}
    for at, visit in enumerate(plan.visits):
        cut = plan.cuts[visit.cut]
        if at and visit.is_threaded:
            yield _Sided(1, 0, 0.0, "")
        for pass_, way in zip(visit.passes_of(cut), visit.passes_of(on_contour[visit.cut]), strict=True):
            side = -int(cut.side) if pass_.is_back else int(cut.side)
            register = registers.setdefault(pass_.by_um, f"D{len(registers) + 1}")
            yield _Sided(len(way.into) + len(way.along), side, pass_.by_um, register)
            yield _Sided(len(way.out), 0, 0.0, "")


def _refuse_misfits(plan: CutPlan, on_contour: Sequence[FigureCut]) -> None:
    """CannotCutError for tabs, overcuts, holes without a core, parts begun in a kerf, and leads without lines.

    Ways back over a tab would need the other side. The turns that take a slug away lie at offsets of their own.
    """
    if plan.making.tab_um or plan.making.slug_tab_um or plan.making.overcut_um:
        raise CannotCutError(Refusal("kept-tab"))
    if any(cut.is_coreless for cut in plan.cuts):
        raise CannotCutError(Refusal("kept-no-core"))
    if any(cut.thread.by == "kerf" for cut in plan.cuts):
        raise CannotCutError(Refusal("kept-common"))
    for cut in on_contour:
        if not all(_is_led(pass_) for pass_ in cut.passes):
            raise CannotCutError(Refusal("kept-lead", (cut.thread.place_um,), (("figure", str(cut.figure.number)),)))


def _is_led(pass_cut: PassCut) -> bool:
    """Whether a line comes first, and a line last: no controller sets compensation up on an arc, or ends it on one."""
    return bool(len(pass_cut.into) and len(pass_cut.out) and not pass_cut.into.is_arc[0] and not pass_cut.out.is_arc[0])
