"""Syntax trees of the project's modules, parsed once for all tests that read the code."""

import ast
import gc
from collections.abc import Iterator
from functools import cache
from pathlib import Path

from places import ROOT

PACKAGES = ("parser", "controller", "sim", "drycut")


@cache
def trees() -> dict[Path, ast.Module]:
    """The tree of each module, by its path from the top."""
    files = [path for package in PACKAGES for path in sorted((ROOT / package).rglob("*.py"))]
    found = {path.relative_to(ROOT): ast.parse(path.read_text("utf-8")) for path in files}
    gc.freeze()  # a million nodes, which no collection needs to look at again
    return found


def trees_of(*packages: str) -> Iterator[tuple[Path, ast.Module]]:
    """The trees of some packages."""
    return ((path, tree) for path, tree in trees().items() if path.parts[0] in packages)
