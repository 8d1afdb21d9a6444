"""The GitHub action and the hook of pre-commit, as far as they run without their hosts; drycut is a stub."""

import json
import os
import re
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest
from places import ROOT

CHECK = ROOT / ".github" / "action-check.sh"
INSTALL = ROOT / ".github" / "action-install.sh"
BASH = shutil.which("bash")
pytestmark = pytest.mark.skipif(BASH is None, reason="the action's scripts are for bash")

STUB = """#!{python}
import json, os, sys
with open(os.environ["CALLS"], "a") as calls:
    calls.write(json.dumps(sys.argv[1:]) + "\\n")
print("::error::from a program")
for file in (word.partition("sarif=")[2] for word in sys.argv):
    if file and os.environ["STATUS"] != "2":
        with open(file, "w") as sarif:
            sarif.write("{{}}")
sys.exit(int(os.environ["STATUS"]))
"""
NONE = {
    f"INPUT_{name}": ""
    for name in ("FAIL_ON", "MACHINE", "WIRE_DIAMETER", "GAP", "SELECT", "IGNORE", "SARIF_FILE", "FILES")
}


class Action:
    def __init__(self, folder: Path) -> None:
        self.calls, self.output, self.folder = folder / "calls", folder / "output", folder
        stub = folder / "drycut stub"
        stub.write_text(STUB.format(python=sys.executable), encoding="utf-8")
        stub.chmod(0o755)
        self.env = {**os.environ, **NONE, "INPUT_LANG": "en", "INPUT_FORMAT": "github", "STATUS": "0"}
        self.env |= {"DRYCUT": str(stub), "CALLS": str(self.calls), "GITHUB_OUTPUT": str(self.output)}

    def run(self, **inputs: str) -> subprocess.CompletedProcess[str]:
        command = [str(BASH), str(CHECK)]
        env = self.env | inputs
        return subprocess.run(command, check=False, cwd=self.folder, env=env, capture_output=True, text=True)

    def called(self) -> list[list[str]]:
        return [json.loads(line) for line in self.calls.read_text("utf-8").splitlines()]


@pytest.fixture
def action(tmp_path: Path) -> Action:
    return Action(tmp_path)


def test_inputs_left_empty_give_no_options(action: Action) -> None:
    assert action.run().returncode == 0
    assert action.called() == [["check", "--format=github", "--lang=en", "--", "."]]


def test_inputs_are_never_code(action: Action) -> None:
    evil = "$(touch evil) `touch evil`; touch evil #"
    done = action.run(
        INPUT_FILES=f"a b.3b\n\n*.3b\r\n--help\n{evil}\n",
        INPUT_MACHINE=evil,
        INPUT_FAIL_ON="--help",
        INPUT_WIRE_DIAMETER="0.18mm",
        INPUT_GAP="10um",
        INPUT_SELECT="3B2,3B3",
        INPUT_IGNORE="3B102",
    )
    assert done.returncode == 0
    assert action.called() == [
        [
            *("check", "--format=github", "--lang=en", "--fail-on=--help", f"--machine={evil}"),
            *("--wire-diameter=0.18mm", "--gap=10um", "--select=3B2,3B3", "--ignore=3B102", "--"),
            *("a b.3b", "*.3b", "--help", evil),
        ]
    ]
    assert not (action.folder / "evil").exists()


@pytest.mark.parametrize("status", [0, 1])
def test_the_step_ends_as_the_check_does_and_tells_where_the_sarif_file_is(action: Action, status: int) -> None:
    done = action.run(STATUS=str(status), INPUT_SARIF_FILE="out put.sarif")
    assert (done.returncode, done.stdout) == (status, "::error::from a program\n")
    assert [call[1:3] for call in action.called()] == [["--format=github", "--format=sarif=out put.sarif"]]
    first, path, last = action.output.read_text("utf-8").splitlines()
    assert path == "out put.sarif"
    assert first == f"sarif-file<<{last}"


def test_a_sarif_file_that_the_run_did_not_write_is_not_handed_on(action: Action) -> None:
    old = action.folder / "old.sarif"
    old.write_text("{}", "ascii")
    os.utime(old, (1e9, 1e9))
    for name in ("old.sarif", "none.sarif"):
        assert action.run(STATUS="2", INPUT_SARIF_FILE=name).returncode == 2
    assert not action.output.exists()


