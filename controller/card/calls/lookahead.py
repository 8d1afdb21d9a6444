"""Path calls through the look-ahead. `F` is the feed of the block in pulse/ms; after a block with `dccFlag` it rests.

Where as many blocks are kept as there may be, the oldest goes to the list first, and the call is refused with 1 if the
list has no room for it. `CodeNum` comes back in the message of a call that is refused (grade C).
"""

from controller.card.calls.io import BITS
from controller.card.calls.lookahead_mode import LookAheadModeCalls
from controller.card.core.call import Double, Long, Short, UShort, gt
from controller.card.core.codes import Code, Refused
from controller.card.engine.entries import Output, Wait
from controller.card.engine.shapes import XY, YZ, ZX
from controller.card.lookahead.data import TLookAheadMsg


class LookAheadCalls(LookAheadModeCalls):
    """Moves, lines, arcs, outputs and waits; as the functions without ``Ex`` where nothing else is said."""

    @gt()
    def GT_MvXYEx(self, x: Double, y: Double, vel: Double) -> None:
        """Positioning move, mostly the first entry of the list; blocks that are kept go before it."""
        self._kept_move(vel, x, y)

    @gt()
    def GT_MvXYZEx(self, x: Double, y: Double, z: Double, vel: Double) -> None:
        """As `GT_MvXYEx`."""
        self._kept_move(vel, x, y, z)

    @gt(zeros=(TLookAheadMsg(),))
    def GT_LnXYG0Ex(self, x: Double, y: Double, F: Double, dccFlag: Short, CodeNum: Long) -> TLookAheadMsg:
        """Line at rapid speed `F`."""
        return self._kept_line((x, y), F, dccFlag, CodeNum, rapid=True)

    @gt(zeros=(TLookAheadMsg(),))
    def GT_LnXYZG0Ex(self, x: Double, y: Double, z: Double, F: Double, dccFlag: Short, CodeNum: Long) -> TLookAheadMsg:
        """Line at rapid speed `F`."""
        return self._kept_line((x, y, z), F, dccFlag, CodeNum, rapid=True)

    @gt(zeros=(TLookAheadMsg(),))
    def GT_LnXYEx(self, x: Double, y: Double, F: Double, dccFlag: Short, CodeNum: Long) -> TLookAheadMsg:
        """Line."""
        return self._kept_line((x, y), F, dccFlag, CodeNum, rapid=False)

    @gt(zeros=(TLookAheadMsg(),))
    def GT_LnXYZEx(self, x: Double, y: Double, z: Double, F: Double, dccFlag: Short, CodeNum: Long) -> TLookAheadMsg:
        """Line."""
        return self._kept_line((x, y, z), F, dccFlag, CodeNum, rapid=False)

    @gt(zeros=(TLookAheadMsg(),))
    def GT_ArcXYPEx(
        self, x_end: Double, y_end: Double, r: Double, direction: Short, F: Double, dccFlag: Short, CodeNum: Long
    ) -> TLookAheadMsg:
        """Arc by end and radius."""
        return self._kept_arc_p(XY, (x_end, y_end, r, direction), F, dccFlag, CodeNum)

    @gt(zeros=(TLookAheadMsg(),))
    def GT_ArcYZPEx(
        self, y_end: Double, z_end: Double, r: Double, direction: Short, F: Double, dccFlag: Short, CodeNum: Long
    ) -> TLookAheadMsg:
        """Arc by end and radius."""
        return self._kept_arc_p(YZ, (y_end, z_end, r, direction), F, dccFlag, CodeNum)

    @gt(zeros=(TLookAheadMsg(),))
    def GT_ArcZXPEx(
        self, z_end: Double, x_end: Double, r: Double, direction: Short, F: Double, dccFlag: Short, CodeNum: Long
    ) -> TLookAheadMsg:
        """Arc by end and radius."""
        return self._kept_arc_p(ZX, (z_end, x_end, r, direction), F, dccFlag, CodeNum)

    @gt(zeros=(TLookAheadMsg(),))
    def GT_ArcXYEx(
        self, x_center: Double, y_center: Double, angle: Double, F: Double, dccFlag: Short, CodeNum: Long
    ) -> TLookAheadMsg:
        """Arc by centre and angle."""
        return self._kept_arc(XY, (x_center, y_center, angle), F, dccFlag, CodeNum)

    @gt(zeros=(TLookAheadMsg(),))
    def GT_ArcYZEx(
        self, y_center: Double, z_center: Double, angle: Double, F: Double, dccFlag: Short, CodeNum: Long
    ) -> TLookAheadMsg:
        """Arc by centre and angle."""
        return self._kept_arc(YZ, (y_center, z_center, angle), F, dccFlag, CodeNum)

    @gt(zeros=(TLookAheadMsg(),))
    def GT_ArcZXEx(
        self, z_center: Double, x_center: Double, angle: Double, F: Double, dccFlag: Short, CodeNum: Long
    ) -> TLookAheadMsg:
        """Arc by centre and angle."""
        return self._kept_arc(ZX, (z_center, x_center, angle), F, dccFlag, CodeNum)

    @gt()
    def GT_BufIOEx(self, status: UShort) -> None:
        """All outputs, behind the block before."""
        self._push_behind(Output(0xFFFF, status))

    @gt()
    def GT_BufIOBitEx(self, io_bit: UShort, bit_status: Short) -> None:
        """One output, behind the block before."""
        if io_bit >= BITS or bit_status not in (0, 1):
            raise Refused(Code.PARAMETER)
        self._push_behind(Output(1 << io_bit, bit_status << io_bit))

    @gt()
    def GT_DelayEx(self, time: Long) -> None:
        """Wait, ms, behind the block before, which ends at rest."""
        if time < 0:
            raise Refused(Code.PARAMETER)
        self._push_behind(Wait(time / 1000.0))
