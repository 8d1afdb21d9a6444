"""Machine and technology files that came to the page: each has a name of its own, by which a form names it."""

import re
from pathlib import Path
from typing import Final

from parser.findings.errors import SettingsError
from sim.setup.machine.machine import Machine, load_machine, machine_names
from sim.setup.technology import TECHNOLOGY, Technology, load_technology
from sim.setup.toml.reader import load_toml

_OWN: Final = re.compile(r"own-\d{1,9}")
_TECHNOLOGY: Final = re.compile(r"technology-\d{1,9}")


class Machines:
    """The machine and technology files of the page.

    Parameters
    ----------
    folder
        Of the files of the server; who gave it clears it away.
    """

    def __init__(self, folder: Path) -> None:
        self.folder = machine_files(folder)
        self._count = 0

    def keep(self, data: bytes) -> str:
        """The name of a file that came. SettingsError, which names the file by that name, where it is neither."""
        name = f"own-{self._count}"
        self._count += 1
        self.folder.mkdir(exist_ok=True)
        file = self.folder / f"{name}.toml"
        file.write_bytes(data)
        try:
            if TECHNOLOGY.name in load_toml(file):
                name = name.replace("own", "technology")
                file = file.rename(file.with_stem(name))
                technology_of(name, self.folder)
            else:
                load_machine(name, own=self.folder)
        except SettingsError:
            file.unlink()
            raise
        return name


def machine_files(folder: Path) -> Path:
    """Where the machine files stand in the folder of a server."""
    return folder / "machines"


def is_machine(name: str) -> bool:
    """Whether a file that came is meant as a machine or a technology, by its name."""
    return name.lower().endswith(".toml")


def is_technology(name: str) -> bool:
    """Whether a file that came was a technology, by the name that it got."""
    return bool(_TECHNOLOGY.fullmatch(name))


def technology_of(name: str, files: Path | None) -> Technology:
    """A technology that came to the page and stands in `files`. SettingsError for another name."""
    if files is not None and is_technology(name) and (files / f"{name}.toml").is_file():
        return load_technology(files / f"{name}.toml")
    raise SettingsError("technology-not-on-page", name=name[:40])


def machine_of(name: str, files: Path | None) -> Machine:
    """A shipped machine, or one that came to the page and stands in `files`: a page names no other file of the disk.

    SettingsError for another name.
    """
    if name in machine_names():
        return load_machine(name)
    if files is not None and _OWN.fullmatch(name) and (files / f"{name}.toml").is_file():
        return load_machine(name, own=files)
    raise SettingsError("machine-not-shipped-on-page", name=name[:40])
