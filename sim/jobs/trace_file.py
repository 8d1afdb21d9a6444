"""``trace.npz``: every step and every sample of a run, as numpy arrays; written where it is asked for, and read."""

import lzma
import struct
import tokenize
import zipfile
import zlib
from collections.abc import Mapping
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Final

import numpy as np
from numpy.typing import NDArray

from parser.findings.errors import FileUnreadableError, system_message
from parser.geometry.curves import Floats
from sim.base.files import write_npz
from sim.run.dryrun import DryRun

TRACE: Final = "trace.npz"

Counts = NDArray[np.int32]


@dataclass(frozen=True, slots=True, eq=False)
class StoredTrace:
    """What ``trace.npz`` holds of a run of n steps and m samples, in program coordinates; blocks count from 1.

    Attributes
    ----------
    step_x_um, step_y_um
        (n + 1,) int32, the start first, then the place commanded after each step.
    step_block
        (n,) int32, block that made each step.
    step_t_s
        (n,) float64, time of each step, never falling; two axes may step at once.
    t_s
        (m,) float64, times of the samples from 0, strictly rising and not evenly spaced.
    x_um, y_um
        (m,) float64, where the wire really was.
    table_x_um, table_y_um
        (m,) float64, where the table stood; the same without wire lag.
    commanded_x_um, commanded_y_um
        (m,) float64, sum of the steps handed out by then.
    block
        (m,) int32, block that was running.
    """

    step_x_um: Counts
    step_y_um: Counts
    step_block: Counts
    step_t_s: Floats
    t_s: Floats
    x_um: Floats
    y_um: Floats
    table_x_um: Floats
    table_y_um: Floats
    commanded_x_um: Floats
    commanded_y_um: Floats
    block: Counts


def read_trace(path: Path | str) -> StoredTrace:
    """The arrays of a ``trace.npz``. FileUnreadableError where there is none, or where it is something else."""
    try:
        with Path(path).open("rb") as file, np.load(file, allow_pickle=False) as arrays:
            trace = StoredTrace(**{field.name: arrays[field.name] for field in fields(StoredTrace)})
    except OSError as error:
        raise FileUnreadableError("in-file", file=path, message=system_message(error)) from None
    except _DAMAGED:
        raise FileUnreadableError("no-trace", path=path) from None
    if not _is_whole(trace):
        raise FileUnreadableError("no-trace", path=path)
    return trace


_DAMAGED: Final = (
    *(ValueError, LookupError, TypeError, ArithmeticError, EOFError, MemoryError, SyntaxError, RuntimeError),
    *(zipfile.BadZipFile, zlib.error, lzma.LZMAError, struct.error, tokenize.TokenError),
)
"""What zipfile and numpy raise of a damaged archive: a method that they do not know, a head that is no Python."""


def _is_whole(trace: StoredTrace) -> bool:
    """Whether the arrays are of the types and sizes that are written."""
    arrays = {field.name: getattr(trace, field.name) for field in fields(StoredTrace)}
    if not all(isinstance(array, np.ndarray) for array in arrays.values()):  # of what is no array numpy gives the bytes
        return False
    steps, samples = len(np.atleast_1d(trace.step_t_s)), len(np.atleast_1d(trace.t_s))
    sizes = {"step_x_um": steps + 1, "step_y_um": steps + 1, "step_block": steps, "step_t_s": steps}
    counts = {"step_x_um", "step_y_um", "step_block", "block"}
    return all(
        array.shape == (sizes.get(name, samples),) and array.dtype == (np.int32 if name in counts else np.float64)
        for name, array in arrays.items()
    )


def write_trace(folder: Path, run: DryRun, steps: Mapping[str, Path]) -> None:
    """Write `TRACE` into a folder, of a run and of the finished files of its steps, which are removed."""
    write_npz(folder / TRACE, steps, trace_arrays(run))


def trace_arrays(run: DryRun) -> dict[str, Floats | Counts]:
    """The arrays of the samples, by their names in `StoredTrace`."""
    trace = run.trace
    return {
        "t_s": trace.t_s,
        "x_um": trace.wire_um[:, 0],
        "y_um": trace.wire_um[:, 1],
        "table_x_um": trace.table_um[:, 0],
        "table_y_um": trace.table_um[:, 1],
        "commanded_x_um": trace.commanded_um[:, 0],
        "commanded_y_um": trace.commanded_um[:, 1],
        "block": (trace.row + 1).astype(np.int32),
    }
