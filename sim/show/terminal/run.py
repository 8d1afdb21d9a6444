"""The summary table of a run on the terminal.

Rows of the summary table about the cut: its passes, the offset of the controller, pieces, and the drawing.
"""

import math
from collections import Counter
from pathlib import Path

from controller.offset.chain import RowOrigin
from parser.findings.catalogue import Language, length, remark_text
from parser.findings.findings import ReadAs
from parser.shape.contours import Contour
from parser.shape.passes import Pass, most_passes
from parser.text.source import BlockNames
from parser.units import mm, mm_text
from sim.base.units import in_figures
from sim.cut.pieces.pieces import Piece
from sim.measure.deviation import Where
from sim.measure.passes import PassFigures
from sim.run.dryrun import DryRun
from sim.run.findings import outcome
from sim.setup.key_words import value_word
from sim.setup.technology import PassTechnology, worst_grade
from sim.show.refusals import taken_for_granted
from sim.show.spark_rows import spark_rows
from sim.show.taper_rows import taper_rows
from sim.show.terminal.finding import finding_lines
from sim.show.terminal.layout import paragraph, show, table
from sim.show.terminal.printer import COLOURS, painted, say, styled
from sim.show.terminal.streams import outlet
from sim.show.terminal.wrap import width_of
from sim.show.texts import Words, bilingual
from sim.show.texts.phrases import lasting, lasting_within, listed, machine_name, numbered, technology_name
from sim.table.losses import Peak

_MOST_PIECES = 4
_MOST_PASSES = 8
Row = tuple[str, str]
"""Name and figures."""


def pass_rows(run: DryRun, tell: Words) -> list[Row]:
    """What each pass comes to, where any contour has more than one."""
    if not run.has_trims:
        return []
    among = Counter(figures.of.edge for figures in run.pass_figures)
    rows = [(_pass_name(figure.of, among, tell), _pass(figure, tell)) for figure in run.pass_figures]
    left = len(rows) - _MOST_PASSES
    return [*rows[:_MOST_PASSES], *([("", tell("summary.more-passes", n=left))] if left > 0 else [])]


def _pass_name(pass_: Pass, among: Counter[int], tell: Words) -> str:
    counted = {"number": pass_.number, "among": among[pass_.edge]}
    if len(among) > 1:
        return tell("summary.pass-of-contour", contour=pass_.edge + 1, **counted)
    return tell("summary.pass", **counted)


