"""Examples that come with drycut: its scenarios, for who has no clone of it and wants something to try."""

from pathlib import Path
from typing import Final

from parser.files import read_bytes
from sim.base.files import staged
from sim.setup.scenario import Scenario, load_scenario

_PACKAGE: Final = Path(__file__).parents[1]


def example_names() -> tuple[str, ...]:
    """Names of the examples, in order."""
    return tuple(sorted(folder.parent.name for folder in _folder().glob("*/scenario.toml")))


def example(name: str) -> Scenario:
    """An example as it comes with drycut. KeyError where none has the name."""
    if name not in example_names():
        raise KeyError(name)
    return load_scenario(_folder() / name)


def example_into(folder: Path, name: str) -> list[str]:
    """Write the files of an example into a folder, all or none; gives their names.

    KeyError where no example has the name, FileUnreadableError where the folder cannot be written.
    """
    if name not in example_names():
        raise KeyError(name)
    files = sorted(file for file in (_folder() / name).iterdir() if file.is_file())
    names = [file.name for file in files]
    with staged(folder, names) as stage:
        for file in files:
            (stage / file.name).write_bytes(read_bytes(file))
    return names


def _folder() -> Path:
    """Where they are: beside the packages in a clone, within them where drycut is installed."""
    shipped = _PACKAGE / "scenarios"
    return shipped if shipped.is_dir() else _PACKAGE.parent / "scenarios"
