"""Compiled loops are kept on disk, told of when they have to be made, and stale once anything they call changes."""

import ast
import errno
import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pytest
from places import ROOT, SCENARIOS

from controller.compiled import entries
from controller.compiled.entries import store, stored
from controller.compiled.loops import compiled
from controller.compiled.machine_code import MachineCode, Shape
from parser.geometry.curves import Floats
from sim.cli.compile import LOOPS, compile_loops
from sim.measure.curve_rows import away_from

INNER = """
from controller.compiled.loops import compiled

@compiled("f8(f8)")
def grown(value):
    return {grown}
"""

OUTER = """
from controller.compiled.loops import compiled
from controller.compiled.compiling import on_compiling

on_compiling(lambda: print("compiling"))
from inner import grown

@compiled("f8(i8)")
def total(count):
    whole = 0.0
    for number in range(count):
        whole += grown(float(number))
    return whole

print(total(4))
"""


@pytest.fixture
def loops(tmp_path: Path) -> Path:
    (tmp_path / "inner.py").write_text(INNER.format(grown="value + 1.0"))
    (tmp_path / "outer.py").write_text(OUTER)
    return tmp_path


def printed(folder: Path, cache: Path) -> list[str]:
    environment = {**os.environ, "NUMBA_CACHE_DIR": str(cache), "PYTHONPATH": f"{ROOT}{os.pathsep}{folder}"}
    command = [sys.executable, str(folder / "outer.py")]
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=True, timeout=120)
    return done.stdout.split()


@pytest.mark.deeper
def test_a_loop_is_compiled_once_and_told_of_once(loops: Path) -> None:
    cache = loops / "cache"
    assert printed(loops, cache) == ["compiling", "10.0"]
    assert printed(loops, cache) == ["10.0"]


def test_of_many_that_start_first_at_once_one_compiles(loops: Path) -> None:
    (loops / "outer.py").write_text(f"{OUTER}\nimport sys\nprint('numba' in sys.modules)\n")
    environment = {**os.environ, "NUMBA_CACHE_DIR": str(loops / "cache"), "PYTHONPATH": f"{ROOT}{os.pathsep}{loops}"}
    command = [sys.executable, str(loops / "outer.py")]
    running = [subprocess.Popen(command, env=environment, stdout=subprocess.PIPE, text=True) for _ in range(3)]
    said = [process.communicate(timeout=120)[0].split() for process in running]
    assert [process.returncode for process in running] == [0, 0, 0]
    assert [each[-2] for each in said] == ["10.0"] * 3
    assert sorted(each[-1] for each in said) == ["False", "False", "True"]


def test_who_holds_the_folder_for_long_keeps_nobody_waiting(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path))
    monkeypatch.setattr(entries, "_MOST_WAIT_S", 0.05)
    with entries.alone(), entries.alone():
        store("a.loop", "0", MachineCode("a", (), Shape("none"), b"code"))
    assert stored("a.loop", "0") is not None
    monkeypatch.setenv("NUMBA_CACHE_DIR", os.devnull)
    with entries.alone():
        assert stored("a.loop", "0") is None


@pytest.mark.deeper
def test_a_loop_is_compiled_again_when_a_loop_that_it_calls_has_changed(loops: Path) -> None:
    cache = loops / "cache"
    printed(loops, cache)
    # Of another length: Python itself takes a file of the same second and length for the one it has bytecode of.
    (loops / "inner.py").write_text(INNER.format(grown="value + value"))
    assert printed(loops, cache) == ["compiling", "12.0"]


@pytest.mark.deeper
def test_every_module_with_loops_is_compiled_at_set_up() -> None:
    with_loops = set()
    for package in ("controller", "sim"):
        for source in _sources(package):
            if any(_is_loop(node, "compiled") for node in ast.walk(ast.parse(source.read_text(encoding="utf-8")))):
                with_loops.add(".".join(source.relative_to(ROOT).with_suffix("").parts))
    assert sorted(LOOPS) == sorted(with_loops)


