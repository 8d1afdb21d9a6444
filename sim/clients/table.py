"""The table where nobody names a machine: it follows the pulses of the card, whatever they ask for.

A program for the card tells nothing of the machine that it was written for. To hold it against a table of another kind
would tell of lost steps that no machine loses.
"""

from typing import Final

from sim.setup.machine.machine import Machine
from sim.setup.machine.table_model import Motor, TableModel

_MOVED_KG: Final = 25.0
_STIFFNESS_N_UM: Final = 400.0
"""With the mass 640 Hz: at 1 m/s² it lags by 0.06 µm."""
_FORCE_N: Final = 1e6
_TRAVEL_MM: Final = 10_000.0
NAME: Final = "follower, a table that follows every pulse"


def following(machine: Machine) -> Machine:
    """The machine with a table that follows its pulses in place of its own."""
    motor = Motor(
        kind="stepper",
        step_time_s=0.0005,
        electrical_period_um=1e6,
        following_error_limit_um=float("inf"),
        force_curve=((0.0, _FORCE_N),),
    )
    table = TableModel(
        travel_x_mm=_TRAVEL_MM,
        travel_y_mm=_TRAVEL_MM,
        saddle_mass_kg=0.1,
        carriage_mass_kg=_MOVED_KG,
        drive_stiffness_n_um=_STIFFNESS_N_UM,
        drive_damping_ratio=1.0,
        motor=motor,
    )
    return machine._replace(name=NAME, table=table, assumed=())
