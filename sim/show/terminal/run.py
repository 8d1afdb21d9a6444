"""The summary table of a run on the terminal."""

import math
from collections import Counter
from pathlib import Path

from rich.console import Console
from rich.markup import escape
from rich.table import Table
from rich.text import Text

from controller.offset.path import Made
from parser.findings.findings import Finding
from parser.findings.remarks import remark_text
from parser.shape.passes import Pass
from parser.text.encoding import printable
from parser.text.excerpt import place, with_caret
from parser.units import mm
from sim.cut.pieces.pieces import Piece
from sim.measure.deviation.deviation import Where
from sim.measure.passes.figures import PassFigures
from sim.run.dryrun import DryRun, verdict
from sim.setup.key_words import value_word
from sim.show.assumptions import taken_for_granted
from sim.show.terminal.colours import COLOURS
from sim.show.terminal.finding import hint, message
from sim.table.record.peaks import Peak
from sim.units import clock, in_figures

_CAUSES = {
    "interpolation": "by interpolation",
    "carried": "carried over",
    "planning": "by planning",
    "table": "by the table",
    "wire": "by the wire",
}
_UNITS = {"force": (1.0, "N"), "speed": (1e-3, "mm/s"), "lag": (1.0, "µm")}
_MOST_FINDINGS = 20
_MOST_CLOSURES = 4
_MOST_LIMITS = 3
_MOST_PIECES = 4
_MOST_PASSES = 8
_LEAST_UM = 0.005  # shown as 0.00
Row = tuple[str, str]


def print_summary(run: DryRun, output: Path | None) -> None:
    """Print the figures of a run, its findings and its verdict to stdout."""
    console = Console(highlight=False)
    console.soft_wrap = not console.is_terminal  # a line a finding for those that read lines
    table = Table(title=escape(run.scenario.title), title_justify="left", show_header=False, title_style="bold")
    table.add_column(style="dim")
    table.add_column()
    for name, value in summary_rows(run):
        table.add_row(name, escape(value))
    console.print(table)
    _print_findings(console, run, output)
    console.print(Text(" ".join(sentence.en for sentence in taken_for_granted(run)), style="dim"))
    reached = verdict(run.findings)
    console.print(Text(f"verdict: {reached}", style=f"bold {COLOURS[reached]}"))


def _print_findings(console: Console, run: DryRun, output: Path | None) -> None:
    for finding in run.findings[:_MOST_FINDINGS]:
        console.print(_line(printable(str(run.scenario.program)), finding))
        if finding.column:
            width = finding.span[1] - finding.span[0]
            excerpt = with_caret(run.program.excerpt(finding.line), finding.column, width)
            console.print(Text(excerpt, style="dim"))
        told = hint(finding, "en")
        if told:
            console.print(Text(f"    = {printable(told)}"))
    if len(run.findings) > _MOST_FINDINGS:
        there = "in report.json" if output else "in the report; -o DIR or --json shows them"
        console.print(f"… and {len(run.findings) - _MOST_FINDINGS} findings more, {there}")


def _line(name: str, finding: Finding) -> Text:
    at = place(name, finding.line, finding.column)
    text = Text(f"{at}: ")
    text.append(f"{finding.severity}[{finding.code}]", style=COLOURS[finding.severity])
    return text.append(f": {message(finding, 'en')}")


def summary_rows(run: DryRun) -> list[Row]:
    """Names and figures, in the order of the table."""
    toolpath, scenario = run.toolpath, run.scenario
    jumps = int(toolpath.is_jump.sum())
    arcs = int(toolpath.is_arc.sum())
    numbers = {"line": len(toolpath) - arcs - jumps, "arc": arcs, "jump": jumps}
    kinds = ", ".join(f"{number:,} {kind}{'s' * (number > 1)}" for kind, number in numbers.items() if number)
    wire = f"wire {mm(scenario.wire.diameter_um):g} mm + 2 × {scenario.wire.spark_gap_um:g} µm gap"
    return [
        ("machine", scenario.machine.name),
        ("blocks", f"{len(toolpath):,} ({kinds})"),
        ("path length", f"{mm(run.ran_um):,.3f} mm"),
        ("kerf", f"{mm(scenario.wire.kerf_um):g} mm ({wire})"),
        *([("wire lag", f"{scenario.wire_lag_um:g} µm")] if scenario.wire_lag_um else []),
        ("steps", f"{len(run.stepped):,} of 1 µm, {value_word(scenario.machine.controller.interpolation).en}"),
        ("estimated cutting time", f"{clock(run.ran_s)} in {scenario.thickness_mm:g} mm"),
        *_times(run),
        *_passes(run),
        *_closures(run),
        *_stopped(run),
        *_offset(run),
        *_pieces(run),
        *_deviations(run),
        *_drawing(run),
        *_limits(run.peaks),
    ]


def _times(run: DryRun) -> list[Row]:
    """Time of each contour, where there are some but few."""
    if not 1 < len(run.whole_contours) <= _MOST_CLOSURES:
        return []
    times = [(c, float(run.block_time_s[c.first - 1 : c.last].sum())) for c in run.whole_contours]
    return [(f"  blocks {c.first}–{c.last}", clock(time_s)) for c, time_s in times]


def _passes(run: DryRun) -> list[Row]:
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
    return f"{way}, offset {reach_um + one.shift_um:,.0f} µm, {taken}, {clock(figures.time_s)}"


