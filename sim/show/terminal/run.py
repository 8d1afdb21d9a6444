"""The summary table of a run on the terminal."""

import math
from pathlib import Path

from parser.findings.facts import ReadAs
from parser.shape.contours import Contour
from parser.text.block_names import BlockNames
from parser.units import mm
from sim.measure.deviation.deviation import Where
from sim.run.dryrun import DryRun
from sim.run.findings import verdict
from sim.setup.key_words import value_word
from sim.show.assumptions import taken_for_granted
from sim.show.terminal.colours import COLOURS, painted, styled
from sim.show.terminal.cut_rows import Row, drawing_rows, offset_rows, pass_rows, piece_rows
from sim.show.terminal.finding import finding_lines
from sim.show.terminal.layout import paragraph, show, table
from sim.show.terminal.printer import say
from sim.show.terminal.streams import outlet
from sim.show.terminal.wrap import width_of
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
_LEAST_UM = 0.005  # shown as 0.00


def print_summary(run: DryRun, output: Path | None) -> None:
    """Print the figures of a run, its findings and its verdict to stdout."""
    figures = table(run.scenario.title)
    for row in summary_rows(run):
        figures.add_row(*row)
    show(figures)
    _print_findings(run, output)
    paragraph(" ".join(sentence.en for sentence in taken_for_granted(run)), "dim")
    reached = verdict(run.findings)
    say(styled(f"verdict: {reached}", f"bold {COLOURS[reached]}"))


def _print_findings(run: DryRun, output: Path | None) -> None:
    name, width = str(run.scenario.program), width_of(outlet())
    findings = [found for found in run.findings if not isinstance(found.fact, ReadAs)]  # told with what was assumed
    for finding in findings[:_MOST_FINDINGS]:
        excerpt = run.program.excerpt(finding.line) if finding.column else None
        for line in finding_lines(name, finding, excerpt, "en", width):
            say(painted(line, finding.severity))
    if len(findings) > _MOST_FINDINGS:
        there = "in report.json" if output else "in the report; -o DIR or --json shows them"
        say(f"… and {len(findings) - _MOST_FINDINGS} findings more, {there}")


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
        *pass_rows(run),
        *_closures(run),
        *_stopped(run),
        *offset_rows(run),
        *piece_rows(run),
        *_deviations(run),
        *drawing_rows(run),
        *_limits(run.peaks, run.block_names),
    ]


def _times(run: DryRun) -> list[Row]:
    """Time of each contour, where there are some but few."""
    if not 1 < len(run.whole_contours) <= _MOST_CLOSURES:
        return []
    times = [(c, float(run.block_time_s[c.first - 1 : c.last].sum())) for c in run.whole_contours]
    return [(f"  blocks {_span(run, contour)}", clock(time_s)) for contour, time_s in times]


def _span(run: DryRun, contour: Contour) -> str:
    """Names of the first and the last block of a contour."""
    first, last = (run.block_names.at(number) for number in (contour.first, contour.last))
    return f"{first}–{last}"


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
            name += f" {_span(run, contour)}" + (" (worst)" if len(shown) < len(run.whole_contours) else "")
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
    block = run.block_names.of_row(ended.row)
    return [("stopped", f"in block {block} after {clock(ended.t_s)}: the {ended.axis.name} {why}")]


def _deviations(run: DryRun) -> list[Row]:
    """Deviation of the cut, and what each cause adds."""
    if not len(run.stepped):
        return [("deviation, at most", "no motion")]
    whole, names = run.deviations.wire, run.block_names
    causes = run.deviations.by_cause._asdict()
    parts = [(f"  {_CAUSES[cause]}", _largest(part.max_um, part.where, names)) for cause, part in causes.items()]
    return [("deviation, at most", _largest(whole.max_um, whole.where, names)), *parts]


def _largest(max_um: float, where: Where | None, names: BlockNames) -> str:
    if where is None or max_um < _LEAST_UM:
        return "none"
    return f"{max_um:,.2f} µm in block {names.at(where.block)} at {_mm(where.x_um)}, {_mm(where.y_um)} mm"


def _limits(peaks: tuple[Peak, ...], blocks: BlockNames) -> list[Row]:
    """The limits that were come nearest to."""
    limited = sorted((peak for peak in peaks if math.isfinite(peak.limit)), key=lambda peak: -peak.share)
    names = ("limits, nearest", *[""] * (_MOST_LIMITS - 1))
    return [(name, _limit(peak, blocks)) for name, peak in zip(names, limited, strict=False)]


def _limit(peak: Peak, names: BlockNames) -> str:
    scale, unit = _UNITS[peak.quantity]
    met = f"{peak.quantity} {peak.axis.name} {_percent(peak.share)} of {in_figures(peak.limit * scale)} {unit}"
    return f"{met}, block {names.of_row(peak.row)} at {_mm(peak.x_um, 1)}, {_mm(peak.y_um, 1)} mm"


def _mm(length_um: float, digits: int = 3) -> str:
    """Millimetres, to the micrometre at most; never −0."""
    return f"{round(mm(length_um), digits) + 0.0:.{digits}f}"


def _percent(share: float) -> str:
    return "<1 %" if share < 0.01 else f"{100.0 * share:.0f} %"
