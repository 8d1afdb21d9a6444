"""Targets `trace`, `loop`, `results` and `dialect`: files that drycut itself writes, and dialects of a shop's own."""

import hashlib
import io
import json
import os
import random
import zipfile
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

from controller.compiled import entries
from controller.compiled.machine_code import MachineCode, Shape
from fuzzing.mutate import damaged
from fuzzing.ran import answer_of, broken_by, ran
from fuzzing.setups import refused
from fuzzing.target import Input, Judged
from fuzzing.toml_trees import fuzzed_toml
from parser.findings.errors import DrycutError
from sim.check import stored
from sim.check.file_check import Job, check_file
from sim.check.files import STORED
from sim.check.settings import CheckSettings
from sim.jobs.trace_file import StoredTrace, read_trace

_LOOP = MachineCode("loop", (Shape("array", "float64", 1, ()),), Shape("int64", "", 0, ()), b"\x7fELF" + b"\0" * 99)
_DIALECTS = (
    b'extends = "fanuc"\noffset_letters = "DH"\n[g]\n145 = "switch"\n[rules]\nouter = "arc"\n[range]\nF = [0, 9999]\n',
    b'integer_um = 0.1\ncalls = ["program", "number"]\nmeant_twice = [78]\nmay_be_inch = true\n[m]\n188 = "stop"\n',
)
_SILENT = "B9900B0B9900GXL1\nB9900B0B9900GXL3\nDD\n"
_FORMS = ("text", "json", "sarif")
_ODD = (
    None,
    True,
    -1,
    10**400,
    1e308,
    float("nan"),
    "",
    "\x1b[31m\n\u2028",
    "\ud800",
    "加工",
    [],
    {},
    [1, 2],
    ["a"],
    [[]],
)
_NAMES = ("extends", "letters", "rules", "g", "m", "range", "calls", "outer", "step_um", "distance", "angle", "name")
_PROGRAM = "O0001\nG92 X0 Y0\nG90 G01 X5000 Y0\nG145 F9\nG02 X0 Y5000 I-5000 J0\nX0 Y0 M188\nM02\n"


def make_trace(rng: random.Random) -> Input:
    """A trace, damaged as a file is, or with arrays of other types and sizes in a sound archive."""
    if rng.random() < 0.6:
        return damaged(rng, _trace(3), (_trace(3), _trace(40)))
    names = [name for name in StoredTrace.__dataclass_fields__ if rng.random() < 0.95]
    arrays = {name: _array(rng) for name in names}
    data = io.BytesIO()
    np.savez_compressed(data, **arrays) if rng.random() < 0.5 else np.savez(data, **arrays)
    return data.getvalue()


def judge_trace(data: Input, _: int, folder: Path) -> Judged:
    """A trace is read, or refused in a line."""
    assert isinstance(data, bytes)
    file = folder / "trace.npz"
    file.write_bytes(data)
    try:
        trace = read_trace(file)
    except DrycutError as error:
        return refused(error, folder)
    return Judged(f"{len(trace.t_s)} {len(trace.step_t_s)}", [], "read")


def make_loop(rng: random.Random) -> Input:
    """An entry of the cache of loops, damaged."""
    return damaged(rng, _entry(), (_entry(),))


def judge_loop(data: Input, _: int, folder: Path) -> Judged:
    """An entry is what was stored, or none: machine code that is not whole is never linked."""
    assert isinstance(data, bytes)
    was = os.environ.get("NUMBA_CACHE_DIR")
    os.environ["NUMBA_CACHE_DIR"] = str(folder)
    try:
        entries.store("loop", "digest", _LOOP)
        (entry,) = folder.rglob("*.loop")
        entry.write_bytes(data)
        found = entries.stored("loop", "digest")
    finally:
        os.environ.pop("NUMBA_CACHE_DIR")
        if was is not None:
            os.environ["NUMBA_CACHE_DIR"] = was
    broken = [] if found is None or found == _LOOP else ["machine code that nobody stored"]
    return Judged(str(found is None), broken, "none" if found is None else "stored")


