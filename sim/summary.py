"""The summary table of a run on the terminal."""

from pathlib import Path

from rich.console import Console
from rich.markup import escape
from rich.table import Table
from rich.text import Text

from parser.catalogue import texts
from parser.encoding import printable
from parser.excerpt import place, with_caret
from parser.findings import Finding, Severity
from parser.units import mm
from sim.deviation import Deviation
from sim.dryrun import DryRun, verdict
from sim.units import clock

_COLOURS = {Severity.ERROR: "red", Severity.WARNING: "yellow", Severity.NOTE: "cyan"}
_INTERPOLATORS = {"point-by-point": "point by point", "card": "by the card at equal times"}
_MOST_FINDINGS = 20
_MOST_CLOSURES = 4


def print_summary(run: DryRun, output: Path | None) -> None:
    """Print the figures of a run, its findings and its verdict to stdout."""
    console = Console(highlight=False)
    console.soft_wrap = not console.is_terminal  # a line a finding for those that read lines
    table = Table(title=escape(run.scenario.title), title_justify="left", show_header=False, title_style="bold")
    table.add_column(style="dim")
    table.add_column()
    for name, value in _rows(run):
        table.add_row(name, escape(value))
    console.print(table)
    _print_findings(console, run, output)
    passed = verdict(run.findings) == "pass"
    console.print(Text(f"verdict: {'pass' if passed else 'fail'}", style="bold green" if passed else "bold red"))
    if output is not None:
        console.print(f"written: {escape(printable(str(output)))}/ cut.png, report.json, trace.npz")


def _rows(run: DryRun) -> list[tuple[str, str]]:
    toolpath, scenario = run.toolpath, run.scenario
    jumps = int(toolpath.is_jump.sum())
    arcs = int(toolpath.is_arc.sum())
    numbers = {"line": len(toolpath) - arcs - jumps, "arc": arcs, "jump": jumps}
    kinds = ", ".join(f"{number:,} {kind}{'s' * (number > 1)}" for kind, number in numbers.items() if number)
    wire = f"wire {mm(scenario.wire.diameter_um):g} mm + 2 × {scenario.wire.spark_gap_um:g} µm gap"
    return [
        ("machine", scenario.machine.name),
        ("blocks", f"{len(toolpath):,} ({kinds})"),
        ("path length", f"{mm(float(toolpath.length_um.sum())):,.3f} mm"),
        ("kerf", f"{mm(scenario.wire.kerf_um):g} mm ({wire})"),
        ("steps", f"{len(run.stepped):,} of 1 µm, {_INTERPOLATORS[scenario.machine.controller.interpolation]}"),
        ("estimated cutting time", f"{clock(run.plan.duration_s)} in {scenario.thickness_mm:g} mm"),
        *_times(run),
        *_closures(run),
        ("deviation of steps, at most", _largest(run.deviations.steps)),
        ("  of it interpolation", _largest(run.deviations.interpolation)),
        ("deviation of table, at most", _largest(run.deviations.table) if len(run.stepped) else "no motion"),
    ]


def _times(run: DryRun) -> list[tuple[str, str]]:
    """Time of each contour, where there are some but few."""
    if not 1 < len(run.contours) <= _MOST_CLOSURES:
        return []
    times = [(c, float(run.block_time_s[c.first - 1 : c.last].sum())) for c in run.contours]
    return [(f"  blocks {c.first}–{c.last}", clock(time_s)) for c, time_s in times]


def _closures(run: DryRun) -> list[tuple[str, str]]:
    """Closure of each contour; of many, the worst."""
    shown = run.contours
    if len(shown) > _MOST_CLOSURES:
        worst = max(shown, key=lambda contour: contour.encloses * (contour.closure_stepped_um + contour.is_open * 1e9))
        shown = (worst,)
    rows = []
    for contour in shown:
        name = "closure"
        if len(run.contours) > 1:
            name += f" {contour.first}–{contour.last}" + (" (worst)" if len(shown) < len(run.contours) else "")
        if not contour.encloses:
            rows.append((name, "none: a parting cut"))
            continue
        figures = f"{contour.closure_exact_um:,.2f} µm exact, {contour.closure_stepped_um:,.2f} µm stepped"
        if contour.returns and contour.closure_exact_um > contour.tolerance_um:
            figures += ", closed on its path"
        rows.append((name, figures))
    return rows


def _largest(deviation: Deviation) -> str:
    where = deviation.where
    if where is None:
        return "no motion"
    return f"{deviation.max_um:,.2f} µm in block {where.block:,} at {_mm(where.x_um)}, {_mm(where.y_um)} mm"


def _mm(length_um: float) -> str:
    """Millimetres to the micrometre; never −0."""
    return f"{round(mm(length_um), 3) + 0.0:.3f}"


def _print_findings(console: Console, run: DryRun, output: Path | None) -> None:
    for finding in run.findings[:_MOST_FINDINGS]:
        console.print(_line(printable(str(run.scenario.program)), finding))
        if finding.column:
            width = finding.span[1] - finding.span[0]
            excerpt = with_caret(run.program.excerpt(finding.line), finding.column, width)
            console.print(Text(excerpt, style="dim"))
    if len(run.findings) > _MOST_FINDINGS:
        there = "in report.json" if output else "in the report; -o DIR or --json shows them"
        console.print(f"… and {len(run.findings) - _MOST_FINDINGS} findings more, {there}")


def _line(name: str, finding: Finding) -> Text:
    at = place(name, finding.line, finding.column)
    block = f" block {finding.block}:" if finding.block else ""
    text = Text(f"{at}: ")
    text.append(f"{finding.severity}[{finding.code}]", style=_COLOURS[finding.severity])
    return text.append(f":{block} {texts(finding).message}")
