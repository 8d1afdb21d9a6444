"""What keeps findings from being shown, as a user meets it."""

import json
from pathlib import Path

import pytest
from checking import SOUND, WRONG_AXIS, drycut
from command import run_inside

from sim.base.workers.rounds import Processes
from sim.check.file_check import check_file
from sim.check.parallel import check_files
from sim.check.result import CheckResult, Silenced
from sim.cli.check.jobs import NO_OPTIONS, jobs_of


def check(*arguments: object, cwd: Path, **environment: str) -> tuple[object, str, str]:
    done = run_inside("check", *arguments, cwd=cwd, **environment)
    return done.returncode, done.stdout.decode(), done.stderr.decode()


@pytest.fixture
def shop(tmp_path: Path) -> Path:
    """A project with a wrong program in each of its folders."""
    shop = tmp_path / "shop"
    for name in ("a.3b", "jigs/b.3b", "jigs/deep/c.3b", "old/d.3b"):
        (shop / name).parent.mkdir(parents=True, exist_ok=True)
        (shop / name).write_text(WRONG_AXIS, "ascii")
    (shop / ".git").mkdir()
    return shop


def verdicts(out: str) -> dict[str, str]:
    return {Path(file["name"]).as_posix(): file["verdict"] for file in json.loads(out)["files"]}


def test_settings_above_the_project_never_turn_a_fail_into_a_pass(shop: Path, tmp_path: Path) -> None:
    (tmp_path / "one" / "two").mkdir(parents=True)
    shop = shop.rename(tmp_path / "one" / "two" / "shop")
    for above in list(shop.parents)[:3]:  # none of them is a folder of other tests, for which they would count
        (above / "drycut.toml").write_text('root = true\nignore = ["3B"]\n', "utf-8")
    for folder in (shop, shop / "jigs", shop.parent):
        assert check(shop / "jigs" / "deep" / "c.3b", cwd=folder)[0] == 1


