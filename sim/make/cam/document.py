"""A made program as data, schema ``drycut.program/1`` (docs/program.md)."""

import json
from typing import Any, Final, Protocol

import numpy as np

from parser import __version__
from parser.drawing.model import Entity, FitFigures, LeftOut
from parser.findings.catalogue import Language, texts
from parser.findings.findings import Finding
from parser.findings.remarks import Remark, remark_text
from sim.make.cam.maker import Made, NotMade
from sim.make.cam.model import CutPlan, FigureCut, PassCut, Refusal
from sim.make.cam.proof.result import Fault, Proof
from sim.make.cam.sums import FigureSum, figure_sums
from sim.setup.wire import Wire

SCHEMA: Final = "drycut.program/1"
_DIGITS: Final = 6


class Say(Protocol):
    """Words for people in one language, as `sim.show.words.Words` has them: the text of a key, its places filled."""

    @property
    def language(self) -> Language:
        """The language."""

    def __call__(self, key: str, /, **values: object) -> str:
        """Text of a key; KeyError where there is none."""


def document(made: Made | NotMade, say: Say) -> dict[str, Any]:
    """What was made, or why nothing was, as plain lists, dicts, numbers and None; the order of keys is fixed.

    `say` has the texts of names in a language.
    """
    plan = made.plan
    done = made if isinstance(made, Made) else None
    proof = None if done is None else done.proof
    run = None if proof is None else proof.run
    return {
        "schema": SCHEMA,
        "drycut": __version__,
        "made": done is not None,
        "drawing": None if plan is None else _drawing(plan),
        "fit": None if plan is None or plan.drawing.fit is None else _fit(plan.drawing.fit, plan.making.tolerance_um),
        "figures": [] if done is None else [*map(_figure, done.plan.cuts, figure_sums(done))],
        "left_out": [] if plan is None else [_left_out(one, say) for one in plan.left_out],
        "length_um": None if done is None else _rounded(float(done.program.toolpath.length_um.sum())),
        "time_s": None if run is None else _rounded(run.ran_s),
        "proof": None if proof is None else _proof(proof, say),
        "notes": [] if plan is None else [_note(one, say) for one in (*plan.drawing.notes, *plan.notes)],
        "refusal": _refusal(made.refusal, say) if isinstance(made, NotMade) else None,
    }


def document_text(made: Made | NotMade, say: Say) -> str:
    """The document as JSON; the same drawing gives the same bytes."""
    return json.dumps(document(made, say), ensure_ascii=False, allow_nan=False, indent=2) + "\n"


def _drawing(plan: CutPlan) -> dict[str, Any]:
    return {"name": plan.drawing.name, "version": plan.drawing.version, "unit": plan.drawing.unit}


def _fit(fit: FitFigures, asked_um: float) -> dict[str, Any]:
    """The tolerance is that which is asked for: arcs may have been fitted nearer, so that the written path keeps it."""
    return {**fit._asdict(), "tolerance_um": _rounded(asked_um), "max_um": _rounded(fit.max_um)}


def _figure(cut: FigureCut, of: FigureSum) -> dict[str, Any]:
    """A figure: blocks and length are those of the text, times those of the run."""
    figure, thread = cut.figure, cut.thread
    passes = (*cut.passes, *cut.cut_off)
    times = of.pass_s or [None] * len(passes)
    return {
        "number": figure.number,
        "kind": figure.kind,
        "part": figure.part,
        "layer": figure.layer,
        "blocks": [of.first_block, of.first_block + of.blocks - 1] if of.blocks else None,
        "length_um": _rounded(of.length_um),
        "time_s": None if of.time_s is None else _rounded(of.time_s),
        "thread_um": _place(thread.place_um),
        "thread_by": thread.by,
        "side": cut.side.name.lower(),
        "direction": _direction(is_ccw=cut.is_ccw),
        "passes": [
            _pass(cut, one, time_s, is_cut_off=at >= len(cut.passes))
            for at, (one, time_s) in enumerate(zip(passes, times, strict=True))
        ],
    }


def _pass(cut: FigureCut, one: PassCut, time_s: float | None, *, is_cut_off: bool) -> dict[str, Any]:
    return {
        "offset_um": _rounded(one.by_um),
        "direction": _direction(is_ccw=cut.is_ccw != one.is_back),
        "cut_off": is_cut_off,
        "length_um": _rounded(float(one.along.length_um.sum())),
        "time_s": None if time_s is None else _rounded(time_s),
    }


