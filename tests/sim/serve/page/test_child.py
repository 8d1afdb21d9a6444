"""A process of drycut's own: what it is told and tells, and what it is not to import."""

from pathlib import Path
from typing import Any

import pytest
from awaited import awaited
from places import ROOT

from sim.serve.page.child import begun


async def rows(file: Path) -> list[Any]:
    child = await begun("sim.serve.page.lister")
    return [row async for row in child.tells([["part.3b", str(file)]])]


def test_it_imports_nothing_from_the_folder_that_drycut_was_started_in(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "json.py").write_text("raise SystemExit('taken')\n")
    (tmp_path / "part.3b").write_text("B1000B0B1000GXL1\nDD\n")
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("PYTHONPATH", str(ROOT))
    assert [row["verdict"] for row in awaited(rows(tmp_path / "part.3b"))] == ["pass"]


def test_one_that_is_ended_tells_no_more(tmp_path: Path) -> None:
    async def ended() -> list[Any]:
        child = await begun("sim.serve.page.lister")
        child.end()
        child.end()
        return [row async for row in child.tells([["part.3b", str(tmp_path / "part.3b")]])]

    assert awaited(ended()) == []
