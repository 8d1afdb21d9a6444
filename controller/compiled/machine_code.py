"""Machine code of loops: how it is linked into the process, and how it is called.

The code is for any processor of its architecture, so that a package can bring it, and one figure is one figure on all
of them: what newer processors add makes no loop here more than 3 % faster (measured on one with AVX-512). It is an
object file in memory, which LLVM links into the process.

It is called as numba calls it within its own code (`numba.core.callconv.CPUCallConv`): a status comes back; what the
loop gives is written where the first argument points, and the second would point to an exception. Then come the
arguments, taken apart: of a tuple its fields, of an array two owners, which are none here, its number of items and the
bytes of one, where it begins, its lengths and its strides (`numba.core.datamodel.models.ArrayModel`).
"""

import ctypes
import threading
from collections.abc import Callable, Iterator
from functools import cache
from operator import index
from typing import Any, Final, NamedTuple, get_args, get_type_hints

import llvmlite.binding as llvm
import numpy as np

from controller.compiled.signals import signals_wait

_NUMBERS: Final = {"float64": ctypes.c_double, "int64": ctypes.c_int64, "bool": ctypes.c_bool}
_READ: Final[dict[str, Callable[[Any], Any]]] = {"float64": float, "int64": index, "bool": bool}
_DONE: Final = frozenset({0, -2})  # `RETCODE_OK`, and `RETCODE_NONE` of a loop that gives nothing


class Shape(NamedTuple):
    """What an argument or a result is.

    Attributes
    ----------
    kind
        ``float64``, ``int64``, ``bool``, ``none``, ``array`` or ``tuple``.
    name
        Of an array: numpy's name of what it holds.
    dimensions
        Of an array.
    fields
        Of a tuple.
    """

    kind: str
    name: str = ""
    dimensions: int = 0
    fields: "tuple[Shape, ...]" = ()


class MachineCode(NamedTuple):
    """A compiled loop.

    Attributes
    ----------
    symbol
        Name of its function in the object file.
    takes, gives
        Its arguments and its result.
    object_code
        The object file, of the system and the architecture that it was made on.
    """

    symbol: str
    takes: tuple[Shape, ...]
    gives: Shape
    object_code: bytes


PROCESSOR: Final = "generic"
"""LLVM's name of the least processor of an architecture."""


@cache
def target_machine() -> llvm.TargetMachine:
    """Any processor of this architecture, as LLVM makes code for it."""
    llvm.initialize_native_target()
    llvm.initialize_native_asmprinter()
    return llvm.Target.from_default_triple().create_target_machine(PROCESSOR, "", opt=3, jit=True)


def function_of(code: MachineCode, result: Any) -> Callable[..., Any]:
    """The function of machine code, whose annotated `result` names the classes of its tuples.

    It raises TypeError for arguments that are not what it takes. RuntimeError where LLVM cannot link the code.
    """
    takers = [_taker(shape) for shape in code.takes]
    types = [part for shape in code.takes for part in _parts(shape)]
    native = ctypes.CFUNCTYPE(ctypes.c_int32, ctypes.c_void_p, ctypes.c_void_p, *types)(_address(code))
    place_of, read = _place(code.gives), _reader(code.gives, result)

    def function(*values: Any) -> Any:
        if len(values) != len(takers):
            raise TypeError(f"{len(takers)} arguments are taken, not {len(values)}")
        parts: list[Any] = []
        for take, value in zip(takers, values, strict=True):
            take(value, parts)
        result, failed = place_of(), ctypes.c_void_p()
        status = native(ctypes.addressof(result), ctypes.addressof(failed), *parts)
        if status not in _DONE:
            raise RuntimeError(f"{code.symbol} ended with status {status}")
        return read(result)

    return function


_linked: Final[list[Any]] = []  # code goes with the objects that LLVM gives for it
_linking: Final = threading.Lock()


@cache
def _linker() -> Any:
    return llvm.create_lljit_compiler(target_machine())


