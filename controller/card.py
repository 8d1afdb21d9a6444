"""A first card: takes steps and their plan, keeps position and status in simulated time, hands out pulses."""

from enum import Enum

import numpy as np

from controller.plan import Plan
from controller.pulses import Pulses, time_steps
from controller.steps import CHUNK_STEPS, Steps


class Status(Enum):
    """What the card is doing."""

    EMPTY = "empty"
    READY = "ready"
    RUNNING = "running"
    FINISHED = "finished"


class CardError(RuntimeError):
    """A call the card cannot take in its present status; nothing has changed."""


class StepCard:
    """Card that runs one load of steps at a time.

    Time is simulated: it passes only as pulses are taken, and then exactly as the plan says.
    """

    def __init__(self) -> None:
        self._load: tuple[Steps, Plan] | None = None
        self._taken = 0
        self._running = False
        self._origin_um = (0, 0)
        self._position_um = (0, 0)
        self._time_s = 0.0

    @property
    def status(self) -> Status:
        """Empty, ready to start, running, or finished with its load."""
        if self._load is None:
            return Status.EMPTY
        if self._taken == len(self._load[0]) and self._running:
            return Status.FINISHED
        return Status.RUNNING if self._running else Status.READY

    @property
    def position_um(self) -> tuple[int, int]:
        """Sum of all pulses handed out, (x, y) µm."""
        return self._position_um

    @property
    def time_s(self) -> float:
        """Simulated time since the start of the present load, s."""
        return self._time_s

    def load(self, steps: Steps, plan: Plan) -> None:
        """Take steps and the plan along their path. CardError while running."""
        if self.status is Status.RUNNING:
            raise CardError("the card is running; a load is taken when it has finished")
        self._load, self._taken, self._running, self._time_s = (steps, plan), 0, False, 0.0
        self._origin_um = self._position_um

    def start(self) -> None:
        """Begin to hand out pulses. CardError unless a load is ready."""
        if self.status is not Status.READY:
            raise CardError(f"the card is {self.status.value}; a start needs a load that is ready")
        self._running = True

    def take(self, most: int = CHUNK_STEPS) -> Pulses:
        """Next pulses, at most so many; none once finished. CardError unless started."""
        if self._load is None or not self._running:
            raise CardError(f"the card is {self.status.value}; pulses come after a start")
        steps, plan = self._load
        until = min(self._taken + most, len(steps))
        pulses = time_steps(steps.chunk(self._taken, until), plan)
        x0, y0 = self._origin_um
        np.maximum(pulses.t_s, self._time_s, out=pulses.t_s)
        pulses = pulses._replace(x_um=pulses.x_um + x0, y_um=pulses.y_um + y0) if x0 or y0 else pulses
        if until > self._taken:
            self._taken = until
            self._time_s = float(pulses.t_s[-1])
            self._position_um = int(pulses.x_um[-1]), int(pulses.y_um[-1])
        return pulses
