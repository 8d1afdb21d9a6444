"""The recipes of docs/ci.md, run in a folder of programs: exit codes, and files as those who take them up want them."""

import json
import os
import re
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

import pytest
import xmlschema
from checking import SOUND, WRONG_AXIS
from depth import cases
from jsonschema import Draft202012Validator
from places import ROOT
from plain_yaml import read_yaml

PAGE = (ROOT / "docs" / "ci.md").read_text("utf-8")
SCHEMAS = ROOT / "tests" / "schemas"
SHELL = shutil.which("bash")
pytestmark = pytest.mark.skipif(SHELL is None, reason="the recipes are for a shell")

DRYCUT = f'#!{SHELL}\nexec "{sys.executable}" -m drycut "$@"\n'
PIP = f'#!{SHELL}\necho "$@" >> "$CALLS"\n'


def blocks(language: str) -> list[str]:
    return re.findall(rf"^```{language}\n(.*?)^```$", PAGE, flags=re.MULTILINE | re.DOTALL)


(KNOWN, SH), (MAKEFILE,), (PIPELINE,) = blocks("sh"), blocks("make"), blocks("groovy")
WITH_ACTION, WITHOUT_ACTION, GITLAB, HOOK, OWN_HOOK = map(read_yaml, blocks("yaml"))
STEPS = WITHOUT_ACTION["jobs"]["drycut"]["steps"]


class Recipe(NamedTuple):
    """Its script, and the files that are taken up afterwards, by their format."""

    script: str
    files: dict[str, str]


def named(pattern: str, text: str) -> str:
    """The one name that a text has at this place."""
    (found,) = re.findall(pattern, text)
    return str(found)


RECIPES = {
    "shell": Recipe(SH, {"junit": "out/check.xml", "sarif": "out/check.sarif"}),
    "make": Recipe("make check", {"junit": "out/check.xml"}),
    "github": Recipe(
        "\n".join(step["run"] for step in STEPS if "run" in step), {"sarif": STEPS[-1]["with"]["sarif_file"]}
    ),
    "gitlab": Recipe(
        "\n".join(GITLAB["drycut"]["script"]),
        {
            "gitlab": GITLAB["drycut"]["artifacts"]["reports"]["codequality"],
            "junit": GITLAB["drycut"]["artifacts"]["reports"]["junit"],
        },
    ),
    "jenkins": Recipe(
        named(r"sh '(.*)'", PIPELINE),
        {"junit": named(r"junit '(.*)'", PIPELINE), "sarif": named(r"sarif\(.*pattern: '(.*?)'", PIPELINE)},
    ),
}