def test_the_result_names_its_settings_and_counts_what_they_silence(
    shop: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def result(name: str, **asked: object) -> CheckResult:
        (job,) = jobs_of([name], NO_OPTIONS._replace(**asked)).jobs  # type: ignore[arg-type]
        return check_file(job)

    (shop / "drycut.toml").write_text('ignore = ["3B2"]\n', "utf-8")
    monkeypatch.chdir(shop)
    told = result("a.3b")
    assert (told.settings_file, told.silenced, told.findings) == ("drycut.toml", Silenced(settings=1), ())
    told = result("a.3b", ignore="3B204")
    assert (told.settings_file, told.silenced) == ("drycut.toml", Silenced(options=1))
    monkeypatch.chdir(shop / "jigs")
    assert result("b.3b").settings_file == str(shop.resolve() / "drycut.toml")
    told = result("b.3b", no_config=True)
    assert (told.settings_file, told.silenced, told.verdict) == ("", Silenced(), "fail")
    Path("empty.3b").write_text("// nothing\n", "ascii")
    assert result("empty.3b").settings_file == str(shop.resolve() / "drycut.toml")


def test_a_settings_file_can_be_named_or_done_without(shop: Path) -> None:
    (shop / "drycut.toml").write_text('select = ["3B1"]\n', "utf-8")
    (shop / "ci").mkdir()
    (shop / "ci" / "strict.toml").write_text('fail_on = "warning"\n', "utf-8")
    (shop / "ci" / "pyproject.toml").write_text("[tool.drycut]\nignore = ['3B204']\n", "utf-8")
    assert check("a.3b", cwd=shop)[0] == 0
    assert check("a.3b", "--no-config", cwd=shop)[0] == 1
    assert check("a.3b", "--config", "ci/strict.toml", cwd=shop)[0] == 1
    assert check("a.3b", "--config", "ci/pyproject.toml", cwd=shop)[0] == 0
    for bad, why in (
        (["--config", "ci/gone.toml"], "gone.toml: cannot be read"),
        (["--config", "ci"], "is a directory"),
        (["--config", "ci/strict.toml", "--no-config"], "--config and --no-config say two things"),
    ):
        code, out, err = check("a.3b", *bad, cwd=shop)
        assert (code, out) == (2, "")
        assert why in err


def test_settings_for_the_standard_input_are_those_of_the_working_folder(shop: Path) -> None:
    (shop / "drycut.toml").write_text('ignore = ["3B2"]\n', "utf-8")
    assert drycut("check", "-", stdin=WRONG_AXIS.encode(), cwd=shop / "jigs")[0] == 0


def test_codes_are_ignored_for_some_files(shop: Path) -> None:
    (shop / "drycut.toml").write_text('[per_file_ignores]\n"jigs/*.3b" = ["3B204"]\n"d.3b" = ["3B2"]\n', "utf-8")
    expected = {"a.3b": "fail", "jigs/b.3b": "pass", "jigs/deep/c.3b": "pass", "old/d.3b": "pass"}
    assert verdicts(check(".", "--format", "json", cwd=shop)[1]) == expected
    assert verdicts(check("b.3b", "--format", "json", cwd=shop / "jigs")[1]) == {"b.3b": "pass"}
    (shop / "drycut.toml").write_text('[per_file_ignores]\n"jigs/*.3b" = ["3B999"]\n', "utf-8")
    assert "[per_file_ignores]: jigs/*.3b: no code begins with '3B999'" in check(".", cwd=shop)[2]


def test_files_and_folders_are_excluded_unless_they_are_named(shop: Path) -> None:
    (shop / "drycut.toml").write_text('exclude = ["old", "jigs/deep/*"]\n', "utf-8")
    for name in (".", "**/*.3b"):
        assert set(verdicts(check(name, "--format", "json", cwd=shop)[1])) == {"a.3b", "jigs/b.3b"}
    assert set(verdicts(check("old/d.3b", "old", "--format", "json", cwd=shop)[1])) == {"old/d.3b"}
    assert "old/d.3b" in verdicts(check(".", "--exclude", "jigs", "--format", "json", cwd=shop)[1])
    code, out, err = check("jigs/deep", cwd=shop)
    assert (code, out) == (2, "")
    assert "jigs/deep: no program there that is not excluded" in err
    code, _, err = check(".", "--exclude", "", cwd=shop)
    assert code == 2
    assert "--exclude is a list of patterns" in err


def test_exit_zero_lets_findings_pass_and_nothing_else(shop: Path) -> None:
    assert check("a.3b", cwd=shop)[0] == 1
    code, out, _ = check("a.3b", "--exit-zero", cwd=shop)
    assert code == 0
    assert "3B204" in out
    (shop / "no.3b").write_text("hello", "ascii")
    assert check("no.3b", "a.3b", "--exit-zero", cwd=shop)[0] == 2
    assert check("gone", "--exit-zero", cwd=shop)[0] == 2


def test_with_a_baseline_only_new_findings_fail(shop: Path) -> None:
    code, _, err = check(".", "--write-baseline", "ci/known.json", cwd=shop)
    assert (code, err) == (0, "ci/known.json: baseline written, findings and incomplete checks in it: 4\n")
    written = (shop / "ci" / "known.json").read_bytes()
    assert check(".", "--baseline", "ci/known.json", cwd=shop)[::2] == (0, "")
    (shop / "a.3b").write_text(f"// turned over\n\n{WRONG_AXIS}", "ascii")
    assert check("a.3b", "--baseline", "../ci/known.json", cwd=shop / "jigs")[0] == 2, "named from the working folder"
    assert check("../a.3b", "b.3b", "--baseline", "../ci/known.json", cwd=shop / "jigs")[::2] == (0, "")
    (shop / "a.3b").write_text(WRONG_AXIS.replace("GXL1", "GXL4"), "ascii")
    code, out, _ = check(".", "--baseline", "ci/known.json", "--fail-on", "warning", cwd=shop)
    assert code == 1
    assert [code for code in ("3B203", "3B204") if code in out] == ["3B203"]
    (shop / "a.3b").write_text(WRONG_AXIS, "ascii")
    check("**/*.3b", "--write-baseline", "ci/known.json", cwd=shop)
    assert (shop / "ci" / "known.json").read_bytes() == written


def test_settings_name_a_baseline_beside_themselves(shop: Path) -> None:
    (shop / "drycut.toml").write_text('baseline = "ci/known.json"\n', "utf-8")
    code, _, err = check("jigs", cwd=shop)
    assert code == 2
    assert "known.json: cannot be read" in err
    check(".", "--write-baseline", "ci/known.json", cwd=shop)
    assert check("b.3b", cwd=shop / "jigs")[0] == 0
    (shop / "other.json").write_text("{}", "ascii")
    code, _, err = check("b.3b", "--baseline", "../other.json", cwd=shop / "jigs")
    assert code == 2
    assert "other.json: is no baseline" in err
    code, _, err = check(".", "--baseline", "x", "--write-baseline", "x", cwd=shop)
    assert code == 2
    assert "say two things" in err


def test_known_findings_that_are_gone_are_told(shop: Path) -> None:
    check(".", "--write-baseline", "known.json", cwd=shop)
    (shop / "a.3b").write_text(SOUND, "ascii")
    code, _, err = check(".", "--baseline", "known.json", cwd=shop)
    assert code == 0
    assert err.startswith("known findings and incomplete checks that no longer occur: 1; --w")
    assert "基线" in check(".", "--baseline", "known.json", "--lang", "zh", cwd=shop)[2]
    assert check("jigs", "--baseline", "known.json", cwd=shop)[2] == "", "files that are not checked"
    assert check(".", "--baseline", "known.json", "--select", "3B1", cwd=shop)[2] == ""
    (shop / "a.3b").write_text(SOUND.replace("B39600", "B396O0"), "ascii")
    assert check("a.3b", "--baseline", "known.json", cwd=shop)[2] == "", "what was not looked for may occur still"


def test_a_baseline_that_cannot_be_written_is_told(shop: Path) -> None:
    (shop / "known.json").mkdir()
    (shop / "file").touch()
    for name in ("known.json", "file/known.json"):
        code, _, err = check(".", "--write-baseline", name, cwd=shop)
        assert code == 2
        assert "Traceback" not in err


def test_what_is_silenced_is_not_mended(shop: Path) -> None:
    remark = WRONG_AXIS.replace("GXNR1", "GXNR1 // drycut: ignore 3B204")
    (shop / "a.3b").write_text(remark, "ascii")
    assert check("a.3b", "--fix", cwd=shop)[::2] == (0, "")
    check("jigs", "--write-baseline", "known.json", cwd=shop)
    check("jigs", "--fix", "--baseline", "known.json", cwd=shop)
    assert (shop / "a.3b").read_text("ascii") == remark
    assert (shop / "jigs" / "b.3b").read_text("ascii") == WRONG_AXIS
    check("jigs", "--fix", cwd=shop)
    assert (shop / "jigs" / "b.3b").read_text("ascii") == SOUND


def test_files_are_silenced_alike_on_all_cores(shop: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (shop / "drycut.toml").write_text('ignore = ["3B102"]\n[per_file_ignores]\n"old/*" = ["3B204"]\n', "utf-8")
    (shop / "a.3b").write_text(WRONG_AXIS.replace("GXNR1\n", "GXNR1 // drycut: ignore 3B204\n"), "ascii")
    check("jigs/b.3b", "--write-baseline", "known.json", cwd=shop)
    monkeypatch.chdir(shop)
    jobs = jobs_of(["."], NO_OPTIONS._replace(baseline=Path("known.json"), fail_on="warning")).jobs
    told: list[tuple[int, int]] = []
    results = list(check_files(jobs, Processes(), lambda done, total: told.append((done, total))))
    assert [result.silenced for result in results] == [
        Silenced(remarks=1),
        Silenced(baseline=1),
        Silenced(),
        Silenced(settings=1),
    ]
    assert results == [check_file(job) for job in jobs]
    assert told == [(done, 4) for done in range(1, 5)]
