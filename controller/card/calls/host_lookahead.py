"""Look-ahead of the library that tells the program the end speeds of its blocks.

All of it is grade C. ``T`` is the time in which a corner is turned, ms: there the velocity may change by ``amax T``.
`amax` also bends arcs, `am` is the acceleration along the path (both pulse/ms²), `vmax` and `F` are pulse/ms. `n`
blocks are kept at most, and coordinates are in units of `con` pulses.
"""

from typing import Any

from controller.card.calls.open import OpenCalls
from controller.card.core.call import Char, Code, Double, Int, Long, Refused, Short, gt
from controller.card.core.settings import UM_S2_PER_PULSE_MS2, UM_S_PER_PULSE_MS
from controller.card.engine.speeds import checked
from controller.card.lookahead import (
    HostBlock,
    HostLookAhead,
    HostRules,
    TLookData,
    checked_data,
    segment_of,
)


class HostLookAheadCalls(OpenCalls):
    """End speeds for `GT_SetDccVel`, told to the program."""

    def __init__(self, *args: Any, **named: Any) -> None:
        super().__init__(*args, **named)
        self._hosts: list[HostLookAhead | None] = [None] * self.settings.cards

    def _reset(self) -> None:
        super()._reset()
        self._hosts[self._number] = None

    @gt()
    def GT_InitLookAhead(self, T: Double, amax: Double, am: Double, vmax: Double, n: Int, con: Double) -> None:
        """Begin, with no block."""
        self._hosts[self._number] = HostLookAhead(rules_of(T, amax, am, vmax, n, con))

    @gt()
    def GT_AddLookData(
        self,
        Code: Char,
        PlaneGroup: Char,
        r: Double,
        x: Double,
        y: Double,
        z: Double,
        F: Double,
        cx: Double,
        cy: Double,
        i: Int,
        n: Long,
        flag: Short,
    ) -> None:
        """Add block `n`: G-code 0 to 3, plane 17 to 19, end, feed, radius or centre; at rest after it where flagged.

        Refused with 1 while as many blocks are kept as there may be: tell one first.
        """
        self._add(TLookData(Code, PlaneGroup, r, x, y, z, F, cx, cy, i, n, flag))

    @gt()
    def GT_AddLookDataEx(self, pLookData: TLookData) -> None:
        """As `GT_AddLookData`."""
        self._add(checked_data(pLookData))

    def _add(self, data: TLookData) -> None:
        host = self._host()
        if host.is_full:
            raise Refused(Code.COMMAND)
        segment = segment_of(data, host.end, host.rules.pulses_per_unit)
        host.add(HostBlock(segment, data.n, bool(data.flag)))

    def _host(self) -> HostLookAhead:
        """Refused with 1 before the look-ahead begins."""
        host = self._hosts[self._number]
        if host is None:
            raise Refused(Code.COMMAND)
        return host

    @gt(zeros=(0.0, 0))
    def GT_CalVel(self) -> tuple[float, int]:
        """End speed of the oldest block, and its number; refused with 1 where none is left."""
        end, number, _ = self._oldest()
        return end, number

    @gt(zeros=(0.0, 0, 0.0))
    def GT_CalVelEx(self) -> tuple[float, int, float]:
        """As `GT_CalVel`, and the highest speed in the block."""
        return self._oldest()

    def _oldest(self) -> tuple[float, int, float]:
        host = self._host()
        if not host.blocks:
            raise Refused(Code.COMMAND)
        entry = host.take_oldest()
        return entry.end_um_s / UM_S_PER_PULSE_MS, entry.block.number, entry.feed_um_s / UM_S_PER_PULSE_MS


def rules_of(T: float, amax: float, am: float, vmax: float, n: int, con: float) -> HostRules:
    """Refused with 4 where a speed or an acceleration is none, with 7 where another number is out of bounds."""
    along, across, ceiling = (checked(value) for value in (am, amax, vmax))
    if T < 0.0 or n < 1 or con <= 0.0:
        raise Refused(Code.PARAMETER)
    return HostRules(
        T / 1000.0, across * UM_S2_PER_PULSE_MS2, along * UM_S2_PER_PULSE_MS2, ceiling * UM_S_PER_PULSE_MS, n, con
    )
