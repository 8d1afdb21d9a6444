"""New files in place of the earlier ones, all of them or none; and what is left to do where a swap was cut short.

A set of files swapped by moves, where there are no links: the earlier files go aside, then the new ones come.

At no moment does a new file stand beside an earlier one, but in between some are missing. A file in the stage has the
names, and says by its own how far the swap came: ``.emptying`` while the earlier files go, ``.filling`` while the new
ones come.
"""

import json
import os
from collections.abc import Sequence
from pathlib import Path

from sim.files.links import settle, swap_by_links

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


def swap(stage: Path, folder: Path, names: Sequence[str]) -> None:
    """Put the files of a stage in the places of these names in its folder; `finish` has to follow.

    A name that is not in the stage is then gone. One file alone is replaced by one rename. Raises OSError where a name
    cannot be replaced; after `finish` the folder is then as it was.
    """
    stage.stat()  # were it gone, its files would seem not to have been made
    if len(names) == 1:
        _replace_one(stage / names[0], folder / names[0])
    elif not swap_by_links(stage, folder, names):
        swap_by_moves(stage, folder, names)


def _replace_one(made: Path, path: Path) -> None:
    if made.exists():
        made.replace(path)
    else:
        path.unlink(missing_ok=True)


def finish(stage: Path, folder: Path) -> None:
    """End a swap, however far it came: then one whole set stands in the folder, and nothing there needs the stage.

    Raises OSError where a file cannot be moved to its place; the stage must then stay.
    """
    settle(stage, folder)
    undo(stage, folder)
