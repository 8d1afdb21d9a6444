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
from typing import Any, Final, TypeVar, get_type_hints

import numba
import numpy as np
import platformdirs
from numba import types
from numba.core import config, event
from numpy.typing import NDArray

from controller.compiled.compiling import compiling

Function = TypeVar("Function", bound=Callable[..., Any])


_COMPILING: Final = "numba:compile"  # an event of numba, where no code on disk fits


_OPTIONS: Final = {"nogil": True, "error_model": "numpy"}


_OF_TUPLES: Final = {"forceinline": True, "_nrt": False}


_TYPES: Final[dict[Any, types.Type]] = {
    float: types.float64,
    int: types.int64,
    bool: types.boolean,
    NDArray[np.float64]: types.float64[::1],
    NDArray[np.int64]: types.int64[::1],
}


_made_of: Final[dict[Callable[..., Any], str]] = {}  # loops, with the digest of all sources that went into them


def compiled(signature: str, *tuples: type) -> Callable[[Function], Function]:
    """Compile a function for a signature in numba's words, such as ``"f8(f8[::1], i8)"``.

    A signature may also name NamedTuples, which are given as `tuples`: ``"(Drive, f8)"``. Their fields are floats,
    ints, bools, arrays (n,) of float64 or int64, and other such tuples. Such a function becomes a part of the loops
    that call it, and no references to its arrays are counted, which would take longer than all else; so it makes no
    arrays. Without a result before its bracket, the result is what the function makes.

    Its code is kept in the user's cache folder, or where the environment's ``NUMBA_CACHE_DIR`` says; where neither can
    be written, it is compiled again in each process. Division by zero gives infinities and NaN, as in numpy.
    """

    def compiled_loop(function: Function) -> Function:
        digest, typed = _digest(function), _signature(signature, tuples)
        options = _OPTIONS | _OF_TUPLES if tuples else _OPTIONS
        with _keeping(digest):
            try:
                loop: Function = numba.njit(typed, cache=True, **options)(function)
            except RuntimeError:  # numba found no place to keep it
                loop = numba.njit(typed, **options)(function)
        _made_of[loop] = digest
        return loop

    return compiled_loop


def _signature(text: str, tuples: tuple[type, ...]) -> Any:
    """A signature as numba has it; numba itself reads a text so, but knows no tuples of others."""
    return eval(text, {}, vars(types) | {tuple_.__name__: _tuple_type(tuple_) for tuple_ in tuples})  # noqa: S307


def _tuple_type(each: type) -> types.Type:
    """Type of a NamedTuple; numba has one of its own for those with fields that are all alike."""
    fields = tuple(_TYPES[of] if of in _TYPES else _tuple_type(of) for of in get_type_hints(each).values())
    if len(set(fields)) == 1:
        return types.NamedUniTuple(fields[0], len(fields), each)
    return types.NamedTuple(fields, each)


class _Started(event.Listener):  # type: ignore[misc]  # numba has no types
    """Tells that something has started."""

    def on_start(self, event: Any) -> None:
        """It has started."""
        compiling()

    def on_end(self, event: Any) -> None:
        """It has ended."""


event.register(_COMPILING, _Started())


def _digest(function: Callable[..., Any]) -> str:
    """Digest of a function's module, and of all compiled loops, numbers and NamedTuples that the module has.

    numba itself looks at the file of a function alone, and not at what it takes from others.
    """
    own = Path(function.__code__.co_filename).read_bytes()
    known = {text for name, value in function.__globals__.items() if (text := _text_of(name, value))}
    return hashlib.sha256(b"\n".join([own, *(text.encode() for text in sorted(known))])).hexdigest()[:16]


def _text_of(name: str, value: object) -> str:
    """What a global value puts into a compiled loop, as text; none where it puts in nothing."""
    if _is_loop(value):
        return _made_of[value]  # type: ignore[index]  # a loop is a function
    if isinstance(value, type) and hasattr(value, "_fields"):
        return f"{name}: {get_type_hints(value)}"
    return f"{name} = {value!r}" if isinstance(value, int | float) else ""


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
