"""Compiled loops: numba makes machine code of them once, which stays on disk; it is loaded when a loop is called.

A compiled loop is for what follows step by step from what was before, where whole arrays do not help. It calls nothing
but numpy and other compiled loops. It has the one signature that it names. It makes no arrays, but fills those that it
is given; it gives numbers, truths, and tuples of them.

Who calls a loop needs no numba, which takes half a second to load: LLVM links the machine code into the process, and
the loop is called by its address. Measured on a run of a small program, 1.01 s of CPU became 0.53 s.

Floats add up in the order in which they are written: the compiler may not change it (numba's ``fastmath`` is off), so
that the same input gives the same bytes.
"""

import hashlib
import threading
from collections.abc import Callable
from functools import cache, cached_property, update_wrapper
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final, TypeVar, cast, get_type_hints

from controller.compiled.compiling import compiling
from controller.compiled.fields import fields_of

if TYPE_CHECKING:
    from controller.compiled.machine_code import MachineCode

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
    is_part
        Whether it is made for other loops alone, by `loop_part`.
    is_core
        Whether it runs as it is written where LLVM is not installed.
    """

    def __init__(
        self, function: Callable[..., Any], signature: str, tuples: tuple[type, ...], *, is_part: bool, is_core: bool
    ) -> None:
        self.function, self.signature, self.tuples = function, signature, tuples
        self.is_part, self.is_core = is_part, is_core
        self._code: Callable[..., Any] | None = None
        update_wrapper(self, function)

    @property
    def name(self) -> str:
        """Its module and its function."""
        return f"{self.function.__module__}.{self.function.__name__}"

    @cached_property
    def digest(self) -> str:
        """Of all that goes into it: its module, loops, numbers and NamedTuples of others, and how code is made."""
        values = self.function.__globals__.items()
        known = {text for name, value in values if (text := _text_of(name, value, self.function.__module__))}
        sources = [_source(self.function.__code__.co_filename), *map(_source, _MAKERS)]
        return hashlib.sha256(b"\n".join([*sources, *(text.encode() for text in sorted(known))])).hexdigest()[:16]

    def __call__(self, *args: Any) -> Any:
        """What the function returns. TypeError for arguments that are not those of the signature."""
        return (self._code or self.loaded())(*args)

    def loaded(self) -> Callable[..., Any]:
        """Its machine code, from disk, or made now and kept there. ModuleNotFoundError where LLVM is not installed."""
        try:
            from controller.compiled.machine_code import function_of  # noqa: PLC0415 - takes a twentieth of a second
        except ModuleNotFoundError:
            if not self.is_core:
                raise
            self._code = self.function
            return self._code
        with _loading:
            if self._code is None:
                self._code = function_of(self._machine_code(), get_type_hints(self.function).get("return"))
            return self._code

    def _machine_code(self) -> "MachineCode":
        from controller.compiled.entries import alone, store, stored  # noqa: PLC0415 - loaded with the machine code

        code = stored(self.name, self.digest)
        if code is not None:
            return code
        compiling()
        with alone():
            code = stored(self.name, self.digest)  # another process may have made it meanwhile
            if code is None:
                code = _made_of(self)
                store(self.name, self.digest, code)
        return code


def _made_of(loop: Loop) -> "MachineCode":
    from controller.compiled import compiler  # noqa: PLC0415 - numba takes half a second

    compiler.let_call_one_another(Loop)
    return compiler.made_of(loop)


def compiled(signature: str, *tuples: type, is_core: bool = False) -> Callable[[Function], Function]:
    """Compile a function for a signature in numba's words, such as ``"f8(f8[::1], i8)"``, when it is first called.

    A signature may also name NamedTuples, which are given as `tuples`: ``"(Drive, f8)"``. Their fields are floats,
    ints, bools, arrays (n,) of float64 or int64, and other such tuples. Such a function becomes a part of each place
    that calls it: to hand its tuples over takes a third of the time of the table. Without a result before its bracket,
    the result is what the function makes; where that is a NamedTuple, the function's annotation names it.

    The package may bring its code (`controller.compiled.entries`). What is compiled here stays in the user's cache
    folder, or where the environment's ``NUMBA_CACHE_DIR`` says; where neither can be written, it is compiled again in
    each process. Division by zero gives infinities and NaN, as in numpy.

    What is done without extras takes loops of the core (`is_core`): they run as they are written, a hundred times
    slower, where LLVM is not installed.
    """

    def compiled_loop(function: Function) -> Function:
        return cast("Function", Loop(function, signature, tuples, is_part=False, is_core=is_core))

    return compiled_loop


def loop_part(signature: str, *tuples: type, is_core: bool = False) -> Callable[[Function], Function]:
    """Like `compiled`, of a function that other loops alone call: set-up makes no code of its own for it."""

    def part(function: Function) -> Function:
        return cast("Function", Loop(function, signature, tuples, is_part=True, is_core=is_core))

    return part


_MAKERS: Final = tuple(str(Path(__file__).with_name(name)) for name in ("compiler.py", "machine_code.py"))


@cache
def _source(file: str) -> bytes:
    return Path(file).read_bytes()


def _text_of(name: str, value: object, module: str) -> str:
    """What a global value puts into a compiled loop of a module, as text; none where it puts in nothing."""
    if isinstance(value, Loop):
        return value.digest if value.function.__module__ != module else ""
    if isinstance(value, type) and hasattr(value, "_fields"):
        return f"{name}: {fields_of(value)}"
    return f"{name} = {value!r}" if isinstance(value, int | float) else ""
