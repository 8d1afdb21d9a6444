"""Levels: the feeds that a run is planned at, and the limits that its drives are held against."""

import math
from collections.abc import Iterable
from typing import NamedTuple

from parser.toolpath import Axis
from parser.units import mm
from sim.run.dryrun import DryRun
from sim.show.draw.paints import Paint
from sim.show.words import Words
from sim.table.record.peaks import Quantity


class Level(NamedTuple):
    """A magnitude that a panel shows on both sides of 0.

    Attributes
    ----------
    key
        Of its text.
    value
        In the unit of the panel.
    axes
        Whose it is, such as ``X, Y``; empty where it is that of the path.
    paint
        What it is drawn in.
    """

    key: str
    value: float
    axes: str
    paint: Paint

    def text(self, say: Words) -> str:
        """What it is, with three figures of its value."""
        return say(self.key, value=three_figures(self.value), axes=self.axes)


def feed_levels(run: DryRun) -> list[Level]:
    """Feeds of cuts and jumps, mm/s, as far as there are any."""
    feeds = run.scenario.machine.feeds(run.scenario.thickness_mm)
    jumps = run.toolpath.is_jump
    shown = (("motion.cut_feed", feeds.cut_um_s, not jumps.all()), ("motion.jump_feed", feeds.jump_um_s, jumps.any()))
    return [Level(key, mm(feed), "", Paint.GREY) for key, feed, there in shown if there]


def limit_levels(run: DryRun, quantity: Quantity, key: str, scale: float = 1.0) -> list[Level]:
    """Limits of both axes where they came nearest to them, times `scale`: one level where they are the same."""
    limits = [(peak.limit * scale, peak.axis) for peak in run.peaks if peak.quantity == quantity]
    finite = [(three_figures(value), value, axis) for value, axis in limits if math.isfinite(value)]
    same = {figures: value for figures, value, _ in finite}
    return [
        Level(key, value, _axes(axis for of, _, axis in finite if of == figures), Paint.ERROR)
        for figures, value in same.items()
    ]


def _axes(axes: Iterable[Axis]) -> str:
    return ", ".join(axis.name for axis in sorted(axes))


def three_figures(value: float) -> str:
    """A value above 0, to three figures."""
    return f"{round(value, 2 - math.floor(math.log10(value))):,.10g}"
