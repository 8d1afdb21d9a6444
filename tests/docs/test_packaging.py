"""The packages install, hold what they need, and own their names."""

import json
import os
import platform
import re
import subprocess
import sys
import tarfile
import tomllib
import zipfile
from importlib import metadata
from pathlib import Path
from typing import Any

import pytest
from depth import spread
from licence_page import closure
from places import ROOT, SCENARIOS

from drycut import __version__
from parser.findings.codes import CODES
from sim.cli.compile import compile_loops
from sim.show.terminal.markdown import files

LOCKS = tuple(f"requirements-{of}lock.txt" for of in ("build-", "core-", "all-", ""))
OWN = {"test", "docs"}
"""Extras of those who change drycut."""


def test_no_other_distribution_owns_our_names() -> None:
    owners = metadata.packages_distributions()
    for name in ("parser", "controller", "sim", "drycut"):
        assert set(owners.get(name, ["drycut"])) == {"drycut"}, name


def test_wheel_holds_packages_data_and_licences(tmp_path: Path) -> None:
    code = f"from hatchling.build import build_wheel; print(build_wheel({str(tmp_path)!r}))"
    done = subprocess.run([sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=True)
    name = done.stdout.splitlines()[-1]
    assert __version__ in name
    with zipfile.ZipFile(tmp_path / name) as wheel:
        names = wheel.namelist()
    assert {path.split("/")[0] for path in names} == {
        "parser",
        "controller",
        "sim",
        "drycut",
        f"drycut-{__version__}.dist-info",
    }
    for needed in (
        "sim/setup/machine/dk7740.toml",
        "sim/show/draw/fonts/OFL.txt",
        "parser/program.py",
        "sim/cli/run.py",
    ):
        assert needed in names
    sources = [path for folder in ("parser", "controller", "sim", "drycut") for path in (ROOT / folder).rglob("*.*")]
    ours = {path.relative_to(ROOT).as_posix() for path in sources if "__pycache__" not in path.parts}
    assert ours - set(names) == set()
    assert sum(path.startswith("parser/findings/pages/") for path in names) > len(CODES)
    assert any(path.startswith("sim/show/draw/fonts/") and path.endswith(".otf") for path in names)
    assert any(path.endswith("licenses/LICENSE") for path in names)
    assert {path for path in names if path.startswith("sim/docs/")} == {f"sim/docs/{name}" for name in files()}
    examples = {file.relative_to(ROOT).as_posix() for file in (ROOT / "scenarios").rglob("*") if file.is_file()}
    assert {path.removeprefix("sim/") for path in names if path.startswith("sim/scenarios/")} == examples


@pytest.mark.skipif(sys.platform != "linux", reason="the tag that is expected is that of Linux")
def test_the_wheel_with_machine_code_runs_at_once_where_nothing_can_be_compiled(tmp_path: Path) -> None:
    """Of code for a processor that every machine of its architecture has, so of one system alone."""
    compile_loops()
    environment = {**os.environ, "HATCH_BUILD_HOOKS_ENABLE": "1"}
    command = [sys.executable, "-m", "hatchling", "build", "--target", "wheel", "--directory", str(tmp_path)]
    subprocess.run(command, cwd=ROOT, env=environment, capture_output=True, check=True, timeout=120)
    (wheel,) = tmp_path.iterdir()
    assert wheel.name.endswith(f"-py3-none-manylinux_2_17_{platform.machine()}.whl")
    zipfile.ZipFile(wheel).extractall(tmp_path / "installed")  # noqa: S202 - it was made here
    code = "import sys; sys.modules['numba'] = None\nfrom drycut.__main__ import main\nmain()"
    empty = {**os.environ, "NUMBA_CACHE_DIR": str(tmp_path / "none"), "PYTHONPATH": str(tmp_path / "installed")}
    scenario = [str(SCENARIOS / "keyhole"), "--kerf", "-o", str(tmp_path / "out")]
    done = subprocess.run(
        [sys.executable, "-c", code, "run", *scenario],
        cwd=tmp_path, env=empty, capture_output=True, text=True, check=False, timeout=120,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    assert "compiling" not in done.stderr
    assert not (tmp_path / "none").exists()


def test_source_package_holds_what_tests_and_documents_need(tmp_path: Path) -> None:
    code = f"from hatchling.build import build_sdist; print(build_sdist({str(tmp_path)!r}))"
    done = subprocess.run([sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=True)
    with tarfile.open(tmp_path / done.stdout.splitlines()[-1]) as package:
        names = {name.partition("/")[2] for name in package.getnames()}
    here = [path for folder in ("parser", "tests", "docs", "scenarios") for path in (ROOT / folder).rglob("*.*")]
    made = {"__pycache__", "failures", "node_modules", "dist"}
    wanted = {path.relative_to(ROOT).as_posix() for path in here if path.is_file() and not made & set(path.parts)}
    scripts = {"package.json", "package-lock.json", ".npmrc", "tsconfig.json", "eslint.config.js"}
    others = {"action.yml", ".pre-commit-hooks.yaml", ".github/action-check.sh", ".ci/build_loops.py"}
    assert (wanted | scripts | others) - names == set()


@pytest.mark.deeper
def test_the_benchmark_runs_and_prints_its_figures() -> None:
    done = subprocess.run(
        [sys.executable, "tests/tools/bench.py", "path", "check", "--blocks", "60"],
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=True,
        env={**os.environ, "PYTHONPATH": str(ROOT)},
    )
    for figure in ("60 blocks", "blocks/s", "ns per step", "plain loop", "peak memory", "with its start"):
        assert figure in done.stdout


def test_types_are_shipped() -> None:
    for name in ("parser", "controller", "sim", "drycut"):
        assert (ROOT / name / "py.typed").exists(), name


def test_every_dependency_is_locked() -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]
    wanted = [
        *project["dependencies"],
        *(name for extra in project["optional-dependencies"].values() for name in extra),
    ]
    locked = {name for name, _ in versions("requirements-lock.txt")}
    for requirement in wanted:
        name = requirement.split(">=")[0]
        assert name in locked or re.fullmatch(r"drycut\[[a-z,]+\]", name), requirement


def test_the_core_is_locked_to_the_same_versions_and_each_package_by_its_hashes() -> None:
    core, every = versions("requirements-core-lock.txt"), versions("requirements-lock.txt")
    assert {requirement.split(">=")[0] for requirement in project()["dependencies"]} <= {name for name, _ in core}
    assert core <= every
    assert core <= versions("requirements-all-lock.txt") <= every
    assert versions("requirements-build-lock.txt") <= every
    for name in LOCKS:
        entries = re.split(r"^(?=[a-z])", (ROOT / name).read_text("utf-8"), flags=re.MULTILINE)[1:]
        assert [entry.split()[0] for entry in entries if "--hash=sha256:" not in entry] == []


def test_the_licence_of_every_package_is_listed() -> None:
    rows = dict(
        re.findall(r"^\| ([a-z0-9-]+) \| ([^|]*?) \|", (ROOT / "docs" / "licences.md").read_text("utf-8"), re.MULTILINE)
    )
    brought = {
        name for extra in ("core", "run", "drawing", "open", "lsp", "film", "cluster") for name in closure(extra)
    }
    assert brought - set(rows) == set()
    assert [name for name, licence in rows.items() if not licence] == []
    locked = {re.sub(r"[-_.]+", "-", name).lower() for name, _ in versions("requirements-lock.txt")}
    assert set(rows) - {"package"} - locked == set()


def test_the_parts_of_the_image_are_there_and_it_runs_as_no_root() -> None:
    lines = (ROOT / "Dockerfile").read_text("utf-8").replace("\\\n", " ").splitlines()
    words = [line.split() for line in lines if line and not line.startswith("#")]
    images = [each[1] for each in words if each[0] == "FROM"]
    assert len(set(images)) == 1, "machine code and packages are of one Python"
    python = tuple(map(int, re.findall(r"\d+", images[0])))
    assert f"Programming Language :: Python :: {python[0]}.{python[1]}" in project()["classifiers"]
    assert [each[1] for each in words if each[0] == "USER"] == ["drycut"]
    assert words[-1] == ["ENTRYPOINT", '["drycut"]']
    run = next(line for line in lines if line.startswith("RUN python"))
    for file in re.findall(r"/source/(\S+)", run):
        assert (ROOT / file).exists()
        assert file not in (ROOT / ".dockerignore").read_text("utf-8").split()
    assert "-m sim.cli.compile" in run
    cache = set(re.findall(r"NUMBA_CACHE_DIR=(\S+)", "\n".join(lines)))
    assert len(cache) == 1, "loops are found where they were stored"


def project() -> Any:
    return tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]


def versions(lock: str) -> set[tuple[str, str]]:
    """Packages of a lock with their versions."""
    return set(re.findall(r"^([A-Za-z0-9_.-]+)==([^ ]+)", (ROOT / lock).read_text("utf-8"), re.MULTILINE))


def test_what_checks_the_scripts_of_pages_is_pinned_and_locked_from_no_place() -> None:
    package = json.loads((ROOT / "package.json").read_text("utf-8"))
    wanted = package["devDependencies"] | package["optionalDependencies"]
    locked = json.loads((ROOT / "package-lock.json").read_text("utf-8"))["packages"]
    assert all(re.fullmatch(r"\d+\.\d+\.\d+", version) for version in wanted.values())
    assert locked[""]["devDependencies"] | locked[""]["optionalDependencies"] == wanted
    assert {name: locked[f"node_modules/{name}"]["version"] for name in wanted} == wanted
    assert not [name for name, entry in locked.items() if "resolved" in entry]
    assert not [name for name, entry in locked.items() if name and not {"integrity", "inBundle"} & entry.keys()]


def test_make_deep_tries_all_that_the_suite_leaves_out() -> None:
    settings = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["tool"]["pytest"]["ini_options"]
    (recipe,) = re.findall(r"^deep:.*\n((?:\t.*\n)+)", (ROOT / "Makefile").read_text("utf-8"), flags=re.MULTILINE)
    marks = {re.split(r"[(:]", mark)[0] for mark in settings["markers"]}
    assert marks == {"alike", "alone", "deep", "deeper"}
    assert marks <= set(re.findall(r"[a-z]+", recipe.replace("DRYCUT_DEEP", "")))


@pytest.mark.parametrize(
    ("most", "number", "tried"),
    [(1, 5, {0}), (2, 5, {0, 4}), (3, 5, {0, 2, 4}), (4, 10, {0, 3, 6, 9}), (9, 3, {0, 1, 2})],
)
def test_cases_that_stand_for_others_are_spread_over_all(most: int, number: int, tried: set[int]) -> None:
    assert spread(most, number) == tried
