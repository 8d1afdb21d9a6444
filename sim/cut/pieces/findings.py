"""Findings on the pieces that a cut leaves: those that come free before their cut is done."""

from parser.dialect.at_block import at_block
from parser.findings.findings import Finding
from parser.program import Program
from parser.units import mm
from sim.cut.pieces.pieces import Piece, Pieces


def piece_findings(program: Program, pieces: Pieces) -> list[Finding]:
    """Finding 3B406 for each piece that comes free before its cut is done."""
    return [_early(program, piece) for piece in pieces.freed if piece.early]


def _early(program: Program, piece: Piece) -> Finding:
    freed = piece.freed
    return at_block(
        program.toolpath,
        program.lines,
        "3B406",
        freed.block - 1,
        kind=piece.kind,
        area_mm2=piece.area_mm2,
        cut_after=piece.cut_after_um,
        t_s=freed.t_s,
        x_mm=mm(freed.wire_um.x),
        y_mm=mm(freed.wire_um.y),
    )
