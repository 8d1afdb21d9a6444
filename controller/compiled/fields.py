"""Fields of the NamedTuples that loops take and give."""

from typing import Any, Final, get_type_hints

import numpy as np
from numpy.typing import NDArray

WORDS: Final[dict[Any, str]] = {
    float: "f8",
    int: "i8",
    bool: "b1",
    NDArray[np.float64]: "f8[::1]",
    NDArray[np.int64]: "i8[::1]",
}
"""Their types in numba's words."""


def fields_of(value: Any) -> str:
    """Fields of a NamedTuple and of those in it, in words that hang on no release of Python or numpy."""
    if hasattr(value, "_fields"):
        return f"({', '.join(f'{name} {fields_of(of)}' for name, of in get_type_hints(value).items())})"
    return WORDS.get(value, "other")  # loops take no tuple with others
