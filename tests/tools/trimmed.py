"""A run with trims, for those who test what is told of passes: a die cut by four passes, the last two through its tab.

They run at 120 and 100 µm, forward and back, then through the tab at 120 and 100 µm, back and forward.
"""

import random
from functools import cache

from replayed import recording_of
from rough_and_trim import RoughAndTrim, rough_and_trim

from sim.run.recording import Recording

ONCE = "B500B0B500GXL1\nB0B500B500GYL2\nB500B0B500GXL3\nB0B500B500GYL4\nDD\n"
"""A square that is cut once."""


@cache
def trimmed() -> RoughAndTrim:
    return rough_and_trim(random.Random(29), most_um=2600.0, kind="die")


@cache
def trimmed_run() -> Recording:
    return recording_of(trimmed().text)


@cache
def untrimmed_run() -> Recording:
    return recording_of(ONCE)
