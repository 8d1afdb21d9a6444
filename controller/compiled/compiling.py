"""Who is to be told that loops have to be compiled; known before numba is imported, which takes half a second."""

from collections.abc import Callable
from typing import Final

_tell: Final[list[Callable[[], None]]] = []


def on_compiling(tell: Callable[[], None]) -> None:
    """Call `tell` once, before the first loop of this process that has to be compiled."""
    _tell.append(tell)


def compiling() -> None:
    """Tell those who want to know it that a loop is being compiled."""
    while _tell:
        _tell.pop()()
