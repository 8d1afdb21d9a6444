"""Columns packed for the scripts of a page, which unpack them (``assets/packed.js``): deflated bytes in base64.

Numbers are bytes of variable length (LEB128), deflated with the head of zlib. Browsers of 2020 inflate that; a stream
without the head they do not.
"""

import base64
import json
import zlib
from collections.abc import Sequence
from typing import Annotated, Any, TypedDict

import numpy as np
from numpy.typing import NDArray

from parser.geometry.curves import Floats, Ints

LONG = 1000
"""Entries of a column from which on it is packed: shorter ones are read in the page as they are."""
_BITS = 7
"""Of a number in each byte, the lowest first; the eighth tells that another byte follows (LEB128)."""
_LEVEL = 6
_DIGITS = 12
"""Decimals that a packed number may have."""
_LARGEST = 2.0**51
"""Below it changes between two numbers are whole in a page's own numbers, counted as `varints` counts them."""


class PackedEntry(TypedDict):
    """A long column: its numbers as changes from one to the next, times `per`; or any values as JSON."""

    count: int
    per: int
    numbers: str | None
    none: Annotated[str | None, "a byte for each number, 1 where there is none; null where there are all"]
    json: str | None


class Packer:
    """Packs bytes as they stream in, in memory that grows with the packed text alone."""

    def __init__(self) -> None:
        self._deflate = zlib.compressobj(_LEVEL)
        self._parts: list[bytes] = []

    def bytes(self, values: NDArray[np.uint8]) -> None:
        """Take (m,) bytes as they are."""
        self._parts.append(self._deflate.compress(values.tobytes()))

    def numbers(self, values: Ints) -> None:
        """Take (m,) signed numbers of less than 2⁶², small ones in few bytes."""
        self.bytes(varints(values))

    def text(self) -> str:
        """All of it, packed; nothing can be taken any more."""
        return base64.b64encode(b"".join((*self._parts, self._deflate.flush()))).decode("ascii")


def varints(values: Ints) -> NDArray[np.uint8]:
    """Bytes of (m,) signed numbers: 0, −1, 1, −2, 2, … counted as 0, 1, 2, 3, 4, …, seven bits a byte."""
    left = ((values << 1) ^ (values >> 63)).astype(np.uint64)
    if not len(left) or left.max() < 1 << _BITS:
        return left.astype(np.uint8)
    size = np.ones(len(left), dtype=np.int64)
    for bits in range(_BITS, int(left.max()).bit_length(), _BITS):
        size += left >= np.uint64(1 << bits)
    first = np.cumsum(size) - size
    result = np.empty(int(size.sum()), dtype=np.uint8)
    at = np.arange(len(left))
    for byte in range(int(size.max())):
        at = at[size[at] > byte]
        more = (size[at] > byte + 1).astype(np.uint64) << np.uint64(_BITS)
        result[first[at] + byte] = (left[at] >> np.uint64(byte * _BITS)) & np.uint64(127) | more
    return result


def packed(values: Sequence[Any]) -> Sequence[Any] | PackedEntry:
    """A column of a page's data: as it is, or packed where it is long, for ``unpacked`` of ``assets/packed.js``.

    The page has the same values, to the last bit of a number; None stays None.
    """
    if len(values) < LONG:
        return values
    numbers = None if any(isinstance(value, str | bool | list | dict | tuple) for value in values) else _numbers(values)
    if numbers is not None:
        return numbers
    text = _text(json.dumps(values, ensure_ascii=False).encode())
    return {"count": len(values), "per": 1, "numbers": None, "none": None, "json": text}


def _numbers(values: Sequence[float | None]) -> PackedEntry | None:
    """Numbers as changes from one to the next, a gap as no change; None where they have too many digits."""
    lacks = np.array([value is None for value in values])
    known = np.array([0.0 if value is None else value for value in values], dtype=np.float64)
    found = _whole(known)
    if found is None:
        return None
    whole, per = found
    last = np.maximum.accumulate(np.where(lacks, 0, np.arange(len(whole))))
    packer = Packer()
    packer.numbers(np.diff(whole[last], prepend=0))
    none = _text(lacks.astype(np.uint8).tobytes()) if lacks.any() else None
    return {"count": len(values), "per": per, "numbers": packer.text(), "none": none, "json": None}


def _whole(values: Floats) -> tuple[Ints, int] | None:
    """Numbers times the least power of ten that makes all of them whole, and it."""
    for digits in range(_DIGITS + 1):
        per = 10**digits
        whole = np.rint(values * per)
        if np.abs(whole).max() >= _LARGEST:
            return None
        if np.array_equal(whole / per, values):
            return whole.astype(np.int64), per
    return None


def _text(content: bytes) -> str:
    packer = Packer()
    packer.bytes(np.frombuffer(content, dtype=np.uint8))
    return packer.text()
