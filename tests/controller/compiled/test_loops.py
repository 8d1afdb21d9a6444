"""Compiled loops are kept on disk, told of when they have to be made, and stale once anything they call changes."""

import ast
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from places import ROOT

from sim.cli.compile import LOOPS
from sim.make.cam.order.order import neighbours

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


def test_a_loop_is_compiled_once_and_told_of_once(loops: Path) -> None:
    cache = loops / "cache"
    assert printed(loops, cache) == ["compiling", "10.0"]
    assert printed(loops, cache) == ["10.0"]


def test_a_loop_is_compiled_again_when_a_loop_that_it_calls_has_changed(loops: Path) -> None:
    cache = loops / "cache"
    printed(loops, cache)
    # Of another length: Python itself takes a file of the same second and length for the one it has bytecode of.
    (loops / "inner.py").write_text(INNER.format(grown="value + value"))
    assert printed(loops, cache) == ["compiling", "12.0"]


def test_every_module_with_loops_is_compiled_at_set_up() -> None:
    with_loops = set()
    for package in ("controller", "sim"):
        for source in (ROOT / package).rglob("*.py"):
            if any(map(_is_loop, ast.walk(ast.parse(source.read_text(encoding="utf-8"))))):
                with_loops.add(".".join(source.relative_to(ROOT).with_suffix("").parts))
    assert sorted(LOOPS) == sorted(with_loops)


def test_numba_is_loaded_when_a_loop_is_called_and_not_before() -> None:
    code = (
        "import sys, importlib\n"
        "for name in sys.argv[1:]: importlib.import_module(name)\n"
        "print('numba' in sys.modules)\n"
        "from sim.table.solve.tick import due_s\n"
        "due_s.loaded()\n"
        "print('numba' in sys.modules)\n"
    )
    command = [sys.executable, "-c", code, *LOOPS]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True, timeout=120)
    assert done.stdout.split() == ["False", "True"]


def test_threads_that_call_a_loop_first_all_get_what_it_returns() -> None:
    code = (
        "from concurrent.futures import ThreadPoolExecutor\n"
        "import numpy as np\n"
        "from sim.make.cam.order.order import neighbours\n"
        "place = np.arange(12.0).reshape(6, 2)\n"
        "def call(_): return neighbours(place, 1).tolist()\n"
        "with ThreadPoolExecutor(8) as pool: found = list(pool.map(call, range(8)))\n"
        "print(all(each == found[0] for each in found), found[0][0])\n"
    )
    done = subprocess.run(
        [sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=True, timeout=120
    )
    assert done.stdout.split() == ["True", "[1]"]


def test_arguments_of_another_signature_are_refused() -> None:
    with pytest.raises(TypeError):
        neighbours(np.zeros((2, 2), dtype=np.complex128), 1)


def _is_loop(node: ast.AST) -> bool:
    """Whether it is a function under the decorator of compiled loops."""
    if not isinstance(node, ast.FunctionDef):
        return False
    calls = (one.func for one in node.decorator_list if isinstance(one, ast.Call))
    return any(isinstance(called, ast.Name) and called.id == "compiled" for called in calls)
