"""A made program as data, schema ``drycut.program/1`` (docs/program.md).

What each figure of a made program comes to: blocks, length and time, and the time of each of its passes.
"""

import json
import math
from bisect import bisect_left
from collections.abc import Iterator
from itertools import pairwise
from operator import attrgetter
from typing import NamedTuple, Protocol

import numpy as np

from parser import __version__
from parser.drawing.model import Entity, FitFigures, LeftOut
from parser.findings.catalogue import Language, Remark, remark_text, texts
from parser.findings.findings import Finding
from parser.geometry.curves import Floats
from parser.shape.passes import Pass
from parser.toolpath import Toolpath
from parser.units import mm
from sim.base.units import known, place, rounded
from sim.make.cam.document_model import (
    BridgedEntry,
    DrawingFileEntry,
    EntityEntry,
    FigureEntry,
    FindingEntry,
    FitEntry,
    LagEntry,
    LeftEntry,
    LeftOutEntry,
    PassEntry,
    PiecesEntry,
    ProgramDocument,
    ProofEntry,
    RefusalEntry,
    TakenEntry,
    WireEntry,
)
from sim.make.cam.maker import MadeProgram, NotMade
from sim.make.cam.model import CutPlan, Figure, FigureCut, PassCut, Refusal
from sim.make.cam.proof_model import Fault, Proof
from sim.make.cam.visits import Spans, figure_rows
from sim.run.dryrun import DryRun
from sim.setup.wire import Wire


class FigureSum(NamedTuple):
    """What a figure comes to, all its passes with their leads.

    Attributes
    ----------
    spans, blocks, length_um
        Of the program as written, of each of its contours the first and the last block; how many, and how long. None
        and 0 where it has not as many contours as the plan.
    time_s
        What it takes on the machine of the proof; None where nothing ran.
    pass_s
        Of each pass, the cut-off behind them, without leads; empty where nothing ran, or the run has other passes.
    """

    spans: tuple[tuple[int, int], ...] = ()
    blocks: int = 0
    length_um: float = 0.0
    time_s: float | None = None
    pass_s: tuple[float, ...] = ()


def figure_sums(made: MadeProgram) -> tuple[FigureSum, ...]:
    """One for each cut of the plan, in running order: jumps part them, in the text and in what ran."""
    plan, toolpath, run = made.plan, made.program.toolpath, made.proof and made.proof.run
    written, ran = figure_rows(toolpath, plan), figure_rows(run.toolpath, plan) if run is not None else []
    sums = [_written(toolpath, rows) for rows in written] or [FigureSum()] * len(plan.cuts)
    if run is None or not ran:
        return tuple(sums)
    what_ran = _ran(run)
    return tuple(_timed(sum_, what_ran, rows, cut) for sum_, rows, cut in zip(sums, ran, plan.cuts, strict=True))


class _Ran(NamedTuple):
    """What ran: the time of each row, s; passes by their first rows, and these; rows before which it stops, rising."""

    time_s: Floats
    passes: list[Pass]
    firsts: list[int]
    stops: list[int]

    def passes_in(self, rows: Spans) -> list[Pass]:
        """Those that begin in some rows."""
        return [each for span in sorted(rows) for each in self.passes[_within(self.firsts, *span)]]


def _ran(run: DryRun) -> _Ran:
    passes = sorted(run.passes.passes, key=attrgetter("first"))
    stops = sorted(stop.after for stop in run.toolpath.stops)
    return _Ran(run.block_time_s, passes, [each.first for each in passes], stops)


def _within(numbers: list[int], first: int, past: int) -> slice:
    """Which of rising numbers lie from one number on and before another."""
    return slice(bisect_left(numbers, first), bisect_left(numbers, past))


def _written(toolpath: Toolpath, rows: Spans) -> FigureSum:
    block = toolpath.source.block
    return FigureSum(
        tuple((int(block[first]), int(block[first]) + past - first - 1) for first, past in rows),
        sum(past - first for first, past in rows),
        float(sum(np.sum(toolpath.length_um[first:past]) for first, past in rows)),
    )


def _timed(figure_sum: FigureSum, ran: _Ran, rows: Spans, cut: FigureCut) -> FigureSum:
    time_s, stretches = ran.time_s, _as_planned(ran, rows, cut)
    pass_s = [float(np.sum(time_s[first:past])) for first, past in stretches]
    times = tuple(pass_s) if len(pass_s) == len(cut.all_passes) else ()
    return figure_sum._replace(time_s=float(sum(np.sum(time_s[first:past]) for first, past in rows)), pass_s=times)


