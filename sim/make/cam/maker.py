"""A drawing to a proved program: `made_program`, the one way in.

How near arcs are fitted to what is drawn, so that the written path keeps its tolerance with few of them.

A made program with remarks in its header: what speaks against one that is written all the same.
"""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Literal, NamedTuple

import numpy as np

from parser.drawing.model import DEFAULT_FLATTEN_UM, Drawing
from parser.drawing.read import read_drawing
from parser.findings.catalogue import Remark
from parser.findings.errors import SettingsError
from parser.program import Program, load_program, paired
from parser.text.encoding import printable
from parser.toolpath import Toolpath
from parser.write.draft import Draft, Written
from sim.base.progress import Progress, silent
from sim.make.cam.compensated_draft import added_draft, draft_of_cuts, draft_of_plan, kept_draft
from sim.make.cam.lean.angle import (
    angle_words,
    height_over_plane_um,
    in_plane,
    lean_notes,
    lean_of,
    leaning,
    refuse_upright_ways,
)
from sim.make.cam.lean.two_drawings import draft_of_both, facing_notes
from sim.make.cam.model import CannotCutError, CutPlan, Refusal
from sim.make.cam.passes import figure_cut
from sim.make.cam.planned import PlanRequest, as_cut, planned
from sim.make.cam.proof import ToProve, proved
from sim.make.cam.proof_model import Proof
from sim.make.cam.proof_run import least_um
from sim.make.cam.target import target_of
from sim.make.conversion_proof import Proof as HeldAgainst
from sim.make.conversion_proof import proof as held_against
from sim.make.wanted import (
    Wanted,
    begun,
    encoded,
    read_with,
    written,
)
from sim.measure.compare.compare import compare_program
from sim.measure.compare.result import FitRequest
from sim.setup.making import Making
from sim.setup.scenario import Scenario

_STEP = 0.03  # of the tolerance, by which each fit is nearer than the one before it
_MOST_STEPS = 6
_MOST_CURVES = 500
"""Of all fits in steps together: of so many arcs some one is always rounded to its wrong side."""
_ROUNDING_UM = 0.5
"""What whole µm add at most: 0.49 µm, written as 3B over an ellipse of 40 × 20 mm fitted within 0.5 … 5 µm."""
_LEAST_SHARE = 0.5
"""Of the tolerance: with less of it, a fit takes ever more arcs, each of them rounded."""


