"""Findings on what a cut leaves: pieces that come free before their cut is done, and a kerf that stays unknown."""

from parser.dialect.reader import at_block
from parser.findings.findings import Finding
from parser.program import Program
from parser.units import mm
from sim.cut.pieces.pieces import Piece, Pieces
from sim.cut.regions import RegionError


def piece_findings(program: Program, pieces: Pieces) -> list[Finding]:
    """Finding 3B406 for each piece that comes free before its cut is done."""
    return [_early(program, piece) for piece in pieces.freed if piece.early]


def region_finding(program: Program, error: RegionError) -> Finding:
    """Finding 3B407: what is left could not be worked out."""
    first, last = (int(program.toolpath.source.block[number - 1]) for number in (error.first, error.last))
    return at_block(program.toolpath, program.lines, "3B407", error.first - 1, first=first, last=last)


def _early(program: Program, piece: Piece) -> Finding:
    freed = piece.freed
    return at_block(
        program.toolpath,
        program.lines,
        "3B406",
        freed.block - 1,
        kind=piece.kind,
        pause=program.reading.spelling.pause,
        area_mm2=piece.area_mm2,
        cut_after=piece.cut_after_um,
        t_s=freed.t_s,
        x_mm=mm(freed.wire_um.x),
        y_mm=mm(freed.wire_um.y),
    )
