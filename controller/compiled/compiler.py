"""Makes machine code of loops with numba, which is loaded for this alone: it takes half a second.

What numba makes is called as numba calls it within its own code (`controller.compiled.machine_code`): its wrappers for
Python are left out, as they need numba itself at hand.
"""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import cache
from typing import Any, Final, Protocol, get_type_hints

import llvmlite.binding as llvm
import numba
import numpy as np
from numba import types
from numba.core import codegen
from numba.extending import typeof_impl

from controller.compiled.fields import WORDS
from controller.compiled.machine_code import PROCESSOR, MachineCode, Shape, target_machine

_OPTIONS: Final = {"error_model": "numpy", "_nrt": False, "no_cpython_wrapper": True, "no_cfunc_wrapper": True}
"""Without its run time (``_nrt``) no array can be made in a loop, and no references are counted."""
numba.config.CPU_NAME, numba.config.CPU_FEATURES = PROCESSOR, ""


class Source(Protocol):
    """What a loop is made of, as `controller.compiled.loops.Loop` has it."""

    function: Callable[..., Any]
    signature: str
    tuples: tuple[type, ...]

    def __hash__(self) -> int:
        """By which it is found again."""


def made_of(loop: Source) -> MachineCode:
    """Machine code of a loop for its one signature, with that of all loops that it calls."""
    with _without_machine_code():
        dispatcher = _dispatcher(loop)
    (typed,) = dispatcher.signatures
    made = dispatcher.overloads[typed]
    module = llvm.parse_assembly(dispatcher.inspect_llvm(typed))
    return MachineCode(
        symbol=made.fndesc.llvm_func_name,
        takes=tuple(map(_shape, made.signature.args)),
        gives=_shape(made.signature.return_type),
        object_code=target_machine().emit_object(module),
    )


@contextmanager
def _without_machine_code() -> Iterator[None]:
    """Let numba make no machine code of its own, of each loop and of each that it calls: nobody calls it there.

    That is a quarter of the time. Nothing else may be compiled meanwhile: threads wait for one another in
    `controller.compiled.loops`.
    """
    library, target = codegen.JITCodeLibrary, codegen.JITCPUCodegen
    before = (library._finalize_specific, library.get_pointer_to_function, target.set_env)

    def no_address(made: codegen.JITCodeLibrary, _: str) -> int:
        made._ensure_finalized()
        return 0

    library._finalize_specific, library.get_pointer_to_function = (lambda _: None), no_address
    target.set_env = lambda *_: None
    try:
        yield
    finally:
        library._finalize_specific, library.get_pointer_to_function, target.set_env = before


@cache
def let_call_one_another(kind: type[Source]) -> None:
    """Let loops of a class be called by others."""
    typeof_impl.register(kind)(_type_of_loop)


def _type_of_loop(loop: Source, context: object) -> types.Type:
    return types.Dispatcher(_dispatcher(loop))


@cache
def _dispatcher(loop: Source) -> Any:
    """A loop as numba has it, compiled."""
    inlined = bool(loop.tuples)  # said of each: numba would take it from the loop that calls
    return numba.njit(_signature(loop.signature, loop.tuples), **_OPTIONS, forceinline=inlined)(loop.function)


def _signature(text: str, tuples: tuple[type, ...]) -> Any:
    """A signature as numba has it; numba itself reads a text so, but knows no tuples of others."""
    return eval(text, {}, vars(types) | {tuple_.__name__: _tuple_type(tuple_) for tuple_ in tuples})  # noqa: S307


def _tuple_type(each: type) -> types.Type:
    """Type of a NamedTuple; numba has one of its own for those with fields that are all alike."""
    fields = tuple(
        _signature(WORDS[of], ()) if of in WORDS else _tuple_type(of) for of in get_type_hints(each).values()
    )
    if len(set(fields)) == 1:
        return types.NamedUniTuple(fields[0], len(fields), each)
    return types.NamedTuple(fields, each)


def _shape(of: types.Type) -> Shape:
    """What a type is, in words that need no numba."""
    if isinstance(of, types.Array):
        return Shape("array", np.dtype(str(of.dtype)).str, of.ndim)
    if isinstance(of, types.BaseTuple):
        return Shape("tuple", fields=tuple(map(_shape, of.types)))
    return Shape(str(of))
