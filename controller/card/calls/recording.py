"""Functions that are taken, kept and answered with 0, and do nothing else."""

import functools
from collections.abc import Callable
from inspect import signature
from typing import Any

from controller.card.core.call import ADDRESSED, gt


def record(body: Callable[..., None]) -> Callable[..., Any]:
    """Decorator of a function without a body: its last good call is kept in `CardState.recorded` by its name."""
    of_axis = next(iter([*signature(body).parameters][1:]), "") in ADDRESSED

    @functools.wraps(body)
    def keep(self: Any, *given: Any) -> None:
        if of_axis:
            self._axis(given[0])
        self._state.recorded[body.__name__] = given

    return gt()(keep)
