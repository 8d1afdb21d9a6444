"""Checks of a shop's own, offered by a distribution: as a shop installs them, each command in a process of its own."""

import json
import re
import sys
from pathlib import Path

import jsonschema
import pytest
from command import run_command
from places import ROOT

PAGE = (ROOT / "docs" / "python.md").read_text("utf-8")
LONG = "B9900B0B9900GXL1\nB60000B0B60000GXL1\nB60000B0B60000GXL3\nB9900B0B9900GXL3\nDD\n"
SHORT = LONG.replace("60000", "6000")
BROKEN = """
import sys
from drycut import OwnCheck, OwnCode, OwnFinding, OwnTexts

def made(run, code="SHOP201"):
    return OwnCheck(run, {code: OwnCode("error", OwnTexts("broken", "{far:um}"))}, "what fails")

def no_table(program):
    raise KeyError("no table")

raises = made(no_table)
other_code = made(lambda program: [OwnFinding("SHOP999")])
lacks_value = made(lambda program: [OwnFinding("SHOP201")])
no_block = made(lambda program: [OwnFinding("SHOP201", block=99, values={"far": 1.0})])
no_finding = made(lambda program: [3])
endless = made(lambda program: iter(lambda: OwnFinding("SHOP201", values={"far": 1.0}), None))
our_code = made(no_table, "ISO203")
small_code = made(no_table, "shop1")
ends = made(lambda program: sys.exit(3))
nothing = 3
"""


@pytest.fixture
def shop(tmp_path: Path) -> Path:
    (tmp_path / "long.3b").write_text(LONG, "ascii")
    (tmp_path / "short.3b").write_text(SHORT, "ascii")
    code, points = re.findall(r"```(?:py|ini)\n(.*?)```", PAGE, re.DOTALL)
    install(tmp_path, code, points.replace('"', "").replace("project.entry-points.", ""))
    return tmp_path


def install(folder: Path, code: str, points: str) -> None:
    info = folder / "site" / "shop_checks-1.0.dist-info"
    info.mkdir(parents=True, exist_ok=True)
    (info / "METADATA").write_text("Metadata-Version: 2.1\nName: shop-checks\nVersion: 1.0\n", "ascii")
    (info / "entry_points.txt").write_text(points, "ascii")
    (folder / "site" / "shop_checks.py").write_text(code, "utf-8")


def drycut(shop: Path, *arguments: str) -> tuple[int, str, str]:
    path = f"{shop / 'site'}{';' if sys.platform == 'win32' else ':'}{ROOT}"
    done = run_command(*arguments, cwd=shop, PYTHONPATH=path)
    return done.returncode, done.stdout.decode(), done.stderr.decode()


@pytest.mark.deeper
def test_its_findings_have_places_and_texts_in_both_languages(shop: Path) -> None:
    code, out, _ = drycut(shop, "check", "long.3b", "--format", "concise", "--fail-on", "warning")
    assert code == 1
    assert "long.3b:2:1: warning[SHOP101]: block 2: a block of 60.000 mm" in out
    assert "long.3b:3:1: warning[SHOP101]" in out
    assert "第 2 段：程序段长 60.000 mm" in drycut(shop, "check", "long.3b", "--lang", "zh", "--format", "concise")[1]
    code, out, _ = drycut(shop, "check", "short.3b")
    assert (code, "9 complete" in out) == (0, True)


@pytest.mark.deeper
def test_its_codes_are_chosen_silenced_known_and_explained(shop: Path) -> None:
    assert "SHOP101" in drycut(shop, "check", "long.3b", "--select", "SHOP")[1]
    assert drycut(shop, "check", "long.3b", "--ignore", "SHOP101", "--fail-on", "warning")[0] == 0
    (shop / "long.3b").write_text("// drycut: ignore-file SHOP101\n" + LONG, "ascii")
    assert "SHOP101" not in drycut(shop, "check", "long.3b")[1]
    (shop / "long.3b").write_text(LONG, "ascii")
    assert drycut(shop, "check", ".", "--write-baseline", "known.json")[0] == 0
    assert drycut(shop, "check", ".", "--baseline", "known.json", "--fail-on", "warning")[0] == 0
    assert "long block (warning)" in drycut(shop, "explain", "shop101")[1]
    assert "程序段太长" in drycut(shop, "explain", "--search", "SHOP101", "--lang", "zh")[1]


@pytest.mark.alike(2)
@pytest.mark.parametrize("form", ["json", "sarif", "junit", "github", "gitlab"])
def test_every_format_has_its_findings(shop: Path, form: str) -> None:
    out = drycut(shop, "check", "long.3b", "--format", form, "--fail-on", "warning")[1]
    assert "SHOP101" in out
    if form in ("json", "sarif"):
        folder, name = (ROOT / "docs", "check") if form == "json" else (ROOT / "tests" / "schemas", "sarif")
        schema = json.loads((folder / f"{name}.schema.json").read_text("utf-8"))
        jsonschema.Draft202012Validator(schema).validate(json.loads(out))


@pytest.mark.alike(2)
@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("raises", "KeyError: 'no table'"),
        ("other_code", "is no finding of its codes"),
        ("lacks_value", "KeyError: 'far'"),
        ("no_block", "there is no block 99"),
        ("ends", "SystemExit: 3"),
        ("no_finding", "3 is no finding of its codes"),
        ("endless", "more than 10000 findings"),
        ("our_code", "'ISO203' is no code of one's own"),
        ("small_code", "'shop1' is no code of one's own"),
        ("nothing", "is no drycut.OwnCheck"),
        ("missing", "AttributeError"),
    ],
)
def test_one_that_cannot_be_run_is_named_and_incomplete(shop: Path, name: str, said: str) -> None:
    install(shop, BROKEN, f"[drycut.checks]\nwhat-fails = shop_checks:{name}\n")
    code, out, err = drycut(shop, "check", "short.3b")
    assert (code, err) == (1, "")
    assert "short.3b: incomplete" in out
    assert said in " ".join(out.split())


def test_the_working_folder_offers_none(shop: Path) -> None:
    (shop / "site" / "part.3b").write_text(LONG, "ascii")
    done = run_command("check", "part.3b", "--fail-on", "warning", cwd=shop / "site", PYTHONPATH=str(ROOT))
    assert (done.returncode, b"SHOP101" in done.stdout) == (0, False)


def test_no_result_is_taken_from_a_folder_where_there_are_any(shop: Path) -> None:
    plain = drycut(shop, "check", "short.3b")
    code, out, err = drycut(shop, "check", "short.3b", "--cache", "results")
    assert (code, out) == plain[:2]
    assert err.startswith("drycut: --cache: there are checks of one's own")
    assert not (shop / "results").exists()
