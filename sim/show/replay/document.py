"""The replay's page: all that it needs as plain data, and one file that plays it with nothing to load or install.

How the blocks of a run are decoded, for the page: words, fields, buffers, ways, in both languages.

What a replay's document says of what lies still: travel, work, clamps, and the pieces that come free.

Columns of a replay's document: the blocks, exact and in words, and the plan along them.

What a replay's document says of what happens in a run: stops, findings, contours, passes and losses.
"""

import math
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any, cast

import numpy as np
import shapely

from controller.decode.blocks import Decoded, decoded
from controller.motion.plan import Plan
from controller.stepping.steps import words_of
from parser import __version__
from parser.controller_words import Axis, StepWords
from parser.findings.catalogue import Language, texts
from parser.findings.findings import Finding
from parser.program import Program
from parser.shape.contours import Contour
from parser.text.encoding import printable
from parser.toolpath import Stop
from parser.units import from_mm
from sim.base.units import (
    column,
    corners,
    numbers,
    place,
    rounded,
)
from sim.cut.pieces.pieces import Piece
from sim.cut.regions import simpler
from sim.run.course import Happening, PassOf, course_of, passes_of
from sim.run.dryrun import DryRun, Ending
from sim.run.findings import outcome
from sim.run.recording import Recording
from sim.setup.obstacles import Outline
from sim.show.decoded import buffer_text, order_text, value_text, way_texts, word_text
from sim.show.draw.style import paint_of_pass, tones_of
from sim.show.html.environment import rendered
from sim.show.html.packed import packed
from sim.show.keys import OF_PAGE, actions_of
from sim.show.replay.lean import lean_entry
from sim.show.replay.model import (
    BlocksEntry,
    ContourEntry,
    CurvesEntry,
    DecodedBlockEntry,
    DecodingEntry,
    EndingEntry,
    FindingEntry,
    FindingTextsEntry,
    LossEntry,
    PassEntry,
    PieceEntry,
    PlanEntry,
    ProgramEntry,
    ReplayDocument,
    StopEntry,
)
from sim.show.replay.quiz import quiz_of
from sim.show.replay.sparks import spark_tape
from sim.show.replay.tape import drawing_columns, exact_columns, tape
from sim.show.texts.phrases import machine_name, named_pass
from sim.table.follow import Setup
from sim.table.losses import Loss
from sim.table.trace import origin_um


def stop_entry(stop: Stop) -> StopEntry:
    """A pause or the end: `after` so many blocks."""
    return {"kind": stop.kind, "after": stop.after, "line": stop.line}


def finding_entry(happening: Happening[Finding]) -> FindingEntry:
    """A finding with its texts in both languages.

    It has its row and time, and its place where it knows that; None where no block that ran is meant.
    """
    finding = happening.what
    place_mm = finding.place_mm
    return {
        "code": finding.code,
        "severity": str(finding.severity),
        "line": finding.line or None,
        "block": finding.block or None,
        "block_name": finding.block_name,
        "row": None if happening.row < 0 else happening.row,
        "t_s": None if math.isnan(happening.t_s) else rounded(happening.t_s),
        "place_um": None if place_mm is None else [rounded(from_mm(along)) for along in place_mm],
        "texts": {"en": _texts(finding, "en"), "zh": _texts(finding, "zh")},
    }


def _texts(finding: Finding, language: Language) -> FindingTextsEntry:
    of = texts(finding, language)
    return {
        "title": of.title,
        "found": of.found,
        "expected": of.expected,
        "machine": of.machine,
        "hint": of.hint,
        "message": of.message,
    }


def contour_entries(contours: Iterable[Contour]) -> list[ContourEntry]:
    """Contours by the rows of their first and last blocks."""
    return [
        {
            "first_row": contour.first - 1,
            "last_row": contour.last - 1,
            "closure_exact_um": rounded(contour.closure_exact_um),
            "closure_stepped_um": rounded(contour.closure_stepped_um),
        }
        for contour in contours
    ]


def ending_entry(ended: Ending) -> EndingEntry:
    """Where the machine stopped before its program was through, and why."""
    return {
        "cause": ended.cause,
        "axis": ended.axis.name,
        "row": ended.row,
        "t_s": rounded(ended.t_s),
        "place_um": place((ended.x_um, ended.y_um)),
    }


def pass_entries(passes: Iterable[PassOf]) -> list[PassEntry]:
    """Passes by the rows of their first and last blocks, with the paint of their tone, and their names."""
    return [
        {
            "first_row": each.first,
            "last_row": each.last,
            "number": each.number,
            "paint": str(paint_of_pass(each.number)),
            "name": named_pass(each, among).entry(),
        }
        for each, among in passes
    ]


