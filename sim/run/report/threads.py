"""Entries of the report on where the wire is threaded, and taken out again."""

from typing import Any

from sim.measure.threadings import Threading, threadings
from sim.rounded import moment, rounded
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
