"""Times as data, schema ``drycut.time/1`` (docs/time.md), and as rows of a CSV file."""

import csv
import io
import json
from collections.abc import Callable, Sequence
from typing import Final

from parser import __version__
from parser.findings.catalogue import Remark
from sim.base.units import rounded
from sim.run.times.cost import Cost
from sim.run.times.estimate import Estimate
from sim.run.times.log import Log
from sim.run.times.model import (
    CostEntry,
    EstimateEntry,
    LogEntry,
    MinutesEntry,
    ProgramTimeEntry,
    TermEntry,
    TimeDocument,
)
from sim.run.times.predicted import Predicted, Term

Tell = Callable[[Remark], str]
_COLUMNS: Final = (
    ("program", "length_mm", "height_mm", "passes"),
    ("least_min", "middle_min", "most_min", "level", "from_cuts"),
    ("currency", "cost_least", "cost", "cost_most"),
)


def document(whole: Estimate, programs: Sequence[tuple[Predicted, Estimate]], log: Log, tell: Tell) -> TimeDocument:
    """Times of programs as plain lists, dicts, numbers and None; `tell` has the texts of notes."""
    return {
        "schema": "drycut.time/1",
        "drycut": __version__,
        **_estimate(whole, tell),
        "programs": [_program(of, estimate, tell) for of, estimate in programs],
        "log": _log(log) if log.file else None,
    }


def document_text(whole: Estimate, programs: Sequence[tuple[Predicted, Estimate]], log: Log, tell: Tell) -> str:
    """The document as JSON."""
    return json.dumps(document(whole, programs, log, tell), ensure_ascii=False, allow_nan=False, indent=2) + "\n"


def rows_text(programs: Sequence[tuple[Predicted, Estimate]]) -> str:
    """A row of CSV for each program, with a first row of names."""
    text = io.StringIO()
    write = csv.writer(text, lineterminator="\n")
    is_priced = any(estimate.cost for _, estimate in programs)
    write.writerow([name for names in _COLUMNS[: 2 + is_priced] for name in names])
    for of, estimate in programs:
        minutes, cost = estimate.minutes, estimate.cost
        row: list[object] = [_harmless(of.name), f"{of.length_mm:.3f}", f"{of.height_mm:g}", of.passes]
        row += [f"{value:.2f}" for value in minutes[:3]] + [minutes.level, estimate.from_cuts]
        if cost is not None:
            row += [_harmless(cost.currency), cost.least, cost.total, cost.most]
        write.writerow(row)
    return text.getvalue()


def _harmless(text: str) -> str:
    """A text that no spreadsheet takes for a formula."""
    return f"'{text}" if text[:1] in ("=", "+", "-", "@", "\t", "\r") else text


def _estimate(estimate: Estimate, tell: Tell) -> EstimateEntry:
    return {
        "minutes": minutes_entry(estimate),
        "from_cuts": estimate.from_cuts,
        "terms": [_term(term) for term in estimate.terms],
        "cost": None if estimate.cost is None else _cost(estimate.cost),
        "notes": [tell(note) for note in estimate.notes],
    }


def minutes_entry(estimate: Estimate) -> MinutesEntry:
    """A time with its interval."""
    least, middle, most, level = estimate.minutes
    return {"least": rounded(least), "middle": rounded(middle), "most": rounded(most), "level": level}


def _program(of: Predicted, estimate: Estimate, tell: Tell) -> ProgramTimeEntry:
    return {
        "program": of.name,
        "length_mm": rounded(of.length_mm),
        "height_mm": rounded(of.height_mm),
        "passes": of.passes,
        **_estimate(estimate, tell),
    }


def _term(term: Term) -> TermEntry:
    return {"name": term.name, "minutes": rounded(term.minutes), "grade": term.grade, "times": term.times}


def _cost(cost: Cost) -> CostEntry:
    return {
        "currency": cost.currency,
        "items": [{"name": item.name, "amount": float(item.amount)} for item in cost.items],
        "total": float(cost.total),
        "least": float(cost.least),
        "most": float(cost.most),
    }


def _log(log: Log) -> LogEntry:
    return {
        "file": log.file,
        "cuts": len(log.cuts),
        "not_cut": log.not_cut,
        "heights_mm": [*map(rounded, log.heights_mm)] if log.cuts else None,
        "passes": sorted({cut.passes for cut in log.cuts}),
    }
