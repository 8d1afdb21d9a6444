"""Where drycut begins in a bundle that PyInstaller packs: two programs, of which one has no window of a terminal.

`drycut` is the command line; `drycut-page` opens the page, of a file where one is dropped on it or double-clicked. A
bundle has no Python of its own to start: what asks for one, ``-P -m MODULE …``, is answered here.
"""

import multiprocessing
import runpy
import sys
from pathlib import Path

PAGE = "drycut-page"
_OF_PYTHON = frozenset({"-P", "-I", "-B", "-u"})
"""Options of Python that a bundle does by itself."""


def arguments_of(program: str, arguments: list[str]) -> list[str]:
    """What the command line of drycut is given, by the name of the program that was started."""
    if Path(program.replace("\\", "/")).stem.lower() == PAGE:
        return ["open", "--from-icon", *arguments]
    return arguments


def module_of(arguments: list[str]) -> tuple[str, list[str]] | None:
    """The module that is to be run and its arguments; None where it is drycut itself."""
    rest = list(arguments)
    while rest and rest[0] in _OF_PYTHON:
        rest.pop(0)
    return (rest[1], rest[2:]) if len(rest) > 1 and rest[0] == "-m" else None


def main() -> None:
    """Begin."""
    multiprocessing.freeze_support()
    module = module_of(sys.argv[1:])
    if module is not None:
        sys.argv[1:] = module[1]
        runpy.run_module(module[0], run_name="__main__", alter_sys=True)
        return
    sys.argv[1:] = arguments_of(sys.argv[0], sys.argv[1:])
    from drycut.__main__ import main as command  # noqa: PLC0415 - a module that is run needs it not

    command()


if __name__ == "__main__":
    main()