def test_parts_of_loops_are_called_by_loops_alone() -> None:
    """Set-up compiles none for itself: a run that called one would compile it at last."""
    modules = {path: ast.parse(path.read_text("utf-8")) for name in ("controller", "sim") for path in _sources(name)}
    parts = {
        (path, node.name) for path, module in modules.items() for node in module.body if _is_loop(node, "loop_part")
    }
    assert len(parts) > 50
    called = {call for path, module in modules.items() for call in _calls_outside_loops(path, module)}
    assert parts & called == set()


@pytest.mark.deeper
def test_numba_is_loaded_to_compile_a_loop_and_not_to_call_it(loops: Path) -> None:
    cache = loops / "cache"
    (loops / "outer.py").write_text(f"{OUTER}\nimport sys\nprint('numba' in sys.modules)\n")
    assert printed(loops, cache) == ["compiling", "10.0", "True"]
    assert printed(loops, cache) == ["10.0", "False"]


@pytest.mark.deeper
def test_a_run_needs_no_numba_once_its_loops_are_compiled(tmp_path: Path) -> None:
    code = (
        "import atexit, sys\n"
        "atexit.register(lambda: print('numba' in sys.modules, 'llvmlite' in sys.modules, file=sys.stderr))\n"
        "from drycut.__main__ import main\n"
        "main()\n"
    )
    compile_loops()
    command = [sys.executable, "-c", code, "run", str(SCENARIOS / "keyhole"), "-o", str(tmp_path / "out"), "--kerf"]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True, timeout=120)
    assert done.stderr.splitlines()[-1] == "False True"


@pytest.mark.parametrize(
    "damaged",
    [
        lambda entry: b"",
        lambda entry: entry[:40],
        lambda entry: entry[:-1],
        lambda entry: entry[:200] + bytes(byte ^ 255 for byte in entry[200:207]) + entry[207:],
        lambda entry: entry[32:],
        lambda entry: b"\0" * len(entry),
    ],
    ids=["empty", "its seal alone", "cut off", "seven bytes other", "without its seal", "zeros"],
)
def test_damaged_machine_code_counts_as_none(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, damaged: Callable[[bytes], bytes]
) -> None:
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path / "cache"))
    code = MachineCode("a", (Shape("array", "<f8", 2),), Shape("tuple", fields=(Shape("bool"),)), bytes(range(256)))
    store("a.loop", "0", code)
    assert stored("a.loop", "0") == code
    assert stored("a.loop", "1") is None
    (entry,) = (tmp_path / "cache").iterdir()
    entry.write_bytes(damaged(entry.read_bytes()))
    assert stored("a.loop", "0") is None


def test_entries_of_the_package_come_first_and_a_damaged_one_counts_as_none(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    code = MachineCode("a", (), Shape("none"), b"of the package")
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path / "ready"))
    store("a.loop", "0", code)
    monkeypatch.setattr(entries, "READY", tmp_path / "ready")
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path / "own"))
    assert stored("a.loop", "0") == code
    own = code._replace(object_code=b"of the user")
    store("a.loop", "0", own)
    assert stored("a.loop", "0") == code
    (tmp_path / "ready" / entries.file_of("a.loop", "0")).write_bytes(b"damaged")
    assert stored("a.loop", "0") == own


@pytest.mark.deeper
def test_damaged_machine_code_is_compiled_again(loops: Path) -> None:
    cache = loops / "cache"
    printed(loops, cache)
    (entry,) = cache.glob("*.total-*.loop")
    sound = entry.read_bytes()
    entry.write_bytes(b"")
    assert printed(loops, cache) == ["compiling", "10.0"]
    assert entry.read_bytes() == sound


@pytest.mark.deeper
def test_where_nothing_can_be_stored_a_loop_is_compiled_each_time(loops: Path) -> None:
    for cache in ("outer.py", "outer.py/within"):
        assert printed(loops, loops / cache) == ["compiling", "10.0"]


def test_of_each_loop_the_latest_entries_stay(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path))
    code = MachineCode("a", (), Shape("none"), b"code")
    store("a.loop_too", "0", code)
    for number in range(7):
        store("a.loop", str(number), code)
        for entry in tmp_path.glob("a.loop-*"):  # as if each were some time older
            os.utime(entry, (0.0, entry.stat().st_mtime - 60.0))
    assert [stored("a.loop", str(number)) == code for number in range(7)] == [False] * 3 + [True] * 4
    assert stored("a.loop_too", "0") == code


