"""A set of files swapped by moves, where there are no links: the earlier files go aside, then the new ones come.

At no moment does a new file stand beside an earlier one, but in between some are missing. A file in the stage has the
names, and says by its own how far the swap came: ``.emptying`` while the earlier files go, ``.filling`` while the new
ones come.
"""

import json
import os
from collections.abc import Sequence
from pathlib import Path

_ASIDE, _BEGUN, _EMPTYING, _FILLING = ".aside", ".begun", ".emptying", ".filling"


def swap_by_moves(stage: Path, folder: Path, names: Sequence[str]) -> None:
    """Move the files of these names in a folder aside, and those of its stage to their places.

    Raises OSError where one cannot be moved; `undo` then puts back what was there.
    """
    (stage / _ASIDE).mkdir()
    (stage / _BEGUN).write_text(json.dumps(names), encoding="utf-8")
    (stage / _BEGUN).rename(stage / _EMPTYING)
    for name in names:
        if os.path.lexists(folder / name):
            (folder / name).rename(stage / _ASIDE / name)
    (stage / _EMPTYING).rename(stage / _FILLING)
    for name in names:
        if (stage / name).exists():
            (stage / name).rename(folder / name)
    (stage / _FILLING).unlink()


def undo(stage: Path, folder: Path) -> None:
    """Put back what was there before a swap by moves that did not come to its end; may be done again from any point.

    Raises OSError where a file cannot be moved back; the earlier files then stay in the stage.
    """
    if (stage / _FILLING).exists():
        for name in json.loads((stage / _FILLING).read_text(encoding="utf-8")):
            (folder / name).unlink(missing_ok=True)
        (stage / _FILLING).rename(stage / _EMPTYING)
    if (stage / _EMPTYING).exists():
        for path in (stage / _ASIDE).iterdir():
            path.replace(folder / path.name)
        (stage / _EMPTYING).unlink()
