"""Arrays of all steps of a run: streamed to ``.npy`` files as the steps come, and joined to one ``.npz``."""

import os
import shutil
import zipfile
from collections.abc import Iterator, Mapping
from contextlib import ExitStack, contextmanager, nullcontext, suppress
from pathlib import Path
from types import TracebackType
from typing import IO, Any, Self

import numpy as np
from numpy.typing import DTypeLike, NDArray

from controller.stepping.pulses import Pulses
from parser.findings.errors import FileUnreadableError, system_message


class StepFiles:
    """Arrays of all steps, streamed to files as the pulses come; a `PulseSink`.

    The arrays are ``step_x_um`` and ``step_y_um`` (int32, one more than there are steps, the start first),
    ``step_block`` (int32) and ``step_t_s`` (float64), one entry a step.
    """

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._files: dict[str, IO[bytes]] = {}

    def __enter__(self) -> Self:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, at: TracebackType | None) -> None:
        """Close the files; their heads now tell how many entries there are."""
        with suppress(FileUnreadableError) if error else nullcontext(), self._by_known_folder(), ExitStack() as closing:
            for file in self._files.values():
                closing.callback(file.close)
            if error is None:
                for file in self._files.values():
                    _finish_head(file)

    @property
    def paths(self) -> dict[str, Path]:
        """Array name to its finished ``.npy`` file."""
        return {name: self._folder / f"{name}.npy" for name in self._files}

    def open(self, origin_um: tuple[int, int]) -> None:
        """Make the files, and write the start; FileUnreadableError where they cannot be written."""
        with self._by_known_folder():
            self._begin(origin_um)

    def _begin(self, origin_um: tuple[int, int]) -> None:
        for name in ("step_x_um", "step_y_um", "step_block", "step_t_s"):
            self._files[name] = (self._folder / f"{name}.npy").open("w+b")
            _write_head(self._files[name], np.float64 if name == "step_t_s" else np.int32, 0)
        self._append(step_x_um=np.array(origin_um[:1]), step_y_um=np.array(origin_um[1:]))

    def take(self, pulses: Pulses) -> None:
        """Append pulses; FileUnreadableError where they cannot be written."""
        with self._by_known_folder():
            self._append(step_x_um=pulses.x_um, step_y_um=pulses.y_um, step_block=pulses.row + 1)
            self._files["step_t_s"].write(pulses.t_s.tobytes())

    def _append(self, **columns: NDArray[np.integer]) -> None:
        for name, column in columns.items():
            self._files[name].write(column.astype("<i4").tobytes())

    @contextmanager
    def _by_known_folder(self) -> Iterator[None]:
        """Tell people of the folder that they know, in which that of the files is hidden."""
        try:
            yield
        except OSError as error:
            raise FileUnreadableError(
                "cannot-be-written", file=self._folder.parent, why=system_message(error)
            ) from None


def _write_head(file: IO[bytes], dtype: DTypeLike, length: int) -> None:
    descr = np.lib.format.dtype_to_descr(np.dtype(dtype))
    np.lib.format.write_array_header_1_0(file, {"descr": descr, "fortran_order": False, "shape": (length,)})


def _finish_head(file: IO[bytes]) -> None:
    """Write the length into a head: numpy leaves room in it for a first axis that grows."""
    file.seek(0)
    np.lib.format.read_magic(file)
    dtype = np.lib.format.read_array_header_1_0(file)[2]
    head = file.tell()
    length = (file.seek(0, os.SEEK_END) - head) // dtype.itemsize
    file.seek(0)
    _write_head(file, dtype, length)


def write_npz(path: Path, files: Mapping[str, Path], arrays: Mapping[str, NDArray[Any]]) -> None:
    """Write a compressed ``.npz`` of finished ``.npy`` files, which are removed, and of arrays.

    The same input gives the same bytes.
    """
    with zipfile.ZipFile(path, "w") as archive:
        for name, source in files.items():
            with source.open("rb") as file, archive.open(_member(name), "w", force_zip64=True) as member:
                shutil.copyfileobj(file, member, 1 << 20)
            source.unlink()
        for name, array in arrays.items():
            with archive.open(_member(name), "w", force_zip64=True) as member:
                np.lib.format.write_array(member, np.ascontiguousarray(array), allow_pickle=False)


def _member(name: str) -> zipfile.ZipInfo:
    member = zipfile.ZipInfo(f"{name}.npy", date_time=(1980, 1, 1, 0, 0, 0))
    member.compress_type = zipfile.ZIP_DEFLATED
    return member
