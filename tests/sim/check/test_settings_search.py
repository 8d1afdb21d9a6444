"""Settings count within their project, and nothing above it does."""

import os
from pathlib import Path

import pytest

from parser.findings.errors import DrycutError, FileUnreadableError, SettingsError
from sim.check.settings.search import SettingsSearch

SILENT = 'ignore = ["3B2"]\n'


@pytest.fixture
def place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder within folders, far from the working folder and from home."""
    place = (tmp_path / "one" / "two" / "three").resolve()
    place.mkdir(parents=True)
    for name, folder in (("HOME", "home"), ("USERPROFILE", "home")):
        (tmp_path / folder).mkdir(exist_ok=True)
        monkeypatch.setenv(name, str(tmp_path / folder))
    (tmp_path / "elsewhere").mkdir()
    monkeypatch.chdir(tmp_path / "elsewhere")
    return place


def counting(folder: Path) -> str:
    """Name of the settings file that counts in a folder."""
    return SettingsSearch().near(folder).settings.file


def settings_in(folder: Path, content: str = SILENT, name: str = "drycut.toml") -> Path:
    file = folder / name
    file.write_text(content, "utf-8")
    return file


def test_settings_above_the_programs_folder_do_not_count_without_a_project(place: Path) -> None:
    for above in place.parents[:3]:
        settings_in(above)
        assert counting(place) == ""
    assert counting(place.parent) == str(place.parent / "drycut.toml"), "those of its own folder do"


def test_no_folder_up_to_the_root_of_the_file_system_counts_without_a_project(place: Path) -> None:
    assert list(SettingsSearch()._ladder(place)) == [place]


def test_the_search_ends_at_the_folder_that_holds_git(place: Path) -> None:
    settings_in(place.parents[1])
    (place.parent / ".git").mkdir()
    assert counting(place) == ""
    inside = settings_in(place.parent)
    assert counting(place) == str(inside)
    (place / ".git").write_text("gitdir: ../elsewhere\n", "utf-8")  # of a worktree, or a submodule
    assert counting(place) == ""


def test_settings_with_root_end_the_search_and_count(place: Path) -> None:
    settings_in(place.parents[1], "[tool.drycut]\nroot = true\nignore = ['3B2']\n", "pyproject.toml")
    settings_in(place.parents[2])
    assert counting(place) == str(place.parents[1] / "pyproject.toml")
    nearer = settings_in(place.parent)
    assert counting(place) == str(nearer), "the nearest one counts, and that one alone"


def test_where_no_folder_is_a_root_the_working_folder_is_the_last(place: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    settings_in(place.parents[1])
    monkeypatch.chdir(place.parent)
    assert counting(place) == ""
    monkeypatch.chdir(place.parents[1])
    assert counting(place) == "drycut.toml"


def test_a_root_below_the_working_folder_ends_the_search_all_the_same(
    place: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    settings_in(place.parents[1])
    (place / ".git").mkdir()
    monkeypatch.chdir(place.parents[1])
    assert counting(place) == ""


def test_nothing_above_the_home_folder_counts(place: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("HOME", str(place.parent))
    monkeypatch.setenv("USERPROFILE", str(place.parent))
    settings_in(place.parents[1], f"root = true\n{SILENT}")
    (place.parents[1] / ".git").mkdir()
    monkeypatch.chdir(place.parents[1])
    assert counting(place) == ""
    at_home = settings_in(place.parent)
    assert counting(place) == str(at_home.relative_to(place.parents[1]))


def test_in_one_folder_drycut_toml_goes_first_and_other_projects_are_passed_over(place: Path) -> None:
    settings_in(place, "[tool.other]\n", "pyproject.toml")
    assert counting(place) == ""
    project = settings_in(place, "[tool.drycut]\n", "pyproject.toml")
    assert counting(place) == str(project)
    assert counting(place) == str(project)
    own = settings_in(place)
    assert counting(place) == str(own)


def test_a_file_that_is_named_counts_wherever_it_stands(place: Path) -> None:
    file = settings_in(place, "[tool.drycut]\nignore = ['3B2']\n", "pyproject.toml")
    assert SettingsSearch().named(file).settings.ignore == ("3B2",)
    with pytest.raises(SettingsError, match=r"has no \[tool.drycut\]"):
        SettingsSearch().named(settings_in(place, "", "pyproject.toml"))
    with pytest.raises(FileUnreadableError, match="cannot be read"):
        SettingsSearch().named(place / "gone.toml")


def test_a_link_to_a_file_counts_where_it_stands_and_a_linked_folder_where_it_is(place: Path, tmp_path: Path) -> None:
    settings_in(place)
    linked = tmp_path / "linked"
    linked.symlink_to(place)
    search = SettingsSearch()
    program = search.placed(linked / "part.3b")
    assert program == place / "part.3b"
    assert search.near(program.parent).settings.file == str(place / "drycut.toml")
    (place / "part.3b").touch()
    (place.parent / "other.3b").symlink_to(place / "part.3b")
    assert search.near(search.placed(place.parent / "other.3b").parent).settings.file == ""


@pytest.mark.parametrize("make", ["folder", "link", "pipe", "text"])
def test_settings_that_cannot_be_read_are_told_and_never_passed_over(place: Path, make: str) -> None:
    file = place / "drycut.toml"
    {
        "folder": file.mkdir,
        "link": lambda: file.symlink_to(place / "nowhere"),
        "pipe": lambda: os.mkfifo(file),
        "text": lambda: file.write_bytes(b"\xff\xfe"),
    }[make]()
    with pytest.raises(DrycutError, match=r"drycut\.toml: "):
        SettingsSearch().near(place)


@pytest.mark.skipif(not hasattr(os, "geteuid") or os.geteuid() != 0, reason="only root can give files away")
@pytest.mark.parametrize("owner", ["file", "link"])
def test_settings_of_another_user_are_refused(place: Path, owner: str, monkeypatch: pytest.MonkeyPatch) -> None:
    (place.parent / ".git").mkdir()
    file = settings_in(place.parent, SILENT, "mine.toml" if owner == "link" else "drycut.toml")
    if owner == "link":
        (place.parent / "drycut.toml").symlink_to(file)
    os.chown(place.parent / "drycut.toml", 4711, -1, follow_symlinks=False)
    with pytest.raises(SettingsError, match=r"belongs to another user \(number 4711\).*--config FILE"):
        SettingsSearch().near(place)
    os.chown(place, 4711, -1)
    assert SettingsSearch().near(place).settings.ignore == ("3B2",), "whose the program is, his are the settings"


@pytest.mark.skipif(not hasattr(os, "geteuid") or os.geteuid() != 0, reason="only root can give files away")
def test_settings_of_another_user_make_no_root(place: Path) -> None:
    os.chown(settings_in(place.parents[1], f"root = true\n{SILENT}"), 4711, -1)
    settings_in(place.parent)
    assert counting(place) == ""


def test_each_folder_is_looked_at_once(place: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (place.parents[1] / ".git").mkdir()
    settings_in(place.parents[1])
    looked: list[Path] = []
    look = SettingsSearch._look_in
    monkeypatch.setattr(SettingsSearch, "_look_in", lambda self, folder: looked.append(folder) or look(self, folder))
    search = SettingsSearch()
    folders = [place / f"{number}" for number in range(500)]
    assert {search.near(folder).settings.file for folder in folders} == {str(place.parents[1] / "drycut.toml")}
    assert len(looked) == len(set(looked)) == len(folders) + 3


def test_a_deep_folder_is_no_trouble(place: Path) -> None:
    deep = place.joinpath(*["d"] * 1500)
    assert counting(deep) == ""
