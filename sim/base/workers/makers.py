"""Who makes a result: what its bytes depend on beside its input. Workers of other machines have to be the same."""

import platform
from functools import cache
from importlib import metadata
from typing import Final

from parser import __version__
from parser.findings.errors import ClusterError

_PACKAGES: Final = ("numpy", "numba", "shapely", "pymunk", "ezdxf", "pygame-ce", "pillow", "jinja2", "click", "rich")

Maker = tuple[tuple[str, str], ...]
"""Names with the version of each."""


@cache
def versions() -> Maker:
    """Versions of drycut, which is first, of Python and of the packages that it uses."""
    return (
        ("drycut", __version__),
        ("Python", platform.python_version()),
        *((name, metadata.version(name)) for name in _PACKAGES),
    )


def made_by() -> Maker:
    """What the bytes of a result come from here: the versions, and the system with its kind of processor."""
    return (*versions(), ("system", f"{platform.system()} {platform.machine()}"))


def refuse_other_makers(maker: Maker) -> None:
    """ClusterError where this worker would make other bytes than the one who asks."""
    theirs = dict(maker)
    for name, here in made_by():
        if here != theirs.get(name):
            raise ClusterError("worker-differs", machine=platform.node(), name=name, here=here, theirs=theirs.get(name))
