"""Who makes a result: another version, another system or other sources make another."""

from collections.abc import Callable
from pathlib import Path

import pytest
from places import ROOT

from parser.findings.errors import ClusterError
from sim.base.workers import maker
from sim.base.workers.maker import (
    digest_of,
    made_by,
    refuse_other_makers,
    sources,
)


@pytest.fixture
def package(tmp_path: Path) -> Path:
    folder = tmp_path / "one" / "sim"
    (folder / "cut").mkdir(parents=True)
    (folder / "cut" / "kerf.py").write_text("GAP_UM = 10\n", "utf-8")
    (folder / "words.toml").write_text("a = 1\n", "utf-8")
    return folder


@pytest.mark.parametrize(
    "change",
    [
        lambda folder: (folder / "cut" / "kerf.py").write_text("GAP_UM = 11\n", "utf-8"),
        lambda folder: (folder / "words.toml").write_text("a = 2\n", "utf-8"),
        lambda folder: (folder / "cut" / "more.py").write_text("", "utf-8"),
        lambda folder: (folder / "cut" / "kerf.py").rename(folder / "kerf.py"),
        lambda folder: (folder / "words.toml").unlink(),
    ],
)
def test_any_change_of_a_source_gives_another_digest(package: Path, change: Callable[[Path], object]) -> None:
    before = digest_of([package])
    change(package)
    assert digest_of([package]) != before


def test_neither_the_place_nor_what_python_compiles_counts(package: Path, tmp_path: Path) -> None:
    before = digest_of([package])
    (package / "__pycache__").mkdir()
    (package / "__pycache__" / "kerf.pyc").write_bytes(b"compiled")
    (tmp_path / "other").mkdir()
    assert digest_of([package.rename(tmp_path / "other" / "sim")]) == before


def test_all_packages_of_drycut_count(monkeypatch: pytest.MonkeyPatch) -> None:
    assert sources() == digest_of(ROOT / name for name in ("parser", "controller", "sim", "drycut"))
    assert dict(made_by())["sources"] == sources()


def test_a_worker_with_other_sources_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    here = made_by()
    refuse_other_makers(here)
    monkeypatch.setattr(maker, "sources", lambda: "0123456789abcdef")
    with pytest.raises(ClusterError, match="sources"):
        refuse_other_makers(here)
