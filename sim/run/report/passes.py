"""Entries of the report on each pass over an edge.

Entries of the report on where the wire is threaded, and taken out again.
"""

from typing import Any

from sim.base.rounded import moment, rounded
from sim.measure.passes.figures import PassFigures
from sim.measure.passes.stock import Stock
from sim.measure.threadings import Threading, threadings
from sim.run.dryrun import DryRun


def thread_entries(run: DryRun) -> list[dict[str, Any]]:
    """All of ``thread_points[]``; times are None where the run ended before."""
    return [_thread(one, run) for one in threadings(run.toolpath, run.border_s)]


def _thread(one: Threading, run: DryRun) -> dict[str, Any]:
    begins, ends = one.at_s <= run.ran_s, run.ended is None or one.last < run.ended.row
    return {
        "blocks": [one.first + 1, one.last + 1],
        "at_um": [rounded(along) for along in one.at_um],
        "at_s": moment(one.at_s, run.ran_s) if begins else None,
        "out_um": [rounded(along) for along in one.out_um],
        "out_s": moment(one.out_s, run.ran_s) if ends else None,
        "left_um": rounded(one.left_um),
        "right_um": rounded(one.right_um),
        "down_um": rounded(one.down_um),
        "up_um": rounded(one.up_um),
    }


def pass_entries(run: DryRun) -> list[dict[str, Any]]:
    """All of ``passes[]``."""
    return [_pass(figures, run.scenario.wire.reach_um) for figures in run.pass_figures]


def _pass(figures: PassFigures, reach_um: float) -> dict[str, Any]:
    one, worst = figures.of, figures.worst
    return {
        "contour": one.edge + 1,
        "number": one.number,
        "blocks": [one.first + 1, one.last + 1],
        "offset_um": rounded(one.offset_um(reach_um)),
        "direction": "back" if one.is_back else "forward",
        "cuts_tab": one.is_tab,
        "length_um": rounded(figures.length_um),
        "time_s": rounded(figures.time_s),
        "stock_um": _stock(figures.stock),
        "deviation": {
            "max_um": 0.0 if worst is None else rounded(worst.deviation_um),
            "where_um": None if worst is None else [rounded(along) for along in worst.place_um],
        },
    }


def _stock(stock: Stock | None) -> dict[str, float] | None:
    if stock is None:
        return None
    return {"least": rounded(stock.least_um), "most": rounded(stock.most_um), "mean": rounded(stock.mean_um)}
