"""Rows of the summary table about the cut: its passes, the offset of the controller, pieces, and the drawing."""

from collections import Counter

from controller.offset.path import Made
from parser.findings.remarks import remark_text
from parser.shape.passes import Pass
from parser.text.block_names import BlockNames
from parser.units import mm
from sim.cut.pieces.pieces import Piece
from sim.measure.passes.figures import PassFigures
from sim.run.dryrun import DryRun
from sim.units import clock, in_figures

_MOST_PIECES = 4
_MOST_PASSES = 8
Row = tuple[str, str]
"""Name and figures."""


def pass_rows(run: DryRun) -> list[Row]:
    """What each pass comes to, where any contour has more than one."""
    if not run.has_trims:
        return []
    among = Counter(figures.of.edge for figures in run.pass_figures)
    named = [_pass_name(figures.of, among) for figures in run.pass_figures]
    told = [_pass(figures, run.scenario.wire.reach_um) for figures in run.pass_figures]
    rows = list(zip(named, told, strict=True))
    more = [("", f"and {len(rows) - _MOST_PASSES} passes more")] if len(rows) > _MOST_PASSES else []
    return [*rows[:_MOST_PASSES], *more]


def _pass_name(one: Pass, among: Counter[int]) -> str:
    contour = f"contour {one.edge + 1}, " if len(among) > 1 else ""
    return f"{contour}pass {one.number} of {among[one.edge]}"


def _pass(figures: PassFigures, reach_um: float) -> str:
    one, stock = figures.of, figures.stock
    way = ("tab, " if one.is_tab else "") + ("back" if one.is_back else "forward")
    taken = "not cut" if stock is None else f"takes {stock.mean_um:,.0f} µm"
    return f"{way}, offset {one.offset_um(reach_um):,.0f} µm, {taken}, {clock(figures.time_s)}"


def offset_rows(run: DryRun) -> list[Row]:
    """What the controller adds, and what became of the program's blocks."""
    made = run.offset
    if made is None:
        return []
    bridges = int((made.path.made == Made.BRIDGE).sum())
    parts = [(bridges, "bridge", "added"), (len(made.path.vanished), "block", "left out")]
    told = [f"{number} {name}{'s' * (number > 1)} {what}" for number, name, what in parts if number]
    by = ", ".join(f"{round(mm(one.by_um), 4):g}" for one in made.passes)
    rows = [("offset", ", ".join([f"{by} mm to the {made.side.name.lower()}", *told]))]
    feeds = run.pass_feed_um_s
    if len(set(feeds)) == 1:
        return rows
    return [*rows, ("  feed", f"{', '.join(in_figures(mm(feed) * 60.0) for feed in feeds)} mm/min")]


def piece_rows(run: DryRun) -> list[Row]:
    """What comes free, and when."""
    if run.remains is None:
        return []
    freed = run.remains.pieces.freed
    if not freed:
        return [("pieces", "none comes free")]
    names = run.block_names
    shown = [_piece(piece, names) for piece in freed[:_MOST_PIECES]]
    more = [f"and {len(freed) - _MOST_PIECES} more"] if len(freed) > _MOST_PIECES else []
    return [("pieces" if at == 0 else "", text) for at, text in enumerate([*shown, *more])]


def _piece(piece: Piece, names: BlockNames) -> str:
    freed = piece.freed
    mass = f"{piece.mass_g:,.1f} g" if piece.mass_g >= 1.0 else f"{piece.mass_g * 1e3:,.0f} mg"
    block = names.at(freed.block)
    told = f"{piece.kind} of {piece.area_mm2:,.2f} mm², {mass}, free in block {block} after {clock(freed.t_s)}"
    if piece.early:
        return f"{told}, {mm(piece.cut_after_um):,.3f} mm of it still to be cut"
    if piece.held_after_block is not None:
        return f"{told}, can be clamped at the D behind block {names.at(piece.held_after_block)}"
    return told


def drawing_rows(run: DryRun) -> list[Row]:
    """How far the cut lies from its drawing."""
    target, found = run.scenario.drawing, run.comparison
    if target is None or found is None:
        return []
    allowed = f"{target.tolerance_um:g} µm allowed"
    names = [("", remark_text(named, names=run.block_names.other)) for named in found.names]
    return [(f"off {found.drawing.name}", f"{found.max_um:,.2f} µm at most, {allowed}"), *names]
