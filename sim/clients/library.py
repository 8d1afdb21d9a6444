"""The card's library for programs in C, made with a compiler of the machine: a `Compiler` and files.

What makes the library: a C compiler, the headers of this Python, and Python as a library.

The files of the library, made in a folder: ``libges.so``, ``libdrycut_sleep.so``, ``ges.h`` and stand-ins.
"""

import os
import shlex
import shutil
import subprocess
import sys
import sysconfig
from pathlib import Path
from typing import Final, NamedTuple

import controller
from controller.card.abi.table import HEADERS, C, digest, header, source
from parser.findings.errors import DrycutError
from parser.text.encoding import printable
from sim.base.files import scratch, staged

_NAMES = ("cc", "gcc", "clang")
_TOLD_LINES = 12


class CompilerError(DrycutError, RuntimeError):
    """The library cannot be made here; says what is missing, or what the compiler said."""


class Compiler(NamedTuple):
    """A C compiler as it is called, the folder of Python's headers, and the file of Python's library."""

    call: tuple[str, ...]
    headers: Path
    python: Path

    def shared(self, source: Path, made: Path, *options: str) -> None:
        """Make a shared library of a source. CompilerError with what the compiler said where it cannot."""
        flags = ("-shared", "-fPIC", "-O2", "-fvisibility=hidden", f"-Wl,-soname,{made.name}")
        done = subprocess.run(  # noqa: S603 - the user's own compiler
            [*self.call, *flags, "-o", str(made), str(source), *options, "-lpthread", "-ldl"],
            capture_output=True,
            encoding="utf-8",
            errors="replace",
            check=False,
        )
        if done.returncode:
            said = "\n".join(done.stderr.splitlines()[:_TOLD_LINES])
            raise CompilerError("compiler-failed", compiler=self.call[0], made=made.name, said=said)


def found_compiler() -> Compiler:
    """The compiler that the environment names in ``CC``, or that of the machine, with what it needs of this Python.

    CompilerError where one of the three is missing.
    """
    if not sys.platform.startswith("linux"):
        raise CompilerError("no-libges-here", system=sys.platform)
    return Compiler(_call(), _headers(), _python())


def _call() -> tuple[str, ...]:
    named = os.environ.get("CC", "").strip()
    call = tuple(shlex.split(named)) if named else ()
    for name in call[:1] or _NAMES:
        if path := shutil.which(name):
            return (path, *call[1:])
    if named:
        raise CompilerError("compiler-of-cc-missing", name=printable(named))
    raise CompilerError("no-compiler", names=", ".join(_NAMES))


def _headers() -> Path:
    folder = Path(sysconfig.get_path("include"))
    if not (folder / "Python.h").is_file():
        raise CompilerError("python-headers-missing", file=folder / "Python.h", version=sysconfig.get_python_version())
    return folder


def _python() -> Path:
    """Python as a library, where the build of this Python has put it."""
    build = {
        key: str(sysconfig.get_config_var(key) or "") for key in ("INSTSONAME", "LDLIBRARY", "LIBDIR", "MULTIARCH")
    }
    folder, beneath = Path(build["LIBDIR"]), build["MULTIARCH"]
    for name in filter(None, (build["INSTSONAME"], build["LDLIBRARY"])):
        for path in (folder / name, folder / beneath / name):
            if ".so" in path.name and path.is_file():
                return path
    raise CompilerError("no-shared-python", python=sys.executable, version=sysconfig.get_python_version())


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
