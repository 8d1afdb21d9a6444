"""Where the card's library cannot be made, it is said plainly, and nothing is left."""

from pathlib import Path

import pytest
from command import run_inside


def test_a_compiler_that_is_not_there_is_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("CC", "no-such-compiler")
    done = run_inside("card", "build", "-o", str(tmp_path / "ges"))
    assert done.returncode == 2
    assert b"there is no C compiler no-such-compiler, which CC names" in done.stderr
    assert not (tmp_path / "ges").exists()


def test_a_machine_without_a_compiler_is_told_what_to_install(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("CC", raising=False)
    monkeypatch.setenv("PATH", str(tmp_path))
    done = run_inside("card", "build", "-o", str(tmp_path / "ges"))
    assert done.returncode == 2
    assert b"there is no C compiler here (cc, gcc, clang)" in done.stderr
