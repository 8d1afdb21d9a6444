"""Machine code of compiled loops, by numba: loaded from disk, or made and kept there."""

import os
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any, Final, Protocol, get_type_hints

import numba
import numpy as np
import platformdirs
from numba import types
from numba.core import config, event
from numba.extending import typeof_impl
from numpy.typing import NDArray

from controller.compiled.compiling import compiling

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


class Source(Protocol):
    """What a loop is made of, as `controller.compiled.loops.Loop` has it."""

    function: Callable[..., Any]
    signature: str
    tuples: tuple[type, ...]
    digest: str

    def loaded(self) -> Callable[..., Any]:
        """Its machine code."""


def code_of(loop: Source) -> Callable[..., Any]:
    """Machine code of a loop for its one signature."""
    typed = _signature(loop.signature, loop.tuples)
    options = _OPTIONS | _OF_TUPLES if loop.tuples else _OPTIONS
    with _keeping(loop.digest):
        try:
            code: Callable[..., Any] = numba.njit(typed, cache=True, **options)(loop.function)
        except RuntimeError:  # numba found no place to keep it
            code = numba.njit(typed, **options)(loop.function)
    return code


def let_call_one_another(kind: type[Source]) -> None:
    """Let loops of a class be called by others; numba takes their machine code for them."""
    typeof_impl.register(kind)(_type_of_loop)


def _type_of_loop(loop: Source, context: object) -> types.Type:
    return types.Dispatcher(loop.loaded())


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
