"""Where settings are looked for: in the folder of a program and above it, up to the root of its project.

The root is the nearest folder that holds ``.git``, or settings with ``root = true``. Where there is none, folders
above the program's own count only as far as the working folder. No folder above the home folder ever counts: what
stands there may be anybody's.
"""

import os
from collections.abc import Iterator, Mapping
from contextlib import suppress
from pathlib import Path
from typing import Any, NamedTuple

from parser.findings.errors import DrycutError, FileUnreadableError, SettingsError, system_message
from sim.check.settings.read import NAMES, NO_SETTINGS, SettingsFile, content_of, read_settings


class _Found(NamedTuple):
    """A settings file, and what it holds for drycut."""

    file: Path
    content: Mapping[str, Any]


class SettingsSearch:
    """Finds the settings of programs; each folder is looked at once, and each settings file read once.

    Attributes
    ----------
    working
        The working folder, without links.
    """

    def __init__(self) -> None:
        self.working = _working_folder()
        self._home = _home()
        self._folders: dict[Path, Path] = {}
        self._near: dict[Path, SettingsFile] = {}
        self._in: dict[Path, _Found | None] = {}
        self._read: dict[Path, SettingsFile] = {}
        self._roots: dict[Path, bool] = {}

    def placed(self, path: Path) -> Path:
        """A path without links but for its last part: a link counts where it stands, not where it leads."""
        folder = path.parent
        if folder not in self._folders:
            self._folders[folder] = folder.resolve()
        return self._folders[folder] / path.name

    def near(self, folder: Path) -> SettingsFile:
        """Settings that count in a folder, whose path has no link in it; those of no file where there are none.

        Raises FileUnreadableError or SettingsError with file and key.
        """
        if folder not in self._near:
            self._near[folder] = self._nearest(folder)
        return self._near[folder]

    def named(self, file: Path) -> SettingsFile:
        """Settings of a file that somebody named, wherever it stands and whoever owns it.

        Raises FileUnreadableError or SettingsError with file and key, and where it holds none for drycut.
        """
        file = self.placed(file)
        content = content_of(file)
        if content is None:
            raise SettingsError("no-tool-drycut", file=self._name_of(file))
        return read_settings(content, file, self._name_of(file))

    def _nearest(self, folder: Path) -> SettingsFile:
        for here in self._ladder(folder):
            found = self._settings_in(here)
            if found:
                self._refuse_of_others(found.file, folder)
                if found.file not in self._read:
                    self._read[found.file] = read_settings(found.content, found.file, self._name_of(found.file))
                return self._read[found.file]
        return NO_SETTINGS

    def _ladder(self, folder: Path) -> Iterator[Path]:
        """Folders of which the settings count for a folder, the nearest first."""
        yield folder
        above = [folder, *folder.parents]
        if self._home in above:
            above = above[: above.index(self._home) + 1]
        root = next((at for at, here in enumerate(above) if self._is_root(here, folder)), None)
        if root is not None:
            yield from above[1 : root + 1]
        else:
            yield from (here for here in above[1:] if here.is_relative_to(self.working))

    def _is_root(self, here: Path, folder: Path) -> bool:
        """Whether a folder is the root of a project. Settings of others, or that cannot be read, make it none."""
        if here not in self._roots:
            self._roots[here] = os.path.lexists(here / ".git")
        if self._roots[here]:
            return True
        with suppress(DrycutError):
            found = self._settings_in(here)
            if found and found.content.get("root") is True:
                self._refuse_of_others(found.file, folder)
                return True
        return False

    def _settings_in(self, folder: Path) -> _Found | None:
        if folder not in self._in:
            self._in[folder] = self._look_in(folder)
        return self._in[folder]

    def _look_in(self, folder: Path) -> _Found | None:
        for file in (folder / name for name in NAMES):
            if _stands(file):
                content = content_of(file)
                if content is not None:
                    return _Found(file, content)
        return None

    def _name_of(self, file: Path) -> str:
        """A settings file as it is named to people: from the working folder where it lies below that."""
        return str(file.relative_to(self.working) if file.is_relative_to(self.working) else file)

    def _refuse_of_others(self, file: Path, folder: Path) -> None:
        """SettingsError for a file that belongs to another user, other than the folder that it is to count for.

        Who owns that folder may write the program as well. Windows does not tell users apart by numbers.
        """
        if not hasattr(os, "geteuid"):
            return
        trusted = {0, os.geteuid()}
        with suppress(OSError):
            trusted.add(folder.stat().st_uid)
        owners = {file.stat().st_uid, file.lstat().st_uid}
        if owners - trusted:
            raise SettingsError("settings-of-another-user", file=self._name_of(file), owner=min(owners - trusted))


def _stands(file: Path) -> bool:
    """Whether anything has that name. FileUnreadableError where nobody can tell."""
    try:
        file.lstat()
    except (FileNotFoundError, NotADirectoryError):
        return False
    except OSError as error:
        raise FileUnreadableError("cannot-be-read", file=file, why=system_message(error)) from None
    return True


def _working_folder() -> Path:
    """The working folder without links. FileUnreadableError where it is gone."""
    try:
        return Path.cwd().resolve()
    except OSError as error:
        raise FileUnreadableError("working-folder-unreadable", why=system_message(error)) from None


def _home() -> Path | None:
    """Folder of the user; None where the system knows none."""
    try:
        return Path.home().resolve()
    except (RuntimeError, OSError):
        return None
