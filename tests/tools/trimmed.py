"""A run with trims, for those who test what is told of passes: a die cut by four passes, the last two through its tab.

They run at 120 and 100 µm, forward and back, then through the tab at 120 and 100 µm, back and forward.
"""

import random
from functools import cache

from replayed import recording_of
from rough_and_trim import RoughAndTrim, rough_and_trim

from controller.offset.shifted import Side
from sim.run.recording import Recording
from sim.setup.part import Offset, OffsetPass

ONCE = "B500B0B500GXL1\nB0B500B500GYL2\nB500B0B500GXL3\nB0B500B500GYL4\nDD\n"
"""A square that is cut once."""


@cache
def trimmed() -> RoughAndTrim:
    return rough_and_trim(random.Random(29), most_um=2600.0, kind="die")


@cache
def trimmed_run() -> Recording:
    return recording_of(trimmed().text)


@cache
def offset_run() -> Recording:
    """A square round its start hole, cut in two passes that the controller makes of it, the second back."""
    text = """B0B1000B1000GYL2\nB1000B0B1000GXL1\nB0B2000B2000GYL4\nB2000B0B2000GXL3\nB0B2000B2000GYL2
B1000B0B1000GXL1\nB0B1000B1000GYL4\nDD"""
    passes = (OffsetPass(120.0, "same"), OffsetPass(100.0, "back"))
    return recording_of(text, offset=Offset(passes, Side.RIGHT))


@cache
def untrimmed_run() -> Recording:
    return recording_of(ONCE)
