"""A set of files swapped in one moment, by links that show the earlier set first and then the new one.

Each name becomes a symbolic link to ``.shown/NAME`` in the stage, where ``.shown`` is itself a link: to ``.kept``,
which has the earlier files. Nothing changes for who reads the name. Then ``.shown`` is made to lead to the stage, which
has the new files: by that one rename all names show them. At last each file takes the place of its link. So between any
two of these steps, and after a kill between them, the names show one whole set.
"""

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