def test_a_draft_that_cannot_be_finished_leaves_nothing(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def full(_path: Path, _target: Path) -> None:
        raise OSError(errno.ENOSPC, "no space left")

    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path))
    monkeypatch.setattr(Path, "replace", full)
    store("a.loop", "0", MachineCode("a", (), Shape("none"), b"code"))
    assert list(tmp_path.iterdir()) == []


def test_threads_that_call_a_loop_first_all_get_what_it_returns() -> None:
    code = (
        "from concurrent.futures import ThreadPoolExecutor\n"
        "import numpy as np\n"
        "from sim.make.cam.order import neighbours\n"
        "place = np.arange(12.0).reshape(6, 2)\n"
        "def call(_): return neighbours(place, 1).tolist()\n"
        "with ThreadPoolExecutor(8) as pool: found = list(pool.map(call, range(8)))\n"
        "print(all(each == found[0] for each in found), found[0][0])\n"
    )
    done = subprocess.run(
        [sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=True, timeout=120
    )
    assert done.stdout.split() == ["True", "[1]"]


@pytest.mark.parametrize(
    "row",
    [
        np.zeros(12, dtype=np.complex128),
        np.zeros(12, dtype=np.float32),
        np.zeros((1, 12)),
        np.zeros(24)[::2],
        [0.0] * 12,
        None,
    ],
)
def test_arguments_of_another_signature_are_refused(row: object) -> None:
    with pytest.raises(TypeError):
        away_from(row, 1.0, 2.0)  # type: ignore[arg-type]  # that is what is tried


def test_a_number_with_a_part_is_no_whole_one() -> None:
    with pytest.raises(TypeError):
        turned_over(Outer(Inner(True, 0.5), 1.5, False), np.zeros((2, 1)), True)  # type: ignore[arg-type]  # tried


def test_more_or_fewer_arguments_are_refused() -> None:
    for extra in ((), (1.0,), (1.0, 2.0, 3.0)):
        with pytest.raises(TypeError):
            away_from(np.zeros(12), *extra)


class Inner(NamedTuple):
    """A tuple in a tuple, of parts that lie apart in memory."""

    is_on: bool
    at: float


class Outer(NamedTuple):
    """A tuple of all that a loop can give."""

    inner: Inner
    number: int
    is_off: bool


@compiled("(Outer, f8[:, ::1], b1)", Outer, Inner)
def turned_over(outer: Outer, table: Floats, is_on: bool) -> Outer:
    """Everything the other way round."""
    return Outer(Inner(not outer.inner.is_on, table[1, 0]), outer.number + table.shape[0], is_on)


@pytest.mark.parametrize("is_on", [True, False])
def test_tuples_arrays_and_truths_go_in_and_come_out(is_on: bool) -> None:
    table = np.arange(6.0).reshape(3, 2)
    given = Outer(Inner(is_on, 0.5), -(2**62), not is_on)
    found = turned_over(given, table, is_on)
    assert found == turned_over.function(given, table, is_on)  # type: ignore[attr-defined]  # as plain Python
    assert [type(each) for each in (*found, *found.inner)] == [Inner, int, bool, bool, float]


def _sources(package: str) -> list[Path]:
    return sorted((ROOT / package).rglob("*.py"))


def _is_loop(node: ast.AST, *decorators: str) -> bool:
    """Whether it is a function under a decorator of compiled loops."""
    if not isinstance(node, ast.FunctionDef):
        return False
    calls = (one.func for one in node.decorator_list if isinstance(one, ast.Call))
    wanted = decorators or ("compiled", "loop_part")
    return any(isinstance(called, ast.Name) and called.id in wanted for called in calls)


def _calls_outside_loops(path: Path, module: ast.Module) -> set[tuple[Path, str]]:
    """Functions, by the file that has them, that a module names outside of its loops."""
    imported = {
        each.asname or each.name: (ROOT.joinpath(*node.module.split(".")).with_suffix(".py"), each.name)
        for node in ast.walk(module)
        if isinstance(node, ast.ImportFrom) and node.module
        for each in node.names
    }
    others = (node for node in module.body if not _is_loop(node))
    names = {each.id for node in others for each in ast.walk(node) if isinstance(each, ast.Name)}
    return {imported.get(name, (path, name)) for name in names}
