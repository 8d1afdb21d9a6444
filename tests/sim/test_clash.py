"""A file or a distribution with one of our names does not kill drycut without a word."""

import os
import py_compile
import subprocess
import sys
from pathlib import Path

import pytest
from places import ROOT

COMMAND = (sys.executable, "-m", "drycut", "--version")
IMPORT = (sys.executable, "-c", "import drycut; drycut.parse_program")


def run(command: tuple[str, ...], folder: Path, *paths: Path) -> subprocess.CompletedProcess[str]:
    """With the folder first on the path of Python, then these, then ours."""
    path = os.pathsep.join(map(str, (*paths, ROOT)))
    return subprocess.run(
        command,
        cwd=folder,
        env={**os.environ, "PYTHONPATH": path, "PYTHONUTF8": "1"},
        capture_output=True,
        encoding="utf-8",
        check=False,
    )


@pytest.mark.parametrize("name", ["parser.py", "sim.py", "controller/__init__.py"])
def test_a_file_in_the_way_is_named_in_one_line_and_not_run(tmp_path: Path, name: str) -> None:
    (tmp_path / name).parent.mkdir(exist_ok=True)
    (tmp_path / name).write_text("print('RUN')\n", "ascii")
    done = run(COMMAND, tmp_path)
    assert (done.returncode, done.stdout) == (2, "")
    (line,) = done.stderr.splitlines()
    package = name.partition("/")[0].removesuffix(".py")
    there = tmp_path / name.removesuffix("/__init__.py")
    assert line == (
        f"drycut: error: {there} stands in place of drycut's package {package}; expected {ROOT / package}: "
        "rename it, or run from elsewhere"
    )


def test_whoever_imports_gets_an_error_of_one_line(tmp_path: Path) -> None:
    (tmp_path / "parser.py").write_text("", "ascii")
    done = run(IMPORT, tmp_path)
    assert done.returncode == 1
    assert done.stderr.splitlines()[-1].startswith(f"ImportError: {tmp_path / 'parser.py'} stands in place of drycut's")


def test_another_distribution_is_named_with_its_version(tmp_path: Path) -> None:
    site = tmp_path / "site"
    (site / "sim").mkdir(parents=True)
    (site / "sim" / "__init__.py").write_text("", "ascii")
    about = site / "cardsim-3.1.dist-info"
    about.mkdir()
    (about / "METADATA").write_text("Metadata-Version: 2.1\nName: cardsim\nVersion: 3.1\n", "ascii")
    (about / "RECORD").write_text("sim/__init__.py,,\n", "ascii")
    done = run(COMMAND, tmp_path, site)
    assert done.returncode == 2
    (line,) = done.stderr.splitlines()
    assert line.startswith("drycut: error: cardsim 3.1 has a package sim too, in ")
    assert line.endswith("give drycut an environment of its own")


def test_signs_that_a_terminal_would_obey_are_not_shown(tmp_path: Path) -> None:
    folder = tmp_path / "a\x1b[31mb"
    folder.mkdir()
    (folder / "parser.py").write_text("", "ascii")
    assert "\x1b" not in run(COMMAND, folder).stderr


def test_a_package_written_over_ours_is_noticed(tmp_path: Path) -> None:
    """Two distributions with one name write into one folder."""
    for name in ("drycut", "parser", "controller", "sim"):
        (tmp_path / name).mkdir()
        (tmp_path / name / "__init__.py").write_bytes((ROOT / name / "__init__.py").read_bytes())
    for name in ("__main__.py", "clash.py"):
        (tmp_path / "drycut" / name).write_bytes((ROOT / "drycut" / name).read_bytes())
    (tmp_path / "sim" / "__init__.py").write_text('"""Another one."""\n', "ascii")
    done = run(COMMAND, tmp_path)
    assert done.returncode == 2
    assert "package sim" in done.stderr


def test_packages_without_sources_are_ours_too(tmp_path: Path) -> None:
    for name in ("drycut", "parser", "controller", "sim"):
        (tmp_path / name).mkdir()
        (tmp_path / name / "__init__.py").write_text("", "ascii")
    for name in ("__init__.py", "clash.py"):
        (tmp_path / "drycut" / name).write_bytes((ROOT / "drycut" / name).read_bytes())
    for name in ("parser", "controller", "sim"):
        py_compile.compile(str(tmp_path / name / "__init__.py"), str(tmp_path / name / "__init__.pyc"))
        (tmp_path / name / "__init__.py").unlink()
    done = run((sys.executable, "-c", "import drycut.clash as c; print(c.refuse_strangers())"), tmp_path)
    assert (done.stdout, done.stderr) == ("None\n", "")


def test_without_a_clash_nothing_is_said(tmp_path: Path) -> None:
    done = run(COMMAND, tmp_path)
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout.startswith("drycut")
