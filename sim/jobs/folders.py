"""A folder in OUT for each program: as the shop has them, under names that every system takes and that never meet."""

import glob
import hashlib
import os
import re
import unicodedata
from collections import Counter
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Final

# Forbidden in names by Windows, with what is no character for people.
# https://learn.microsoft.com/windows/win32/fileio/naming-a-file
_UNSAFE: Final = re.compile(r'[<>:"/\\|?*\x00-\x1f\x7f-\x9f\ud800-\udfff]')
_DEVICES: Final = re.compile(r"(con|prn|aux|nul|com[0-9¹²³]|lpt[0-9¹²³])(\..*)?", re.IGNORECASE)
_HIDDEN: Final = ".drycut-"  # begins the names of our own hidden folders
MOST_CHARACTERS: Final = 80  # characters of one name; Windows takes 260 of a whole path


def folder_names(programs: Sequence[Path], names: Iterable[str], taken: frozenset[str]) -> list[str]:
    """The folder of each program in OUT, with ``/`` between its parts: its way from the folder that was named.

    Of several names it is the way from the folder that holds all of them. A part that some system cannot have, or that
    is `taken` by a file of ours, is mended and gets a mark, eight hex digits of what it was; so do folders that a
    system could not tell apart. So no two are the same, and the same names and programs give the same folders.
    """
    root = _root(names)
    ways = [_way(path, root) for path in programs]
    made = ["/".join(_safe(part, taken) for part in way) for way in ways]
    count = Counter(map(_told_apart, made))
    return [
        name if count[_told_apart(name)] == 1 else f"{name}~{_mark('/'.join(way))}"
        for name, way in zip(made, ways, strict=True)
    ]


def _root(names: Iterable[str]) -> str | None:
    """The folder that holds all that was named; None where Windows has it on several drives."""
    try:
        return os.path.commonpath([_folder(name) for name in names])
    except ValueError:
        return None


def _folder(name: str) -> str:
    path = Path(name)
    if not path.exists() and glob.has_magic(name):
        fixed = [part for part in path.parts if not glob.has_magic(part)]
        path = Path(*path.parts[: next(at for at, part in enumerate(path.parts) if part not in fixed)])
    return os.path.abspath(path if path.is_dir() else path.parent)  # noqa: PTH100 - links stay as they are named


def _way(path: Path, root: str | None) -> tuple[str, ...]:
    whole = Path(os.path.abspath(path))  # noqa: PTH100 - as above
    way = whole.parts if root is None else Path(os.path.relpath(whole, root)).parts
    return way or (whole.name,)


def _safe(part: str, taken: frozenset[str]) -> str:
    """A name that every system takes, the same where it is one already."""
    plain = unicodedata.normalize("NFC", part)
    clean = _UNSAFE.sub("_", plain).rstrip(". ")[:MOST_CHARACTERS]
    ours = clean.startswith(_HIDDEN) or clean.lower() in taken
    if clean == plain and not ours and not _DEVICES.fullmatch(clean):
        return clean
    visible = clean.lstrip(". ")
    return f"{'_' if _DEVICES.fullmatch(visible) else ''}{visible}~{_mark(part)}"


def _mark(text: str) -> str:
    return hashlib.sha256(text.encode("utf-8", "surrogatepass")).hexdigest()[:8]


def _told_apart(name: str) -> str:
    """What of a name counts on systems that do not tell case apart."""
    return unicodedata.normalize("NFC", name).casefold()
