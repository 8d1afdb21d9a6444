"""Decoded blocks as data, schema ``drycut.decode/1`` (docs/iso.md §8)."""

import json
from collections.abc import Sequence
from typing import Final

from controller.decode.blocks import Decoded, Way
from controller.decode.model import BlockEntry, DecodeDocument, InForceEntry, StepEntry, WayEntry
from parser import __version__
from parser.dialect.decoding import DecodeStep, InForce
from parser.findings.catalogue import Language
from parser.program import Program
from parser.toolpath import Point

_DIGITS: Final = 6


def document(program: Program, blocks: Sequence[Decoded], language: Language) -> DecodeDocument:
    """Blocks of a program as plain lists, dicts, numbers and None; the order of keys is fixed.

    Why something was assumed is told in a language.
    """
    return {
        "schema": "drycut.decode/1",
        "drycut": __version__,
        "file": program.name,
        "dialect": program.reading.dialect,
        "assumptions": [assumption.entry(language) for assumption in program.reading.assumptions],
        "blocks": [block_entry(decoded) for decoded in blocks],
    }


def document_text(program: Program, blocks: Sequence[Decoded], language: Language) -> str:
    """The document as JSON; the same program gives the same bytes."""
    return json.dumps(document(program, blocks, language), ensure_ascii=False, allow_nan=False, indent=2) + "\n"


def block_entry(decoded: Decoded) -> BlockEntry:
    """A block: the buffer that it fills, the steps in which it does so, what is in force, and its way."""
    block = decoded.block
    return {
        "line": block.line,
        "buf_state": 1,
        "number": block.number,
        "number_bcd": block.number_bcd,
        "coor_um": dict(block.coor_um),
        "f": plain(block.f),
        "s": plain(block.s),
        "g0": block.g0,
        "g": [plain(value) for value in block.g],
        "m": [plain(value) for value in block.m],
        "t": plain(block.t),
        "d": plain(block.d),
        "h": plain(block.h),
        "others": {letter: plain(value) for letter, value in block.others.items()},
        "steps": [_step(step) for step in block.steps],
        "in_force": None if block.in_force is None else _in_force(block.in_force),
        "way": None if decoded.way is None else _way(decoded.way),
    }


def _step(step: DecodeStep) -> StepEntry:
    return {
        "order": step.order,
        "word": step.word,
        "column": step.column,
        "field": step.field,
        "value": plain(step.value),
    }


def _in_force(force: InForce) -> InForceEntry:
    return {
        "motion": force.motion,
        "distance": force.distance,
        "side": force.side,
        "register": force.register,
        "offset_um": plain(force.offset_um),
        "f": plain(force.f),
    }


def _way(way: Way) -> WayEntry:
    return {
        "row": way.row,
        "runs": way.runs,
        "kind": way.kind,
        "start_um": _place(way.start_um),
        "end_um": _place(way.end_um),
        "left_um": _known_place(way.left_um),
        "right_um": _known_place(way.right_um),
        "wire_center_um": _known_place(way.wire_center_um),
        "arc_center_um": _known_place(way.arc_center_um),
        "length_um": _rounded(way.length_um),
        "joint": way.joint.value,
        "before_line": way.before_line or None,
    }


def plain(value: float | None) -> float | None:
    """A number as people write it: whole ones without a point; None where there is none, or none that JSON has."""
    if value is None or not abs(value) < float("inf"):
        return None
    return int(value) if value == int(value) else value


def _place(place: Point) -> list[float]:
    return [_rounded(place.x), _rounded(place.y)]


def _known_place(place: Point | None) -> list[float] | None:
    return None if place is None else _place(place)


def _rounded(value: float) -> float:
    return round(value, _DIGITS) + 0.0
