"""Which programs names lead to, and with what each is run."""

from pathlib import Path

import pytest
from checking import SOUND

from parser.findings.errors import FileUnreadableError, SettingsError
from sim.jobs.shop import ShopProgram, find_programs
from sim.setup.scenario import load_scenario


@pytest.fixture(autouse=True)
def shop(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Programs alone, a scenario with one more program beside its own, one that cannot be read, and a page."""
    for name in ("shop/b.3b", "shop/jigs/A.4B", "shop/die/program.3b", "shop/die/trial.3b", "shop/broken/any.3b"):
        path = tmp_path / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(SOUND, "ascii")
    (tmp_path / "shop" / "die" / "scenario.toml").write_text('title = "Die"\n', "utf-8")
    (tmp_path / "shop" / "broken" / "scenario.toml").write_text("title = 3\n", "utf-8")
    (tmp_path / "shop" / "notes.txt").write_text("none", "utf-8")
    monkeypatch.chdir(tmp_path)
    return tmp_path


def found(*names: str, out: str = "out") -> list[ShopProgram]:
    return find_programs(names, load_scenario, Path(out), frozenset())


def test_a_folder_leads_to_programs_and_scenarios_each_once() -> None:
    programs = found("shop")
    assert [(one.file, one.folder) for one in programs] == [
        ("shop/b.3b", "b.3b"),
        ("shop/broken/scenario.toml", "broken"),
        ("shop/die/program.3b", "die"),
        ("shop/die/trial.3b", "die/trial.3b"),
        ("shop/jigs/A.4B", "jigs/A.4B"),
    ]
    titles = [one.scenario.title if one.scenario else one.error for one in programs]
    assert titles[0] == "b.3b"
    assert "scenario.toml: title" in titles[1]
    assert titles[2:] == ["Die", "trial.3b", "A.4B"]


def test_a_program_alone_has_the_settings_that_it_has_alone() -> None:
    for one in found("shop/b.3b", "shop/jigs"):
        assert one.scenario == load_scenario(Path(one.file))


def test_names_come_in_their_order_and_no_file_twice() -> None:
    assert [one.file for one in found("shop/jigs", "shop/*.3b", "shop/b.3b")] == ["shop/jigs/A.4B", "shop/b.3b"]
    assert [one.file for one in found("shop/d*", "shop/notes.txt")][-1] == "shop/notes.txt"


def test_the_program_of_a_scenario_is_run_with_it_even_where_it_is_named() -> None:
    assert [one.folder for one in found("shop/die/program.3b", "shop/die")] == ["die", "trial.3b"]


def test_nothing_is_looked_for_where_the_runs_are_written(shop: Path) -> None:
    (shop / "shop" / "out").mkdir()
    (shop / "shop" / "out" / "old.3b").write_text(SOUND, "ascii")
    assert "shop/out/old.3b" not in [one.file for one in found("shop", out="shop/out")]


@pytest.mark.parametrize("name", ["nowhere/*.3b", "shop/*.txt/*", "shop/empty"])
def test_a_name_that_leads_nowhere_is_told(shop: Path, name: str) -> None:
    (shop / "shop" / "empty").mkdir()
    with pytest.raises(FileUnreadableError, match="no program there"):
        found("shop", name)


def test_settings_that_no_program_can_have_are_told_once() -> None:
    def refusing(path: Path) -> None:
        raise SettingsError("no-length", found="thickness")

    with pytest.raises(SettingsError, match="thickness"):
        find_programs(["shop/b.3b"], refusing, Path("out"), frozenset())  # type: ignore[arg-type]
