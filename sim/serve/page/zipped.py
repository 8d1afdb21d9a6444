"""Files as one zip, made while it is sent: however large they are, a piece of them is held at a time."""

import io
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Final
from zipfile import ZIP_DEFLATED, ZipFile, ZipInfo

_PIECE: Final = 1 << 18


def zipped(files: Iterable[Path]) -> Iterator[bytes]:
    """The bytes of a zip of files, each under its own name; without their times, so that the same give the same.

    OSError where one cannot be read.
    """
    made = _Sink()
    with ZipFile(made, "w") as archive:
        for file in files:
            entered = ZipInfo(file.name)
            entered.compress_type = ZIP_DEFLATED
            with file.open("rb") as data, archive.open(entered, "w", force_zip64=True) as entry:
                while piece := data.read(_PIECE):
                    entry.write(piece)
                    yield made.taken()
    yield made.taken()


class _Sink(io.RawIOBase):
    """Takes what is written, once, and cannot go back."""

    def __init__(self) -> None:
        self._held = bytearray()

    def writable(self) -> bool:
        return True

    def write(self, data: object) -> int:
        piece = bytes(memoryview(data))  # type: ignore[arg-type]  # whatever has bytes
        self._held += piece
        return len(piece)

    def taken(self) -> bytes:
        """What came since the last time."""
        held, self._held = bytes(self._held), bytearray()
        return held
