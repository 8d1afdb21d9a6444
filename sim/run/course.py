"""The course of a recorded run: what goes on at any moment of it, and what happens on the way."""

import math
from collections import Counter
from dataclasses import dataclass
from itertools import chain
from typing import Generic, NamedTuple, TypeVar

import numpy as np

from controller.stepping.pulses import Pulses
from parser.findings.findings import Finding
from parser.geometry.curves import Floats, Ints
from parser.shape.passes import Pass
from parser.toolpath import Stop
from sim.check.offset import InPass
from sim.cut.pieces.pieces import Piece, Pieces
from sim.measure.deviation import Across, across
from sim.run.dryrun import DryRun
from sim.run.recording import Recording
from sim.table.losses import Loss
from sim.table.trace import Trace, origin_um

Event = Finding | Stop | Piece | Loss
What_co = TypeVar("What_co", bound=Event, covariant=True)


class Happening(NamedTuple, Generic[What_co]):
    """Something that happens in a run.

    Attributes
    ----------
    t_s
        When; for a finding about a block and for a stop as planned. NaN for a finding about no block that ran.
    row
        Row of the toolpath that it is about; of a stop the row that comes next, n at the end. −1 for a finding about no
        block that ran.
    what
        What it is.
    """

    t_s: float
    row: int
    what: What_co


class PassOf(NamedTuple):
    """A pass, and how many there are over its edge."""

    pass_: Pass
    among: int


class Moment(NamedTuple):
    """A moment of a run.

    Attributes
    ----------
    t_s
        Its time.
    row, cuts
        Row that runs, and whether it cuts: else the wire jumps.
    running
        Pass that runs; None on leads and jumps, and where every edge is cut once.
    wire_um, commanded_um
        (2,) float64, where the wire is, and where the steps have asked the table to be.
    feed_um_s
        Planned speed along the path.
    deviation_um
        Distance of the wire from the ideal path.
    """

    t_s: float
    row: int
    cuts: bool
    running: PassOf | None
    wire_um: Floats
    commanded_um: Floats
    feed_um_s: float
    deviation_um: float


@dataclass(frozen=True, slots=True, eq=False)
class Course:
    """A run of n blocks up to where it ended, of itself or before.

    Attributes
    ----------
    run
        What came of it.
    steps, trace, duration_s
        What the machine did before it stopped: pulses, samples, and the time of the whole.
    across
        Where the wire lies across the ideal path at each sample of the trace.
    border_s
        (n + 1,) float64, planned times at which the blocks begin, and the end of the last one.
    passes
        All passes in the order they are cut; none where every edge is cut once.
    findings, stops, pieces, losses
        All of each kind, those too that were to come when the run ended, in the order in which the run tells them.
    happenings
        What happened before the run ended, in order of time; of what falls together findings come first.
    """

    run: DryRun
    steps: Pulses
    trace: Trace
    duration_s: float
    across: Across
    border_s: Floats
    passes: tuple[PassOf, ...]
    findings: tuple[Happening[Finding], ...]
    stops: tuple[Happening[Stop], ...]
    pieces: tuple[Happening[Piece], ...]
    losses: tuple[Happening[Loss], ...]
    happenings: tuple[Happening[Event], ...]

    def at(self, t_s: float) -> Moment:
        """What goes on at a time; times past either end count as that end.

        Between two samples the wire goes straight, and so does the place on the path that its deviation is measured
        from. So no moment deviates more than the worse of the two samples beside it.
        """
        t_s = min(max(t_s, 0.0), self.duration_s)
        row = self.row_at(t_s)
        wire, foot = self._between(self.trace.wire_um, t_s), self._between(self.across.foot_um, t_s)
        return Moment(
            t_s=t_s,
            row=row,
            cuts=not self.run.toolpath.is_jump[row],
            running=self.pass_of(row),
            wire_um=wire,
            commanded_um=self.commanded_um(self.steps_by(t_s)),
            feed_um_s=float(self.run.plan.at(t_s).speed_um_s),
            deviation_um=math.dist(wire, foot),
        )

    def row_at(self, t_s: float) -> int:
        """Row that runs at a time."""
        return max(int(np.searchsorted(self.border_s[:-1], t_s, side="right")) - 1, 0)

    def pass_of(self, row: int) -> PassOf | None:
        """Pass that a row belongs to; None for one of a lead or a jump, and where every edge is cut once."""
        at = int(self.run.passes.of_row[row])
        return self.passes[at] if self.passes and at >= 0 else None

    def numbers_at(self, t_s: Floats) -> Ints:
        """Number of the pass that runs at times (m,): 1 on leads and jumps too, and where every edge is cut once."""
        if not self.passes:
            return np.ones(len(t_s), dtype=np.int64)
        numbers = np.array([*(each.number for each, _ in self.passes), 1])  # the last for rows of no pass, −1
        row = np.maximum(np.searchsorted(self.border_s[:-1], t_s, side="right") - 1, 0)
        return np.asarray(numbers[self.run.passes.of_row[row]])

    def steps_by(self, t_s: float) -> int:
        """How many steps are done by a time."""
        return int(np.searchsorted(self.steps.t_s, t_s, side="right"))

    def commanded_um(self, steps: int) -> Floats:
        """Place (2,) after so many steps."""
        if steps == 0:
            return np.array(origin_um(self.run.toolpath), dtype=np.float64)
        return np.array([self.steps.x_um[steps - 1], self.steps.y_um[steps - 1]], dtype=np.float64)

    def _between(self, places_um: Floats, t_s: float) -> Floats:
        """Place (2,) at a time, of the places (m, 2) at the samples."""
        x, y = (float(np.interp(t_s, self.trace.t_s, places_um[:, axis])) for axis in (0, 1))
        return np.array([x, y])


