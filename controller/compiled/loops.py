"""The decorator of compiled loops: numba makes machine code of them once, and keeps it on disk.

A compiled loop is for what follows step by step from what was before, where whole arrays do not help. It calls nothing
but numpy and other compiled loops. It is compiled when its module is imported, for the one signature that it names; so
`python -m sim.cli.compile` compiles all of them beforehand.

Floats add up in the order in which they are written: the compiler may not change it (numba's ``fastmath`` is off), so
that the same input gives the same bytes.
"""

import hashlib
import os
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any, Final, TypeVar

import numba
import platformdirs
from numba.core import config, event

from controller.compiled.telling import compiling

Function = TypeVar("Function", bound=Callable[..., Any])

_COMPILING: Final = "numba:compile"  # an event of numba, where no code on disk fits
_OPTIONS: Final = {"nogil": True, "error_model": "numpy"}
_made_of: Final[dict[Callable[..., Any], str]] = {}  # loops, with the digest of all sources that went into them


def compiled(signature: str) -> Callable[[Function], Function]:
    """Compile a function for a signature in numba's words, such as ``"f8(f8[::1], i8)"``.

    Its code is kept in the user's cache folder, or where the environment's ``NUMBA_CACHE_DIR`` says; where neither can
    be written, it is compiled again in each process. Division by zero gives infinities and NaN, as in numpy.
    """

    def made(function: Function) -> Function:
        digest = _digest(function)
        with _keeping(digest):
            try:
                loop: Function = numba.njit(signature, cache=True, **_OPTIONS)(function)
            except RuntimeError:  # numba found no place to keep it
                loop = numba.njit(signature, **_OPTIONS)(function)
        _made_of[loop] = digest
        return loop

    return made


class _Started(event.Listener):  # type: ignore[misc]  # numba has no types
    """Tells that something has started."""

    def on_start(self, event: Any) -> None:
        """It has started."""
        compiling()

    def on_end(self, event: Any) -> None:
        """It has ended."""


event.register(_COMPILING, _Started())


def _digest(function: Callable[..., Any]) -> str:
    """Digest of a function's module and of all compiled loops that the module has.

    numba itself looks at the file of a function alone, and not at what it calls in others.
    """
    known = (_made_of[value] for value in function.__globals__.values() if _is_loop(value))
    own = Path(function.__code__.co_filename).read_bytes()
    return hashlib.sha256(b"\n".join([own, *(digest.encode() for digest in sorted(set(known)))])).hexdigest()[:16]


def _is_loop(value: object) -> bool:
    return isinstance(value, numba.core.dispatcher.Dispatcher) and value in _made_of


@contextmanager
def _keeping(digest: str) -> Iterator[None]:
    """Let numba keep what is compiled meanwhile in a folder of these sources."""
    own = config.CACHE_DIR
    folder = Path(own) if own else Path(platformdirs.user_cache_dir("drycut", appauthor=False)) / "loops"
    config.CACHE_DIR = os.fspath(folder / digest)
    try:
        yield
    finally:
        config.CACHE_DIR = own