def _pass(figures: PassFigures, tell: Words) -> str:
    pass_, stock = figures.of, figures.stock
    way = "tab-" * pass_.is_tab + ("back" if pass_.is_back else "forward")
    values = {
        "way": tell(f"summary.way-{way}"),
        "offset": f"{figures.offset_um:,.0f}",
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
    numbers = {"bridge": int((made.path.made == RowOrigin.BRIDGE).sum()), "vanished": len(made.path.vanished)}
    told_numbers = [_counted(what, n, tell) for what, n in numbers.items() if n]
    by = ", ".join(f"{round(mm(pass_.by_um), 4):g}" for pass_ in made.passes)
    side = tell(f"summary.offset-{made.side.name.lower()}", by=by)
    rows = [(tell("summary.offset"), tell("phrases.comma").join([side, *told_numbers]))]
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
    lines = [_piece(piece, names, tell) for piece in freed[:_MOST_PIECES]]
    more = [tell("summary.pieces-more", n=len(freed) - _MOST_PIECES)] if len(freed) > _MOST_PIECES else []
    return [(tell("summary.pieces") if at == 0 else "", text) for at, text in enumerate([*lines, *more])]


def _piece(piece: Piece, names: BlockNames, tell: Words) -> str:
    freed = piece.freed
    mass = f"{piece.mass_g:,.1f} g" if piece.mass_g >= 1.0 else f"{piece.mass_g * 1e3:,.0f} mg"
    text = tell(
        "summary.piece",
        kind=tell(f"summary.kind-{piece.kind}"),
        area=f"{piece.area_mm2:,.2f}",
        mass=mass,
        block=names.at(freed.block),
        time=lasting(freed.t_s),
    )
    if piece.early:
        return tell("summary.piece-early", piece=text, left=f"{mm(piece.cut_after_um):,.3f}")
    if piece.held_after_block is not None:
        return tell("summary.piece-held", piece=text, block=names.at(piece.held_after_block))
    return text


def drawing_rows(run: DryRun, tell: Words) -> list[Row]:
    """How far the cut lies from its drawing."""
    rows: list[Row] = []
    for name, found in (("off-drawing", run.comparison), ("off-drawing-top", run.top)):
        if found is None:
            continue
        most, tolerance = f"{found.max_um:,.2f}", f"{found.request.tolerance_um:g}"
        rows.append(
            (
                tell(f"summary.{name}", drawing=found.drawing.name),
                tell("summary.off-drawing-of", most=most, tolerance=tolerance),
            )
        )
        rows += [("", remark_text(named, tell.language, run.block_names.other)) for named in found.names]
    return rows


_CAUSES = ("interpolation", "carried", "planning", "table", "wire")
_UNITS = {"force": (1.0, "N"), "speed": (1e-3, "mm/s"), "lag": (1.0, "µm")}
_MOST_FINDINGS = 20
_MOST_CLOSURES = 4
_MOST_LIMITS = 3
_LEAST_UM = 0.005  # shown as 0.00


def print_summary(run: DryRun, output: Path | None, language: Language = "en") -> None:
    """Print the figures of a run, its findings and its verdict to stdout."""
    figures = table(run.scenario.title_in(language))
    for row in summary_rows(run, language):
        figures.add_row(*row)
    show(figures)
    _print_findings(run, output, language)
    gap = {"en": " ", "zh": ""}[language]  # Chinese has no blank behind a full stop
    paragraph(gap.join(getattr(sentence, language) for sentence in taken_for_granted(run)), "dim")
    reached = outcome(run.findings)
    say(styled(Words(language)(f"summary.verdict-{reached}"), f"bold {COLOURS[reached]}"))


def _print_findings(run: DryRun, output: Path | None, language: Language) -> None:
    name, width = str(run.scenario.program), width_of(outlet())
    findings = [found for found in run.findings if not isinstance(found.fact, ReadAs)]  # told with what was assumed
    for finding in findings[:_MOST_FINDINGS]:
        excerpt = run.program.excerpt(finding.line) if finding.column else None
        for line in finding_lines(name, finding, excerpt, language, width):
            say(painted(line, finding.severity))
    if len(findings) > _MOST_FINDINGS:
        where = "in-report" if output else "unseen"
        say(Words(language)(f"summary.more-{where}", n=len(findings) - _MOST_FINDINGS))


def summary_rows(run: DryRun, language: Language = "en") -> list[Row]:
    """Names and figures, in the order of the table."""
    tell = Words(language)
    return [
        *_work_rows(run, tell),
        *_times(run, tell),
        *spark_rows(run.process, run.block_names, tell),
        *taper_rows(run.tilted, run.scenario, tell),
        *pass_rows(run, tell),
        *_closures(run, tell),
        *_stopped(run, tell),
        *offset_rows(run, tell),
        *piece_rows(run, tell),
        *_deviations(run, tell),
        *drawing_rows(run, tell),
        *_limits(run.peaks, run.block_names, tell),
    ]


def _work_rows(run: DryRun, tell: Words) -> list[Row]:
    """Machine, program, and what it comes to in all."""
    toolpath, scenario = run.toolpath, run.scenario
    jumps, arcs = int(toolpath.is_jump.sum()), int(toolpath.is_arc.sum())
    kinds = numbered({"line": len(toolpath) - arcs - jumps, "arc": arcs, "jump": jumps})
    wire, how = scenario.wire, value_word(scenario.machine.controller.interpolation)
    widths = {"kerf": f"{mm(wire.kerf_um):g}", "wire": f"{mm(wire.diameter_um):g}", "gap": f"{wire.spark_gap_um:.4g}"}
    lasts = lasting_within(run.ran_s, run.time_s, scenario.technology)
    time = tell("summary.time-of", time=lasts, thickness=f"{scenario.thickness_mm:g}")
    lag = [(tell("summary.wire-lag"), f"{scenario.wire_lag_um:.4g} µm")] if scenario.wire_lag_um else []
    return [
        (tell("summary.machine"), getattr(machine_name(scenario.machine), tell.language)),
        (tell("summary.blocks"), tell("summary.blocks-of", number=f"{len(toolpath):,}", kinds=kinds)),
        (tell("summary.length"), f"{mm(run.ran_um):,.3f} mm"),
        (tell("summary.kerf"), tell("summary.kerf-of", **widths)),
        *lag,
        *_technology(run, tell),
        (tell("summary.steps"), tell("summary.steps-of", number=f"{len(run.stepped):,}", how=how)),
        (tell("summary.time"), time),
    ]


def _technology(run: DryRun, tell: Words) -> list[Row]:
    """What the technology says of each pass that the program has; none without one."""
    technology, material = run.scenario.technology, run.scenario.cut_material
    if technology is None or material is None:
        return []
    most = most_passes(run.passes)
    known = [each for each in run.scenario.pass_technologies if each.number <= most]
    rows = [(tell("summary.technology-pass", number=each.number), _of_pass(each, tell)) for each in known]
    if known and most > known[-1].number:
        rows[-1] = (tell("summary.technology-later", number=known[-1].number), rows[-1][1])
    name = getattr(technology_name(technology), tell.language)
    return [(tell("summary.technology"), tell("summary.technology-of", name=name, material=material)), *rows]


def _of_pass(of_pass: PassTechnology, tell: Words) -> str:
    """Gap, feed and lag of a pass with their intervals, and the worst of their grades."""
    of = {"gap": (of_pass.gap_um, "µm"), "feed": (of_pass.feed_mm_min, "mm/min"), "lag": (of_pass.lag_um, "µm")}
    figures = {name: (figure, unit) for name, (figure, unit) in of.items() if figure is not None}
    said = [
        bilingual(
            f"summary.{name}-within", value=f"{at.value:.3g}", least=f"{at.least:.3g}", most=f"{at.most:.3g}", unit=unit
        )
        for name, (at, unit) in figures.items()
    ]
    text: str = getattr(listed([*said, value_word(worst_grade(at.grade for at, _ in figures.values()))]), tell.language)
    return text


def _times(run: DryRun, tell: Words) -> list[Row]:
    """Time of each contour, where there are some but few."""
    if not 1 < len(run.whole_contours) <= _MOST_CLOSURES:
        return []
    times = [(c, float(run.block_time_s[c.first - 1 : c.last].sum())) for c in run.whole_contours]
    return [
        (tell("summary.time-blocks", **_span(run, contour)), getattr(lasting(time_s), tell.language))
        for contour, time_s in times
    ]


def _span(run: DryRun, contour: Contour) -> dict[str, str]:
    """Names of the first and the last block of a contour."""
    first, last = (run.block_names.at(number) for number in (contour.first, contour.last))
    return {"first": first, "last": last}


def _closures(run: DryRun, tell: Words) -> list[Row]:
    """Closure of each contour; of many, the worst."""
    contours, key = run.whole_contours, "closure-of"
    if len(contours) > _MOST_CLOSURES:
        closing = [each for each in contours if each.has_closure] or contours
        worst = max(closing, key=lambda each: (each.is_open, each.closure_stepped_um))
        contours, key = (worst,), "closure-worst"
    elif len(contours) == 1:
        key = "closure"
    return [(tell(f"summary.{key}", **_span(run, contour)), _closure(contour, tell)) for contour in contours]


def _closure(contour: Contour, tell: Words) -> str:
    if not contour.encloses:
        return tell("summary.closure-none")
    if contour.is_closed_by_others:
        return tell("summary.closure-others")
    exact, stepped = length(contour.closure_exact_um), length(contour.closure_stepped_um)
    figures = tell("summary.closure-figures", exact=exact, stepped=stepped)
    if contour.returns and contour.closure_exact_um > contour.tolerance_um:
        return tell("summary.closure-on-path", figures=figures)
    return figures


def _stopped(run: DryRun, tell: Words) -> list[Row]:
    """Where the machine stopped before its program was through, so that what follows is not cut."""
    ended = run.ended
    if ended is None:
        return []
    where = {"block": run.block_names.of_row(ended.row), "time": lasting(ended.t_s), "axis": ended.axis.name}
    return [(tell("summary.stopped"), tell(f"summary.stopped-{ended.cause}", **where))]


def _deviations(run: DryRun, tell: Words) -> list[Row]:
    """Deviation of the cut, and what each cause adds."""
    if not len(run.stepped):
        return [(tell("summary.deviation"), tell("summary.no-motion"))]
    whole, names = run.deviations.wire, run.block_names
    causes = run.deviations.by_cause._asdict()
    parts = [
        (tell(f"summary.by-{cause}"), _largest(causes[cause].max_um, causes[cause].where, names, tell))
        for cause in _CAUSES
    ]
    return [(tell("summary.deviation"), _largest(whole.max_um, whole.where, names, tell)), *parts]


def _largest(max_um: float, where: Where | None, names: BlockNames, tell: Words) -> str:
    if where is None or max_um < _LEAST_UM:
        return tell("summary.none")
    place = {"block": names.at(where.block), "x": mm_text(where.x_um), "y": mm_text(where.y_um)}
    return tell("summary.largest", most=length(max_um), **place)


def _limits(peaks: tuple[Peak, ...], blocks: BlockNames, tell: Words) -> list[Row]:
    """The limits that were come nearest to."""
    limited = sorted((peak for peak in peaks if math.isfinite(peak.limit)), key=lambda peak: -peak.share)
    names = (tell("summary.limits"), *[""] * (_MOST_LIMITS - 1))
    return [(name, _limit(peak, blocks, tell)) for name, peak in zip(names, limited, strict=False)]


def _limit(peak: Peak, names: BlockNames, tell: Words) -> str:
    scale, unit = _UNITS[peak.quantity]
    what = tell(f"summary.limit-{peak.quantity}")
    met = {"share": _percent(peak.share), "limit": in_figures(peak.limit * scale), "unit": unit}
    place = {"block": names.of_row(peak.row), "x": mm_text(peak.x_um, 1), "y": mm_text(peak.y_um, 1)}
    return tell("summary.limit", what=what, axis=peak.axis.name, **met, **place)


def _percent(share: float) -> str:
    return "<1 %" if share < 0.01 else f"{100.0 * share:.0f} %"
