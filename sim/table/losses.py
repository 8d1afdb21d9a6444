"""What the drives lose, and findings on it: steps that a stepper slips past, the error at which a servo trips."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Final, Literal, NamedTuple

from parser.controller_words import Axis
from parser.dialect.reader import at_block
from parser.findings.catalogue import TO
from parser.findings.findings import Fact, Finding, Value, file_order
from parser.program import Program
from parser.units import mm
from sim.base.units import newtons
from sim.setup.machine.motor import Motor
from sim.table.drive import Drive
from sim.table.history import PEAK_COLUMNS, Record
from sim.table.ticks import Ticks
from sim.table.trace import Trace

Quantity = Literal["force", "speed", "lag"]
_QUANTITIES: Final[tuple[Quantity, ...]] = ("force", "speed", "lag")


class Peak(NamedTuple):
    """Where an axis came nearest to a limit.

    Attributes
    ----------
    quantity
        ``force`` of the drive, N; ``speed`` of the slide, µm/s; ``lag`` of the slide behind its motor, µm, or where a
        position loop is closed of what that looks at behind its command.
    axis
        Whose.
    value, limit
        Largest magnitude, and the limit at that moment, infinite where there is none. Where the limit changes with the
        step rate, they are those of the moment with the largest share.
    row, t_s, x_um, y_um
        Block (row of the toolpath), time, and place of the table in program coordinates; that of the other axis is
        taken between two samples of the trace.
    """

    quantity: Quantity
    axis: Axis
    value: float
    limit: float
    row: int
    t_s: float
    x_um: float
    y_um: float

    @property
    def share(self) -> float:
        """Value over limit; 0 without a limit."""
        return self.value / self.limit


def peaks_of(
    records: tuple[Record, Record], drives: tuple[Drive, Drive], trace: Trace, ticks: Ticks
) -> tuple[Peak, ...]:
    """Peaks of force, speed and lag, of X and Y each."""
    peaks = []
    for number, quantity in enumerate(_QUANTITIES):
        for axis in Axis:
            peak = records[axis].peaks[number * PEAK_COLUMNS : (number + 1) * PEAK_COLUMNS].tolist()
            _, value, limit, t_s, at_um = peak
            if quantity == "force":
                value, limit = (newtons(each * drives[axis].mass_kg) for each in (value, limit))
            place = trace.place_with(axis, at_um, t_s)
            peaks.append(Peak(quantity, axis, value, limit, ticks.row_at(t_s), t_s, *place))
    return tuple(peaks)


LossKind = Literal["lost-steps", "trip"]


class Loss(NamedTuple):
    """A loss of one axis in one block.

    Attributes
    ----------
    kind
        ``lost-steps``: a stepper slipped by whole electrical periods; ``trip``: a servo gave up, and the machine
        stopped.
    axis
        Whose drive it was.
    row
        Row of the toolpath that was running (block number less one).
    t_s
        Time of the loss; where there are several slips, that of the first.
    amount_um
        Of lost steps, the sum of the block's slips: positive where the table stands short of its command in the
        positive direction. Where the slips cancel out, the sum of their magnitudes instead. Of a trip, the following
        error: command less place.
    x_um, y_um
        Place of the table then, in program coordinates; that of the other axis is taken between two samples of the
        trace.
    neighbours_um
        What neighbours of the run lose in the block (`sim.table.neighbours`), each as `amount_um` has it.
    """

    kind: LossKind
    axis: Axis
    row: int
    t_s: float
    amount_um: float
    x_um: float
    y_um: float
    neighbours_um: tuple[float, ...] = ()

    @property
    def least_um(self) -> float:
        """The least that the run or a neighbour of it loses, µm."""
        return min((self.amount_um, *self.neighbours_um))

    @property
    def most_um(self) -> float:
        """The most that the run or a neighbour of it loses, µm."""
        return max((self.amount_um, *self.neighbours_um))


class Slip(NamedTuple):
    """A slip of a motor: when, by how much, and where its slide was; or the lag at which it tripped."""

    t_s: float
    amount_um: float
    at_um: float


class SlipTally:
    """Sums up the slips of one axis, one entry for each block."""

    def __init__(self, ticks: Ticks) -> None:
        self._ticks = ticks
        self._first: dict[int, Slip] = {}
        self._sums: dict[int, tuple[float, float]] = {}

    def take(self, slips: Iterable[Slip]) -> None:
        """Take the next slips."""
        for slip in slips:
            row = self._ticks.row_at(slip.t_s)
            self._first.setdefault(row, slip)
            amount, way = self._sums.get(row, (0.0, 0.0))
            self._sums[row] = amount + slip.amount_um, way + abs(slip.amount_um)

    def lost_um(self, row: int) -> float:
        """What was lost in a block: the sum of its slips, or of their magnitudes where they cancel out."""
        amount, way = self._sums.get(row, (0.0, 0.0))
        return amount or way

    def losses(self, axis: Axis, trace: Trace, neighbours: Sequence["SlipTally"]) -> list[Loss]:
        """The losses of all blocks, with what the neighbours of the run lose in them."""
        losses = []
        for row, slip in self._first.items():
            place = trace.place_with(axis, slip.at_um, slip.t_s)
            others = tuple(neighbour.lost_um(row) for neighbour in neighbours)
            losses.append(Loss("lost-steps", axis, row, slip.t_s, self.lost_um(row), *place, others))
        return losses


def trip_loss(axis: Axis, trip: Slip, trace: Trace, ticks: Ticks) -> Loss:
    """A trip as a loss."""
    return Loss("trip", axis, ticks.row_at(trip.t_s), *trip[:2], *trace.place_with(axis, trip.at_um, trip.t_s))


def in_order(losses: Iterable[Loss]) -> tuple[Loss, ...]:
    """Losses in order of time."""
    return tuple(sorted(losses, key=lambda loss: (loss.t_s, loss.axis)))


MOST_FINDINGS = 20
"""Findings of lost steps on one axis; the last of them holds all the rest."""


@dataclass(frozen=True, slots=True)
class Lost(Fact):
    """A drive lost what `kind` says, as `Loss` does."""

    kind: LossKind


def loss_findings(program: Program, losses: tuple[Loss, ...], motor: Motor) -> list[Finding]:
    """Findings of a run's losses, in file order.

    Each trip is a finding 3B403. Lost steps are findings 3B402: one for each axis and stretch of consecutive blocks
    that slip, with the way lost in all of them, whichever way, at the place of the first slip.
    """
    found = [_trip(program, loss, motor) for loss in losses if loss.kind == "trip"]
    for axis in Axis:
        of_axis = (loss for loss in losses if loss.kind == "lost-steps" and loss.axis is axis)
        found += [_lost(program, stretch) for stretch in _stretches(of_axis)]
    return sorted(found, key=file_order)


def _stretches(losses: Iterable[Loss]) -> list[list[Loss]]:
    """Losses of one axis, parted where blocks without loss lie between, into no more than `MOST_FINDINGS`."""
    stretches: list[list[Loss]] = []
    for loss in sorted(losses, key=lambda loss: loss.row):
        goes_on = stretches and loss.row - stretches[-1][-1].row <= 1
        if goes_on or len(stretches) == MOST_FINDINGS:
            stretches[-1].append(loss)
        else:
            stretches.append([loss])
    return stretches


def _lost(program: Program, stretch: list[Loss]) -> Finding:
    loss, last, lost_um = stretch[0], stretch[-1].row + 1, sum(abs(loss.amount_um) for loss in stretch)
    where = _where(loss) | {"chance": _chance(stretch)}
    found = at_block(program.toolpath, program.lines, "3B402", loss.row, **where, lost=lost_um, last=last)
    return found.with_fact(Lost(loss.kind))


def _chance(stretch: list[Loss]) -> str:
    """What a run and its neighbours lose in a stretch, from the least to the most; empty where all lose the same."""
    runs = zip(*((loss.amount_um, *loss.neighbours_um) for loss in stretch), strict=True)
    lost_um = [sum(map(abs, amounts)) for amounts in runs]
    least, most = min(lost_um), max(lost_um)
    return f"{least:.0f}{TO}{most:.0f} µm" if least < most else ""


def _trip(program: Program, loss: Loss, motor: Motor) -> Finding:
    lag_um, limit_um = abs(loss.amount_um), motor.following_error_limit_um
    found = at_block(program.toolpath, program.lines, "3B403", loss.row, **_where(loss), lag=lag_um, limit=limit_um)
    return found.with_fact(Lost(loss.kind))


def _where(loss: Loss) -> dict[str, Value]:
    """Axis, time and place of a loss."""
    return {"axis": loss.axis.name, "t_s": loss.t_s, "x_mm": mm(loss.x_um), "y_mm": mm(loss.y_um)}
