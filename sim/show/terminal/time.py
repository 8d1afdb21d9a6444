"""Times on the terminal: each program with its interval, what the whole is made of, what it costs, what to know."""

from collections.abc import Sequence

from rich.table import Table

from parser.findings.catalogue import Bilingual, Language, Remark
from sim.measure.factor import UNKNOWN, Interval
from sim.run.times.cost import Cost
from sim.run.times.estimate import Estimate
from sim.run.times.predicted import Predicted
from sim.show.terminal.layout import paragraph, show, table
from sim.show.texts import Words
from sim.show.texts.phrases import lasting, lasting_within, with_interval


def print_times(whole: Estimate, programs: Sequence[tuple[Predicted, Estimate]], language: Language) -> None:
    """Print times to stdout."""
    tell = Words(language)
    show(_programs(whole, programs, tell))
    paragraph(_whole(whole, tell), "bold")
    show(_terms(whole, tell))
    if whole.cost is not None:
        show(_cost(whole.cost, tell))
    for note in whole.notes:
        paragraph(tell("time.note", text=note_text(note, language)), "cyan")


def note_text(note: Remark, language: Language) -> str:
    """What a time was made without, for people."""
    return Words(language)(f"time.note-{note.name}", **note.values)


def _programs(whole: Estimate, programs: Sequence[tuple[Predicted, Estimate]], tell: Words) -> Table:
    heads = tuple(tell(f"time.head-{name}") for name in ("program", "length", "height", "passes", "time", "between"))
    rows = table("", heads, right=(1, 2, 3, 4))
    for of, estimate in programs:
        length, height = f"{of.length_mm:,.1f} mm", f"{of.height_mm:g} mm"
        rows.add_row(of.name, length, height, str(of.passes), *_times(estimate, tell))
    if len(programs) > 1:
        rows.add_row(tell("time.all"), "", "", "", *_times(whole, tell))
    return rows


def _times(estimate: Estimate, tell: Words) -> tuple[str, str]:
    """The middle, and the interval."""
    least, middle, most = (_in(lasting(60.0 * value), tell) for value in estimate.minutes[:3])
    is_known = estimate.from_cuts or estimate.technology is not None
    return middle, f"{least} … {most}" if is_known else f"± {round(100.0 * UNKNOWN)} %"


def _whole(estimate: Estimate, tell: Words) -> str:
    least, middle, most, level = estimate.minutes
    time_s = Interval(60.0 * least, 60.0 * middle, 60.0 * most, level)
    if estimate.technology is not None:
        return _in(lasting_within(60.0 * middle, time_s, estimate.technology), tell)
    return _in(with_interval(time_s, estimate.from_cuts), tell)


def _in(text: Bilingual, tell: Words) -> str:
    return text.zh if tell.language == "zh" else text.en


def _terms(whole: Estimate, tell: Words) -> Table:
    rows = table(tell("time.terms"), ("", "", ""), right=(1,))
    for term in whole.terms:
        name = tell(f"time.term-{term.name}")
        many = name if not term.times else tell("time.term-times", name=name, times=term.times)
        lasts = _in(lasting(60.0 * abs(term.minutes)), tell)
        rows.add_row(many, f"−{lasts}" if term.minutes < 0.0 else lasts, tell(f"time.grade-{term.grade}"))
    return rows


def _cost(cost: Cost, tell: Words) -> Table:
    rows = table(tell("time.cost", currency=cost.currency))
    for item in cost.items:
        rows.add_row(tell(f"time.cost-{item.name}"), f"{item.amount:,.2f}")
    ends = {"total": cost.total, "least": cost.least, "most": cost.most}
    between = tell("time.cost-between", **{name: f"{amount:,.2f}" for name, amount in ends.items()})
    rows.add_row(tell("time.cost-total"), between)
    return rows
