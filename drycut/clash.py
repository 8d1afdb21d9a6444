"""Whether the packages that drycut is made of are its own: their names are such as others use too."""

import importlib.util
from functools import cache
from pathlib import Path
from typing import Final

PACKAGES: Final = ("parser", "controller", "sim")
_OWN: Final = Path(__file__).resolve().parents[1]
"""The folder that holds this package and the three."""
_MARK: Final = "drycut"
"""Stands in the first file of each: another distribution may have written its own over it."""


@cache
def refuse_strangers() -> None:
    """ImportError, in one line, where one of the three packages is not the one that stands beside this one.

    A file ``parser.py`` in the folder of a user, or another distribution with a package ``sim``, would be loaded in its
    place. Nothing of it is run here.
    """
    for name in PACKAGES:
        found = _found(name)
        if found != _OWN / name or _is_written_over(found):
            raise ImportError(_why(name, found))


def _is_written_over(package: Path) -> bool:
    """Whether the first file of a package is another's; not where there is none to be read, as in an archive."""
    try:
        return _MARK not in (package / "__init__.py").read_text("utf-8", "replace")
    except OSError:
        return False


def _found(name: str) -> Path | None:
    """Where Python finds a package: its folder, or the file of a module; None where it finds nothing."""
    try:
        spec = importlib.util.find_spec(name)
    except ValueError:  # already there, and made by hand
        return None
    if spec is None or spec.origin is None:
        return None
    origin = Path(spec.origin).resolve()
    return origin.parent if origin.stem == "__init__" else origin


def _why(name: str, found: Path | None) -> str:
    own, there = _printable_path(_OWN / name), _printable_path(found)
    if found is None:
        return f"its package {name} is missing; expected {own}: install drycut again"
    whose = _distribution(name)
    if whose:
        return f"{whose} has a package {name} too, in {there}; expected {own}: give drycut an environment of its own"
    return f"{there} stands in place of drycut's package {name}; expected {own}: rename it, or run from elsewhere"


def _printable_path(path: Path | None) -> str:
    """A path without what a terminal would obey."""
    return "".join(sign if sign.isprintable() else "?" for sign in str(path))


def _distribution(name: str) -> str:
    """Name and version of another distribution that brought a package of this name; empty where none did."""
    from importlib.metadata import distribution, packages_distributions  # noqa: PLC0415 - slow, and seldom needed

    others = [whose for whose in packages_distributions().get(name, []) if whose != "drycut"]
    return f"{others[0]} {distribution(others[0]).version}" if others else ""