class Shop:
    """A folder with programs, and a PATH on which drycut stands."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.calls = folder / "calls"
        (folder / "bin").mkdir()
        for name, script in {"drycut": DRYCUT, "pip": PIP}.items():
            (folder / "bin" / name).write_text(script, "utf-8")
            (folder / "bin" / name).chmod(0o755)
        (folder / "Makefile").write_text(MAKEFILE, "utf-8")
        (folder / "programs" / "deep").mkdir(parents=True)
        self.write("part.3b", SOUND)
        self.write("deep/零件.4b", f"//起点\n{SOUND}")

    def write(self, name: str, text: str) -> None:
        (self.folder / "programs" / name).write_bytes(text.encode("gb18030"))

    def run(self, script: str, **environment: str) -> subprocess.CompletedProcess[str]:
        path = os.pathsep.join([str(self.folder / "bin"), os.environ["PATH"]])
        own = {"PATH": path, "CALLS": str(self.calls), "PYTHONPATH": str(ROOT), "PYTHONUTF8": "1", "LC_ALL": "C.UTF-8"}
        return subprocess.run(
            [str(SHELL), "-e", "-c", script],
            cwd=self.folder,
            env={**os.environ, **own, **environment},
            capture_output=True,
            encoding="utf-8",
            timeout=120,
            check=False,
        )


@pytest.fixture
def shop(tmp_path: Path) -> Shop:
    return Shop(tmp_path)


def fits_schema(name: str) -> Callable[[Path], Any]:
    def read(path: Path) -> Any:
        content = json.loads(path.read_text("ascii"))
        validator = Draft202012Validator(json.loads((SCHEMAS / f"{name}.schema.json").read_text("utf-8")))
        assert [error.message for error in validator.iter_errors(content)] == []
        return content

    return read


def junit_failures(path: Path) -> list[Any]:
    schema = xmlschema.XMLSchema(SCHEMAS / "junit.xsd")
    schema.validate(str(path))
    return [
        int(suite.get("failures", 0))
        for suite in xmlschema.XMLResource(str(path)).root
        if int(suite.get("failures", 0))
    ]


OPEN = "B9900B0B9900GXL1\nB0B9900B9900GYL2\nB3000B2000B3000GXL3\nDD\n"
TAPER = "G92 X0 Y0\nG90 G51\nG01 X0 Y5000\nX5000 Y5000\nX5000 Y0\nX0 Y0\nG50\nM02\n"
FINDINGS: dict[str, Callable[[Path], Any]] = {
    "sarif": lambda path: fits_schema("sarif")(path)["runs"][0]["results"],
    "gitlab": fits_schema("gitlab"),
    "junit": junit_failures,
}


def test_every_recipe_is_run_here() -> None:
    assert re.findall(r"^```(\w*)$", PAGE, flags=re.MULTILINE)[::2] == [
        *("sh", "sh", "make", "yaml", "yaml", "yaml", "groovy", "yaml", "yaml"),
    ]
    assert re.findall(r"^## (.*)$", PAGE, flags=re.MULTILINE) == [
        "Old programs: only what is new fails",
        *("A plain shell", "make", "GitHub Actions", "GitLab CI", "Jenkins", "pre-commit"),
    ]


@pytest.mark.alike(1)
@pytest.mark.parametrize(
    ("name", "is_sound"), [("shell", True), ("gitlab", True), *((name, False) for name in RECIPES)]
)
def test_a_recipe_ends_as_its_programs_are_with_its_files_written(shop: Shop, name: str, is_sound: bool) -> None:
    recipe = RECIPES[name]
    shop.write("part.3b", SOUND if is_sound else WRONG_AXIS)
    done = shop.run(recipe.script)
    failed = 2 if name == "make" else 1  # make has codes of its own
    assert done.returncode == (0 if is_sound else failed)
    assert ("3B204" in done.stdout) is not is_sound
    for form, file in recipe.files.items():
        assert len(FINDINGS[form](shop.folder / file)) == (0 if is_sound else 1), file
    if "pip install" in recipe.script:
        assert shop.calls.read_text("utf-8") == "install drycut @ git+URL@REF\n"


def test_what_is_known_passes_a_recipe_and_what_is_new_fails_it(shop: Shop) -> None:
    shop.write("part.3b", WRONG_AXIS)
    assert shop.run(KNOWN).returncode == 0
    recipe = RECIPES["gitlab"]
    done = shop.run(recipe.script)
    assert done.returncode == 0
    assert "drycut.toml" in done.stdout
    assert not FINDINGS["gitlab"](shop.folder / recipe.files["gitlab"])
    shop.write("deep/零件.4b", WRONG_AXIS)
    assert shop.run(recipe.script).returncode == 1
    assert len(FINDINGS["gitlab"](shop.folder / recipe.files["gitlab"])) == 1


@pytest.mark.deeper
@pytest.mark.deep
def test_a_shop_adopts_and_then_fails_on_what_is_new_alone(shop: Shop) -> None:
    kinds = [("3b", SOUND), ("3b", WRONG_AXIS), ("3b", OPEN), ("iso", TAPER), ("3b", SOUND.replace("GXL1", "GXL4"))]
    for at in cases(40, 200):
        suffix, text = kinds[at % len(kinds)]
        (shop.folder / "programs" / str(at // 10)).mkdir(exist_ok=True)
        shop.write(f"{at // 10}/p{at}.{suffix}", text)
    ((hook,),) = [repository["hooks"] for repository in OWN_HOOK["repos"]]
    names = sorted(str(path.relative_to(shop.folder)) for path in (shop.folder / "programs").rglob("*.*"))
    ways = {
        "github": RECIPES["github"].script,
        "gitlab": RECIPES["gitlab"].script,
        "pre-commit": " ".join([hook["entry"], *hook["args"], *names]),
    }
    assert shop.run(ways["gitlab"]).returncode == 1
    assert shop.run(KNOWN).returncode == 0
    for way, script in ways.items():
        done = shop.run(script)
        assert done.returncode == 0, (way, done.stdout)
        assert "checks in the baseline" in done.stdout, way
    shop.write("3/p30.3b", WRONG_AXIS)
    for way, script in ways.items():
        done = shop.run(script)
        assert (done.returncode, done.stdout.count("3B204")) == (1, 1), way


@pytest.mark.deeper
def test_make_leaves_the_mends_for_a_person(shop: Shop) -> None:
    shop.write("part.3b", WRONG_AXIS)
    assert shop.run("make mend").returncode == 0
    command = named(r"`(git apply [^`]*)`", PAGE)
    assert shop.run(command, GIT_CEILING_DIRECTORIES=str(shop.folder.parent)).returncode == 0
    assert (shop.folder / "programs" / "part.3b").read_text("ascii") == SOUND
    assert shop.run("make mend").returncode == 0
    assert (shop.folder / "out" / "mend.patch").read_bytes() == b""


def test_the_action_is_given_inputs_that_it_has_and_its_output_is_taken_up(shop: Shop) -> None:
    action = read_yaml((ROOT / "action.yml").read_text("utf-8"))
    rows = re.findall(r"^\| (`[a-z].*?) \| .* \| (.*) \|$", PAGE, flags=re.MULTILINE)
    listed = {name: default for cell, default in rows for name in re.findall(r"`([a-z-]+)`", cell)}
    told = {name: default for name, default in listed.items() if name in action["inputs"]}
    assert set(told) == set(action["inputs"])
    for name, default in told.items():
        assert default in {"theirs", "none", "the runner's own", f"`{action['inputs'][name]['default']}`"}
    _, check, upload = WITH_ACTION["jobs"]["drycut"]["steps"]
    given = check["with"]
    assert set(given) <= set(action["inputs"])
    shop.write("part.3b", WRONG_AXIS)
    inputs = {name: of["default"] for name, of in action["inputs"].items()} | given
    output = shop.folder / "output"
    environment = {f"INPUT_{name.upper().replace('-', '_')}": value for name, value in inputs.items()}
    environment |= {"DRYCUT": str(shop.folder / "bin" / "drycut"), "GITHUB_OUTPUT": str(output)}
    done = shop.run(f'bash "{ROOT}/.github/action-check.sh"', **environment)
    assert done.returncode == 1
    assert "::error file=programs/part.3b,line=2" in done.stdout
    (name,) = action["outputs"]
    assert upload["with"]["sarif_file"] == f"${{{{ steps.{check['id']}.outputs.{name} }}}}"
    first, file, _ = output.read_text("utf-8").splitlines()
    assert (first.partition("<<")[0], file) == (name, given["sarif-file"])
    assert len(FINDINGS["sarif"](shop.folder / file)) == 1


@pytest.mark.alike(1)
@pytest.mark.parametrize("hook", ["ours", "own"])
def test_hooks_check_the_programs_that_pre_commit_names(shop: Shop, hook: str) -> None:
    ours = {one["id"]: one for one in read_yaml((ROOT / ".pre-commit-hooks.yaml").read_text("utf-8"))}
    ((asked,),) = [repository["hooks"] for repository in (HOOK if hook == "ours" else OWN_HOOK)["repos"]]
    used = {**ours[asked["id"]], **asked} if hook == "ours" else asked
    assert used["require_serial"] == "true"
    (shop.folder / "programs" / "-dash.3B").write_text(SOUND, "ascii")
    staged = ["programs/part.3b", "programs/deep/零件.4b", "programs/notes.txt", "-dash.3B"]
    (shop.folder / "-dash.3B").write_text(SOUND, "ascii")
    names = [name for name in staged if re.search(used["files"], name)]
    assert names == [name for name in staged if "notes" not in name]
    command = " ".join([used["entry"], *used["args"], *names])
    done = shop.run(command)
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")
    if hook == "ours":
        shop.write("part.3b", SOUND.replace("GXL1", "GXL4"))  # a warning, which its --fail-on asks for
        assert shop.run(command).returncode == 1
