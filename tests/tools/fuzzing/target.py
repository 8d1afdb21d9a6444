"""What is fuzzed: inputs that are made from their numbers, and the promises that every answer must keep."""

import random
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

SEED = 20260101

Input = bytes | tuple[str, ...]
"""Content of a file, or the words of a command line."""


class Judged(NamedTuple):
    """What drycut answered to an input, and the promises that it broke.

    `answer` holds all that must be the same when the input is tried again; `reached` names the ending, so that it can
    be counted how many inputs were refused, and how many were worked on.
    """

    answer: str
    broken: list[str]
    reached: str = ""


class Target(NamedTuple):
    """One kind of input.

    Attributes
    ----------
    name
        On the command line.
    make
        An input from a source of chance.
    judge
        The answer to an input. It is given the number of the input, which may choose settings, and an empty folder. An
        exception that gets out of it is a broken promise.
    share
        How many of a hundred inputs are of this kind.
    most_s
        Processor time that an input may take, s.
    most_mb
        How far an input may raise the memory of its process above what that has needed before, MB.
    """

    name: str
    make: Callable[[random.Random], Input]
    judge: Callable[[Input, int, Path], Judged]
    share: float
    most_s: float = 2.0
    most_mb: float = 200.0

    def input(self, seed: int, number: int) -> Input:
        """The input of a number."""
        return self.make(random.Random(f"{self.name}:{seed}:{number}"))
