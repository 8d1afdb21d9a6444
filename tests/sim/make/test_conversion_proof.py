"""The proof of a conversion notices every way in which what is read may differ from what was drafted."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from twins import TWIN_3B

from parser.controller_words import Compensation, CompensationRules
from parser.dialect.reader import Choices
from parser.geometry.curves import CurveKind
from parser.program import parse_program
from parser.toolpath import Toolpath
from parser.write.draft import draft_of
from parser.write.iso import iso_choices, written_iso
from sim.make.conversion_proof import proof

DRAFT = draft_of(parse_program(TWIN_3B + "").toolpath)
MADE = written_iso(DRAFT, iso_choices("fast-wire"))
READ = parse_program(MADE.text, choices=Choices(dialect="fast-wire")).toolpath


def moved(path: Toolpath, row: int, by_um: float) -> Toolpath:
    end = path.end_um.copy()
    end[row] += by_um
    return replace(path, end_um=end)


def with_jump(path: Toolpath) -> Toolpath:
    kind = path.kind.copy()
    kind[2] = CurveKind.JUMP
    return replace(path, kind=kind)


def turned_round(path: Toolpath) -> Toolpath:
    sweep = path.sweep_rad.copy()
    arc = int(np.flatnonzero(path.is_arc)[0])
    sweep[arc] -= np.copysign(2.0 * np.pi, sweep[arc])
    return replace(path, sweep_rad=sweep)


def with_side(path: Toolpath) -> Toolpath:
    side = np.ones(len(path), dtype=np.int64)
    return replace(path, compensation=Compensation(side, 100.0 * side, ("D1",) * len(path), CompensationRules()))


def test_what_is_read_as_it_was_written_is_as_far_off_as_its_ends() -> None:
    held = proof(DRAFT, MADE, READ)
    assert held.differs == ""
    assert held.off_um == pytest.approx(np.hypot(*(READ.end_um - DRAFT.curves.end_um).T).max())


def test_a_whole_path_that_lies_aside_by_the_rounding_of_its_start_is_the_same() -> None:
    aside = replace(READ, start_um=READ.start_um + 0.3, end_um=READ.end_um + 0.3, center_um=READ.center_um + 0.3)
    assert proof(DRAFT, MADE, aside).off_um == pytest.approx(proof(DRAFT, MADE, READ).off_um)


@pytest.mark.parametrize(
    ("spoiled", "differs"),
    [
        (with_jump, "jumps"),
        (turned_round, "turns"),
        (with_side, "offsets"),
        (lambda path: replace(path, stops=()), "stops"),
    ],
)
def test_another_program_is_told(spoiled: Callable[[Toolpath], Toolpath], differs: str) -> None:
    assert proof(DRAFT, MADE, spoiled(READ)).differs == differs


def test_a_block_too_many_is_told() -> None:
    assert proof(DRAFT, MADE._replace(row=MADE.row[1:]), READ).differs == "blocks"


def test_an_end_that_is_off_is_measured() -> None:
    assert proof(DRAFT, MADE, moved(READ, 4, 40.0)).off_um == pytest.approx(40.0 * np.sqrt(2.0), rel=0.05)


def test_an_arc_that_bulges_otherwise_is_measured() -> None:
    center = READ.center_um.copy()
    arc = int(np.flatnonzero(READ.is_arc)[0])
    center[arc, 1] += 25.0
    assert proof(DRAFT, MADE, replace(READ, center_um=center)).off_um > 20.0