def loss_entry(loss: Loss) -> LossEntry:
    """Steps that a stepper lost, or where a servo tripped."""
    return {
        "kind": loss.kind,
        "axis": loss.axis.name,
        "row": loss.row,
        "t_s": rounded(loss.t_s),
        "amount_um": rounded(loss.amount_um),
        "place_um": [rounded(loss.x_um), rounded(loss.y_um)],
    }


def block_columns(run: DryRun) -> BlocksEntry:
    """Columns of n blocks, one entry a block; `place_*`, `first_step` and `border_s` have n + 1."""
    columns = {
        **exact_columns(run.toolpath),
        **_words(words_of(run.toolpath)),
        **_source(run.program),
        "first_step": [0, *np.cumsum(run.stepped.count).tolist()],
        "border_s": column(run.border_s),
        "reach_um": _reaches(run),
    }
    return cast("BlocksEntry", columns)


def _reaches(run: DryRun) -> list[float] | None:
    """Half the width of the kerf of each block; None where it is the same for all."""
    if run.scenario.technology is None:
        return None
    return numbers(run.reach_um)


def plan_columns(plan: Plan) -> PlanEntry:
    """Columns of p phases, `t_s` with p + 1; no `jerk_um_s3` where there is none."""
    return {
        "t_s": numbers(plan.time_s, 9),
        "speed_um_s": numbers(plan.speed_um_s),
        "acceleration_um_s2": numbers(plan.acceleration_um_s2),
        "jerk_um_s3": numbers(plan.jerk_um_s3) if plan.jerk_um_s3.any() else None,
    }


def _words(words: StepWords) -> dict[str, list[Any]]:
    """What the controller counts by: words of the program, or its own."""
    return {
        "word_x_um": words.x_um.tolist(),
        "word_y_um": words.y_um.tolist(),
        "count_um": words.count_um.tolist(),
        "count_axis": [Axis(axis).name for axis in words.count_axis.tolist()],
        "quadrant": words.quadrant.tolist(),
        "turn": words.turn.tolist(),
    }


def _source(program: Program) -> dict[str, list[Any]]:
    """Each block's number and name in the program, its line from 1, its first character in that from 0, its length."""
    source = program.toolpath.source
    _, first = program.lines.places(source.span[:, 0])
    return {
        "number": source.block.tolist(),
        "line": source.line.tolist(),
        "character": (first - 1).tolist(),
        "characters": (source.span[:, 1] - source.span[:, 0]).tolist(),
        "name": source.names.of_rows(),
        "label": [source.names.label(row) for row in range(len(program.toolpath))],
    }


_OUTLINE_UM = 1.0
"""Outlines of pieces are simplified by a step, and drawn in whole µm."""


def _travel(run: DryRun) -> list[list[float]]:
    """Lowest and highest corner of the table's room, µm of the program."""
    room = Setup(run.scenario.machine.table, run.scenario.start_um, origin_um(run.toolpath)).room_um
    return corners(np.asarray(room, dtype=np.float64))


def piece_entry(happening: Happening[Piece]) -> PieceEntry:
    """A piece that comes free; `outline_um` is its outer ring, `holes_um` are those in it."""
    piece = happening.what
    return {
        "kind": piece.kind,
        "row": happening.row,
        "t_s": rounded(happening.t_s),
        "area_mm2": rounded(piece.area_mm2),
        "mass_g": rounded(piece.mass_g),
        "center_um": [rounded(piece.center_um.x), rounded(piece.center_um.y)],
        "outline_um": _ring(piece.outline_um.exterior),
        "holes_um": [_ring(hole) for hole in piece.outline_um.interiors],
    }


def _ring(ring: shapely.LinearRing) -> list[list[float]]:
    """Corners of a closed outline, the first one once."""
    corners = np.asarray(simpler(ring, _OUTLINE_UM).coords)[:-1, :2]
    whole: list[list[float]] = np.rint(corners).astype(np.int64).tolist()
    return whole


def _corners(outline: Outline) -> list[list[float]]:
    return [[rounded(corner.x), rounded(corner.y)] for corner in outline]


_MOST = 3000
"""Blocks: a longer program is not one to learn from, and its page would grow by half."""


def decoding(run: DryRun) -> DecodingEntry | None:
    """Decoded blocks that run, and which of them each row is of; None where there are none, and of long programs."""
    program = run.program
    if program.decoder is None or len(program.toolpath) > _MOST:
        return None
    contour = program.toolpath if run.offset is None else run.offset.passed.drawn
    moving = [each for each in decoded(program, contour) if each.way is not None]
    of_first = {each.block.span[0]: index for index, each in enumerate(moving)}
    return {
        "of_row": [of_first.get(first, -1) for first in program.toolpath.source.span[:, 0].tolist()],
        "blocks": [_entry(program.text, each) for each in moving],
    }


