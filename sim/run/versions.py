"""What the bytes of a run depend on beside its input: versions of drycut, of Python and of the packages it uses."""

import platform
from functools import cache
from importlib import metadata
from typing import Final

from parser import __version__

_PACKAGES: Final = ("numpy", "numba", "shapely", "pymunk", "ezdxf", "pygame-ce", "pillow", "jinja2", "click", "rich")


@cache
def versions() -> tuple[tuple[str, str], ...]:
    """Names and versions, drycut first."""
    return (
        ("drycut", __version__),
        ("Python", platform.python_version()),
        *((name, metadata.version(name)) for name in _PACKAGES),
    )
