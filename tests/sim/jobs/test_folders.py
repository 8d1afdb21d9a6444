"""Names of folders in OUT: every system takes them, and no two meet."""

import random
import re
import unicodedata
from pathlib import Path

import pytest

from sim.jobs.shop import folder_names

TAKEN = frozenset({"report.html", "index.html"})
FORBIDDEN = re.compile(
    r'[<>:"\\|?*\x00-\x1f]|[. ](/|$)|(^|/)(con|prn|aux|nul|com\d|lpt\d)(\.[^/]*)?(/|$)', re.IGNORECASE
)


def named(*programs: str, root: str = "shop") -> list[str]:
    return folder_names([Path(root, program) for program in programs], [root], TAKEN)


@pytest.fixture(autouse=True)
def shop(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "shop").mkdir()
    monkeypatch.chdir(tmp_path)


def test_a_folder_is_the_way_from_what_was_named() -> None:
    assert named("a.3b", "jigs/a.3b", "jigs/deep/模具.3b") == ["a.3b", "jigs/a.3b", "jigs/deep/模具.3b"]


def test_of_a_file_and_of_a_glob_it_is_the_way_from_their_folder() -> None:
    paths = [Path("shop/a.3b"), Path("shop/old/b.3b")]
    assert folder_names(paths, ["shop/a.3b", "shop/old"], TAKEN) == ["a.3b", "old/b.3b"]
    assert folder_names(paths, ["shop/**/*.3b"], TAKEN) == ["a.3b", "old/b.3b"]
    assert folder_names([Path("shop")], ["shop", "shop/x"], TAKEN) == ["shop"]


@pytest.mark.parametrize("name", ["aux.3b", "a:b.3b", "dot.", "blank ", "COM1", ".drycut-0123456789abcdef", "x" * 200])
def test_a_name_that_some_system_cannot_have_gets_a_mark(name: str) -> None:
    (made,) = named(name)
    assert re.search(r"~[0-9a-f]{8}$", made)
    assert not FORBIDDEN.search(made)
    assert not made.startswith(".")
    assert len(made) <= 90
    assert named(name) == [made]


def test_names_of_our_own_files_are_taken() -> None:
    assert [name for name in named("index.html", "jigs/Report.HTML") if "~" not in name] == []


def test_names_that_differ_in_case_or_in_accents_alone_are_told_apart() -> None:
    decomposed = unicodedata.normalize("NFD", "é.3b")
    made = named("a.3b", "A.3b", "é.3b", decomposed, "b.3b")
    folded = [unicodedata.normalize("NFC", name).casefold() for name in made]
    assert len(set(folded)) == 5
    assert made[-1] == "b.3b"


def test_no_two_of_random_names_meet_and_all_are_possible() -> None:
    chance = random.Random(18)
    letters = ["a", "A", "é", "e\u0301", ".", " ", ":", "con", "nul", "模", "~", "_", "?", ".3b", "\ud800"]
    parts = ["".join(chance.choices(letters, k=chance.randint(1, 4))) for _ in range(600)]
    ways = sorted({"/".join(chance.choices(parts, k=chance.randint(1, 3))) for _ in range(600)})
    ways = [way for way in ways if not re.search(r"(^|/)\.{1,2}(/|$)", way)]
    made = named(*ways)
    assert len({unicodedata.normalize("NFC", name).casefold() for name in made}) == len(ways) > 400
    assert [name for name in made if FORBIDDEN.search(name)] == []
    for name in made:
        name.encode("utf-8")
