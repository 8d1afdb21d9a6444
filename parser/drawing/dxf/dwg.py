"""DWG by the ODA File Converter, where one is installed: nobody else reads all releases of it."""

import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory
from threading import Lock
from typing import Final

from parser.files import read_bytes
from parser.findings.errors import DrawingError

_RELEASE: Final = "R2018"
_NO_SCREEN: Final = {"DISPLAY": ":0", "QT_QPA_PLATFORM": "offscreen"}
"""What a program with windows needs where there is no screen, as on a server."""
_ONE_AT_A_TIME: Final = Lock()
"""The environment is that of all threads, and the page's server reads drawings in several of them."""


def dxf_of_dwg(path: Path, data: bytes) -> bytes:
    """The bytes of a DWG file as DXF. DrawingError where there is no converter, or it makes nothing of them."""
    from ezdxf.addons import odafc  # noqa: PLC0415 - few drawings are DWG

    if not odafc.is_installed():  # type: ignore[attr-defined]
        raise DrawingError("dwg-needs-converter", path=path)
    with TemporaryDirectory() as folder:
        source, made = Path(folder) / "drawing.dwg", Path(folder) / "drawing.dxf"
        source.write_bytes(data)
        try:
            with _ONE_AT_A_TIME, _with_a_screen():
                odafc.convert(source, made, version=_RELEASE, replace=True)  # type: ignore[attr-defined]
            return read_bytes(made)
        except Exception as error:  # a program of others ends in any error
            raise DrawingError("dwg-not-converted", path=path, why=type(error).__name__) from None


@contextmanager
def _with_a_screen() -> Iterator[None]:
    """The environment with what is missing of a screen, for as long as the context lasts."""
    missing = {} if "DISPLAY" in os.environ else _NO_SCREEN
    os.environ.update(missing)
    try:
        yield
    finally:
        for name in missing:
            os.environ.pop(name, None)
