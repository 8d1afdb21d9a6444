"""Compiled loops are kept on disk, told of when they have to be made, and stale once anything they call changes."""

import ast
import os
import subprocess
import sys
from pathlib import Path

import pytest
from places import ROOT

from sim.cli.compile import LOOPS

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
    assert set(LOOPS) == with_loops


def _is_loop(node: ast.AST) -> bool:
    """Whether it is a function under the decorator of compiled loops."""
    if not isinstance(node, ast.FunctionDef):
        return False
    calls = (one.func for one in node.decorator_list if isinstance(one, ast.Call))
    return any(isinstance(called, ast.Name) and called.id == "compiled" for called in calls)
