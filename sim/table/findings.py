"""Findings on what the drives lost in a run: steps of a stepper, the following error that a servo tripped on."""

from collections.abc import Iterable

from parser.dialect.at_block import at_block
from parser.findings.findings import Finding, Value, file_order
from parser.program import Program
from parser.toolpath import Axis
from parser.units import mm
from sim.setup.machine.table_model import Motor
from sim.table.record.losses import Loss

MOST = 20
"""Findings of lost steps on one axis; the last of them holds all the rest."""


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
    lost_um = sum(abs(loss.amount_um) for loss in stretch)
    return _at(program, "3B402", stretch[0], lost=lost_um, last=stretch[-1].row + 1)


def _trip(program: Program, loss: Loss, motor: Motor) -> Finding:
    return _at(program, "3B403", loss, lag=abs(loss.amount_um), limit=motor.following_error_limit_um)


def _at(program: Program, code: str, loss: Loss, **values: Value) -> Finding:
    """Finding at the block of a loss, with its axis, time and place beside its own values."""
    return at_block(
        program.toolpath,
        program.lines,
        code,
        loss.row,
        axis=loss.axis.name,
        t_s=loss.t_s,
        x_mm=mm(loss.x_um),
        y_mm=mm(loss.y_um),
        **values,
    )
