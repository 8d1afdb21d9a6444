"""What a check looks at, with which settings, and what of it fails: as a shop adopts it."""

import json
import re
from pathlib import Path

import pytest
from checking import SOUND, WRONG_AXIS, drycut
from places import ROOT

from sim.check.settings.read import KEYS

OPEN = "B9900B0B9900GXL1\nB0B9900B9900GYL2\nB3000B2000B3000GXL3\nDD\n"
LABEL = SOUND.replace("GXL1", "GXL4")  # a warning
TAPER = "G92 X0 Y0\nG90 G51\nG01 X0 Y5000\nX5000 Y5000\nX5000 Y0\nX0 Y0\nG50\nM02\n"


@pytest.fixture
def shop(tmp_path: Path) -> Path:
    for name in ("a.3b", "O0013", "jigs/b.TAP", "jigs/c.txt", "old/O0001"):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_text(SOUND, "ascii")
    (tmp_path / ".git").mkdir()
    (tmp_path / ".git" / "HEAD").touch()
    return tmp_path


def names(out: str) -> list[str]:
    return [Path(line).as_posix() for line in out.splitlines()]


def test_files_of_a_folder_that_are_passed_over_are_counted_by_kind(shop: Path) -> None:
    code, out, err = drycut("check", ".", cwd=shop)
    assert (code, out.count("pass")) == (0, 1)
    assert err == "4 files passed over: O0013, .TAP, .txt, O0001\n"
    assert drycut("check", ".", "--quiet", cwd=shop) == (0, "", "")
    assert drycut("check", "a.3b", cwd=shop)[2] == ""
    (shop / "drycut.toml").write_text('exclude = ["old", "*.txt"]\n', "ascii")
    assert drycut("check", ".", cwd=shop)[2] == "2 files passed over: O0013, .TAP\n"


def test_included_files_are_checked_whatever_they_end_in(shop: Path) -> None:
    files = drycut("check", ".", "--include", "O[0-9]*", "--include", "*.TAP", "--show-files", cwd=shop)[1]
    assert names(files) == ["O0013", "a.3b", "jigs/b.TAP", "old/O0001"]
    (shop / "drycut.toml").write_text('include = ["O[0-9]*", "jigs/*"]\nexclude = ["old"]\n', "ascii")
    assert names(drycut("check", ".", "--show-files", cwd=shop)[1]) == ["O0013", "a.3b", "jigs/b.TAP", "jigs/c.txt"]
    (shop / "O0013").write_text(WRONG_AXIS, "ascii")
    assert "O0013:2:14: error[3B204]" in drycut("check", ".", cwd=shop)[1]
    (shop / "drycut.toml").write_text("include = [1]\n", "ascii")
    code, _, err = drycut("check", ".", cwd=shop)
    assert (code, "include" in err) == (2, True)


@pytest.mark.parametrize("mode", ["--show-files", "--show-settings"])
def test_a_file_that_is_named_and_is_not_there_is_told(shop: Path, mode: str) -> None:
    code, out, err = drycut("check", "a.3b", "none.3b", mode, cwd=shop)
    assert (code, "a.3b" in out) == (2, True)
    assert err == "drycut: error: none.3b: cannot be read: No such file or directory\n"
    assert drycut("check", "a.3b", mode, cwd=shop)[0] == 0


def test_the_settings_that_count_are_shown_with_what_gave_them(shop: Path) -> None:
    (shop / "b.3b").write_text(WRONG_AXIS, "ascii")
    (shop / "drycut.toml").write_text('fail_on = "warning"\n[per_file_ignores]\n"b.3b" = ["3B2"]\n', "ascii")
    code, out, _ = drycut("check", ".", "--show-settings", "--wire-diameter", "0.2mm", "--machine", "dk7740", cwd=shop)
    assert code == 0
    first, second = out.split("b.3b:\n")
    assert first.startswith("a.3b:\n")
    rows = dict(line.strip().split("  # ") for line in first.splitlines()[1:])
    told = {key.strip(): source for key, source in rows.items()}
    assert told['fail_on = "warning"'] == "drycut.toml; errors, incomplete checks and warnings fail"
    assert told["wire.diameter_mm = 0.2"] == "option"
    assert told["open = false"] == "as usual"
    assert any(key.startswith("machine = ") and source == "option" for key, source in told.items())
    assert 'per_file_ignores = ["3B2"]' in second
    assert "3B204" not in out


def test_what_settings_say_of_the_folder_is_shown_too(shop: Path) -> None:
    (shop / "machines").mkdir()
    said = 'machines = "machines"\nexclude = ["old", "*.bak"]\nbaseline = "known.json"\n'
    said += '[dialects.house]\nextends = "fanuc"\n'
    (shop / "drycut.toml").write_text(said, "ascii")
    assert drycut("check", "a.3b", "--write-baseline", "known.json", cwd=shop)[0] == 0
    code, out, _ = drycut("check", "a.3b", "--show-settings", "--include", "*.TAP", cwd=shop)
    assert code == 0
    told = dict(line.strip().replace(" ", "").split("#", 1) for line in out.splitlines()[1:])
    assert {key: told[key] for key in told if told[key] == "drycut.toml"} == dict.fromkeys(
        ['machines="machines"', 'exclude=["old","*.bak"]', 'baseline="known.json"', 'dialects=["house"]'], "drycut.toml"
    )
    assert told['include=["*.TAP"]'] == "option"
    assert {key.split("=")[0].split(".")[0] for key in told} == set(KEYS) - {"root"}
    out = drycut("check", "a.3b", "--show-settings", "--write-baseline", "new.json", "--no-config", cwd=shop)[1]
    assert "baseline = –" in out
    assert "drycut.toml" not in out


