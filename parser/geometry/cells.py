"""Cells of a grid as keys: places that fall into one cell are found by sorting."""

from typing import Final

from parser.geometry.curves import Ints

_FACTORS: Final = (-7046029254386353131, 7809847782465536322, -4417276706812531889)
"""Mixed bits, signed: 2⁶⁴ over the golden ratio, the upper half of the basis of FNV for 128 bits, a prime of xxHash."""


def cell_keys(column: Ints, row: Ints | int, layer: Ints | int = 0) -> Ints:
    """One key (n,) a cell from its column, row and layer (n,) int64; sums wrap round.

    Keys of two cells may be the same, if seldom. That costs time, not truth, where what shares a key is compared.
    """
    return column * _FACTORS[0] + row * _FACTORS[1] + layer * _FACTORS[2]
