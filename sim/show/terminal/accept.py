"""A measured piece on the terminal: sizes and forms by their limits, what is missing, what explains it, the verdict."""

from parser.findings.catalogue import Language
from parser.units import mm
from sim.measure.accept.gap import MeasuredGap
from sim.measure.accept.judge import Judged, Judgement
from sim.show.terminal.layout import paragraph, show, table
from sim.show.texts import Words

_STYLES = {"pass": "bold green", "to-check": "bold yellow", "incomplete": "bold yellow", "fail": "bold red"}


def print_judgement(of: Judgement, gap: MeasuredGap | None, language: Language) -> None:
    """Print a judgement to stdout, and the gap if it was asked for."""
    tell = Words(language)
    heads = tuple(tell(f"accept.head-{name}") for name in ("feature", "z", "value", "deviation", "limits", "verdict"))
    rows = table(tell("accept.title"), heads, (1, 2, 3))
    for each in of.judged:
        rows.add_row(*_row(each, tell))
    show(rows)
    for cause in of.causes:
        by = f"{cause.value_um:+.1f} ± {cause.by_um:.1f} µm".replace("-", "−")
        paragraph(tell("accept.cause", by=by, text=tell(f"accept.cause-{cause.name}")), "cyan")
    if gap is not None:
        by = f"{gap.gap_um:.1f} ± {gap.by_um:.1f} µm".replace("-", "−")
        paragraph(tell("accept.gap", by=by, sizes=gap.sizes), "cyan")
    for name in of.missing:
        paragraph(tell("accept.missing", name=name), "yellow")
    for name in of.without_limits:
        paragraph(tell("accept.without-limits", name=name), "cyan")
    paragraph(tell(f"accept.verdict-{of.verdict}"), _STYLES[of.verdict])


def _row(each: Judged, tell: Words) -> tuple[str, ...]:
    name = each.feature.name if each.what == "size" else tell("accept.form", name=each.feature.name)
    limits = f"{each.lower_um:+g} … {each.upper_um:+g}" if each.what == "size" else f"≤ {each.upper_um:g}"
    value = f"{mm(each.value_um):.4f} mm" if each.what == "size" else f"{each.value_um:.1f} µm"
    deviation = f"{each.deviation_um:+.1f} ± {each.uncertainty_um:.1f}"
    return (
        name,
        "" if each.z_mm is None else f"{each.z_mm:g}",
        value,
        deviation.replace("-", "−"),
        limits.replace("-", "−"),
        tell(f"accept.{each.verdict}"),
    )
