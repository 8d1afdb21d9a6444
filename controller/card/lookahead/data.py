"""Structures of the look-ahead functions, and G-code blocks made into segments."""

from typing import Any, NamedTuple

from controller.card.core.call import Char, Double, Long, Reader, Short, read_arguments
from controller.card.core.codes import Code, Refused
from controller.card.core.units import UM_S_PER_PULSE_MS
from controller.card.engine.entries import XY, YZ, ZX, Pace, Place, Segment, arc_by_radius, arc_to, checked_line, four
from controller.card.engine.speeds import checked

_PLANES = {17: XY, 18: ZX, 19: YZ}
"""Planes by their G-code."""
RAPID, LINE, CLOCKWISE, COUNTER_CLOCKWISE = range(4)


class TLookAheadMsg(NamedTuple):
    """What a path call through the look-ahead tells of an error; all 0 where there is none.

    Its fields are graded A, as the vendor's header explains them; which block they tell of is graded C.

    Attributes
    ----------
    mtnNum
        `CodeNum` of the block in which the error occurred.
    num
        Blocks before it that were not sent to the list; 32767 stands for more, too.
    error
        Why: the code that the call returns.
    """

    mtnNum: int = 0  # noqa: N815 - the library's name
    num: int = 0
    error: int = 0


class TLookData(NamedTuple):
    """A block for `GT_AddLookDataEx`; fields as the parameters of `GT_AddLookData`."""

    Code: Char
    PlaneGroup: Char
    r: Double
    x: Double
    y: Double
    z: Double
    F: Double
    cx: Double
    cy: Double
    i: Short
    n: Long
    flag: Short


def checked_data(given: Any) -> TLookData:
    """Refused with 7 where it is no block, or a field does not fit its C type."""
    if not isinstance(given, tuple) or len(given) != len(TLookData._fields):
        raise Refused(Code.PARAMETER)
    return TLookData(*read_arguments(_READERS, given))


_READERS: list[Reader] = [hint.__metadata__[0].reader for hint in TLookData.__annotations__.values()]


def segment_of(data: TLookData, start: Place, pulses_per_unit: float) -> Segment:
    """The path of a block: by its radius, or about its centre where the radius is 0.

    Refused with 7 where code or plane is none, with 4 where the feed is none, and as path calls are.
    """
    plane = _PLANES.get(data.PlaneGroup)
    if plane is None or data.Code not in range(4):
        raise Refused(Code.PARAMETER)
    pace = Pace(checked(data.F) * UM_S_PER_PULSE_MS, 0.0, data.Code == RAPID)
    place = four((*(pulses_per_unit * value for value in (data.x, data.y, data.z)), 0.0))
    if data.Code in {RAPID, LINE}:
        return checked_line(0, pace, start, place)
    sense = 1 if data.Code == COUNTER_CLOCKWISE else -1
    end = (place[plane[0]], place[plane[1]])
    if data.r:
        return arc_by_radius(0, pace, start, plane, end, data.r * pulses_per_unit, sense)
    centre = (data.cx * pulses_per_unit, data.cy * pulses_per_unit)
    return arc_to(0, pace, start, plane, centre, end, sense)