def make_results(rng: random.Random) -> Input:
    """The record of a result with values of other kinds in it, or damaged; ``sealed`` before it, or ``bare``."""
    data = json.dumps(_odd(rng, _record())).encode()
    if rng.random() < 0.3:
        data = damaged(rng, data, (data,))
    return rng.choice([b"sealed ", b"bare "]) + data


def judge_results(data: Input, number: int, folder: Path) -> Judged:
    """What is under no seal counts as none; what is may be anything, and the check has an answer."""
    assert isinstance(data, bytes)
    here, form = folder / str(number), _FORMS[number % len(_FORMS)]
    here.mkdir()
    (here / "part.3b").write_text(_SILENT, encoding="utf-8")
    command = ("check", "part.3b", "--format", form)
    plain = ran(command, here)
    ran((*command, "--cache", "results"), here)
    file = here / "results" / STORED
    seal, _, body = file.read_bytes().partition(b"\n")
    (key,) = json.loads(body)
    how, _, record = data.partition(b" ")
    body = b'{"%b":%b}' % (key.encode(), record)
    file.write_bytes((stored.seal(body).encode() if how == b"sealed" else seal) + b"\n" + body)
    done = ran((*command, "--cache", "results"), here)
    broken = list(broken_by(done, here, form))
    if how != b"sealed" and answer_of(done, here) != answer_of(plain, here):
        broken.append("takes a result that is under no seal")
    return Judged(answer_of(done, folder), broken, f"{how.decode(errors='replace')[:6]}, exit {done.returncode}")


def make_dialect(rng: random.Random) -> Input:
    """A dialect of a shop's own."""
    return fuzzed_toml(rng, _DIALECTS, _NAMES)


def judge_dialect(data: Input, number: int, folder: Path) -> Judged:
    """Samples are read in the dialect, or it is refused in a line."""
    assert isinstance(data, bytes)
    here = folder / str(number)
    here.mkdir()
    (here / "own.toml").write_bytes(data)
    (here / "part.nc").write_text(_PROGRAM, encoding="utf-8")
    done = ran(("dialect", "test", "part.nc", "--dialect", "own.toml"), here)
    return Judged(answer_of(done, folder), list(broken_by(done, here)), f"exit {done.returncode}")


def _record() -> Any:
    silent = check_file(Job("part.3b", _SILENT.encode(), CheckSettings()))
    return json.loads(json.dumps(stored.record_of(silent)))


def _odd(rng: random.Random, tree: Any) -> Any:
    """A tree of JSON with something else at some of its places."""
    if rng.random() < 0.05:
        return rng.choice(_ODD)
    if isinstance(tree, dict):
        return {name: _odd(rng, value) for name, value in tree.items() if rng.random() < 0.97}
    return [_odd(rng, value) for value in tree] if isinstance(tree, list) else tree


@cache
def _trace(samples: int) -> bytes:
    """A trace of so many samples and as many steps."""
    counts = {"step_x_um": samples + 1, "step_y_um": samples + 1, "step_block": samples, "block": samples}
    arrays = {
        name: np.zeros(counts.get(name, samples), dtype=np.int32 if name in counts else np.float64)
        for name in StoredTrace.__dataclass_fields__
    }
    data = io.BytesIO()
    with zipfile.ZipFile(data, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, array in arrays.items():
            with archive.open(zipfile.ZipInfo(f"{name}.npy"), "w") as file:  # no clock in it
                np.lib.format.write_array(file, array)
    return data.getvalue()


def _array(rng: random.Random) -> np.ndarray[tuple[int, ...], np.dtype[np.generic]]:
    shape = rng.choice([(3,), (4,), (0,), (), (3, 2), (10_000,)])
    return np.zeros(shape, dtype=rng.choice(["f8", "i4", "i8", "f4", "U3", "?", "c16", "M8[s]"]))


@cache
def _entry() -> bytes:
    """An entry as it is stored."""
    rest = json.dumps([_LOOP.symbol, _LOOP.takes, _LOOP.gives]).encode() + b"\n" + _LOOP.object_code
    return hashlib.sha256(rest).digest() + rest
