"""The map against the tree: its rooms, their order, their border types and every path that it names."""

import ast
import re
import tomllib
from functools import cache
from pathlib import Path
from typing import NamedTuple

import pytest
from places import ROOT

PAGE = (ROOT / "docs" / "architecture.md").read_text("utf-8")
PACKAGES = ("parser", "controller", "sim")
LINTER = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["tool"]["importlinter"]["contracts"]


class Room(NamedTuple):
    """A row of a package's table: its path, and the types in the column of its border."""

    path: Path
    border: tuple[str, ...]

    @property
    def name(self) -> str:
        return self.path.stem

    @property
    def docstring(self) -> str:
        file = self.path / "__init__.py" if self.path.is_dir() else self.path
        return ast.get_docstring(ast.parse(file.read_text("utf-8"))) or ""


def types(text: str) -> tuple[str, ...]:
    return tuple(re.findall(r"`([A-Z]\w+)`", text))


def part(heading: str) -> str:
    """What stands under the heading that begins so."""
    (found,) = re.findall(rf"^## {heading}.*?\n(.*?)(?=^## |\Z)", PAGE, flags=re.MULTILINE | re.DOTALL)
    return found


def rooms_of(package: str) -> list[Room]:
    rows = re.findall(r"^\| `([\w./]+)` \| [^|]+ \| ([^|]+) \| [^|]+ \|$", part(f"`{package}`"), flags=re.MULTILINE)
    return [Room(ROOT / package / path, types(border)) for path, border in rows]


def inner(folder: Path) -> set[str]:
    """Rooms in a folder: packages of Python."""
    return {file.parent.name for file in folder.glob("*/__init__.py")}


ROOMS = [room for package in PACKAGES for room in rooms_of(package)]
EACH = [pytest.param(room, id=str(room.path.relative_to(ROOT))) for room in ROOMS]


@cache
def defined(path: Path) -> set[str]:
    """Classes and constants that a module, or the modules of a room, define."""
    names = set()
    for file in path.rglob("*.py") if path.is_dir() else (path,):
        for node in ast.parse(file.read_text("utf-8")).body:
            if isinstance(node, ast.ClassDef):
                names.add(node.name)
            elif isinstance(node, ast.Assign):
                names |= {target.id for target in node.targets if isinstance(target, ast.Name)}
    return names


@pytest.mark.parametrize("package", PACKAGES)
def test_every_room_stands_in_the_table_of_its_package(package: str) -> None:
    modules = {file.stem for file in (ROOT / package).glob("*.py")} - {"__init__", "__main__"}
    assert sorted(room.name for room in rooms_of(package)) == sorted(inner(ROOT / package) | modules)


@pytest.mark.parametrize("package", PACKAGES)
def test_rooms_stand_above_those_that_they_may_import(package: str) -> None:
    (layers,) = (contract["layers"] for contract in LINTER if contract.get("containers") == [package])
    floor = {name: at for at, names in enumerate(layers) for name in names.split(" | ")}
    floors = [floor[room.name] for room in rooms_of(package)]
    assert floors == sorted(floors)


@pytest.mark.parametrize("room", EACH)
def test_a_room_says_itself_what_crosses_its_border(room: Room) -> None:
    assert room.docstring
    if room.path.is_dir():
        assert set(types(room.docstring)) == set(room.border)


@pytest.mark.parametrize("room", EACH)
def test_types_at_a_border_are_those_of_the_room_or_of_a_border_below_it(room: Room) -> None:
    package = PACKAGES.index(room.path.relative_to(ROOT).parts[0])
    own = rooms_of(PACKAGES[package])
    below = [*own[own.index(room) + 1 :], *(other for name in PACKAGES[:package] for other in rooms_of(name))]
    lent = {name for other in below for name in other.border if name in defined(other.path)}
    assert set(room.border) <= defined(room.path) | lent


def test_rooms_within_rooms_are_all_there() -> None:
    told: dict[str, set[str]] = {}
    room = ""
    for name, within in re.findall(r"^\| (?:`([\w/]+)/`)? ?\| (.+) \|$", part("Rooms within rooms"), re.MULTILINE):
        room = name or room
        told.setdefault(room, set()).update(re.findall(r"`(\w+)/`", within))
    real = {str(room.path.relative_to(ROOT)): inner(room.path) for room in ROOMS if room.path.is_dir()}
    assert told == {path: within for path, within in real.items() if within}


def test_every_path_named_exists() -> None:
    named = re.findall(r"`((?:parser|controller|sim)/[\w/.]*)`", PAGE)
    assert len(named) > 40
    assert [path for path in named if not (ROOT / path).exists()] == []


def test_every_path_that_recipes_name_exists() -> None:
    page = (ROOT / "CONTRIBUTING.md").read_text("utf-8")
    named = re.findall(r"`((?:parser|controller|sim|tests|docs|scenarios)/[\w/.-]+)`", page)
    made_by_hand = re.compile(r"NAME|CODE|^tests/failures/$")
    assert len(named) > 40
    assert [path for path in named if not made_by_hand.search(path) and not (ROOT / path).exists()] == []