def test_programs_in_the_log_are_no_commands(action: Action) -> None:
    first, shown, last = action.run(INPUT_FORMAT="text").stdout.splitlines()
    word = first.removeprefix("::stop-commands::")
    assert (shown, last) == ("::error::from a program", f"::{word}::")
    assert len(word) > 30
    assert word not in action.run(INPUT_FORMAT="text").stdout
    assert action.run().stdout == "::error::from a program\n"


def test_every_input_is_handed_over_and_none_is_in_a_script() -> None:
    text = (ROOT / "action.yml").read_text("utf-8")
    inputs = re.findall(r"^  ([a-z-]+):$", text.split("\noutputs:")[0].split("\ninputs:")[1], re.MULTILINE)
    assert len(inputs) == 11
    script = CHECK.read_text("utf-8")
    for name in set(inputs) - {"python"}:
        variable = f"INPUT_{name.upper().replace('-', '_')}"
        assert f"{variable}: ${{{{ inputs.{name} }}}}\n" in text
        assert f"${variable}" in script
    assert not [line for line in text.splitlines() if "run:" in line and "${{" in line]


def test_it_is_pinned_by_its_own_commit() -> None:
    """It uses no action whose name may mean something else tomorrow, and no package without a hash."""
    assert "uses:" not in (ROOT / "action.yml").read_text("utf-8")
    installs = [line for line in INSTALL.read_text("utf-8").splitlines() if line.startswith("pip ")]
    for line in installs:
        assert "--require-hashes" in line or ("--no-deps" in line and "--no-build-isolation" in line), line
    backend = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["build-system"]["requires"]
    locked = (ROOT / "requirements-build-lock.txt").read_text("utf-8")
    for requirement in backend:
        assert re.search(rf"^{re.split('[<>=~]', requirement)[0]}==\S+ ", locked, re.MULTILINE), requirement


@pytest.mark.parametrize(("named", "taken"), [("", "python3.12"), ("my python", "my python")])
def test_it_takes_the_first_python_that_is_new_enough(tmp_path: Path, named: str, taken: str) -> None:
    installed = run_install(tmp_path, {"python3": 1, "python": 1, "python3.12": 0, "my python": 0}, named)
    assert installed.returncode == 0
    assert (tmp_path / "calls").read_text("utf-8").splitlines()[0].startswith(f"{taken} -m venv --clear ")
    assert (tmp_path / "env").read_text("utf-8").startswith("DRYCUT=")


@pytest.mark.parametrize("named", ["", "python3"])
def test_without_a_python_that_is_new_enough_it_says_so(tmp_path: Path, named: str) -> None:
    refused = run_install(tmp_path, {"python3": 1, "python3.12": 0 if named else 1}, named)
    assert (refused.returncode, refused.stdout.count("\n")) == (2, 1)
    assert refused.stdout.startswith("::error::drycut needs Python 3.11 or newer")


def run_install(folder: Path, pythons: dict[str, int], named: str) -> subprocess.CompletedProcess[str]:
    """The script that installs, with stubs as the only Pythons: each is new enough (0) or not (1)."""
    stubs, home = folder / "stubs", folder / "temporary"
    for each in (stubs, home / "drycut-venv" / "bin"):
        each.mkdir(parents=True)
    for name, status in pythons.items():
        write_program(stubs / name, f'[ "$1" = -c ] && exit {status}; echo "{name} $*" >> "$CALLS"')
    write_program(home / "drycut-venv" / "bin" / "python", 'echo "pip $*" >> "$CALLS"')
    for program in ("bash", "env"):
        (stubs / program).symlink_to(str(shutil.which(program)))
    env = {"PATH": str(stubs), "CALLS": str(folder / "calls"), "GITHUB_ENV": str(folder / "env")}
    env |= {"RUNNER_TEMP": str(home), "DRYCUT_ACTION": str(ROOT), "INPUT_PYTHON": named}
    return subprocess.run([str(BASH), str(INSTALL)], check=False, env=env, capture_output=True, text=True)


def write_program(path: Path, line: str) -> None:
    path.write_text(f"#!{BASH}\n{line}\n", "utf-8")
    path.chmod(0o755)


def test_the_hook_takes_programs_alone() -> None:
    hooks = (ROOT / ".pre-commit-hooks.yaml").read_text("utf-8")
    pattern = re.search(r"files: (.*)", hooks)
    assert pattern
    for name, taken in {"a.3b": True, "dir/A.3B": True, "零件.4B": True, "a.3b.bak": False, "a3b": False}.items():
        assert bool(re.search(pattern[1], name)) is taken
