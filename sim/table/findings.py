"""Findings on what the drives lost in a run: steps of a stepper, the following error that a servo tripped on."""

from collections.abc import Iterable
from dataclasses import dataclass

from parser.controller_words import Axis
from parser.dialect.reader import at_block
from parser.findings.findings import Fact, Finding, Value, file_order
from parser.program import Program
from parser.units import mm
from sim.setup.machine.machine import Motor
from sim.table.losses import Loss, LossKind

MOST = 20
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
    """Losses of one axis, parted where blocks without loss lie between, into no more than `MOST`."""
    stretches: list[list[Loss]] = []
    for loss in sorted(losses, key=lambda loss: loss.row):
        goes_on = stretches and loss.row - stretches[-1][-1].row <= 1
        if goes_on or len(stretches) == MOST:
            stretches[-1].append(loss)
        else:
            stretches.append([loss])
    return stretches


def _lost(program: Program, stretch: list[Loss]) -> Finding:
    loss, last, lost_um = stretch[0], stretch[-1].row + 1, sum(abs(loss.amount_um) for loss in stretch)
    found = at_block(program.toolpath, program.lines, "3B402", loss.row, **_where(loss), lost=lost_um, last=last)
    return found.with_fact(Lost(loss.kind))


def _trip(program: Program, loss: Loss, motor: Motor) -> Finding:
    lag_um, limit_um = abs(loss.amount_um), motor.following_error_limit_um
    found = at_block(program.toolpath, program.lines, "3B403", loss.row, **_where(loss), lag=lag_um, limit=limit_um)
    return found.with_fact(Lost(loss.kind))


def _where(loss: Loss) -> dict[str, Value]:
    """Axis, time and place of a loss."""
    return {"axis": loss.axis.name, "t_s": loss.t_s, "x_mm": mm(loss.x_um), "y_mm": mm(loss.y_um)}
