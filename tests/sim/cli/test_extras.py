"""What the core of drycut does without its extras, and what is said where one is needed."""

import ast
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest
from checking import SOUND, WRONG_AXIS
from places import ROOT
from trees import trees

from sim.cli.faults import EXTRA_OF

BLOCKED = """
import sys
class Lacking:
    def find_spec(self, name, path=None, target=None):
        if name.partition(".")[0] in {lacking!r}:
            raise ModuleNotFoundError(f"No module named {{name!r}}", name=name)
sys.meta_path.insert(0, Lacking())
from importlib import metadata
version = metadata.version
def of_installed(name):
    if name in {lacking!r}:
        raise metadata.PackageNotFoundError(name)
    return version(name)
metadata.version = of_installed
sys.argv = ["drycut", *{arguments!r}]
from drycut.__main__ import main
main()
"""
ISO = "G92 X0 Y0\nG90 G41 D1 G01 X0 Y5000\nX9000\nY14000\nX0\nY5000\nG40 X0 Y0\nM02\n"


def drycut(folder: Path, *arguments: str, extra: str = "") -> tuple[int, str, str]:
    """The command with no extra installed but one; the metadata of the others are not there either."""
    lacking = {package for package, of in EXTRA_OF.items() if of != extra}
    code = BLOCKED.format(lacking=lacking, arguments=arguments)
    environment = {"PYTHONPATH": str(ROOT), "PYTHONUTF8": "1", "LC_ALL": "C.UTF-8", "PATH": ""}
    done = subprocess.run([sys.executable, "-c", code], cwd=folder, capture_output=True, env=environment, check=False)
    return done.returncode, done.stdout.decode(), done.stderr.decode()


@pytest.fixture
def shop(tmp_path: Path) -> Path:
    (tmp_path / "part.3b").write_text(SOUND, "ascii")
    (tmp_path / "wrong.3b").write_text(WRONG_AXIS, "ascii")
    (tmp_path / "part.iso").write_text(ISO, "ascii")
    return tmp_path


@pytest.mark.alike(4)
@pytest.mark.parametrize(
    ("code", "arguments"),
    [
        (0, ("check", "part.3b", "--machine", "dk7740", "--wire-diameter", "0.18mm")),
        (1, ("check", ".", "--format", "sarif=x.sarif", "--format", "junit=x.xml", "--offset", "D1=0.1mm")),
        (0, ("check", "wrong.3b", "--fix")),
        (0, ("explain", "3B204")),
        (0, ("explain", "--search", "kerf", "--json")),
        (0, ("decode", "part.iso", "--offset", "D1=0.1mm")),
        (0, ("convert", "part.3b", "-o", "x.iso")),
        (0, ("example", "keyhole", "-o", "x")),
        (0, ("time", "part.3b", "--json")),
        (0, ("dialect", "test", "part.iso", "--dialect", "fanuc")),
        (0, ("draw", "part.3b", "-o", "x.svg", "--lang", "zh", "--theme", "dark")),
    ],
    ids=lambda of: of[0] if isinstance(of, tuple) else str(of),
)
def test_the_core_needs_no_extra(shop: Path, code: int, arguments: tuple[str, ...]) -> None:
    done = drycut(shop, *arguments)
    assert (done[0], done[2].count("error:")) == (code, 0), done[2]


@pytest.mark.alike(4)
@pytest.mark.parametrize(
    ("extra", "arguments"),
    [
        ("run", ("run", "part.3b")),
        ("run", ("ballbar",)),
        ("run", ("draw", "part.3b", "-o", "x.png")),
        ("run", ("drill", "part.3b", "-o", "x")),
        ("drawing", ("program", "part.dxf", "-o", "x.3b")),
        ("drawing", ("compare", "part.3b", "part.dxf")),
        ("open", ("open", "--no-browser")),
        ("lsp", ("lsp",)),
    ],
    ids=lambda of: of[0] if isinstance(of, tuple) else of,
)
def test_what_is_missing_is_said_with_the_command_that_brings_it(
    shop: Path, extra: str, arguments: tuple[str, ...]
) -> None:
    code, out, err = drycut(shop, *arguments)
    assert (code, out) == (2, "")
    assert err.startswith("drycut: error: this needs ")
    assert f"pip install 'drycut[{extra}]'" in err
    assert not list(shop.glob("x*"))


@pytest.mark.deeper
@pytest.mark.parametrize("arguments", [("run", "part.3b", "-o", "out"), ("draw", "part.3b", "-o", "x.png")])
def test_a_run_needs_its_own_extra_alone(shop: Path, arguments: tuple[str, ...]) -> None:
    code, _, err = drycut(shop, *arguments, extra="run")
    assert (code, err.count("error:")) == (0, 0), err


def test_every_package_that_is_imported_is_of_the_core_or_of_the_extra_that_is_named() -> None:
    core = {"click", "numpy", "rich"}
    ours = {"parser", "controller", "sim", "drycut"}
    nodes = [node for tree in trees().values() for node in ast.walk(tree)]
    names = {alias.name for node in nodes if isinstance(node, ast.Import) for alias in node.names}
    names |= {node.module for node in nodes if isinstance(node, ast.ImportFrom) and node.module}
    packages = {name.partition(".")[0] for name in names} - set(sys.stdlib_module_names) - ours - {"_typeshed"}
    assert packages - core - set(EXTRA_OF) == set()
    assert set(EXTRA_OF) - packages == {"imageio_ffmpeg"}  # imported by its name, where a film is encoded


def test_the_extras_are_those_of_the_project() -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]
    extras = project["optional-dependencies"]
    assert set(EXTRA_OF.values()) == set(extras) - {"all", "test", "docs"}
    assert extras["all"] == [f"drycut[{','.join(sorted(set(EXTRA_OF.values())))}]"]
