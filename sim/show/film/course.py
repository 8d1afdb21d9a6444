"""The course of a recorded run: what goes on at any moment, and what happens on the way."""

from dataclasses import dataclass
from typing import Literal, NamedTuple

import numpy as np
import shapely

from controller.stepping.pulses import Pulses
from parser.geometry.curves import Floats
from sim.cut.pieces.pieces import Piece
from sim.measure.deviation.deviation import distance
from sim.run.course import ran
from sim.run.dryrun import DryRun
from sim.run.recording import Recording
from sim.show.replay.happenings import finding_entries
from sim.table.motion import origin_um
from sim.table.trace import Trace

INTO_KERF = 1.9
"""Offsets by which outlines are grown; the kerf that then lies over their borders is two wide."""
PLAIN_UM = 2.0
"""Before that, outlines lose their finer detail: they may have a corner to each step, and the kerf hides the border."""

Sort = Literal["error", "warning", "note", "pause", "free"]


class Happening(NamedTuple):
    """Something on the way: its time, its sort, and its name, a finding's code or a piece's kind."""

    t_s: float
    sort: Sort
    name: str


class Moment(NamedTuple):
    """A moment of the run.

    Attributes
    ----------
    t_s
        Its time.
    row, cuts
        Row that runs, and whether it cuts: else the wire jumps.
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
    wire_um: Floats
    commanded_um: Floats
    feed_um_s: float
    deviation_um: float


@dataclass(frozen=True, slots=True, eq=False)
class Course:
    """A run up to where it ended, of itself or by a trip, with n blocks.

    Attributes
    ----------
    run
        What came of it.
    pieces
        What came free, in order.
    outlines_um
        Polygon of each piece as it is to be drawn, into the kerf round it: with what is still to be cut in it.
    steps, trace, duration_s
        What the machine did before it stopped.
    begins_s
        (n,) float64, when each row begins, as planned.
    happenings
        In order of their times.
    """

    run: DryRun
    pieces: tuple[Piece, ...]
    outlines_um: tuple[shapely.Polygon, ...]
    steps: Pulses
    trace: Trace
    duration_s: float
    begins_s: Floats
    happenings: tuple[Happening, ...]

    def at(self, t_s: float) -> Moment:
        """What goes on at a time; times past either end count as that end."""
        t_s = min(max(t_s, 0.0), self.duration_s)
        row = self.row_at(t_s)
        toolpath = self.run.toolpath
        x, y = (float(np.interp(t_s, self.trace.t_s, self.trace.wire_um[:, axis])) for axis in (0, 1))
        off = distance(toolpath, np.array([row]), np.array([x]), np.array([y]))
        return Moment(
            t_s=t_s,
            row=row,
            cuts=not toolpath.is_jump[row],
            wire_um=np.array([x, y]),
            commanded_um=self.commanded_um(self.steps_by(t_s)),
            feed_um_s=float(self.run.plan.at(t_s).speed_um_s),
            deviation_um=float(off[0]),
        )

    def row_at(self, t_s: float) -> int:
        """Row that runs at a time."""
        return max(int(np.searchsorted(self.begins_s, t_s, side="right")) - 1, 0)

    def steps_by(self, t_s: float) -> int:
        """How many steps are done by a time."""
        return int(np.searchsorted(self.steps.t_s, t_s, side="right"))

    def commanded_um(self, steps: int) -> Floats:
        """Place (2,) after so many steps."""
        if steps == 0:
            return np.array(origin_um(self.run.toolpath), dtype=np.float64)
        return np.array([self.steps.x_um[steps - 1], self.steps.y_um[steps - 1]], dtype=np.float64)


def course_of(recording: Recording) -> Course:
    """The course of a recorded run."""
    run, made = recording.run, ran(recording)
    begins_s = np.concatenate([[0.0], np.cumsum(run.block_time_s)[:-1]])
    pieces = recording.pieces.freed
    happenings = [*_findings(run), *_pauses(run, begins_s), *(Happening(p.freed.t_s, "free", p.kind) for p in pieces)]
    met = sorted(one for one in happenings if one.t_s <= made.duration_s)
    return Course(run, pieces, _outlines(run, pieces), made.steps, made.trace, made.duration_s, begins_s, tuple(met))


def _outlines(run: DryRun, pieces: tuple[Piece, ...]) -> tuple[shapely.Polygon, ...]:
    """Outlines of pieces with the kerf round them."""
    grown_um = INTO_KERF * run.scenario.wire.reach_um
    plain = [shapely.simplify(piece.outline_um, PLAIN_UM) for piece in pieces]
    return tuple(shapely.buffer(one, grown_um, quad_segs=4) for one in plain)


def _findings(run: DryRun) -> list[Happening]:
    entries = [entry for entry in finding_entries(run) if entry["t_s"] is not None]
    return [Happening(entry["t_s"], entry["severity"], entry["code"]) for entry in entries]


def _pauses(run: DryRun, begins_s: Floats) -> list[Happening]:
    ends = np.append(begins_s, run.plan.duration_s)
    return [Happening(float(ends[stop.after]), "pause", "D") for stop in run.toolpath.stops if stop.kind == "pause"]
