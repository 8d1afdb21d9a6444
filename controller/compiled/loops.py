"""Compiled loops: numba makes machine code of them once, and keeps it on disk; it is loaded when a loop is called.

A compiled loop is for what follows step by step from what was before, where whole arrays do not help. It calls nothing
but numpy and other compiled loops. It has the one signature that it names. Neither numba nor any machine code is loaded
with its module: that takes half a second, and most commands call few loops. `python -m sim.cli.compile` compiles all of
them beforehand.

Floats add up in the order in which they are written: the compiler may not change it (numba's ``fastmath`` is off), so
that the same input gives the same bytes.
"""

import hashlib
import threading
from collections.abc import Callable
from functools import cache, update_wrapper
from pathlib import Path
from types import ModuleType
from typing import Any, Final, TypeVar, cast, get_type_hints

Function = TypeVar("Function", bound=Callable[..., Any])
_loading: Final = threading.RLock()  # loops that a loop calls are loaded with it


class Loop:
    """A function that is called as machine code.

    Attributes
    ----------
    function
        What it is made of.
    signature, tuples
        As `compiled` has them.
    digest
        Of all sources that go into it.
    """

    def __init__(self, function: Callable[..., Any], signature: str, tuples: tuple[type, ...]) -> None:
        self.function, self.signature, self.tuples = function, signature, tuples
        self.digest = _digest(function)
        self._code: Callable[..., Any] | None = None
        update_wrapper(self, function)

    def __call__(self, *args: Any) -> Any:
        """What the function returns. TypeError for arguments that are not those of the signature."""
        return (self._code or self.loaded())(*args)

    def loaded(self) -> Callable[..., Any]:
        """Its machine code, from disk, or made now and kept there."""
        with _loading:
            if self._code is None:
                self._code = _machine_code().code_of(self)
            return self._code


@cache
def _machine_code() -> ModuleType:
    from controller.compiled import machine_code  # noqa: PLC0415 - numba takes half a second

    machine_code.let_call_one_another(Loop)
    return machine_code


def compiled(signature: str, *tuples: type) -> Callable[[Function], Function]:
    """Compile a function for a signature in numba's words, such as ``"f8(f8[::1], i8)"``, when it is first called.

    A signature may also name NamedTuples, which are given as `tuples`: ``"(Drive, f8)"``. Their fields are floats,
    ints, bools, arrays (n,) of float64 or int64, and other such tuples. Such a function becomes a part of the loops
    that call it, and no references to its arrays are counted, which would take longer than all else; so it makes no
    arrays. Without a result before its bracket, the result is what the function makes.

    Its code is kept in the user's cache folder, or where the environment's ``NUMBA_CACHE_DIR`` says; where neither can
    be written, it is compiled again in each process. Division by zero gives infinities and NaN, as in numpy.
    """

    def compiled_loop(function: Function) -> Function:
        return cast("Function", Loop(function, signature, tuples))

    return compiled_loop


def _digest(function: Callable[..., Any]) -> str:
    """Digest of a function's module, and of all compiled loops, numbers and NamedTuples that the module has.

    numba itself looks at the file of a function alone, and not at what it takes from others.
    """
    values = function.__globals__.items()
    known = {text for name, value in values if (text := _text_of(name, value))}
    own = _source(function.__code__.co_filename)
    return hashlib.sha256(b"\n".join([own, *(text.encode() for text in sorted(known))])).hexdigest()[:16]


@cache
def _source(file: str) -> bytes:
    return Path(file).read_bytes()


def _text_of(name: str, value: object) -> str:
    """What a global value puts into a compiled loop, as text; none where it puts in nothing."""
    if isinstance(value, Loop):
        return value.digest
    if isinstance(value, type) and hasattr(value, "_fields"):
        return f"{name}: {get_type_hints(value)}"
    return f"{name} = {value!r}" if isinstance(value, int | float) else ""