def fits_um(tolerance_um: float, curves: int) -> tuple[float, ...]:
    """How far arcs may lie off what is drawn, the first fit to be tried first, where the path may by a tolerance.

    `curves` says how many the first fit has. Other arcs are rounded otherwise, mostly by less than the last fit allows
    for: so as few of them as of the whole tolerance often do.
    """
    steps = min(_MOST_STEPS, _MOST_CURVES // max(curves, 1) - 1)
    surely_um = max(tolerance_um - _ROUNDING_UM, _LEAST_SHARE * tolerance_um)
    nearer = (round(tolerance_um * (1.0 - _STEP * step), 6) for step in range(1, steps + 1))
    return (tolerance_um, *(each for each in nearer if each > surely_um), surely_um)


def path_off_um(wire_way: Toolpath, plan: CutPlan, drawn: Drawing, reach_um: float) -> float | None:
    """How far a written way of the wire lies at most from where the drawing wants it, both ways, gaps aside.

    None where figures end at different offsets, or where it cannot be worked out.
    """
    edge_um = {least_um(cut.figure, plan.making, reach_um) for cut in plan.cuts}
    target, _ = target_of(drawn, plan)
    if target is None or len(edge_um) != 1:
        return None
    try:
        fit_request = FitRequest(plan.making.tolerance_um, fitted=False)
        found = compare_program(wire_way, edge_um.pop(), target.drawing, fit_request)
    except SettingsError:
        return None
    return max(found.max_um - target.gap_um, 0.0) if np.isfinite(found.max_um) else None


_SURELY_ALONE = 2  # fits: of a large drawing no more is looked at than the one that is surely near enough
_FLATTEN_SHARE = 0.01  # of the tolerance: how far the lines of the drawing as it is drawn lie off its curves


class MadeProgram(NamedTuple):
    """A program that was made of a drawing.

    Attributes
    ----------
    data
        Bytes of its text.
    program
        What reading them gives.
    plan, draft
        What it was written of.
    written
        How far the path of its text lies off that which was planned, and what else of it is not the same.
    proof
        What its run shows; None where nobody asked for one.
    drawn
        The drawing without the fit of arcs; None where it was not read so.
    unled
        The same program for a wire that does not lag: the way of the wire where the program leads guides; else None.
    upper_data
        Bytes of the text of its upper contour, where that has one of its own, as in 3B; else None.
    """

    data: bytes
    program: Program
    plan: CutPlan
    draft: Draft
    written: HeldAgainst
    proof: Proof | None = None
    drawn: Drawing | None = None
    unled: Program | None = None
    upper_data: bytes | None = None

    @property
    def wire_way(self) -> Toolpath:
        """The way on which the wire is to cut."""
        return (self.unled or self.program).toolpath

    @property
    def is_proved(self) -> bool:
        """Whether its run was looked at, all of it, and nothing speaks against it."""
        return self.proof is not None and self.proof.verdict == "pass"

    @property
    def verdict(self) -> Literal["pass", "to-check", "incomplete", "fail"]:
        """That of its proof; of one that passes, whether something of the drawing is to be checked."""
        if self.proof is None:
            return "incomplete"
        return "to-check" if self.is_proved and (self.plan.to_check or self.plan.doubts) else self.proof.verdict


class NotMade(NamedTuple):
    """Why there is none, and as much of the plan as there is."""

    refusal: Refusal
    plan: CutPlan | None = None


def made_program(
    path: Path, making: Making, wanted: Wanted, scenario: Scenario, progress: Progress = silent
) -> MadeProgram | NotMade:
    """A program of a drawing, proved on the machine of a scenario.

    Holes without a core that fail the proof get one, and parts that fail it where they begin in the kerf of others are
    cut all round. Figures that fail it stay uncut where the program of the others passes it.

    Raises FileUnreadableError and DrawingError where there is no drawing, SettingsError where the dialect cannot say
    what it needs.
    """
    request = _plan_request(path, making, wanted, scenario, progress)
    done = _proved(request, wanted)
    if isinstance(done, MadeProgram) and not done.is_proved and (numbers := _to_core(done)):
        request = request._replace(with_core=numbers)
        done = _proved(request, wanted)
    if isinstance(done, MadeProgram) and not done.is_proved and (numbers := _to_cut_round(done)):
        request = request._replace(whole=numbers)
        done = _proved(request, wanted)
    if isinstance(done, MadeProgram) and done.proof is not None and done.proof.at_fault:
        others = _proved(request._replace(at_fault=done.proof.at_fault), wanted)
        if isinstance(others, MadeProgram) and others.is_proved:
            return others
    return done


def _plan_request(path: Path, making: Making, wanted: Wanted, scenario: Scenario, progress: Progress) -> PlanRequest:
    return PlanRequest(path, _leaning(making, wanted, scenario), scenario, progress)


def _leaning(making: Making, wanted: Wanted, scenario: Scenario) -> Making:
    return leaning(with_known_lag(making, wanted, scenario), scenario, says_angle=wanted.iso is not None)


def with_known_lag(making: Making, wanted: Wanted, scenario: Scenario) -> Making:
    """What is asked for, with the lag that the technology knows of the last pass where nobody names another one.

    Not where the lag cannot be corrected: where the controller adds the offsets, and for edges that parts have in
    common.
    """
    adds = wanted.keeps or (making.passes_um and not any(making.passes_um))
    if scenario.technology is None or making.lag_um or adds or making.common_edges or lean_of(scenario) is not None:
        return making
    return making._replace(lag_um=scenario.lag_um(max(len(making.passes_um), 1)))


def _to_core(done: MadeProgram) -> frozenset[int]:
    """Numbers of holes that are cut without a core and fail the proof; of all of them where it names none."""
    coreless = frozenset(cut.figure.number for cut in done.plan.cuts if cut.is_coreless)
    at_fault = () if done.proof is None else done.proof.at_fault
    return coreless.intersection(each.number for each in at_fault) or coreless


def _to_cut_round(done: MadeProgram) -> frozenset[int]:
    """Numbers of parts that begin in the kerf of others and fail the proof; of all of them where it names none."""
    in_kerf = frozenset(cut.figure.number for cut in done.plan.cuts if cut.thread.by == "kerf")
    at_fault = () if done.proof is None else done.proof.at_fault
    return in_kerf.intersection(each.number for each in at_fault) or in_kerf


def _proved(request: PlanRequest, wanted: Wanted) -> MadeProgram | NotMade:
    """A program with its proof."""
    done = _unproved(request, wanted)
    if isinstance(done, NotMade):
        return done
    done = _with_drawn(done, request)
    assert done.drawn is not None  # noqa: S101 - read before
    wire_way = None if done.unled is None else done.unled.toolpath
    above = _drawn_above(request)
    given = ToProve(done.program, done.plan, done.drawn, done.written, wanted.bound_um, wire_way, above)
    return done._replace(proof=proved(given, request.scenario, request.progress))


def unproved(
    path: Path, making: Making, wanted: Wanted, scenario: Scenario, progress: Progress = silent
) -> MadeProgram | NotMade:
    """A program as `made_program` gives it, before anything is run.

    Arcs are fitted within the tolerance. Where whole µm move the written path past it, they are fitted anew, nearer.
    """
    return _unproved(_plan_request(path, making, wanted, scenario, progress), wanted)


def _unproved(request: PlanRequest, wanted: Wanted) -> MadeProgram | NotMade:
    making = request.making
    try:
        refuse_upright_ways(making, wanted, request.scenario)
        done = _fitted(request, wanted, making.tolerance_um)
        fit = done.plan.drawing.fit
        fits = fits_um(making.tolerance_um, 0 if fit is None else fit.arcs + fit.lines)
        for fit_um in fits[1:]:
            if _is_surely_within(done):
                break
            if len(fits) > _SURELY_ALONE:
                done = _with_drawn(done, request)
                if not _is_rounded_off(done, in_plane(request.scenario), wanted):
                    break
            done = _fitted(request, wanted, fit_um)._replace(drawn=done.drawn)
    except CannotCutError as error:
        return NotMade(error.refusal)
    return done


def _fitted(request: PlanRequest, wanted: Wanted, fit_um: float) -> MadeProgram:
    """A program whose arcs are fitted within `fit_um`. CannotCutError where there is none, or its language has none."""
    plan = planned(request, fit_um)
    request.progress("write", 0, 1)
    plan = plan._replace(notes=(*plan.notes, *_own_codes(wanted), *lean_notes(plan, wanted), *facing_notes(plan)))
    plan = plan._replace(is_added=wanted.keeps and wanted.language == "4b" and any(plan.passes_um))
    draft = begun(_drafted(plan, wanted, height_over_plane_um(request.scenario)), wanted)
    text, program = _read_back(draft, request.path.stem, wanted)
    off = held_against(draft, text, program.toolpath)
    upper_data = None if text.upper is None else encoded(text.upper, wanted)
    made = MadeProgram(encoded(text.text, wanted), program, plan, draft, off, upper_data=upper_data)
    if not plan.making.lag_um:
        return made
    _, unled = _read_back(begun(draft_of_cuts(plan.visits, plan.cuts), wanted), request.path.stem, wanted)
    return made._replace(unled=unled)


def _read_back(draft: Draft, name: str, wanted: Wanted) -> tuple[Written, Program]:
    """The text of a draft, and the program that reading it gives."""
    text = written(draft, wanted)
    choices, name = read_with(draft, wanted), f"{name}.{wanted.language}"
    program, *above = (
        load_program(each.encode(wanted.encoding, "replace"), name, choices)
        for each in (text.text, text.upper)
        if each is not None
    )
    return text, paired(program, *above) if above else program


def _is_surely_within(done: MadeProgram) -> bool:
    """Whether the fit and rounding together keep the tolerance; no fit, no other fit."""
    fit = done.plan.drawing.fit
    return fit is None or fit.max_um <= 0.0 or fit.max_um + done.written.off_um <= done.plan.making.tolerance_um


def _is_rounded_off(done: MadeProgram, scenario: Scenario, wanted: Wanted) -> bool:
    """Whether the written path lies past the tolerance, by no more than rounding explains."""
    assert done.drawn is not None  # noqa: S101 - read before
    off_um = path_off_um(done.wire_way, done.plan, done.drawn, scenario.wire.reach_um)
    return off_um is not None and 0.0 < off_um - done.plan.making.tolerance_um <= wanted.bound_um


def _own_codes(wanted: Wanted) -> tuple[Remark, ...]:
    """What is to be said of words for the end and a pause that other readers do not know."""
    codes = [each for each in (wanted.end_code, wanted.pause_code) if each is not None]
    return (Remark("own-codes", {"codes": ", ".join(codes)}),) if codes else ()


def _with_drawn(done: MadeProgram, request: PlanRequest) -> MadeProgram:
    """With the drawing as it is drawn, read again where arcs were fitted to it."""
    if done.drawn is not None:
        return done
    plan = done.plan
    if plan.drawing.fit is None:
        return done._replace(drawn=plan.drawing)
    drawn = _unfitted(request.path, plan.making)
    return done._replace(drawn=as_cut(drawn, plan.making, request.scenario))


def _drawn_above(request: PlanRequest) -> Drawing | None:
    """The drawing of the top without the fit of arcs; None of one drawing."""
    return None if request.making.upper is None else _unfitted(request.making.upper, request.making)


def _unfitted(path: Path, making: Making) -> Drawing:
    flatten_um = min(DEFAULT_FLATTEN_UM, _FLATTEN_SHARE * making.tolerance_um)
    return read_drawing(path, making.layer, making.gap_um, flatten_um, unit=making.unit)


def _drafted(plan: CutPlan, wanted: Wanted, height_um: float) -> Draft:
    """What is written of a plan, whose top lies so high over the plane of the program.

    CannotCutError where the controller cannot add its offsets.
    """
    if plan.making.lag_um:
        _refuse_unknown_ways(plan, wanted)
    if not plan.facings and (not wanted.keeps or not any(plan.passes_um)):
        draft = draft_of_plan(plan)
        return draft if wanted.iso is None else replace(draft, taper=angle_words(plan, draft.curves))
    wishes = tuple(wish._replace(passes_um=(0.0,) * len(wish.passes_um)) for wish in plan.making.layers)
    making = plan.making._replace(layers=wishes)
    nothing = (0.0,) * len(plan.passes_um)
    on_contour = tuple(figure_cut(cut.figure, cut.thread, nothing, making) for cut in plan.cuts)
    if plan.facings:
        rules = wanted.iso.profile.rules if wanted.keeps and wanted.iso is not None else None
        return draft_of_both(plan, on_contour, rules, height_um)
    if wanted.iso is None:
        return added_draft(plan, on_contour)
    return kept_draft(plan, on_contour, wanted.iso.profile.rules)


def _refuse_unknown_ways(plan: CutPlan, wanted: Wanted) -> None:
    """CannotCutError where the controller adds the offsets: how it leads a wire that lags, nobody knows."""
    if wanted.keeps:
        raise CannotCutError(Refusal("kept-lag"))
    if not all(pass_.by_um for cut in plan.cuts for pass_ in cut.passes):
        raise CannotCutError(Refusal("no-lag-offset"))


_LONGEST = 120
"""Characters of a remark: what a controller shows in a line (assumed)."""


def remarked(done: MadeProgram, texts: Sequence[str], wanted: Wanted) -> MadeProgram:
    """The same program with remark lines behind its first line, one for each text; the same blocks are read back.

    Letters that the encoding of the program does not have become question marks.
    """
    lines = [_remark(text, is_iso=wanted.iso is not None) for text in texts]
    first, newline, rest = done.program.text.partition(wanted.newline)
    text = newline.join([first, *lines, rest])
    data = text.encode(wanted.encoding, "replace")
    program = load_program(data, done.program.name, read_with(done.draft, wanted))
    if done.upper_data is not None:  # a remark adds no block
        program = replace(program, toolpath=replace(program.toolpath, upper=done.program.toolpath.upper))
    return done._replace(data=encoded(text, wanted), program=program)


def _remark(text: str, *, is_iso: bool) -> str:
    """One line: what could end a remark, or begin a header or a word to drycut in it, is taken out."""
    plain = printable(" ".join(text.split())).replace("µ", "u").replace("=", " ").replace(";", ",")
    plain = f"not proved: {plain}"[:_LONGEST]
    return "(" + plain.replace("(", "[").replace(")", "]") + ")" if is_iso else f"// {plain}"
