"""A set of files swapped by moves, where there are no links: the earlier files go aside, then the new ones come.

At no moment does a new file stand beside an earlier one, but in between some are missing. An empty file in the stage
says how far the swap came: ``emptying`` while the earlier files go, ``filling`` while the new ones come.
"""

import os
from collections.abc import Sequence
from pathlib import Path

from sim.files.links import MADE

_ASIDE, _EMPTYING, _FILLING = "aside", "emptying", "filling"


def swap_by_moves(stage: Path, folder: Path, names: Sequence[str]) -> None:
    """Move the files of these names in a folder aside, and those of ``made`` in its stage to their places.

    Raises OSError where one cannot be moved; `undo` then puts back what was there.
    """
    (stage / _ASIDE).mkdir()
    (stage / _EMPTYING).touch()
    for name in names:
        if os.path.lexists(folder / name):
            (folder / name).rename(stage / _ASIDE / name)
    (stage / _EMPTYING).rename(stage / _FILLING)
    for name in names:
        if (stage / MADE / name).exists():
            (stage / MADE / name).rename(folder / name)
    (stage / _FILLING).unlink()


def undo(stage: Path, folder: Path, names: Sequence[str]) -> None:
    """Put back what was there before a swap by moves that did not come to its end; may be done again from any point.

    Raises OSError where a file cannot be moved back; the earlier files then stay in the stage.
    """
    if (stage / _FILLING).exists():
        for name in names:
            (folder / name).unlink(missing_ok=True)
        (stage / _FILLING).rename(stage / _EMPTYING)
    if (stage / _EMPTYING).exists():
        for name in names:
            if os.path.lexists(stage / _ASIDE / name):
                (stage / _ASIDE / name).replace(folder / name)
        (stage / _EMPTYING).unlink()