def _closures(run: DryRun) -> list[Row]:
    """Closure of each contour; of many, the worst."""
    shown = run.whole_contours
    if len(shown) > _MOST_CLOSURES:
        worst = max(shown, key=lambda contour: contour.encloses * (contour.closure_stepped_um + contour.is_open * 1e9))
        shown = (worst,)
    rows = []
    for contour in shown:
        name = "closure"
        if len(run.whole_contours) > 1:
            name += f" {contour.first}–{contour.last}" + (" (worst)" if len(shown) < len(run.whole_contours) else "")
        if not contour.encloses:
            rows.append((name, "none: a parting cut"))
            continue
        figures = f"{contour.closure_exact_um:,.2f} µm exact, {contour.closure_stepped_um:,.2f} µm stepped"
        if contour.returns and contour.closure_exact_um > contour.tolerance_um:
            figures += ", closed on its path"
        rows.append((name, figures))
    return rows


def _stopped(run: DryRun) -> list[Row]:
    """Where the machine stopped before its program was through, so that what follows is not cut."""
    ended = run.ended
    if ended is None:
        return []
    why = {"trip": "servo tripped", "travel": "travel ends here; --past-stop goes on"}[ended.cause]
    return [("stopped", f"in block {ended.row + 1:,} after {clock(ended.t_s)}: the {ended.axis.name} {why}")]


def _offset(run: DryRun) -> list[Row]:
    """What the controller adds, and what became of the program's blocks."""
    asked, made = run.scenario.offset, run.offset
    if asked is None or made is None:
        return []
    bridges = int((made.path.made == Made.BRIDGE).sum())
    parts = [(bridges, "bridge", "added"), (len(made.path.vanished), "block", "left out")]
    told = [f"{number} {name}{'s' * (number > 1)} {what}" for number, name, what in parts if number]
    by = ", ".join(f"{mm(one.by_um):g}" for one in asked.passes)
    rows = [("offset", ", ".join([f"{by} mm to the {asked.side.name.lower()}", *told]))]
    feeds = [run.scenario.pass_feed_um_s(one) for one in asked.passes]
    if len(set(feeds)) == 1:
        return rows
    return [*rows, ("  feed", f"{', '.join(in_figures(mm(feed) * 60.0) for feed in feeds)} mm/min")]


def _pieces(run: DryRun) -> list[Row]:
    """What comes free, and when."""
    if run.remains is None:
        return []
    freed = run.remains.pieces.freed
    if not freed:
        return [("pieces", "none comes free")]
    shown = [_piece(piece) for piece in freed[:_MOST_PIECES]]
    more = [f"and {len(freed) - _MOST_PIECES} more"] if len(freed) > _MOST_PIECES else []
    return [("pieces" if at == 0 else "", text) for at, text in enumerate([*shown, *more])]


def _piece(piece: Piece) -> str:
    freed = piece.freed
    mass = f"{piece.mass_g:,.1f} g" if piece.mass_g >= 1.0 else f"{piece.mass_g * 1e3:,.0f} mg"
    told = f"{piece.kind} of {piece.area_mm2:,.2f} mm², {mass}, free in block {freed.block:,} after {clock(freed.t_s)}"
    if piece.early:
        return f"{told}, {mm(piece.cut_after_um):,.3f} mm of it still to be cut"
    if piece.held_after_block is not None:
        return f"{told}, can be clamped at the D behind block {piece.held_after_block:,}"
    return told


def _drawing(run: DryRun) -> list[Row]:
    """How far the cut lies from its drawing."""
    target, found = run.scenario.drawing, run.comparison
    if target is None or found is None:
        return []
    allowed = f"{target.tolerance_um:g} µm allowed"
    names = [("", remark_text(named)) for named in found.names]
    return [(f"off {found.drawing.name}", f"{found.max_um:,.2f} µm at most, {allowed}"), *names]


def _deviations(run: DryRun) -> list[Row]:
    """Deviation of the cut, and what each cause adds."""
    if not len(run.stepped):
        return [("deviation, at most", "no motion")]
    whole = run.deviations.wire
    causes = run.deviations.by_cause._asdict()
    parts = [(f"  {_CAUSES[cause]}", _largest(part.max_um, part.where)) for cause, part in causes.items()]
    return [("deviation, at most", _largest(whole.max_um, whole.where)), *parts]


def _largest(max_um: float, where: Where | None) -> str:
    if where is None or max_um < _LEAST_UM:
        return "none"
    return f"{max_um:,.2f} µm in block {where.block:,} at {_mm(where.x_um)}, {_mm(where.y_um)} mm"


def _limits(peaks: tuple[Peak, ...]) -> list[Row]:
    """The limits that were come nearest to."""
    limited = sorted((peak for peak in peaks if math.isfinite(peak.limit)), key=lambda peak: -peak.share)
    names = ("limits, nearest", *[""] * (_MOST_LIMITS - 1))
    return [(name, _limit(peak)) for name, peak in zip(names, limited, strict=False)]


def _limit(peak: Peak) -> str:
    scale, unit = _UNITS[peak.quantity]
    met = f"{peak.quantity} {peak.axis.name} {_percent(peak.share)} of {in_figures(peak.limit * scale)} {unit}"
    return f"{met}, block {peak.row + 1:,} at {_mm(peak.x_um, 1)}, {_mm(peak.y_um, 1)} mm"


def _mm(length_um: float, digits: int = 3) -> str:
    """Millimetres, to the micrometre at most; never −0."""
    return f"{round(mm(length_um), digits) + 0.0:.{digits}f}"


def _percent(share: float) -> str:
    return "<1 %" if share < 0.01 else f"{100.0 * share:.0f} %"