def _address(code: MachineCode) -> int:
    """Where the function of machine code begins, once linked. RuntimeError where it cannot be.

    An interrupt while LLVM links code ends in a crash.
    """
    with _linking, signals_wait():
        library = llvm.JITLibraryBuilder().add_object_img(code.object_code).export_symbol(code.symbol)
        linked = library.add_current_process().link(_linker(), f"loop {len(_linked)}")
        _linked.append(linked)
        return int(linked[code.symbol])


def _parts(shape: Shape) -> Iterator[Any]:
    """Types of the parts that an argument is taken apart into."""
    if shape.kind == "tuple":
        for field in shape.fields:
            yield from _parts(field)
    elif shape.kind == "array":
        yield from (ctypes.c_void_p, ctypes.c_void_p, ctypes.c_int64, ctypes.c_int64, ctypes.c_void_p)
        yield from [ctypes.c_int64] * (2 * shape.dimensions)
    else:
        yield _NUMBERS[shape.kind]


def _taker(shape: Shape) -> Callable[[Any, list[Any]], None]:
    """What takes an argument apart and adds its parts to a list."""
    if shape.kind == "tuple":
        return _tuple_taker([_taker(field) for field in shape.fields])
    if shape.kind == "array":
        return _array_taker(np.dtype(shape.name), shape.dimensions)
    read = _READ[shape.kind]
    return lambda value, parts: parts.append(read(value))


def _tuple_taker(takers: list[Callable[[Any, list[Any]], None]]) -> Callable[[Any, list[Any]], None]:
    def take(value: Any, parts: list[Any]) -> None:
        if len(value) != len(takers):
            raise TypeError(f"a tuple of {len(takers)} is taken, not of {len(value)}")
        for each, field in zip(takers, value, strict=True):
            each(field, parts)

    return take


def _array_taker(dtype: "np.dtype[Any]", dimensions: int) -> Callable[[Any, list[Any]], None]:
    def take(value: Any, parts: list[Any]) -> None:
        if not (isinstance(value, np.ndarray) and value.dtype == dtype and value.ndim == dimensions):
            raise TypeError(f"an array of {dtype} in {dimensions} dimensions is taken, not {_named(value)}")
        if not value.flags.c_contiguous:
            raise TypeError("an array without gaps is taken, in the order of its rows")
        begin = value.__array_interface__["data"][0]
        parts += (None, None, value.size, value.itemsize, begin, *value.shape, *value.strides)

    return take


def _named(value: object) -> str:
    return f"{value.dtype} in {value.ndim}" if isinstance(value, np.ndarray) else type(value).__name__


def _place(shape: Shape) -> Any:
    """The type of where a result is written."""
    if shape.kind == "tuple":
        fields = [(f"field{at}", _place(field)) for at, field in enumerate(shape.fields)]
        return type("Place", (ctypes.Structure,), {"_fields_": fields})
    return _NUMBERS.get(shape.kind, ctypes.c_void_p)


def _reader(shape: Shape, result: Any) -> Callable[[Any], Any]:
    """What reads a result from where it was written."""
    if shape.kind == "tuple":
        return _tuple_reader(shape, result)
    return (lambda place: None) if shape.kind == "none" else (lambda place: place.value)


def _tuple_reader(shape: Shape, result: Any) -> Callable[[Any], Any]:
    is_named = hasattr(result, "_fields")
    annotated = get_type_hints(result).values() if is_named else get_args(result)
    names = [f"field{at}" for at in range(len(shape.fields))]
    inner = [
        _reader(field, of) if field.kind == "tuple" else None for field, of in zip(shape.fields, annotated, strict=True)
    ]
    whole = result._make if is_named else tuple

    def read(place: Any) -> Any:
        values = (getattr(place, name) for name in names)  # numbers come as Python's own
        return whole(value if each is None else each(value) for each, value in zip(inner, values, strict=True))

    return read