def course_of(recording: Recording) -> Course:
    """The course of a recorded run."""
    run, trace = recording.run, recording.run.cut
    duration_s = run.ran_s if run.ended else max(run.ran_s, float(trace.t_s[-1]))
    findings, stops, losses = findings_of(run), stops_of(run), losses_of(run)
    pieces = pieces_freed(recording.pieces)
    met = (each for each in chain[Happening[Event]](findings, stops, pieces, losses) if each.t_s <= duration_s)
    return Course(
        run=run,
        steps=recording.steps,
        trace=trace,
        duration_s=duration_s,
        across=across(run.toolpath, trace, trace.wire_um, run.plan.at(trace.t_s).along_um),
        border_s=run.border_s,
        passes=passes_of(run),
        findings=findings,
        stops=stops,
        pieces=pieces,
        losses=losses,
        happenings=tuple(sorted(met, key=lambda each: each.t_s)),
    )


def passes_of(run: DryRun) -> tuple[PassOf, ...]:
    """Passes of a run in the order they are cut; none where every edge is cut once."""
    if not run.has_trims:
        return ()
    among = Counter(pass_.edge for pass_ in run.passes.passes)
    return tuple(PassOf(pass_, among[pass_.edge]) for pass_ in run.passes.passes)


def findings_of(run: DryRun) -> tuple[Happening[Finding], ...]:
    """Findings of a run, with their own time where they know it, else with that at which their block begins."""
    blocks, rows = np.unique(run.toolpath.source.block, return_index=True)
    first_row = dict(zip(blocks.tolist(), rows.tolist(), strict=True))
    begins_s = [*run.border_s.tolist()[:-1], math.nan]
    placed = [(finding, first_row.get(finding.block, -1)) for finding in run.findings]
    placed = [(finding, _row_in_pass(run, finding, row)) for finding, row in placed]
    return tuple(Happening(float(each.values.get("t_s", begins_s[row])), row, each) for each, row in placed)


def _row_in_pass(run: DryRun, finding: Finding, row: int) -> int:
    """The first row of a finding's block in the pass that it is about, if it is about one; else the row given."""
    if run.offset is None or not isinstance(finding.fact, InPass):
        return row
    rows = np.flatnonzero(
        (run.toolpath.source.block == finding.block) & (run.offset.pass_of_row == finding.fact.number)
    )
    return int(rows[0]) if len(rows) else row


def stops_of(run: DryRun) -> tuple[Happening[Stop], ...]:
    """Pauses of a run, and its end."""
    border_s = run.border_s
    return tuple(Happening(float(border_s[stop.after]), stop.after, stop) for stop in run.toolpath.stops)


def pieces_freed(pieces: Pieces) -> tuple[Happening[Piece], ...]:
    """Pieces as they come free."""
    return tuple(Happening(piece.freed.t_s, piece.freed.block - 1, piece) for piece in pieces.freed)


def losses_of(run: DryRun) -> tuple[Happening[Loss], ...]:
    """What the drives of a run lost."""
    return tuple(Happening(loss.t_s, loss.row, loss) for loss in run.losses)
