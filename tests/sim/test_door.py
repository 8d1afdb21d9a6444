"""The door for importers: every name is there, typed, documented and loaded late, and what the document shows runs."""

import ast
import inspect
import os
import re
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest
from checking import WRONG_AXIS
from compare_cases import polygon, write_dxf
from door_page import renewed
from places import ROOT

import drycut

PAGE = (ROOT / "docs" / "python.md").read_text(encoding="utf-8")
PART = Path("x.3b")
SHORT = drycut.parse_program("B0B0B9GYL2DD")


def test_every_name_is_typed_where_it_is_loaded_from() -> None:
    source = ast.parse((ROOT / "drycut" / "__init__.py").read_text(encoding="utf-8"))
    names = [
        (node.module, name) for node in ast.walk(source) if isinstance(node, ast.ImportFrom) for name in node.names
    ]
    typed = {
        name.asname or name.name: f"{module}:{name.name}" if name.asname not in {None, name.name} else module
        for module, name in names
    }
    for own in ("TYPE_CHECKING", "Any", "refuse_strangers"):
        del typed[own]
    assert typed == dict(drycut._HOMES)
    assert sorted(set(typed) - {"__version__"}) == drycut.__all__
    assert set(drycut.__all__) <= set(dir(drycut))


@pytest.mark.parametrize("name", drycut.__all__)
def test_every_name_is_loaded_described_and_documented(name: str) -> None:
    loaded = getattr(drycut, name)
    assert inspect.getdoc(loaded)
    assert f"### {name}\n" in PAGE
    assert getattr(drycut, name) is loaded


def test_what_is_not_named_is_refused_as_python_does() -> None:
    with pytest.raises(AttributeError, match="module 'drycut' has no attribute 'nothing'"):
        _ = drycut.nothing


def test_the_door_loads_nothing_before_it_is_asked() -> None:
    code = "import sys, drycut; print(sorted({'numpy', 'pymunk', 'pygame', 'PIL', 'jinja2'} & set(sys.modules)))"
    heavy = "import sys, drycut; drycut.check_program(drycut.parse_program('B0B0B1000GYL2 DD')); print(*sys.modules)"
    done = [
        subprocess.run([sys.executable, "-c", text], cwd=ROOT, capture_output=True, text=True, check=True).stdout
        for text in (code, heavy)
    ]
    assert done[0] == "[]\n"
    assert not {"pymunk", "pygame", "PIL", "jinja2", "ezdxf"} & set(done[1].split())


@pytest.mark.parametrize(
    ("made", "message"),
    [
        (lambda: drycut.Wire(-5.0, 10.0), "a wire's diameter is more than 0; found -5 µm"),
        (
            lambda: drycut.Scenario("x", Path("x.3b"), drycut.load_machine("dk7740"), thickness_mm=-4.0),
            "thickness_mm is -4",
        ),
        (
            lambda: drycut.check_program(
                drycut.parse_program("B0B0B9GYL2DD"), drycut.CheckSettings(wire_diameter_um=-5.0)
            ),
            "-5 µm",
        ),
    ],
)
def test_values_that_cannot_be_are_refused_before_anything_runs(made: Callable[[], object], message: str) -> None:
    with pytest.raises(drycut.DrycutError, match=re.escape(message)):
        made()


def test_every_name_stands_in_the_reference_as_its_docstring_has_it() -> None:
    assert renewed(PAGE) == PAGE, "make pages"


def test_the_python_shown_runs(tmp_path: Path) -> None:
    code, _ = re.findall(r"```python\n(.*?)```", PAGE, flags=re.DOTALL)
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


def test_the_python_shown_converts_makes_and_draws(tmp_path: Path) -> None:
    _, code = re.findall(r"```python\n(.*?)```", PAGE, flags=re.DOTALL)
    square = "B1000B0B1000GXL1 B0B2000B2000GYL2 B4000B0B4000GXL1 B0B4000B4000GYL4 B4000B0B4000GXL3"
    (tmp_path / "part.3b").write_text(f"{square} B0B2000B2000GYL2 B1000B0B1000GXL3 DD", "ascii")
    write_dxf(tmp_path / "part.dxf", [polygon((0.0, 0.0), (4000.0, 0.0), (4000.0, 3000.0), (0.0, 3000.0))])
    done = subprocess.run(
        [sys.executable, "-c", code],
        cwd=tmp_path,
        env={**os.environ, "PYTHONPATH": str(ROOT), "PYTHONUTF8": "1"},
        capture_output=True,
        encoding="utf-8",
        check=True,
    )
    assert done.stdout == "at most 0.00 µm off\n"
    assert (tmp_path / "part.iso").read_bytes()
    assert drycut.check_program(drycut.read_program(tmp_path / "made.3b")).findings == ()
    assert (tmp_path / "pictures" / "cut.png").read_bytes().startswith(b"\x89PNG")
