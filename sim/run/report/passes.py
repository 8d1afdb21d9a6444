"""Entries of the report on each pass over an edge."""

from typing import Any

from sim.measure.passes.figures import PassFigures
from sim.measure.passes.stock import Stock
from sim.rounded import rounded
from sim.run.dryrun import DryRun


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
