"""Panels: what each shows of a run's history, in units for people, with its levels, and over which range."""

import math
from collections.abc import Iterable
from typing import Final, NamedTuple

import numpy as np

from parser.controller_words import Axis
from parser.geometry.curves import Floats, Ints
from parser.units import mm
from sim.base.units import in_figures
from sim.run.dryrun import DryRun
from sim.show.draw.chart import AxisRange, range_of
from sim.show.draw.paints import Paint
from sim.show.texts import Words
from sim.table.record.bins import Envelope
from sim.table.record.history import History
from sim.table.record.losses import Quantity

ROOM: Final = 0.08
"""Share of its range that a panel leaves free at either side."""
REACH: Final = 0.3
"""Share of the range by which a panel grows to show a level."""
_MOST_FEEDS = 3


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
        return say(self.key, value=in_figures(self.value), axes=self.axes)


class Panel(NamedTuple):
    """What a panel shows: the key of its name, an envelope and levels in its unit, and the least range."""

    name: str
    envelope: Envelope
    levels: list[Level]
    least: float

    @property
    def range(self) -> AxisRange:
        """From the lowest to the highest, and to levels just outside."""
        shown_range = range_of(self.envelope.low, self.envelope.high, least=self.least)
        reach, levels = shown_range.wider(REACH), np.array([level.value for level in self.levels])
        both = np.concatenate([levels, -levels])
        near = both[(both >= reach.low) & (both <= reach.high)]
        return range_of(np.array(shown_range), near).wider(ROOM)


def panels_of(run: DryRun, most: int) -> tuple[Floats, list[Panel]]:
    """Times (b + 1,) s of up to `most` bins, and the panels from above, with those bins."""
    motor = run.scenario.machine.table.motor
    history = run.history
    t_s, pooled = _pooled(history, most)
    lag = limit_levels(run, "lag", "motion.pull_out" if motor.kind == "stepper" else "motion.servo_limit")
    speed = [*feed_levels(run), *limit_levels(run, "speed", "motion.speed_limit", mm(1.0))]
    return t_s, [
        Panel("motion.velocity", _in_mm(pooled[0]), speed, least=0.01),
        Panel("motion.acceleration", _in_mm(pooled[1]), [], least=1.0),
        Panel("motion.error", pooled[2], lag, least=1.0),
        Panel("motion.force", pooled[3], limit_levels(run, "force", "motion.force_limit"), least=1.0),
    ]


def _in_mm(envelope: Envelope) -> Envelope:
    return Envelope._make(mm(column) for column in envelope)


def _pooled(history: History, most: int) -> tuple[Floats, list[Envelope]]:
    """The history in no more than `most` bins, none too narrow to be seen: nothing that is short gets lost."""
    bins = len(history.t_s) - 1
    first = np.unique(np.arange(min(most, bins)) * bins // min(most, bins))
    t_s = np.append(history.t_s[first], history.t_s[-1])
    series = (history.velocity_um_s, history.acceleration_um_s2, history.following_error_um, history.force_n)
    return t_s, [_pool(envelope, first, np.diff(history.t_s)) for envelope in series]


def _pool(envelope: Envelope, first: Ints, width_s: Floats) -> Envelope:
    area = np.add.reduceat(envelope.mean * width_s[:, None], first, axis=0)
    return Envelope(
        low=np.minimum.reduceat(envelope.low, first, axis=0),
        high=np.maximum.reduceat(envelope.high, first, axis=0),
        mean=area / np.add.reduceat(width_s, first)[:, None],
    )


def feed_levels(run: DryRun) -> list[Level]:
    """Feeds of cuts and of jumps, mm/s, as far as there are any; of many passes the lowest and the highest."""
    if run.feeds is None:
        return []
    jumps = run.toolpath.is_jump
    cut = np.unique(np.broadcast_to(run.feeds.cut_um_s, len(jumps))[~jumps])
    if len(cut) > _MOST_FEEDS:
        cut = cut[[0, -1]]
    jump = [run.feeds.jump_um_s] if jumps.any() else []
    levels = [("motion.cut_feed", cut.tolist()), ("motion.jump_feed", jump)]
    return [Level(key, mm(feed), "", Paint.GREY) for key, feeds in levels for feed in feeds]


def limit_levels(run: DryRun, quantity: Quantity, key: str, scale: float = 1.0) -> list[Level]:
    """Limits of both axes at the moments when the axes came nearest to them, times `scale`; equal ones as one level."""
    limits = [(peak.limit * scale, peak.axis) for peak in run.peaks if peak.quantity == quantity]
    finite = [(in_figures(value), value, axis) for value, axis in limits if math.isfinite(value)]
    same = {figures: value for figures, value, _ in finite}
    return [
        Level(key, value, _axes(axis for of, _, axis in finite if of == figures), Paint.ERROR)
        for figures, value in same.items()
    ]


def _axes(axes: Iterable[Axis]) -> str:
    return ", ".join(axis.name for axis in sorted(axes))
