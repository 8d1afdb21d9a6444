"""Deviation of every sample of a cut, left of the path positive: the numbers that the pictures of deviation show."""

from dataclasses import dataclass

import numpy as np

from parser.geometry.curves import Bools, Floats
from sim.measure.deviation.across import across, across_um
from sim.measure.deviation.deviation import Where
from sim.run.dryrun import DryRun
from sim.setup.part import DEFAULT_TOLERANCE_UM
from sim.table.trace import Trace


@dataclass(frozen=True, slots=True, eq=False)
class Samples:
    """Deviations at the n ≥ 1 samples of a run's trace, as far as the machine ran.

    They are the distances that the report sums up, left of the direction of travel positive.

    Attributes
    ----------
    run
        The run.
    trace
        Its trace, up to a trip where there was one.
    along_um
        (n,) float64, path length that was planned by each sample, jumps included; never falling.
    cutting
        (n,) whether the wire was cutting, not on a jump.
    steps_um, table_um, wire_um
        (n,) float64, deviation of the place commanded, of the table and of the wire.
    foot_um
        (n, 2) float64, places on the path that the deviation of the wire is measured from.
    """

    run: DryRun
    trace: Trace
    along_um: Floats
    cutting: Bools
    steps_um: Floats
    table_um: Floats
    wire_um: Floats
    foot_um: Floats

    def __len__(self) -> int:
        return len(self.along_um)

    @property
    def tolerance_um(self) -> float:
        """What the cut is held to: the tolerance of its drawing, or of a first cut."""
        drawing = self.run.scenario.drawing
        return DEFAULT_TOLERANCE_UM if drawing is None else drawing.tolerance_um

    @property
    def worst(self) -> int | None:
        """Sample of the wire's largest deviation in the cut; None where nothing was cut."""
        off = np.where(self.cutting, np.abs(self.wire_um), -1.0)
        at = int(np.argmax(off))
        return at if off[at] >= 0.0 else None

    @property
    def max_um(self) -> float:
        """The wire's largest deviation in the cut."""
        return float(np.abs(self.wire_um[self.cutting]).max(initial=0.0))

    @property
    def p95_um(self) -> float:
        """95 % of the cut deviate no more than this."""
        off = np.abs(self.wire_um[self.cutting])
        return float(np.quantile(off, 0.95, method="inverted_cdf")) if len(off) else 0.0

    def where(self, at: int) -> Where:
        """Place of the wire at a sample."""
        x, y = self.trace.wire_um[at].tolist()
        return Where(int(self.trace.row[at]) + 1, x, y, float(self.trace.t_s[at]))

    def block_name(self, at: int) -> str:
        """What the block is called that the wire was in at a sample."""
        return self.run.block_names.of_row(int(self.trace.row[at]))


def samples_of(run: DryRun) -> Samples:
    """Deviations of all samples of a run."""
    trace = run.cut
    along = np.asarray(run.plan.at(trace.t_s).along_um)
    wire = across(run.toolpath, trace, trace.wire_um, along)
    bows = trace.wire_um is not trace.table_um
    return Samples(
        run=run,
        trace=trace,
        along_um=along,
        cutting=~run.toolpath.is_jump[trace.row],
        steps_um=across_um(run.toolpath, trace, trace.commanded_um, along),
        table_um=across_um(run.toolpath, trace, trace.table_um, along) if bows else wire.off_um,
        wire_um=wire.off_um,
        foot_um=wire.foot_um,
    )
