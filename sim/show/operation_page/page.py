"""The two pages of drills of operation, each a file that needs no other; the strips of the instruments as SVG."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any, Final

import numpy as np

from parser.findings.catalogue import Bilingual
from parser.geometry.curves import Floats
from parser.text.encoding import printable
from parser.units import mm_text
from sim.process.cut import Started
from sim.process.ticks import state as ticks
from sim.show.draw.svg import path_data
from sim.show.html.environment import rendered
from sim.show.operation_page.model import OperationEntry
from sim.show.panel_page.page import panel_entry
from sim.show.texts import bilingual
from sim.teach.operation.incidents import ACTIONS, KINDS, REMEDIES, OperationDrill

_ASSETS: Final = Path(__file__).with_name("assets")
WIDTH, HEIGHT = 560, 90
"""Of the box of a strip, whole units; y points down."""
_EDGE: Final = 4.0
_STANDS: Final = {
    ticks.RUNNING: "runs",
    ticks.IN_VAIN: "in-vain",
    ticks.SHORTED: "shorted",
    ticks.STALLED: "stalled",
    ticks.BREAKS_AGAIN: "breaks-again",
    ticks.BROKEN: "broken",
    ticks.POWERLESS: "powerless",
    ticks.FINISHED: "runs",
}


def operation_page(title: Bilingual, cut: Started, drills: Sequence[OperationDrill], number: int) -> str:
    """The page of a set of drills: the same set gives the same bytes. What the program says stands escaped."""
    return rendered(
        _ASSETS,
        "operation.html.j2",
        data=operation_entry(cut, drills, number),
        **_template_values(title, cut, drills, number),
    )


def operation_answers_page(title: Bilingual, cut: Started, drills: Sequence[OperationDrill], number: int) -> str:
    """The sheet of answers, for paper too: what happened, and one way that is proved to mend it."""
    return rendered(_ASSETS, "operation_answers.html.j2", **_template_values(title, cut, drills, number))


def _template_values(title: Bilingual, cut: Started, drills: Sequence[OperationDrill], number: int) -> dict[str, Any]:
    return {
        "title": title,
        "number": number,
        "drills": [_view(cut, drill) for drill in drills],
        "kinds": KINDS,
        "actions": ACTIONS,
        "box": (WIDTH, HEIGHT),
    }


def _view(cut: Started, drill: OperationDrill) -> dict[str, Any]:
    """What the templates show of a drill."""
    state, counters, source = drill.state, drill.counters, cut.work.toolpath.source
    low, high = source.span[counters.row].tolist()
    volts, amps = drill.strip[-1, 1:].tolist()
    now = state[ticks.TICKS]
    return {
        "kind": drill.kind,
        "remedy": REMEDIES[drill.kind],
        "stands": bilingual(f"operation.stands-{_STANDS[drill.came_to]}"),
        "block": source.names.of_row(counters.row),
        "text": printable(source.text[low:high]),
        "counters": {
            "x": mm_text(counters.x_um),
            "y": mm_text(counters.y_um),
            "j": counters.count_left_um,
        },
        "volts": f"{volts * cut.spark.open_v:.0f}",
        "amps": f"{100.0 * amps:.0f}",
        "set_value": f"{state[ticks.SET_SHARE]:.2f}",
        "pump": bool(state[ticks.PUMPLESS_UNTIL] <= now),
        "drum": bool(state[ticks.DRUMLESS_UNTIL] <= now),
        "voltage": _line(drill.strip, 1),
        "current": _line(drill.strip, 2),
        "seconds": f"{-drill.strip[0, 0]:.0f}",
    }


def _line(strip: Floats, column: int) -> str:
    """SVG path data of a strip: time to the right, the share upward."""
    x = _EDGE + (WIDTH - 2.0 * _EDGE) * (1.0 - strip[:, 0] / min(strip[0, 0], -1e-3))
    y = HEIGHT - _EDGE - (HEIGHT - 2.0 * _EDGE) * np.clip(strip[:, column], 0.0, 1.0)
    return path_data(np.column_stack([x, y]))


def operation_entry(cut: Started, drills: Sequence[OperationDrill], number: int) -> OperationEntry:
    """What the page hands over to its script."""
    return {
        "set": number,
        "panel": panel_entry(cut),
        "drills": [{"kind": drill.kind, "state": drill.state.tolist(), "least_um": drill.least_um} for drill in drills],
        "kinds": list(KINDS),
        "actions": list(ACTIONS),
    }
