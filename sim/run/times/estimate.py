"""An estimate: what was predicted, times what the shop's own cuts say, with its interval and its cost."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from parser.findings.catalogue import Remark
from sim.measure.factor import Factor, Interval, factor_of, interval_of
from sim.run.times.cost import Cost, cost_of
from sim.run.times.log import Log
from sim.run.times.predicted import Predicted, Term
from sim.setup.shop import Rates
from sim.setup.technology import LEVEL, Technology


class Estimate(NamedTuple):
    """How long one or several programs take.

    Attributes
    ----------
    minutes, from_cuts
        With their interval; and how many of the shop's own cuts say so.
    terms
        Parts that add up to the middle.
    cost
        What it costs; None where no rates are given.
    notes
        What it was made without: names of texts ``time.note-…``.
    technology
        What the interval is of; None where it is of the shop's own cuts, or of nothing.
    """

    minutes: Interval
    from_cuts: int
    terms: tuple[Term, ...]
    cost: Cost | None
    notes: tuple[Remark, ...] = ()
    technology: Technology | None = None


def estimated(programs: Sequence[Predicted], log: Log, rates: Rates | None) -> Estimate:
    """How long programs take together, one or more; their terms by name."""
    whole = sum(program.minutes for program in programs)
    shares = np.array([program.minutes / whole if whole else 1.0 / len(programs) for program in programs])
    unlike = [log.unlike_sd(program.height_mm, program.passes) for program in programs]
    factor = factor_of(log.log_ratios, float(shares @ np.array(unlike)), shares)
    minutes, technology = interval_of(whole, factor), None if log.cuts else _technology(programs)
    if technology is not None:
        less, more = (sum(getattr(each, name) for each in programs) for name in ("less_min", "more_min"))
        minutes = Interval(whole - less, whole, whole + more, LEVEL)
    terms = (*_together(programs), *_learned(whole, factor))
    cost = None if rates is None else cost_of(minutes.least, minutes.middle, minutes.most, rates, len(programs))
    return Estimate(minutes, factor.from_cuts, terms, cost, tuple(_notes(programs, log)), technology)


def _technology(programs: Sequence[Predicted]) -> Technology | None:
    """The technology of all programs; None where one has another, or none."""
    first = programs[0].technology
    return first if all(each.technology == first for each in programs) else None


def _together(programs: Sequence[Predicted]) -> list[Term]:
    """The terms of all programs, those of one name and grade added up."""
    found: dict[tuple[str, str], Term] = {}
    for term in (term for program in programs for term in program.terms):
        before = found.get((term.name, term.grade), term._replace(minutes=0.0, times=None if term.times is None else 0))
        times = None if term.times is None or before.times is None else term.times + before.times
        found[term.name, term.grade] = term._replace(minutes=before.minutes + term.minutes, times=times)
    return list(found.values())


def _learned(whole: float, factor: Factor) -> list[Term]:
    return [Term("learned", (factor.middle - 1.0) * whole, "measured")] if factor.from_cuts else []


def _notes(programs: Sequence[Predicted], log: Log) -> list[Remark]:
    """What no logged cut was like, and what of the log is to be looked at."""
    if not log.cuts:
        return []
    least, most = log.heights_mm
    outside = sorted({program.height_mm for program in programs if not least <= program.height_mm <= most})
    known = {cut.passes for cut in log.cuts}
    unlike = sorted({program.passes for program in programs} - known)
    return [
        *(Remark("outside-heights", {"height": height, "least": least, "most": most}) for height in outside),
        *(Remark("unlike-passes", {"passes": passes}) for passes in unlike),
        *(Remark("odd-row", {"line": cut.line, "ratio": cut.ratio}) for cut in log.odd[:5]),
        *([Remark("not-cut", {"number": log.not_cut})] if log.not_cut else []),
    ]