def _as_planned(ran: _Ran, rows: Spans, cut: FigureCut) -> Spans:
    """First row and past the last of each pass of a figure as the plan has them: what is cut off stands last.

    A run takes a single pass and the cut of its tab, which goes on behind a stop, for one pass. Where the wire goes
    back over the tab that it has cut, that is part of the cut-off or of the way out, as in the plan.
    """
    passes: Spans = []
    cut_off: Spans = []
    is_there_and_back = any(np.allclose(each.along.start_um[0], each.along.end_um[-1]) for each in cut.cut_off)
    for each in ran.passes_in(rows):
        past = each.last + 1
        inside = ran.stops[_within(ran.stops, each.first + 1, past)]
        is_again = bool(cut_off) and any(low <= cut_off[-1][0] and past <= high for low, high in rows)
        if each.is_tab and is_again:
            cut_off[-1] = (cut_off[-1][0], past if is_there_and_back else cut_off[-1][1])
        elif each.is_tab:
            cut_off.append((each.first, past))
        else:
            passes.append((each.first, inside[0] if inside else past))
            cut_off += pairwise([*inside, past])
    return [*passes, *cut_off]


class Say(Protocol):
    """Words for people in one language, as `sim.show.texts.Words` has them: the text of a key, its places filled."""

    @property
    def language(self) -> Language:
        """The language."""

    def __call__(self, key: str, /, **values: object) -> str:
        """Text of a key; KeyError where there is none."""


def document(made: MadeProgram | NotMade, say: Say) -> ProgramDocument:
    """What was made, or why nothing was, as plain lists, dicts, numbers and None; the order of keys is fixed.

    `say` has the texts of names in a language.
    """
    plan = made.plan
    done = made if isinstance(made, MadeProgram) else None
    proof = None if done is None else done.proof
    run = None if proof is None else proof.run
    return {
        "schema": "drycut.program/1",
        "drycut": __version__,
        "made": done is not None,
        "drawing": None if plan is None else _drawing(plan),
        "fit": None if plan is None or plan.drawing.fit is None else _fit(plan.drawing.fit, plan.making.tolerance_um),
        "figures": [] if done is None else [*map(_figure, done.plan.cuts, figure_sums(done))],
        "taken": [] if plan is None else [_taken_entry(cut.figure, plan) for cut in plan.cuts],
        "left": [] if plan is None else [*map(_left_entry, plan.uncut_entities)],
        "bridged": [] if plan is None else [*_bridged(plan)],
        "left_out": [] if plan is None else [_left_out(each, say) for each in plan.left_out],
        "length_um": None if done is None else rounded(float(done.program.toolpath.length_um.sum())),
        "time_s": None if run is None else rounded(run.ran_s),
        "proof": None if done is None or proof is None else _proof(proof, say, done.plan.making.lag_um),
        "notes": [] if plan is None else [_note(note, say) for note in (*plan.drawing.notes, *plan.notes)],
        "refusal": _refusal(made.refusal, say) if isinstance(made, NotMade) else None,
    }


def document_text(made: MadeProgram | NotMade, say: Say) -> str:
    """The document as JSON; the same drawing gives the same bytes."""
    return json.dumps(document(made, say), ensure_ascii=False, allow_nan=False, indent=2) + "\n"


def _drawing(plan: CutPlan) -> DrawingFileEntry:
    return {"name": plan.drawing.name, "version": plan.drawing.version, "unit": plan.drawing.unit}


def _fit(fit: FitFigures, asked_um: float) -> FitEntry:
    """The tolerance is that which is asked for: arcs may have been fitted nearer, so that the written path keeps it."""
    return {"tolerance_um": rounded(asked_um), "max_um": rounded(fit.max_um), "arcs": fit.arcs, "lines": fit.lines}


def _figure(cut: FigureCut, of: FigureSum) -> FigureEntry:
    """A figure: blocks and length are those of the text, times those of the run."""
    figure, thread = cut.figure, cut.thread
    passes = cut.all_passes
    times = of.pass_s or [None] * len(passes)
    return {
        "number": figure.number,
        "kind": figure.kind,
        "part": figure.part,
        "layer": figure.layer,
        "blocks": list(of.spans[0]) if len(of.spans) == 1 else None,
        "spans": [list(span) for span in of.spans],
        "length_um": rounded(of.length_um),
        "time_s": known(of.time_s),
        "thread_um": place(thread.place_um),
        "thread_by": thread.by,
        "side": cut.side.name.lower(),
        "direction": _direction(is_ccw=cut.is_ccw),
        "no_core": cut.is_coreless,
        "passes": [
            _pass(cut, pass_, time_s, is_cut_off=at >= len(cut.passes))
            for at, (pass_, time_s) in enumerate(zip(passes, times, strict=True))
        ],
    }


def _pass(cut: FigureCut, pass_cut: PassCut, time_s: float | None, *, is_cut_off: bool) -> PassEntry:
    return {
        "offset_um": rounded(pass_cut.by_um),
        "direction": _direction(is_ccw=cut.is_ccw != pass_cut.is_back),
        "cut_off": is_cut_off,
        "length_um": rounded(float(pass_cut.along.length_um.sum())),
        "time_s": known(time_s),
    }


def _direction(*, is_ccw: bool) -> str:
    return "ccw" if is_ccw else "cw"


def _taken_entry(figure: Figure, plan: CutPlan) -> TakenEntry:
    numbers = np.unique(figure.entity).tolist()
    return {"figure": figure.number, "entities": [_entity(plan.drawing.entities[each]) for each in numbers]}


