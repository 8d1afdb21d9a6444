"""Bytecode of the templates: read in place of a template that did not change, and never a reason to fail."""

import sys
from collections.abc import Callable
from pathlib import Path

import pytest
from jinja2 import Environment, FileSystemLoader

from sim.show.html.bytecode import Bytecode


@pytest.fixture(autouse=True)
def written(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "dont_write_bytecode", False)
    monkeypatch.setattr(sys, "pycache_prefix", None)


def _page(folder: Path) -> str:
    """The page as a new process makes it."""
    environment = Environment(loader=FileSystemLoader(folder), autoescape=True, bytecode_cache=Bytecode())
    return environment.get_template("page.html.j2").render(name="<b>")


def _stored(folder: Path) -> Path:
    (entry,) = (folder / "__pycache__").iterdir()
    return entry


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "page.html.j2").write_text("one {{ name }}", "utf-8")
    assert _page(tmp_path) == "one &lt;b&gt;"
    return tmp_path


def test_a_template_is_compiled_once(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def compiled(*args: object, **kwargs: object) -> None:
        raise AssertionError("compiled again")

    monkeypatch.setattr(Environment, "_generate", compiled)
    assert _page(folder) == "one &lt;b&gt;"


def test_a_template_that_changed_is_compiled_again(folder: Path) -> None:
    before = _stored(folder).read_bytes()
    (folder / "page.html.j2").write_text("two {{ name }}", "utf-8")
    assert _page(folder) == "two &lt;b&gt;"
    assert _stored(folder).read_bytes() != before  # in place of the old one, no second file


@pytest.mark.parametrize(
    "damage", [lambda entry: b"", lambda entry: entry[:40], lambda entry: entry[:-1] + b"?", lambda entry: b"x" * 4000]
)
def test_damaged_bytecode_counts_as_none(folder: Path, damage: Callable[[bytes], bytes]) -> None:
    entry = _stored(folder)
    whole = entry.read_bytes()
    entry.write_bytes(damage(whole))
    assert _page(folder) == "one &lt;b&gt;"
    assert entry.read_bytes() == whole


def test_bytecode_of_another_compiler_counts_as_none(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    before = _stored(folder).read_bytes()
    monkeypatch.setattr("sim.show.html.bytecode._compiler", lambda: b"another")
    assert _page(folder) == "one &lt;b&gt;"
    assert _stored(folder).read_bytes() != before


def test_a_page_is_made_where_no_bytecode_can_be_written(tmp_path: Path) -> None:
    (tmp_path / "page.html.j2").write_text("one {{ name }}", "utf-8")
    (tmp_path / "__pycache__").write_text("a file where the folder is to be", "utf-8")
    assert _page(tmp_path) == "one &lt;b&gt;"


def test_where_python_writes_none_we_write_none(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "dont_write_bytecode", True)
    (tmp_path / "page.html.j2").write_text("one {{ name }}", "utf-8")
    assert _page(tmp_path) == "one &lt;b&gt;"
    assert not (tmp_path / "__pycache__").exists()
