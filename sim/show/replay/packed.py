"""Columns of whole numbers as text for a page: variable-length bytes, deflated, in base64."""

import base64
import zlib

import numpy as np
from numpy.typing import NDArray

from parser.geometry.curves import Ints

_BITS = 7
"""Of a number in each byte, the lowest first; the eighth tells that another byte follows (LEB128)."""
_LEVEL = 6
_RAW = -15  # window bits of a stream without head and checksum, as a page's DecompressionStream("deflate-raw") takes it


class Packer:
    """Packs bytes as they stream in, in memory that grows with the packed text alone."""

    def __init__(self) -> None:
        self._deflate = zlib.compressobj(_LEVEL, zlib.DEFLATED, _RAW)
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
