"""How far a recorded run went: a servo that trips ends it, though its card goes on."""

from typing import NamedTuple

import numpy as np

from controller.stepping.pulses import Pulses
from sim.run.recording import Recording
from sim.table.trace import Trace


class Ran(NamedTuple):
    """What the machine did before it stopped: pulses, samples, and the time of the whole, s."""

    steps: Pulses
    trace: Trace
    duration_s: float


def ran(recording: Recording) -> Ran:
    """The recorded run up to where it ended, of itself or by a trip."""
    run, steps = recording.run, recording.steps
    if run.tripped is None:
        return Ran(steps, run.trace, max(run.plan.duration_s, float(run.trace.t_s[-1])))
    until_s = run.tripped.t_s
    made = int(np.searchsorted(steps.t_s, until_s, side="right"))
    return Ran(steps.part(0, made), run.cut, until_s)