@pytest.mark.parametrize(
    ("text", "name", "failing"),
    [
        (SOUND, "a.3b", set()),
        (WRONG_AXIS, "a.3b", {"error", "incomplete", "warning"}),
        (TAPER, "a.iso", {"incomplete", "warning"}),
        (LABEL, "a.3b", {"warning"}),
    ],
)
def test_fail_on_names_what_fails(text: str, name: str, failing: set[str], tmp_path: Path) -> None:
    (tmp_path / name).write_text(text, "ascii")
    codes = {on: drycut("check", name, "--fail-on", on, cwd=tmp_path)[0] for on in ("error", "incomplete", "warning")}
    assert codes == {on: int(on in failing) for on in codes}
    assert drycut("check", name, cwd=tmp_path)[0] == codes["incomplete"]


def test_among_several_files_those_that_pass_are_only_counted(tmp_path: Path) -> None:
    for at in range(9):
        (tmp_path / f"{at}.3b").write_text(SOUND, "ascii")
    (tmp_path / "x.3b").write_text(OPEN, "ascii")
    code, out, _ = drycut("check", ".", cwd=tmp_path)
    assert code == 1
    assert [line for line in out.splitlines() if ".3b: pass" in line] == []
    assert out.splitlines()[-1].startswith("10 files: 9 pass, 1 fail; 1 error")
    (tmp_path / "x.3b").unlink()
    assert drycut("check", ".", cwd=tmp_path) == (0, "9 files: 9 pass; no findings\n", "")


def test_a_shop_has_machines_of_its_own_by_name(shop: Path) -> None:
    (shop / "machines").mkdir()
    shipped = (ROOT / "sim" / "setup" / "machine" / "dk7740.toml").read_text("utf-8")
    (shop / "machines" / "mill.toml").write_text(re.sub(r"travel_x_mm = .*", "travel_x_mm = 5.0", shipped), "utf-8")
    (shop / "drycut.toml").write_text('machines = "machines"\n', "ascii")
    assert drycut("check", "a.3b", cwd=shop)[0] == 0
    assert drycut("check", "a.3b", "--machine", "dk7740", cwd=shop)[0] == 0
    assert "3B401" in drycut("check", "a.3b", "--machine", "mill", cwd=shop)[1]
    code, _, err = drycut("check", "a.3b", "--machine", "lathe", cwd=shop)
    assert (code, "mill" in err) == (2, True)
    (shop / "drycut.toml").write_text('machines = "machines"\nmachine = "mill"\n', "ascii")
    assert "3B401" in drycut("check", "a.3b", cwd=shop)[1]
    (shop / "drycut.toml").write_text('machines = "nowhere"\n', "ascii")
    code, _, err = drycut("check", "a.3b", cwd=shop)
    assert (code, "machines is a folder" in err) == (2, True)


@pytest.mark.parametrize("address", ["https://wiki.shop/drycut/{code}", "http://10.0.0.7:8080/?q={code}#mend"])
def test_a_shop_has_pages_of_findings_of_its_own(shop: Path, address: str) -> None:
    (shop / "drycut.toml").write_text(f'help_uri = "{address}"\n', "ascii")
    (shop / "jigs" / "drycut.toml").write_text('help_uri = "https://other/{code}"\n', "ascii")
    code, out, _ = drycut("check", ".", "jigs/b.TAP", "--format", "sarif", cwd=shop)
    rules = json.loads(out)["runs"][0]["tool"]["driver"]["rules"]
    assert code == 0
    assert {rule["helpUri"] for rule in rules} == {address.replace("{code}", rule["id"]) for rule in rules}
    shown = drycut("check", "a.3b", "--show-settings", cwd=shop)[1]
    assert re.search(rf'help_uri = "{re.escape(address)}" +# drycut.toml', shown)


@pytest.mark.parametrize(
    "address", ["wiki/{code}", "https://wiki/", "https://wiki/{code} x", "https://wiki/{code}{code}"]
)
def test_an_address_that_is_none_is_refused(shop: Path, address: str) -> None:
    (shop / "drycut.toml").write_text(f'help_uri = "{address}"\n', "ascii")
    code, _, err = drycut("check", "a.3b", cwd=shop)
    assert (code, "help_uri is an address" in err, "{code}" in err) == (2, True, True)


def test_rules_have_no_address_where_a_shop_has_no_pages(shop: Path) -> None:
    rules = json.loads(drycut("check", "a.3b", "--format", "sarif", cwd=shop)[1])["runs"][0]["tool"]["driver"]["rules"]
    assert not any("helpUri" in rule for rule in rules)
