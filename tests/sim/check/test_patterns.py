"""Patterns for paths mean what they mean in the settings of ruff."""

import random
import time
from fnmatch import fnmatchcase
from pathlib import Path

import pytest

from parser.findings.errors import SettingsError
from sim.check.settings.read import PathPattern, pattern_list

ROOT = Path("/shop/programs")


@pytest.mark.parametrize(
    ("pattern", "inside", "outside"),
    [
        ("part.3b", ["part.3b", "a/part.3b"], ["apart.3b", "part.3bx"]),
        ("old", ["old", "a/old"], ["older", "old/part.3b"]),
        ("old/", ["old", "a/old"], ["older"]),
        ("jigs/*.3b", ["jigs/a.3b", "jigs/deep/a.3b"], ["a.3b", "x/jigs/a.3b", "jigs/a.4b"]),
        ("./jigs/*", ["jigs/a.3b"], ["a.3b"]),
        ("*.3b", ["a.3b", "x/y.3b"], ["a.3B", "a.4b"]),
        ("**/try/*.3b", ["try/a.3b", "x/y/try/b/c.3b"], ["retry/a.3b", "try.3b"]),
        ("a/**/b.3b", ["a/b.3b", "a/x/y/b.3b"], ["a/xb.3b", "b.3b"]),
        ("lot-?", ["lot-7", "x/lot-7"], ["lot-", "lot-77"]),
        ("lot-[0-3].3b", ["lot-2.3b"], ["lot-4.3b", "lot-[0-3].3b"]),
        ("lot-[!0-3].3b", ["lot-4.3b"], ["lot-2.3b"]),
        ("a[b.3b", ["a[b.3b"], ["ab.3b"]),
        ("[[a]*", ["[x", "ax"], ["x"]),
        ("a.b+(c)", ["a.b+(c)"], ["aXb+(c)", "a.bb(c)"]),
        ("零件*", ["零件1.3b"], ["件1.3b"]),
        ("/shop/programs/a/*", ["a/b.3b"], ["b.3b"]),
        ("a*b*c", ["abc", "aXbXbXc"], ["acb", "ab"]),
        ("a*bc/**/d", ["abc/d", "abXbc/x/d"], ["abd", "abc/xd"]),
    ],
)
def test_a_pattern_means_names_anywhere_and_paths_from_its_folder(
    pattern: str, inside: list[str], outside: list[str]
) -> None:
    one = PathPattern(pattern, ROOT)
    assert [path for path in inside if not one.matches(ROOT / path)] == []
    assert [path for path in outside if one.matches(ROOT / path)] == []


def test_a_name_is_matched_as_the_shell_matches_it() -> None:
    draw = random.Random(17)
    for _ in range(3000):
        pattern = "".join(draw.choices(["a", "b", ".", "*", "?", "[ab]", "[!a]"], k=draw.randint(1, 7)))
        name = "".join(draw.choices("ab.c", k=draw.randint(1, 8)))
        assert PathPattern(pattern, ROOT).matches(Path(name)) == fnmatchcase(name, pattern), (pattern, name)


def test_a_path_elsewhere_is_meant_by_its_name_alone() -> None:
    assert not PathPattern("jigs/*", ROOT).matches(Path("/other/jigs/a.3b"))
    assert PathPattern("a.3b", ROOT).matches(Path("/other/jigs/a.3b"))


def test_no_pattern_takes_long() -> None:
    begin = time.perf_counter()
    assert not PathPattern("**/" * 40 + "*a" * 60 + "b", ROOT).matches(ROOT.joinpath(*["a" * 200] * 20))
    assert time.perf_counter() - begin < 2.0


@pytest.mark.parametrize("value", ["old", [1], [""], ["/"], ["./"], None, {"old": []}])
def test_what_is_no_list_of_patterns_is_refused(value: object) -> None:
    with pytest.raises(SettingsError, match="exclude is a list of patterns"):
        pattern_list(value, ROOT, "exclude")
