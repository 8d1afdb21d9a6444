"""The files of the library, made in a folder: ``libges.so``, ``libdrycut_sleep.so``, ``ges.h`` and stand-ins."""

import sys
from pathlib import Path
from typing import Final

import controller
from controller.card.abi.table import (
    HEADERS,
    C,
    digest,
    header,
    source,
)
from sim.base.files import scratch, staged
from sim.clients.library.compiler import Compiler

LIBRARY, SLEEP, HEADER, FOLDER = "libges.so", "libdrycut_sleep.so", "ges.h", "include"
_SPELLED: Final = {"Windows.h": "windows.h"}
"""Windows does not tell large letters from small ones in names of files; these are files of their own."""


def build(folder: Path, compiler: Compiler) -> list[Path]:
    """Make the library in a folder; the files.

    It finds this Python and its packages where they are now. CompilerError where it cannot be made, FileUnreadableError
    where the folder cannot be written.
    """
    libraries = (LIBRARY, SLEEP)
    headers = {HEADER: header(), **{name: (C / "include" / name).read_text("utf-8") for name in HEADERS}}
    headers |= {spelled: headers[name] for spelled, name in _SPELLED.items()}
    with staged(folder, libraries) as made, staged(folder / FOLDER, tuple(headers)) as texts:
        for name, text in headers.items():
            (texts / name).write_text(text, "utf-8")
        _compile(made, texts, compiler)
    return [*(folder / name for name in libraries), *(folder / FOLDER / name for name in headers)]


def _compile(made: Path, headers: Path, compiler: Compiler) -> None:
    with scratch() as folder:
        written = folder / "libges.c"
        written.write_text(source(_places(compiler)), "utf-8")
        python = (str(compiler.python), f"-Wl,-rpath,{compiler.python.parent}")
        compiler.shared(written, made / LIBRARY, f"-I{compiler.headers}", f"-I{headers}", *python)
    compiler.shared(C / "sleep.c", made / SLEEP)


def _places(compiler: Compiler) -> dict[str, str | list[str]]:
    """What is built in: Python, its library, the folders of its modules, ours before all others."""
    assert controller.__file__ is not None  # noqa: S101 - a package
    own = str(Path(controller.__file__).resolve().parent.parent)
    others = (str(Path(path).resolve()) for path in sys.path if Path(path).exists() and path)
    return {
        "drycut_python": sys.executable,
        "drycut_libpython": str(compiler.python),
        "drycut_paths": list(dict.fromkeys((own, *others))),
        "drycut_digest": digest(),
    }
