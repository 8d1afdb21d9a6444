"""Decoded blocks as data, schema ``drycut.decode/1`` (docs/iso.md §8)."""

import json
from collections.abc import Sequence
from typing import Any, Final

from controller.decode.blocks import Decoded, Way
from parser import __version__
from parser.dialect.decoding import DecodedBlock, InForce
from parser.findings.catalogue import Language
from parser.program import Program
from parser.toolpath import Point

SCHEMA: Final = "drycut.decode/1"
_DIGITS: Final = 6
_PLACES: Final = ("start_um", "end_um", "left_um", "right_um", "wire_center_um", "arc_center_um")


def document(program: Program, blocks: Sequence[Decoded], language: Language) -> dict[str, Any]:
    """Blocks of a program as plain lists, dicts, numbers and None; the order of keys is fixed.

    Why something was assumed is told in a language.
    """
    return {
        "schema": SCHEMA,
        "drycut": __version__,
        "file": program.name,
        "dialect": program.reading.dialect,
        "assumptions": [assumption.entry(language) for assumption in program.reading.assumptions],
        "blocks": [block_entry(decoded) for decoded in blocks],
    }


def document_text(program: Program, blocks: Sequence[Decoded], language: Language) -> str:
    """The document as JSON; the same program gives the same bytes."""
    return json.dumps(document(program, blocks, language), ensure_ascii=False, allow_nan=False, indent=2) + "\n"


def block_entry(decoded: Decoded) -> dict[str, Any]:
    """A block: the buffer that it fills, the steps in which it does so, what is in force, and its way."""
    block = decoded.block
    return {
        "line": block.line,
        "buf_state": 1,
        "number": block.number,
        "number_bcd": block.number_bcd,
        "coor_um": dict(block.coor_um),
        **_registers(block),
        "others": {letter: plain(value) for letter, value in block.others.items()},
        "steps": [{**step._asdict(), "value": plain(step.value)} for step in block.steps],
        "in_force": None if block.in_force is None else _in_force(block.in_force),
        "way": None if decoded.way is None else _way(decoded.way),
    }


def _registers(block: DecodedBlock) -> dict[str, Any]:
    return {
        "f": plain(block.f),
        "s": plain(block.s),
        "g0": block.g0,
        "g": [plain(value) for value in block.g],
        "m": [plain(value) for value in block.m],
        "t": plain(block.t),
        "d": plain(block.d),
        "h": plain(block.h),
    }


def _in_force(force: InForce) -> dict[str, Any]:
    return {**force._asdict(), "offset_um": plain(force.offset_um), "f": plain(force.f)}


def _way(way: Way) -> dict[str, Any]:
    places = {name: _place(getattr(way, name)) for name in _PLACES}
    return {
        "row": way.row,
        "runs": way.runs,
        "kind": way.kind,
        **places,
        "length_um": _rounded(way.length_um),
        "joint": way.joint.value,
        "before_line": way.before_line or None,
    }


def plain(value: float | None) -> float | None:
    """A number as people write it: whole ones without a point; None where there is none, or none that JSON has."""
    if value is None or not abs(value) < float("inf"):
        return None
    return int(value) if value == int(value) else value


def _place(place: Point | None) -> list[float] | None:
    return None if place is None else [_rounded(place.x), _rounded(place.y)]


def _rounded(value: float) -> float:
    return round(value, _DIGITS) + 0.0
