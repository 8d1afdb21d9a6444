"""Signals that end a process, and what they have to wait for."""

import signal
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Final

ENDING: Final = frozenset({signal.SIGINT, signal.SIGTERM})


@contextmanager
def signals_wait() -> Iterator[None]:
    """Let `ENDING` wait until the end of a block, also in processes that it starts; Windows has no such thing."""
    if not hasattr(signal, "pthread_sigmask"):
        yield
        return
    before = signal.pthread_sigmask(signal.SIG_BLOCK, ENDING)
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def signals_come() -> None:
    """Let `ENDING` come in a process that was started while they waited."""
    if hasattr(signal, "pthread_sigmask"):
        signal.pthread_sigmask(signal.SIG_UNBLOCK, ENDING)
