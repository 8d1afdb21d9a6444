"""What ends a command that is no fault of its user: one of drycut itself, or a package that is not installed.

A fault of drycut itself: what people are told, and a file with all that its makers need.

What of an installation is missing: the extra that brings a package which a command needs.
"""

import platform
import shlex
import sys
import tempfile
from collections.abc import Iterator, Mapping
from typing import Final

from parser import __version__
from parser.findings.catalogue import Language
from parser.findings.errors import Message
from parser.text.encoding import harmless
from sim.show.terminal.printer import say
from sim.show.terminal.wrap import wrapped
from sim.show.texts import Words

EXIT: Final = 3
_MOST_FILES = 10
_INDENT = "    "


def tell_faults(tracebacks: Mapping[str, str], language: Language) -> int:
    """Tell of faults on stderr, each by the file at which it happened, and keep their tracebacks; the exit code.

    The name is empty where a fault belongs to no one file. Of more than ten the others are in the file that is kept.
    """
    words = Words(language)
    named = list(tracebacks.items())
    for name, traceback in named[:_MOST_FILES]:
        _tell(words("fault.head", at=f"{name}: " if name else "", error=_last_line(traceback)))
    if len(named) > _MOST_FILES:
        _tell(words("fault.more", count=f"{len(named) - _MOST_FILES:,}"))
    _tell(words("fault.what"), _INDENT)
    facts = [f"{words('fault.command')}{shlex.join(['drycut', *sys.argv[1:]])}", _version()]
    report = _written_file([*facts, *_fault_lines(tracebacks)])
    for fact in (*facts, f"{words('fault.traceback')}{report or words('fault.not-written')}"):
        _tell(fact, _INDENT)
    return EXIT


def _tell(text: str, head: str = "") -> None:
    for line in wrapped(harmless(text), head=head, indent=_INDENT):
        say(line, err=True)


def _version() -> str:
    return f"drycut {__version__}, Python {platform.python_version()}, {platform.platform()}"


def _last_line(traceback: str) -> str:
    return (traceback.strip().splitlines() or [""])[-1]


def _fault_lines(tracebacks: Mapping[str, str]) -> Iterator[str]:
    for name, traceback in tracebacks.items():
        yield from ("", name, *traceback.splitlines())


def _written_file(lines: list[str]) -> str:
    """Name of the file that holds the lines, in the system's folder for such; empty where none can be written."""
    try:
        with tempfile.NamedTemporaryFile(
            "w", encoding="utf-8", errors="backslashreplace", prefix="drycut-fault-", suffix=".txt", delete=False
        ) as file:
            file.writelines(f"{harmless(line)}\n" for line in lines)
            return file.name
    except OSError:
        return ""


EXTRA_OF: Final[Mapping[str, str]] = {
    **dict.fromkeys(("PIL", "jinja2", "llvmlite", "markupsafe", "numba", "platformdirs"), "run"),
    **dict.fromkeys(("pygame", "pymunk", "shapely"), "run"),
    "ezdxf": "drawing",
    "svgelements": "drawing",
    "xlsxwriter": "class",
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
