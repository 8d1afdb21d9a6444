"""Leads that part widely, meet at the start, or are cut again: scrap between them is no part, and a slug is none."""

from pathlib import Path

import pytest
from traced import STEEL, kerf_along

from parser.program import load_program
from sim.cut.pieces.pieces import pieces_of

PROGRAMS = Path(__file__).parent / "leads"


@pytest.mark.alike(2)
@pytest.mark.parametrize(
    ("name", "offset_um", "parts", "slugs"),
    [
        ("trims-from-elsewhere", 110.0, 2, 0),  # the trim has a hole of its own beside the first
        ("start-cut-off-by-leads", 100.0, 0, 2),  # the tab is cut behind a jump, from the same hole
        ("cut-closed-at-start", 100.0, 1, 1),
        ("leads-cut-again", 110.0, 2, 0),
    ],
)
def test_each_figure_leaves_one_piece_of_its_kind(name: str, offset_um: float, parts: int, slugs: int) -> None:
    path = load_program((PROGRAMS / f"{name}.3b").read_bytes(), f"{name}.3b").toolpath
    freed = pieces_of(kerf_along(path, offset_um=offset_um), None, STEEL).freed
    kinds = [piece.kind for piece in freed if not piece.is_scrap]
    assert (kinds.count("part"), kinds.count("slug")) == (parts, slugs)
    assert sum(piece.is_scrap for piece in freed) > 0
