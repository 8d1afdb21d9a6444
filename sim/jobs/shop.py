"""The programs of a shop: what names, folders and globs lead to, each once, a scenario with the program that is its."""

import os
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Final, NamedTuple

from parser.findings.errors import DrycutError
from parser.program import suffixes
from parser.text.encoding import printable
from sim.check.files import find_files
from sim.jobs.folders import folder_names
from sim.setup.scenario import Scenario

SCENARIO: Final = "scenario.toml"


class ShopProgram(NamedTuple):
    """A program of a shop.

    Attributes
    ----------
    file
        Its file as it was named, with ``/`` between the parts; of a scenario that cannot be read, ``scenario.toml``.
    folder
        Its folder in OUT.
    scenario
        What it is run with; None where that cannot be read, for which `error` says why.
    """

    file: str
    folder: str
    scenario: Scenario | None
    error: str = ""


def find_programs(
    names: Sequence[str], scenario_of: Callable[[Path], Scenario], out: Path, taken: frozenset[str]
) -> list[ShopProgram]:
    """The programs that names lead to, in the order of the names, in folders in that of their paths.

    A folder with a ``scenario.toml`` is one scenario: its program is not run by itself too. Of a scenario that cannot
    be read nobody knows which program that is: none that stands beside it is run. Nothing is looked for in `out`.

    Parameters
    ----------
    names
        Files, folders and globs.
    scenario_of
        Scenario of a folder, and of a program alone; raises DrycutError.
    out
        Where the runs are written.
    taken
        Names, in small letters, that no folder in it may have.

    Raises FileUnreadableError for a name that leads to nothing, and what `scenario_of` raises for any program alone.
    """
    away = out.resolve()
    ends = (*suffixes(), f"/{SCENARIO}")
    files = [Path(file) for file in find_files(names, lambda path: path.resolve() == away, ends)]
    scenarios = {file: _scenario(file.parent, scenario_of) for file in files if file.name.lower() == SCENARIO}
    theirs = _Theirs(scenarios)
    apart = [file for file in files if file in scenarios or file not in theirs]
    ways = [file.parent if file in scenarios else file for file in apart]
    folders = folder_names(ways, names, taken)
    alone = _Alone(scenario_of)
    return [
        _found(file, scenarios[file] if file in scenarios else alone.of(file), folder)
        for file, folder in zip(apart, folders, strict=True)
    ]


def _scenario(folder: Path, scenario_of: Callable[[Path], Scenario]) -> Scenario | str:
    """The scenario of a folder, or why there is none."""
    try:
        return scenario_of(folder)
    except DrycutError as error:
        return error.message


class _Theirs:
    """The programs that belong to scenarios."""

    def __init__(self, scenarios: dict[Path, Scenario | str]) -> None:
        found = {file.parent: scenario for file, scenario in scenarios.items()}
        self._programs = {os.path.realpath(one.program) for one in found.values() if isinstance(one, Scenario)}
        self._unread = {os.path.realpath(folder) for folder, one in found.items() if isinstance(one, str)}

    def __contains__(self, file: Path) -> bool:
        """Whether a program is that of a scenario, or may be."""
        path = os.path.realpath(file)
        return path in self._programs or os.path.dirname(path) in self._unread  # noqa: PTH120 - text, as above


def _found(file: Path, scenario: Scenario | str, folder: str) -> ShopProgram:
    if isinstance(scenario, str):
        return ShopProgram(file.as_posix(), folder, None, scenario)
    return ShopProgram(scenario.program.as_posix(), folder, scenario)


class _Alone:
    """Scenarios of programs alone: read once, since all of them have the same machine, wire and work."""

    def __init__(self, scenario_of: Callable[[Path], Scenario]) -> None:
        self._scenario_of = scenario_of
        self._first: Scenario | None = None

    def of(self, file: Path) -> Scenario:
        """That of a file."""
        if self._first is None:
            self._first = self._scenario_of(file)
        return replace(self._first, title=printable(file.name), program=file)
