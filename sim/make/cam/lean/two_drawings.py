"""A plan of two drawings: each contour at the bottom of the work with its partner at the top, to a draft of both.

The plan is that of the lower drawing. Its passes are drawn along the contour itself, piece by piece with those of the
upper contour, and both are offset as a controller offsets two contours, each in its own plane.
"""

from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np
import shapely

from controller.offset.programmed import compensated
from controller.taper.two_contours import matched_offsets
from parser.controller_words import Compensation, CompensationRules
from parser.findings.catalogue import Remark
from parser.geometry.curves import Curves, Floats, curves_between, total_before
from parser.geometry.distance import lengths_to
from parser.text.source import Source
from parser.toolpath import Point, Toolpath
from parser.write.draft import Draft
from sim.make.cam.compensated_draft import draft_of_cuts, kept_draft
from sim.make.cam.facing import Facing, facing
from sim.make.cam.model import CannotCutError, CutPlan, Figure, FigureCut, PassCut, Refusal
from sim.measure.compare.rings import orientation, polygon

_ALIKE = 0.1
"""Partners have at least this share of their areas in common."""


def facings_of(figures: Sequence[Figure], upper: Sequence[Figure], *, all_cut: bool) -> dict[int, Facing]:
    """Each figure of the lower drawing, by its number, with the contour that lies over it in the upper one.

    CannotCutError where one has no partner; where `all_cut`, also where there are not as many contours in both.
    """
    if all_cut and len(figures) != len(upper):
        raise CannotCutError(Refusal("upper-counts", (), (("lower", str(len(figures))), ("upper", str(len(upper))))))
    shapes = [[polygon(figure.contour) for figure in of] for of in (figures, upper)]
    free = list(range(len(upper)))
    found: dict[int, Facing] = {}
    for figure, shape in zip(figures, shapes[0], strict=True):
        shares = [_in_common(shape, shapes[1][at]) if upper[at].kind == figure.kind else 0.0 for at in free]
        best = int(np.argmax(shares)) if shares else 0
        if not shares or shares[best] < _ALIKE:
            place = Point(*figure.contour.start_um[0].tolist())
            raise CannotCutError(Refusal("no-upper", (place,), (("figure", str(figure.number)),)))
        found[figure.number] = facing(figure.contour, upper[free.pop(best)].contour)
    return found


def _in_common(shape: shapely.Polygon, other: shapely.Polygon) -> float:
    return float(shapely.area(shapely.intersection(shape, other)) / max(shape.area, other.area))


def facing_notes(plan: CutPlan) -> tuple[Remark, ...]:
    """By what the contours of both drawings were matched."""
    by: dict[str, list[int]] = {}
    for cut, faced in zip(plan.cuts, plan.facings, strict=False):  # none of one drawing
        by.setdefault(faced.by, []).append(cut.figure.number)
    return tuple(
        Remark(f"facing-{name}", {"number": len(figures), "figures": ", ".join(map(str, sorted(figures)))})
        for name, figures in by.items()
    )


def draft_of_both(
    plan: CutPlan, on_contour: Sequence[FigureCut], rules: CompensationRules | None, height_um: float
) -> Draft:
    """The draft of both contours of a plan, of which `on_contour` are the cuts on the lower contours themselves.

    With `rules` the controller adds the offsets, each in its plane. Without, they are worked into both contours, as
    much wider as a wire cuts that leans as its walls do on average. CannotCutError where the plan has no leads for it.
    """
    pairs = [_paired(cut, faced) for cut, faced in zip(on_contour, plan.facings, strict=True)]
    if rules is None:
        cuts = tuple(_widened(cut, faced, height_um) for cut, faced in zip(plan.cuts, plan.facings, strict=True))
        plan = plan._replace(cuts=cuts)
    draft = kept_draft(plan, [pair.lower for pair in pairs], rules or CompensationRules(outer="lengthen"))
    upper = draft_of_cuts(plan.visits, [pair.upper for pair in pairs]).curves
    return replace(draft, upper=upper) if rules is not None else _worked_in(draft, upper)


def _widened(cut: FigureCut, faced: Facing, height_um: float) -> FigureCut:
    cosine = faced.cosine(height_um)
    return cut._replace(passes=tuple(pass_._replace(by_um=pass_.by_um / cosine) for pass_ in cut.passes))


class _Paired(NamedTuple):
    """The cuts of a figure and of its partner, row by row."""

    lower: FigureCut
    upper: FigureCut


def _paired(cut: FigureCut, faced: Facing) -> _Paired:
    """A cut on the contour itself, its rows as pieces that have partners, and the same of the upper contour."""
    lower, upper = [], []
    for pass_ in cut.passes:
        way_um = float(pass_.along.length_um.sum()) * orientation(pass_.along)
        low, high = faced.stretch(float(lengths_to(faced.lower, pass_.along.start_um[:1])[0]), way_um)
        lower.append(pass_._replace(along=low))
        begin, end = high.start_um[0] - low.start_um[0], high.end_um[-1] - low.end_um[-1]
        into, out = _led(pass_.into, begin, is_in=True), _led(pass_.out, end, is_in=False)
        upper.append(PassCut(pass_.by_um, pass_.is_back, into, high, out))
    return _Paired(cut._replace(passes=tuple(lower)), cut._replace(passes=tuple(upper)))


def _led(lead: Curves, aside_um: Floats, *, is_in: bool) -> Curves:
    """A lead between a thread point, where the wire is upright, and a contour beside that of the lower one."""
    if not len(lead):
        return lead
    done = total_before(lead.length_um) / max(float(lead.length_um.sum()), 1.0)
    shares = (done if is_in else 1.0 - done)[:, None]
    start, end = lead.start_um + shares[:-1] * aside_um, lead.end_um + shares[1:] * aside_um
    return curves_between(start, end, lead.center_um, np.zeros(len(lead)))


def _worked_in(draft: Draft, upper: Curves) -> Draft:
    """A draft and its upper contour with their offsets in their paths."""
    compensation = draft.compensation
    assert compensation is not None  # noqa: S101 - a kept draft has one
    lower, above = (compensated(_toolpath(of, compensation)).path for of in (draft.curves, upper))
    both = matched_offsets(lower, above)
    drawn = lower.source_row[both.source_row]
    stops = tuple(stop._replace(after=int(np.searchsorted(drawn, stop.after))) for stop in draft.stops)
    n = len(drawn)
    nowhere = np.full((n, 2), np.nan)
    return Draft(both.lower, stops, np.zeros(n, dtype=np.bool_), nowhere, is_meant=True, upper=both.upper)


def _toolpath(curves: Curves, compensation: Compensation) -> Toolpath:
    """Curves that a controller compensates, of no text."""
    n = len(curves)
    rows = np.arange(1, n + 1)
    return Toolpath(
        **{name: getattr(curves, name) for name in Curves.__slots__},
        printed_end_um=np.full((n, 2), np.nan),
        words=None,
        source=Source("", rows, np.zeros((n, 2), dtype=np.int64), np.ones(n, dtype=np.int64), ("",) * n),
        stops=(),
        compensation=compensation,
    )
