"""New files in place of the earlier ones, all of them or none; and what is left to do where a swap was cut short."""

from collections.abc import Sequence
from pathlib import Path

from sim.files.links import settle, swap_by_links
from sim.files.moves import swap_by_moves, undo


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
