"""New files in place of the earlier ones, all of them or none; and what is left to do where a swap was cut short.

A set of files swapped by moves, where there are no links: the earlier files go aside, then the new ones come.

At no moment does a new file stand beside an earlier one, but in between some are missing. A file in the stage has the
names, and says by its own how far the swap came: ``.emptying`` while the earlier files go, ``.filling`` while the new
ones come.

A set of files swapped in one moment, by links that show the earlier set first and then the new one.

Each name becomes a symbolic link to ``.shown/NAME`` in the stage, where ``.shown`` is itself a link: to ``.kept``,
which has the earlier files. Nothing changes for who reads the name. Then ``.shown`` is made to lead to the stage, which
has the new files: by that one rename all names show them. At last each file takes the place of its link. So between any
two of these steps, and after a kill between them, the names show one whole set.
"""

import json
import os
import stat
from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path

_KEPT, _SHOWN, _NEXT = ".kept", ".shown", ".next"


def swap_by_links(stage: Path, folder: Path, names: Sequence[str]) -> bool:
    """Let the names in a folder show the files of its stage; `settle` then puts these in their places.

    A name that is not in the stage is then gone. False, and nothing has changed, where there are no such links to be
    had: on Windows, on file systems without links, and where one of the files is a link or may not be linked. Raises
    OSError where a name cannot be replaced; `settle` then puts back what was there.
    """
    if os.name == "nt":  # links need a privilege there, and one to a folder is not replaced by a rename
        return False
    try:
        _keep(stage, folder, names)
        (stage / _SHOWN).symlink_to(_KEPT)
    except OSError:
        return False
    for name in names:
        _put_link(stage, _link(stage, name), folder / name)
    _put_link(stage, ".", stage / _SHOWN)
    return True


def _keep(stage: Path, folder: Path, names: Sequence[str]) -> None:
    """Second names for the earlier files, in the stage; OSError where one cannot be made."""
    (stage / _KEPT).mkdir()
    for name in names:
        with suppress(FileNotFoundError):
            if not stat.S_ISREG((folder / name).lstat().st_mode):
                raise OSError(f"{name} is a link, and may lead elsewhere from another folder")
            (stage / _KEPT / name).hardlink_to(folder / name)


def _put_link(stage: Path, leads_to: str, path: Path) -> None:
    """Put a link in place of what is there."""
    (stage / _NEXT).symlink_to(leads_to)
    (stage / _NEXT).replace(path)


def settle(stage: Path, folder: Path) -> None:
    """Put the set that the names show in place of the links that show it; where there are none, nothing changes.

    Raises OSError where one cannot be replaced; the names show that whole set still.
    """
    if not (stage / _SHOWN).is_symlink():
        return
    with os.scandir(folder) as entries:
        links = [entry.name for entry in entries if entry.is_symlink()]
    for name in links:
        if str((folder / name).readlink()) == _link(stage, name):
            try:
                (stage / _SHOWN / name).replace(folder / name)
            except FileNotFoundError:  # this set has no such file
                (folder / name).unlink()


def _link(stage: Path, name: str) -> str:
    """Text of a link in the folder; it holds wherever the folder is moved to."""
    return f"{stage.name}/{_SHOWN}/{name}"


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
