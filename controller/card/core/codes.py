"""Return codes and status bits of the card, as its programs and headers give them (docs/card.md)."""

from enum import IntEnum, IntFlag


class Code(IntEnum):
    """What a call returns. Grade A: headers and programs agree."""

    OK = 0
    COMMAND = 1  # not executable now, or the list is full
    RADIUS = 2  # radius or chord 0
    LENGTH = 3  # line of no length, or too long
    SPEED = 4  # velocity or acceleration ≤ 0
    CHORD = 5  # chord longer than the diameter
    MAP = 6  # no solution of the map
    PARAMETER = 7
    CLOSED = -1  # no communication: the card is not open
    VERSION = -2


LIST_FULL = 0x8000
"""`GT_GetCmdSts` after a push on a full list; grade B."""


class CrdSts(IntFlag):
    """Bits of `GT_GetCrdSts`. Grade A, `ABNORMAL` grade C."""

    IDLE = 1 << 0
    ABNORMAL = 1 << 9
    LIST_EMPTY = 1 << 13


class AxisSts(IntFlag):
    """Bits of `GT_GetSts`; bits 12 and 13 hold the axis number less one."""

    FINISHED = 1 << 0
    ALARM = 1 << 1
    CAPTURED = 1 << 3
    MOTION_ERROR = 1 << 4
    POSITIVE_LIMIT = 1 << 5
    NEGATIVE_LIMIT = 1 << 6
    HOST_ERROR = 1 << 7
    ENABLED = 1 << 9
    MOVING = 1 << 10
    LIMITS_ON = 1 << 11
    HOME_ARMED = 1 << 14
    INDEX_ARMED = 1 << 15


LATCHED = (
    AxisSts.FINISHED
    | AxisSts.ALARM
    | AxisSts.CAPTURED
    | AxisSts.MOTION_ERROR
    | AxisSts.POSITIVE_LIMIT
    | AxisSts.NEGATIVE_LIMIT
    | AxisSts.HOST_ERROR
)
"""Bits that stay until they are cleared; the others follow the axis."""


class Refused(Exception):  # noqa: N818 - a refusal is an answer of the card, no error of the program
    """A call that the card does not take; `code` is what it returns, and nothing has changed."""

    def __init__(self, code: Code, command_status: int = 0) -> None:
        super().__init__(code.name)
        self.code = code
        self.command_status = command_status
