"""A machine file whose circular test loses as much motion, and is as far out of square, as was measured.

What friction adds to backlash depends on how the table is shaken by its steps: no formula has it. So the test is run
with the machine as it is and fitted as the measured circle was. By what the two differ its backlash is set, and so are
squareness and scales, again and again until they are alike.
"""

import math
from collections.abc import Iterator, Mapping
from typing import Final, NamedTuple

import numpy as np

from sim.base.progress import Progress, silent
from sim.measure.fit.circle import CircleFit, fit_circle
from sim.measure.fit.piece import PieceFit
from sim.run.ballbar.circle import circle_test, run_test
from sim.setup.machine.machine import Machine

ALIKE_UM: Final = 0.05
"""Lost motion that differs by no more is as it was measured."""
_ROUNDS: Final = 5
_OF_PIECE_UM: Final = 10_000.0
"""Radius of the circular test that is to lose as much motion as a piece: that of its disc."""
_AXES: Final = ("x", "y")
_SKEWS: Final = ("squareness", "scale_difference")


class FittedMachine(NamedTuple):
    """A machine that loses as much motion as was measured, and the keys that were set for that.

    `off_um` is by how much its lost motion still differs from what was measured, of the worse axis.
    """

    machine: Machine
    keys: tuple[str, ...]
    off_um: float


def fitted_machine(
    machine: Machine, fit: CircleFit | PieceFit, feed_um_s: float | None, progress: Progress = silent
) -> FittedMachine:
    """The machine with lost motion, squareness and scales of a fit. SettingsError for a circle beyond its travel.

    Lost motion is that of a circular test on the measured radius; of a piece on one of `_OF_PIECE_UM`.

    Where friction alone loses more than was measured there is no backlash, and less friction. Of an axis of which the
    circle does not tell it, both stay. What is set is assumed no more; backlash and squareness are measured then,
    backlash with the friction and the stiffness that stand in the file.
    """
    radius_um = _radius_um(fit)
    wanted = [fit.value(f"reversal_{name}") for name in _AXES]
    made = machine
    for rounds_left in reversed(range(_ROUNDS + 1)):
        found = _simulated(made, radius_um, feed_um_s, progress)
        off = [_less(want, found.value(f"reversal_{name}")) for want, name in zip(wanted, _AXES, strict=True)]
        skew = {name: _less(fit.value(name), found.value(name)) for name in _SKEWS}
        is_alike = max(abs(1e-6 * radius_um * each) for each in skew.values()) <= ALIKE_UM
        if (max(map(abs, off)) <= ALIKE_UM and is_alike) or not rounds_left:
            break
        made = _skewed(_with_more(made, off), skew)
    if fit.value("scale_difference") is not None:
        made = _scaled(made, fit.value("mean_scale"))
    keys = (*_changed(machine, made, wanted), *_skew_keys(fit))
    assumed = tuple(name for name in machine.assumed if name not in keys)
    measured = {name: within for name, within in machine.measured if name not in keys} | _margins(fit)
    for axis, name in enumerate(_AXES):
        # Without backlash the friction makes the lost motion, and what is still off was not measured so.
        if f"friction_{name}_n" in keys or abs(off[axis]) > ALIKE_UM:
            measured.pop(f"backlash_{name}_um", None)
    made = made._replace(assumed=assumed, measured=tuple(measured.items()))
    return FittedMachine(made, keys, max(map(abs, off)))


def _radius_um(fit: CircleFit | PieceFit) -> float:
    if isinstance(fit, PieceFit):
        return _OF_PIECE_UM
    return float(round(next(each.value for each in fit.parameters if each.value is not None)))


def _simulated(machine: Machine, radius_um: float, feed_um_s: float | None, progress: Progress) -> CircleFit:
    """The fit of a circular test that is run on a machine."""
    done = run_test(circle_test(machine, radius_um, feed_um_s), progress)
    places = np.concatenate([turn.points_um for turn in done.turns])
    return fit_circle(places, by_points=machine.controller.interpolation == "point-by-point")


def _changed(machine: Machine, made: Machine, wanted: list[float | None]) -> Iterator[str]:
    """Names of the keys that were set: the backlash of each axis that was measured, and friction that was lowered."""
    for axis, name in enumerate(_AXES):
        if wanted[axis] is not None:
            yield f"backlash_{name}_um"
        if made.table.friction_n[axis] != machine.table.friction_n[axis]:
            yield f"friction_{name}_n"


def _margins(fit: CircleFit | PieceFit) -> dict[str, float]:
    """Half the intervals of what was told, by the keys of the machine file.

    Not of the scales where their difference alone is told, as by a circle.
    """
    known = {
        each.name: 0.5 * (each.most - each.least)
        for each in fit.parameters
        if each.least is not None and each.most is not None
    }
    keys = {"reversal_x": "backlash_x_um", "reversal_y": "backlash_y_um", "squareness": "squareness_urad"}
    found = {key: known[name] for name, key in keys.items() if name in known}
    if {"mean_scale", "scale_difference"} <= set(known):
        of_axis = math.hypot(known["mean_scale"], 0.5 * known["scale_difference"])
        found |= {f"scale_{axis}_ppm": of_axis for axis in _AXES}
    return {key: round(within, 3) for key, within in found.items()}


def _scaled(machine: Machine, mean_ppm: float | None) -> Machine:
    """The machine with another mean of both scales, where that is told."""
    geometry = machine.table.geometry
    more = 0.0 if mean_ppm is None else mean_ppm - 0.5 * sum(geometry.scale_ppm)
    scales = (geometry.scale_ppm[0] + more, geometry.scale_ppm[1] + more)
    return machine._replace(table=machine.table._replace(geometry=geometry._replace(scale_ppm=scales)))


def _less(wanted: float | None, found: float | None) -> float:
    return 0.0 if wanted is None or found is None else wanted - found


def _skew_keys(fit: CircleFit | PieceFit) -> Iterator[str]:
    """Names of the keys of what was measured of the axes' directions and scales."""
    if fit.value("squareness") is not None:
        yield "squareness_urad"
    if fit.value("scale_difference") is not None:
        yield from ("scale_x_ppm", "scale_y_ppm")


def _skewed(machine: Machine, more: Mapping[str, float]) -> Machine:
    """The machine so much more out of square, and with scales so much more apart: half of it in X, half in Y.

    A circle does not tell the mean of both scales from its radius; what a piece tells of it is set behind.
    """
    geometry = machine.table.geometry
    half = 0.5 * more["scale_difference"]
    geometry = geometry._replace(
        squareness_urad=geometry.squareness_urad + more["squareness"],
        scale_ppm=(geometry.scale_ppm[0] + half, geometry.scale_ppm[1] - half),
    )
    return machine._replace(table=machine.table._replace(geometry=geometry))


def _with_more(machine: Machine, more_um: list[float]) -> Machine:
    """The machine with so much more lost motion: of backlash, or less friction where that is gone."""
    table = machine.table
    backlash, friction = list(table.backlash_um), list(table.friction_n)
    for axis, more in enumerate(more_um):
        backlash[axis] += more
        if backlash[axis] < 0.0:
            friction[axis] = max(friction[axis] + 0.5 * backlash[axis] * table.drive_stiffness_n_um, 0.0)
            backlash[axis] = 0.0
    return machine._replace(
        table=table._replace(backlash_um=(backlash[0], backlash[1]), friction_n=(friction[0], friction[1]))
    )