def _left_entry(left_out: LeftOut) -> LeftEntry:
    at_mm = None if left_out.place_um is None else _in_mm(*left_out.place_um)
    return {"entity": _entity(left_out.entity), "at_mm": at_mm, "why": left_out.why}


def _in_mm(x_um: float, y_um: float) -> list[float]:
    return [rounded(mm(x_um)), rounded(mm(y_um))]


def _bridged(plan: CutPlan) -> Iterator[BridgedEntry]:
    """Gaps of the drawing between curves of one contour, where these are cut or prolonged to meet."""
    for cut in plan.cuts:
        for bridge in cut.figure.bridges:
            gap_mm = rounded(mm(bridge.gap_um))
            yield {"figure": cut.figure.number, "at_mm": _in_mm(*bridge.place_um), "gap_mm": gap_mm}


def _left_out(left_out: LeftOut, say: Say) -> LeftOutEntry:
    return {
        "entity": _entity(left_out.entity),
        "why": left_out.why,
        "text": say(f"program.left-out-{left_out.why}", **dict(left_out.values)),
        "detail": None if left_out.detail is None else remark_text(left_out.detail, say.language),
        "gap_um": known(left_out.gap_um),
        "place_um": None if left_out.place_um is None else place(left_out.place_um),
    }


def _entity(entity: Entity) -> EntityEntry:
    return {"kind": entity.kind, "handle": entity.handle, "layer": entity.layer}


def _proof(proof: Proof, say: Say, lag_um: float) -> ProofEntry:
    edges = proof.comparison
    return {
        "verdict": proof.verdict,
        "written_um": _finite(proof.written_um),
        "path_um": _finite(proof.path_um),
        "edge_to_drawing_um": None if edges is None else rounded(edges.edge_max_um),
        "drawing_to_edge_um": None if edges is None else rounded(float(edges.drawing_to_edge.max_um.max())),
        "tolerance_um": None if edges is None else rounded(edges.request.tolerance_um),
        "pieces": _pieces(proof),
        "wire": _wire(proof.wire),
        "lag": _lag(proof, lag_um) if lag_um else None,
        "walls": [
            {"figure": wall.figure, "z_mm": rounded(mm(wall.z_um)), "off_um": _finite(wall.off_um)}
            for wall in proof.walls
        ],
        "start_mm": None
        if proof.run is None or proof.run.scenario.start_mm is None
        else place(proof.run.scenario.start_mm),
        "findings": [
            *(_fault(fault, say) for fault in proof.faults),
            *(_finding(finding, say) for finding in proof.findings),
        ],
        "unproved": [say(f"program.unproved-{each.name}", **each.values) for each in proof.unproved],
        "notes": [say(f"program.proof-{note.name}", **note.values) for note in proof.notes],
    }


def _pieces(proof: Proof) -> PiecesEntry | None:
    if proof.run is None or proof.run.remains is None:
        return None
    kinds = [piece.kind for piece in proof.run.remains.pieces.freed if not piece.is_scrap]
    return {"parts": kinds.count("part"), "slugs": kinds.count("slug")}


def _wire(wire: Wire) -> WireEntry:
    return {"diameter_um": rounded(wire.diameter_um), "spark_gap_um": rounded(wire.spark_gap_um)}


def _lag(proof: Proof, lag_um: float) -> LagEntry:
    faces = proof.faces
    return {
        "lag_um": rounded(lag_um),
        "face_lag_um": None if faces is None else rounded(faces.lag_um),
        "face_edge_to_drawing_um": None if faces is None else rounded(faces.comparison.edge_max_um),
    }


def _fault(fault: Fault, say: Say) -> FindingEntry:
    return {
        "code": None,
        "name": fault.name,
        "severity": "error",
        "text": say(f"program.fault-{fault.name}", **fault.values),
        "figure": fault.figure or None,
        "block": fault.block or None,
        "line": None,
        "place_um": None if fault.place_um is None else place(fault.place_um),
    }


def _finding(finding: Finding, say: Say) -> FindingEntry:
    at = finding.place_mm
    return {
        "code": finding.code,
        "name": None,
        "severity": finding.severity.value,
        "text": texts(finding, say.language).message,
        "figure": None,
        "block": finding.block or None,
        "line": finding.line or None,
        "place_um": None if at is None else place((1000.0 * at[0], 1000.0 * at[1])),
    }


def _note(remark: Remark, say: Say) -> str:
    """What the reader of drawings says, or the maker."""
    try:
        return remark_text(remark, say.language)
    except KeyError:
        return say(f"program.note-{remark.name}", **remark.values)


def _refusal(refusal: Refusal, say: Say) -> RefusalEntry:
    return {
        "why": refusal.why,
        "text": say(f"program.refused-{refusal.why}", **dict(refusal.values)),
        "places_um": [place(at) for at in refusal.places_um],
    }


def _finite(value: float | None) -> float | None:
    """None where there is no distance, since there is no path."""
    return rounded(value) if value is not None and math.isfinite(value) else None
