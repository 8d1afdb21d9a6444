"""The door for importers: every name is there, typed, documented and loaded late, and what the document shows runs."""

import ast
import inspect
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest
from checking import WRONG_AXIS
from places import ROOT

import sim

PAGE = (ROOT / "docs" / "python.md").read_text(encoding="utf-8")


def test_every_name_is_typed_where_it_is_loaded_from() -> None:
    source = ast.parse((ROOT / "sim" / "__init__.py").read_text(encoding="utf-8"))
    typed = {
        name.name: node.module for node in ast.walk(source) if isinstance(node, ast.ImportFrom) for name in node.names
    }
    del typed["TYPE_CHECKING"], typed["Any"], typed["__version__"]
    assert typed == dict(sim._HOMES)
    assert sorted(typed) == sim.__all__
    assert set(sim.__all__) <= set(dir(sim))


@pytest.mark.parametrize("name", sim.__all__)
def test_every_name_is_loaded_described_and_documented(name: str) -> None:
    loaded = getattr(sim, name)
    assert inspect.getdoc(loaded)
    assert f"`{name}(" in PAGE
    assert getattr(sim, name) is loaded


def test_what_is_not_named_is_refused_as_python_does() -> None:
    with pytest.raises(AttributeError, match="module 'sim' has no attribute 'nothing'"):
        _ = sim.nothing


def test_the_door_loads_nothing_before_it_is_asked() -> None:
    code = "import sys, sim; print(sorted({'numpy', 'pymunk', 'pygame', 'PIL', 'jinja2'} & set(sys.modules)))"
    heavy = "import sys, sim; sim.check_program(sim.parse_program('B0B0B1000GYL2 DD')); print(*sys.modules)"
    done = [
        subprocess.run([sys.executable, "-c", text], cwd=ROOT, capture_output=True, text=True, check=True).stdout
        for text in (code, heavy)
    ]
    assert done[0] == "[]\n"
    assert not {"pymunk", "pygame", "PIL", "jinja2", "ezdxf"} & set(done[1].split())


def test_the_python_shown_runs(tmp_path: Path) -> None:
    (code,) = re.findall(r"```python\n(.*?)```", PAGE, flags=re.DOTALL)
    (tmp_path / "part.3b").write_text(WRONG_AXIS, "ascii")
    done = subprocess.run(
        [sys.executable, "-c", code],
        cwd=tmp_path,
        env={**os.environ, "PYTHONPATH": str(ROOT), "PYTHONUTF8": "1"},
        capture_output=True,
        encoding="utf-8",
        check=True,
    )
    finding, ran, off, steps = done.stdout.splitlines()
    assert finding.startswith("2 3B204 the block counts on X")
    assert re.fullmatch(r"fail \d+ s", ran)
    assert 100.0 < float(off.split()[0]) < 200.0  # µm: it stops 140 µm early, and comes back on the wrong side
    assert int(steps.split()[0]) > 9900 * 2
