"""Measured circles as files have them: ``x_mm,y_mm`` in order, or ``x_um,y_um`` as `drycut ballbar --trace` writes."""

from pathlib import Path
from typing import Final

import numpy as np

from parser.findings.errors import SettingsError
from parser.geometry.curves import Floats
from parser.units import UM_PER_MM
from sim.setup.rows import Row, read_rows
from sim.setup.toml.reader import Bound

_PLACE_MM: Final = Bound(-1e5, 1e5)
_PLACE_UM: Final = Bound(-1e8, 1e8)
_COLUMNS: Final = ("x_mm", "y_mm", "x_back_mm", "y_back_mm", "x_um", "y_um", "feature")


def is_of_features(path: Path) -> bool:
    """Whether a file has rows of a test piece. Raises as `read_circle` does for a file that has no rows."""
    return any(row.text("feature") for row in read_rows(path, _COLUMNS))


def read_circle(path: Path, back: Path | None = None) -> Floats:
    """Places (n, 2) µm in the order of time, the way back behind the way there: of further columns, or a further file.

    Raises FileUnreadableError, and SettingsError with file, line and column.
    """
    rows = read_rows(path, _COLUMNS)
    if any(row.text("feature") for row in rows):
        raise SettingsError("fit-of-features", file=rows[0].file)
    is_um = "x_um" in rows[0].fields
    x, y, scale = ("x_um", "y_um", 1.0) if is_um else ("x_mm", "y_mm", UM_PER_MM)
    found = [_places(rows, (x, y), scale)]
    if "x_back_mm" in rows[0].fields:
        found.append(_places(rows, ("x_back_mm", "y_back_mm"), UM_PER_MM))
    if back is not None:
        found.append(read_circle(back))
    return np.concatenate(found)


def _places(rows: list[Row], names: tuple[str, str], scale: float) -> Floats:
    """The places of two columns; rows in which both are empty are passed over."""
    bound = _PLACE_UM if scale == 1.0 else _PLACE_MM
    found = []
    for row in rows:
        pair = [row.number(name, bound) for name in names]
        if pair == [None, None]:
            continue
        if None in pair:
            raise row.refused(names[pair.index(None)], f"{bound.low:g} … {bound.high:g}")
        found.append(pair)
    return scale * np.array(found, dtype=np.float64).reshape(-1, 2)
