"""Rows of the summary table about the cut: its passes, the offset of the controller, pieces, and the drawing."""

from collections import Counter

from controller.offset.path import Made
from parser.findings.remarks import remark_text
from parser.shape.passes import Pass
from parser.text.block_names import BlockNames
from parser.units import mm
from sim.base.units import in_figures
from sim.cut.pieces.pieces import Piece
from sim.measure.passes.figures import PassFigures
from sim.run.dryrun import DryRun
from sim.show.words import Words
from sim.show.words.phrases import lasting

_MOST_PIECES = 4
_MOST_PASSES = 8
Row = tuple[str, str]
"""Name and figures."""


def pass_rows(run: DryRun, tell: Words) -> list[Row]:
    """What each pass comes to, where any contour has more than one."""
    if not run.has_trims:
        return []
    among = Counter(figures.of.edge for figures in run.pass_figures)
    reach_um = run.scenario.wire.reach_um
    rows = [(_pass_name(one.of, among, tell), _pass(one, reach_um, tell)) for one in run.pass_figures]
    left = len(rows) - _MOST_PASSES
    return [*rows[:_MOST_PASSES], *([("", tell("summary.more-passes", n=left))] if left > 0 else [])]


def _pass_name(one: Pass, among: Counter[int], tell: Words) -> str:
    counted = {"number": one.number, "among": among[one.edge]}
    if len(among) > 1:
        return tell("summary.pass-of-contour", contour=one.edge + 1, **counted)
    return tell("summary.pass", **counted)


def _pass(figures: PassFigures, reach_um: float, tell: Words) -> str:
    one, stock = figures.of, figures.stock
    way = "tab-" * one.is_tab + ("back" if one.is_back else "forward")
    values = {
        "way": tell(f"summary.way-{way}"),
        "offset": f"{one.offset_um(reach_um):,.0f}",
        "time": lasting(figures.time_s),
    }
    if stock is None:
        return tell("summary.pass-not-cut", **values)
    return tell("summary.pass-takes", stock=f"{stock.mean_um:,.0f}", **values)


def offset_rows(run: DryRun, tell: Words) -> list[Row]:
    """What the controller adds, and what became of the program's blocks."""
    made = run.offset
    if made is None:
        return []
    numbers = {"bridge": int((made.path.made == Made.BRIDGE).sum()), "vanished": len(made.path.vanished)}
    told = [_counted(what, n, tell) for what, n in numbers.items() if n]
    by = ", ".join(f"{round(mm(one.by_um), 4):g}" for one in made.passes)
    side = tell(f"summary.offset-{made.side.name.lower()}", by=by)
    rows = [(tell("summary.offset"), tell("phrases.comma").join([side, *told]))]
    feeds = run.pass_feed_um_s
    if len(set(feeds)) == 1:
        return rows
    return [*rows, (tell("summary.feed"), f"{', '.join(in_figures(mm(feed) * 60.0) for feed in feeds)} mm/min")]


def _counted(what: str, number: int, tell: Words) -> str:
    return tell(f"summary.one-{what}") if number == 1 else tell(f"summary.some-{what}", n=number)


def piece_rows(run: DryRun, tell: Words) -> list[Row]:
    """What comes free, and when."""
    if run.remains is None:
        return []
    freed = run.remains.pieces.freed
    if not freed:
        return [(tell("summary.pieces"), tell("summary.pieces-none"))]
    names = run.block_names
    shown = [_piece(piece, names, tell) for piece in freed[:_MOST_PIECES]]
    more = [tell("summary.pieces-more", n=len(freed) - _MOST_PIECES)] if len(freed) > _MOST_PIECES else []
    return [(tell("summary.pieces") if at == 0 else "", text) for at, text in enumerate([*shown, *more])]


def _piece(piece: Piece, names: BlockNames, tell: Words) -> str:
    freed = piece.freed
    mass = f"{piece.mass_g:,.1f} g" if piece.mass_g >= 1.0 else f"{piece.mass_g * 1e3:,.0f} mg"
    told = tell(
        "summary.piece",
        kind=tell(f"summary.kind-{piece.kind}"),
        area=f"{piece.area_mm2:,.2f}",
        mass=mass,
        block=names.at(freed.block),
        time=lasting(freed.t_s),
    )
    if piece.early:
        return tell("summary.piece-early", piece=told, left=f"{mm(piece.cut_after_um):,.3f}")
    if piece.held_after_block is not None:
        return tell("summary.piece-held", piece=told, block=names.at(piece.held_after_block))
    return told


def drawing_rows(run: DryRun, tell: Words) -> list[Row]:
    """How far the cut lies from its drawing."""
    target, found = run.scenario.drawing, run.comparison
    if target is None or found is None:
        return []
    figures = tell("summary.off-drawing-of", most=f"{found.max_um:,.2f}", tolerance=f"{target.tolerance_um:g}")
    names = [("", remark_text(named, tell.language, run.block_names.other)) for named in found.names]
    return [(tell("summary.off-drawing", drawing=found.drawing.name), figures), *names]
