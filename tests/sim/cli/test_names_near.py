"""A command, a code or a document that is misspelt: what it is like is named, in the language of the user."""

from pathlib import Path

import pytest
from command import run_inside


@pytest.mark.parametrize(
    ("arguments", "english", "chinese"),
    [
        (["chekc", "a.3b"], "there is no command 'chekc'; did you mean check?", "没有命令 'chekc'；是不是 check？"),
        (["card", "bild"], "there is no command 'bild'; did you mean build?", "没有命令 'bild'；是不是 build？"),
        (["xyzzy"], "there is no command 'xyzzy'; drycut --help lists them", "用 drycut --help 列出全部"),
        (["explain", "3b20"], "did you mean 3B201, 3B202, 3B203?", "是不是 3B201, 3B202, 3B203？"),
        (["explain", "repotr"], "did you mean report?", "是不是 report？"),
        (["explain", "xyzzy"], "drycut explain lists them", "用 drycut explain 列出全部"),
    ],
)
def test_what_a_misspelt_name_is_like_is_named(arguments: list[str], english: str, chinese: str) -> None:
    for language, message in (("en", english), ("zh", chinese)):
        done = run_inside("--lang", language, *arguments)
        assert (done.returncode, done.stdout) == (2, b"")
        assert message in done.stderr.decode()


def test_a_program_in_the_place_of_a_command_is_one_to_check(tmp_path: Path) -> None:
    (tmp_path / "part.3b").write_text("DD\n")
    done = run_inside("part.3b", cwd=tmp_path)
    assert done.returncode == 2
    assert "there is no command 'part.3b'; did you mean check part.3b?" in done.stderr.decode()


def test_a_group_without_a_command_shows_its_help() -> None:
    done = run_inside("card")
    assert (done.returncode, done.stdout) == (2, b"")
    assert done.stderr.decode() == run_inside("card", "--help").stdout.decode()
