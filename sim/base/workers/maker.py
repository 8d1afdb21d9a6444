"""Who makes a result: what its bytes depend on beside its input. Workers of other machines have to be the same."""

import hashlib
import platform
from collections.abc import Iterable
from functools import cache
from importlib import metadata, util
from pathlib import Path
from typing import Final

from parser import __version__
from parser.findings.errors import ClusterError

_PACKAGES: Final = (
    "numpy",
    "numba",
    "llvmlite",
    "shapely",
    "pymunk",
    "ezdxf",
    "pygame-ce",
    "pillow",
    "jinja2",
    "click",
    "rich",
)
_OURS: Final = ("parser", "controller", "sim", "drycut")
_COMPILED: Final = (".pyc", ".pyo")

Maker = tuple[tuple[str, str], ...]
"""Names with the version of each."""


@cache
def versions() -> Maker:
    """Versions of drycut, which is first, of Python and of those packages that it uses and that are installed."""
    installed = ((name, _version(name)) for name in _PACKAGES)
    return (
        ("drycut", __version__),
        ("Python", platform.python_version()),
        *((name, version) for name, version in installed if version),
    )


def _version(package: str) -> str:
    """Version of a package; empty where it is not installed, as extras may be left out."""
    try:
        return metadata.version(package)
    except metadata.PackageNotFoundError:
        return ""


def made_by() -> Maker:
    """What the bytes of a result come from here: versions, our own sources, the system and its kind of processor.

    The sources count by themselves: between two releases a version says nothing of what was changed.
    """
    return (*versions(), ("sources", sources()), ("system", f"{platform.system()} {platform.machine()}"))


@cache
def sources() -> str:
    """Digest of all files of drycut's packages, whatever folder they stand in."""
    specs = [util.find_spec(name) for name in _OURS]
    return digest_of(Path(spec.origin).parent for spec in specs if spec is not None and spec.origin is not None)


def digest_of(folders: Iterable[Path]) -> str:
    """Digest of the files of folders, by the names of the folders and their places in these; compiled ones aside."""
    whole = hashlib.sha256()
    for folder in folders:
        for file in sorted(folder.rglob("*")):
            if file.is_file() and file.suffix not in _COMPILED:
                name = f"{folder.name}/{file.relative_to(folder).as_posix()}"
                whole.update(f"{name}\0{hashlib.sha256(file.read_bytes()).hexdigest()}\n".encode())
    return whole.hexdigest()[:16]


def refuse_other_makers(maker: Maker) -> None:
    """ClusterError where this worker would make other bytes than the one who asks."""
    theirs = dict(maker)
    for name, here in made_by():
        if here != theirs.get(name):
            raise ClusterError("worker-differs", machine=platform.node(), name=name, here=here, theirs=theirs.get(name))
