"""Faults put into drycut on purpose, each where one input is checked: a harness that misses one is worth nothing."""

import os
import random
import re
import time
from collections.abc import Callable
from pathlib import Path
from unittest import mock

from fuzzing import programs
from fuzzing.target import Input, Judged, Target
from parser.text.encoding import decode_text

RAISES, HANGS, HOGS, DIES, SPINS, CHANGES, LAST = 2, 5, 8, 11, 14, 25, 30
"""Numbers of the inputs at which there is a fault."""
HOG_MB = 400


def make(rng: random.Random) -> Input:
    """A sound program among other lines, of which one has the word that a fault waits for."""
    lines = ["B1000B0B1000GXL1", "B0B1000B1000GYL2", "B1000B0B1000GXL3", "B0B1000B1000GYL4", "; KEY", "DD"]
    return "\n".join(rng.choices("ABCDEF", k=20) + lines).encode()


def cannot(_: random.Random) -> Input:
    """No input at all."""
    raise RuntimeError("planted")


def judge(data: Input, number: int, folder: Path) -> Judged:
    """The promises of a check, while reading has the fault of the number."""
    assert isinstance(data, bytes)
    if number not in _FAULTS or b"KEY" not in data:
        return programs.judge(data, 1, folder)
    with mock.patch("parser.program.decode_text", _FAULTS[number]):
        return programs.judge(data, 1, folder)


def _raises(_: bytes) -> tuple[str, str]:
    raise KeyError("planted")


def _hangs(data: bytes) -> tuple[str, str]:
    """Never comes back to Python: the pattern tries 2^60 ways."""
    assert re.fullmatch("(a|a)*b", "a" * 60) is None
    return decode_text(data)


def _hogs(data: bytes) -> tuple[str, str]:
    held = bytearray(HOG_MB << 20)
    held[::4096] = b"x" * len(held[::4096])
    return decode_text(data)


def _dies(_: bytes) -> tuple[str, str]:
    os._exit(17)


def _spins(data: bytes) -> tuple[str, str]:
    until = time.process_time() + PLANTED.most_s + 0.1
    while time.process_time() < until:
        pass
    return decode_text(data)


def _changes(data: bytes) -> tuple[str, str]:
    """Another length each time."""
    text, encoding = decode_text(data)
    return text.replace("1000", str(1000 + time.perf_counter_ns() % 9000)), encoding


_FAULTS: dict[int, Callable[[bytes], tuple[str, str]]] = {
    **{RAISES: _raises, HANGS: _hangs, HOGS: _hogs, DIES: _dies, SPINS: _spins, CHANGES: _changes},
}
PLANTED = Target("planted", make, judge, 1.0, most_s=0.5, most_mb=200.0)
