"""The steps of a stretch of time."""

import numpy as np

from controller.stepping.pulses import Pulses
from parser.geometry.curves import Floats


class HeldSteps:
    """Places that were commanded from `since_s` to `until_s`, gathered as the pulses stream in."""

    def __init__(self, since_s: float, until_s: float) -> None:
        self._since_s = since_s
        self._until_s = until_s
        self._times: list[Floats] = []
        self._places: list[Floats] = []

    def take(self, pulses: Pulses) -> None:
        """Keep those pulses that fall into the time."""
        inside = (pulses.t_s >= self._since_s) & (pulses.t_s <= self._until_s)
        self._times.append(pulses.t_s[inside])
        self._places.append(np.stack([pulses.x_um[inside], pulses.y_um[inside]], axis=1).astype(np.float64))

    def places_um(self) -> Floats:
        """Places (n, 2), each held for some time: of two axes that step at once, where both have stepped."""
        held = np.diff(np.concatenate(self._times), append=np.inf) > 0.0
        return np.asarray(np.concatenate(self._places)[held], dtype=np.float64)
