"""What of an installation is missing: the extra that brings a package which a command needs."""

from collections.abc import Mapping
from typing import Final

from parser.findings.errors import Message

EXTRA_OF: Final[Mapping[str, str]] = {
    **dict.fromkeys(("PIL", "jinja2", "llvmlite", "markupsafe", "numba", "platformdirs"), "run"),
    **dict.fromkeys(("pygame", "pymunk", "shapely"), "run"),
    "ezdxf": "drawing",
    **dict.fromkeys(("starlette", "uvicorn"), "open"),
    **dict.fromkeys(("lsprotocol", "pygls"), "lsp"),
    "imageio_ffmpeg": "film",
    "distributed": "cluster",
}
"""Extras of `pyproject.toml` by the packages that they bring, as those are imported."""


def missing(error: Exception) -> Message | None:
    """What to say where an error is that a package is not installed that an extra brings; None of any other error."""
    package = (error.name or "").partition(".")[0] if isinstance(error, ModuleNotFoundError) else ""
    extra = EXTRA_OF.get(package)
    return Message("needs-an-extra", package=package, extra=extra) if extra else None
