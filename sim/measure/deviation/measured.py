"""All that is measured of a run: deviation of its steps, its table and its wire, and what each cause adds to it."""

from typing import NamedTuple

import numpy as np

from controller.stepping.pulses import Pulses
from controller.stepping.steps import Steps
from parser.geometry.curves import Floats
from sim.measure.deviation.across import across_um, summed
from sim.measure.deviation.causes import NOTHING, Causes, Part, Stage, added, cut_off, whole
from sim.measure.deviation.deviation import Deviation
from sim.measure.deviation.meters import Sampling, SamplingMeter, StepMeters, StepTally
from sim.table.motion import Motion
from sim.table.trace import Trace


class Deviations(NamedTuple):
    """Deviation of steps, table and wire from the ideal geometry.

    `steps` is measured where the steps are. For `interpolation` the steps of each block are moved back by what they
    were off when the block began, so that what earlier blocks missed does not count. Where the wire does not bow,
    `wire` is the same as `table`. `by_cause` tells what each stage adds. `sampling` is None unless the card
    interpolates.
    """

    interpolation: Deviation
    steps: Deviation
    table: Deviation
    wire: Deviation
    by_cause: Causes
    sampling: Sampling | None


class Meters:
    """All that is measured of the pulses of a run, and of the trace that they make."""

    def __init__(self, motion: Motion, steps: Steps) -> None:
        drive = motion.drive
        self._toolpath, self._plan = drive.toolpath, drive.plan
        own = drive.interpolation == "card"
        start = drive.toolpath.start_um
        drift = np.array(drive.origin_um) - (start[:1] if own else start - steps.corner_um[:-1])
        self._drift: Floats = np.broadcast_to(drift, start.shape)
        self._steps = StepMeters(drive, self._drift)
        self._period_s = motion.card.servo_period_s
        self._sampling = SamplingMeter(drive, self._period_s) if own else None
        self.tally = StepTally(len(drive.toolpath), drive.origin_um)

    def take(self, pulses: Pulses) -> None:
        """Take the next pulses."""
        self._steps.take(pulses)
        self.tally.take(pulses)
        if self._sampling is not None:
            self._sampling.take(pulses)

    def deviations(self, trace: Trace) -> Deviations:
        """Of all pulses so far, and of the trace that they made."""
        along_um = self._plan.at(trace.t_s).along_um
        commanded, table = (self._stage(trace, along_um, place) for place in (trace.commanded_um, trace.table_um))
        bows = trace.wire_um is not trace.table_um
        wire = self._stage(trace, along_um, trace.wire_um) if bows else table
        sampling = self._sampling.result() if self._sampling is not None else None
        of_table = summed(self._toolpath, trace, *table)
        return Deviations(
            interpolation=self._steps.own,
            steps=self._steps.placed,
            table=of_table,
            wire=summed(self._toolpath, trace, *wire) if bows else of_table,
            by_cause=Causes(
                interpolation=whole(self._steps.own if sampling is None else sampling.rounding),
                carried=self._carried(trace, along_um, commanded),
                planning=NOTHING if sampling is None else cut_off(self._toolpath, trace, self._plan, self._period_s),
                table=added(trace, table, commanded),
                wire=added(trace, wire, table) if bows else NOTHING,
            ),
            sampling=sampling,
        )

    def _stage(self, trace: Trace, along_um: Floats, place_um: Floats) -> Stage:
        return Stage(place_um, across_um(self._toolpath, trace, place_um, along_um))

    def _carried(self, trace: Trace, along_um: Floats, commanded: Stage) -> Part:
        """What the command adds to where it would be without what the blocks before missed."""
        if not self._drift.any():
            return NOTHING
        own_um = trace.commanded_um - self._drift[trace.row]
        return added(trace, commanded, self._stage(trace, along_um, own_um))
