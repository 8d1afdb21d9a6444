"""What a replay shows of a cut under sparks: the instruments at each step, and what happened in each block."""

from typing import TypedDict

import numpy as np

from parser.documents import SaidEntry
from sim.run.dryrun import DryRun
from sim.show.spark_rows import event_words

_MOST_ROWS = 2000


class SparkEventEntry(TypedDict):
    """Something that happened: in which row of the toolpath, when in the cut under sparks, and its words."""

    row: int
    t_s: float
    what: SaidEntry


class SparkTapeEntry(TypedDict):
    """Means of the instruments, in the order of the steps at which they were seen."""

    open_v: float
    set_share: float | None
    step: list[int]
    t_s: list[float]
    voltage: list[float]
    current: list[float]
    events: list[SparkEventEntry]


def spark_tape(run: DryRun) -> SparkTapeEntry | None:
    """The tape of a run; None without sparks."""
    process = run.process
    if process is None:
        return None
    rows = process.history[np.argsort(process.history[:, 1], kind="stable")]
    rows = rows[:: max(-(-len(rows) // _MOST_ROWS), 1)]
    happened = [*process.moments, *([process.stopped] if process.stopped else [])]
    return {
        "open_v": process.spark.open_v,
        "set_share": process.spark.filled.set_value if process.spark.law == "voltage" else None,
        "step": rows[:, 1].astype(np.int64).tolist(),
        "t_s": rows[:, 0].round(1).tolist(),
        "voltage": rows[:, 2].round(3).tolist(),
        "current": rows[:, 3].round(3).tolist(),
        "events": [{"row": each.row, "t_s": round(each.t_s, 1), "what": _in_both(each.kind)} for each in happened],
    }


def _in_both(kind: str) -> SaidEntry:
    words = event_words(kind)
    return {"en": words.en, "zh": words.zh}