def _direction(*, is_ccw: bool) -> str:
    return "ccw" if is_ccw else "cw"


def _left_out(one: LeftOut, say: Say) -> dict[str, Any]:
    return {
        "entity": _entity(one.entity),
        "why": one.why,
        "text": say(f"program.left-out-{one.why}"),
        "detail": None if one.detail is None else remark_text(one.detail, say.language),
        "gap_um": None if one.gap_um is None else _rounded(one.gap_um),
        "place_um": None if one.place_um is None else _place(one.place_um),
    }


def _entity(entity: Entity) -> dict[str, Any]:
    return {"kind": entity.kind, "handle": entity.handle, "layer": entity.layer}


def _proof(proof: Proof, say: Say) -> dict[str, Any]:
    return {
        "verdict": proof.verdict,
        "written_um": _rounded(proof.written_um),
        "path_um": None if proof.path_um is None else _rounded(proof.path_um),
        **_edges(proof),
        "pieces": _pieces(proof),
        "wire": _wire(proof.wire),
        "start_mm": None
        if proof.run is None or proof.run.scenario.start_mm is None
        else _place(proof.run.scenario.start_mm),
        "findings": [*(_fault(one, say) for one in proof.faults), *(_finding(one, say) for one in proof.findings)],
        "unproved": [say(f"program.unproved-{one.name}", **one.values) for one in proof.unproved],
        "notes": [say(f"program.proof-{one.name}", **one.values) for one in proof.notes],
    }


def _edges(proof: Proof) -> dict[str, Any]:
    """Both directions of the edge as cut, as ``drycut compare`` has them."""
    found = proof.comparison
    if found is None:
        return {"edge_to_drawing_um": None, "drawing_to_edge_um": None, "tolerance_um": None}
    return {
        "edge_to_drawing_um": _rounded(found.edge_max_um),
        "drawing_to_edge_um": _rounded(float(found.drawing_to_edge.max_um.max())),
        "tolerance_um": _rounded(found.asked.tolerance_um),
    }


def _pieces(proof: Proof) -> dict[str, int] | None:
    if proof.run is None or proof.run.remains is None:
        return None
    kinds = [piece.kind for piece in proof.run.remains.pieces.freed if not piece.is_scrap]
    return {"parts": kinds.count("part"), "slugs": kinds.count("slug")}


def _wire(wire: Wire) -> dict[str, Any]:
    return {"diameter_um": _rounded(wire.diameter_um), "spark_gap_um": _rounded(wire.spark_gap_um)}


def _fault(fault: Fault, say: Say) -> dict[str, Any]:
    return {
        "code": None,
        "name": fault.name,
        "severity": "error",
        "text": say(f"program.fault-{fault.name}", **fault.values),
        "figure": fault.figure or None,
        "block": fault.block or None,
        "line": None,
        "place_um": None if fault.place_um is None else _place(fault.place_um),
    }


def _finding(finding: Finding, say: Say) -> dict[str, Any]:
    at = finding.place_mm
    return {
        "code": finding.code,
        "name": None,
        "severity": finding.severity.value,
        "text": texts(finding, say.language).message,
        "figure": None,
        "block": finding.block or None,
        "line": finding.line or None,
        "place_um": None if at is None else _place((1000.0 * at[0], 1000.0 * at[1])),
    }


def _note(remark: Remark, say: Say) -> str:
    """What the reader of drawings says, or the maker."""
    try:
        return remark_text(remark, say.language)
    except KeyError:
        return say(f"program.note-{remark.name}", **remark.values)


def _refusal(refusal: Refusal, say: Say) -> dict[str, Any]:
    return {
        "why": refusal.why,
        "text": say(f"program.refused-{refusal.why}", **dict(refusal.values)),
        "places_um": [_place(place) for place in refusal.places_um],
    }


def _place(place: tuple[float, float]) -> list[float | None]:
    return [_rounded(place[0]), _rounded(place[1])]


def _rounded(value: float) -> float | None:
    """A number as JSON has it: None where it is none, no sign of a 0 that is rounding."""
    return round(value, _DIGITS) + 0.0 if np.isfinite(value) else None