def _entry(text: str, each_decoded: Decoded) -> DecodedBlockEntry:
    return {
        "text": printable(text[slice(*each_decoded.block.span)]),
        "steps": [
            {
                "order": order_text(step.order),
                "word": word_text(step).entry(),
                "field": step.field,
                "value": value_text(step).entry(),
            }
            for step in each_decoded.block.steps
        ],
        "buffer": buffer_text(each_decoded.block),
        "ways": [{"name": named.name.entry(), "text": named.text.entry()} for named in way_texts(each_decoded)],
    }


_ASSETS = Path(__file__).with_name("assets")


def replay_page(recording: Recording) -> str:
    """HTML of ``replay.html`` for a recorded run."""
    tones = tones_of(each for each, _ in passes_of(recording.run))
    scenario = recording.run.scenario
    lean = lean_entry(recording.run)
    values = {
        "document": _handed_over(replay_document(recording)),
        "machine": machine_name(scenario.machine),
        "titles": scenario.titles,
        "tones": tones,
        "sparks": spark_tape(recording.run),
        "walls": lean and {**lean, "lower": _packed(lean["lower"]), "upper": _packed(lean["upper"])},
    }
    return rendered(_ASSETS, "replay.html.j2", **values, keys=OF_PAGE, actions=actions_of(OF_PAGE))


def _handed_over(document: ReplayDocument) -> dict[str, Any]:
    """A document as the page has it, the long columns of blocks and plan packed.

    The lines of the program are not: a browser that is too old to unpack them lists them all the same.
    """
    drawing = document["drawing"]
    return {
        **document,
        "drawing": drawing and _packed(drawing),
        "blocks": _packed(document["blocks"]),
        "plan": _packed(document["plan"]),
    }


def _packed(columns: Mapping[str, Any]) -> dict[str, Any]:
    return {name: value and packed(value) for name, value in columns.items()}


def replay_document(recording: Recording) -> ReplayDocument:
    """Document of a recorded run as lists, dicts, texts, numbers and None; rows of blocks count from 0.

    Where the machine stopped early, steps, samples and the duration end there.
    """
    run, course, scenario = recording.run, course_of(recording), recording.run.scenario
    return {
        "schema": "drycut.replay/1",
        "drycut": __version__,
        "title": scenario.title,
        "provenance": scenario.provenance,
        "verdict": outcome(run.findings),
        "duration_s": course.duration_s,
        "program": _program(run.program),
        "machine": scenario.machine.name,
        "interpolator": scenario.machine.controller.interpolation,
        "wire_diameter_um": rounded(scenario.wire.diameter_um),
        "offset_um": rounded(scenario.wire.reach_um),
        "thickness_mm": scenario.thickness_mm,
        "travel_um": _travel(run),
        "work_um": None if scenario.work_um is None else _corners(scenario.work_um),
        "clamps": [{"name": clamp.name, "outline_um": _corners(clamp.outline_um)} for clamp in scenario.clamps],
        "has_jumps": bool(run.toolpath.is_jump.any()),
        "drawing": _drawing(run),
        "blocks": block_columns(run),
        "decoding": decoding(run),
        "plan": plan_columns(run.plan),
        "stops": [stop_entry(stop.what) for stop in course.stops],
        "contours": contour_entries(run.whole_contours),
        "passes": pass_entries(course.passes),
        "findings": [finding_entry(finding) for finding in course.findings],
        "losses": [loss_entry(loss.what) for loss in course.losses],
        "ended": None if run.ended is None else ending_entry(run.ended),
        "pieces": [piece_entry(piece) for piece in course.pieces],
        "quiz": quiz_of(run, course.steps),
        "tape": tape(course.steps, origin_um(run.toolpath), course.trace, course.across.row),
    }


def _drawing(run: DryRun) -> CurvesEntry | None:
    found = run.comparison
    return None if found is None else drawing_columns(found.drawing, found.placement)


def _program(program: Program) -> ProgramEntry:
    """Name and lines, with every character in its place; what cannot be printed is replaced."""
    lines = range(1, program.lines.line(max(len(program.text) - 1, 0)) + 1)
    return {
        "name": printable(program.name),
        "dialect": program.reading.dialect,
        "is_worded": program.toolpath.words is not None,
        "lines": [printable(program.excerpt(line)) for line in lines],
    }
