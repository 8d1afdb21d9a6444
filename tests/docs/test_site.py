"""The site of the documents: every document is in it, links lead somewhere, and it is read without a network."""

import json
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest
from places import ROOT

from parser.findings.catalogue import own_codes
from parser.findings.codes import CODES

BUILD = ROOT / "docs" / "site" / "build.py"
LOADED = re.compile(r"""(?:<script[^>]*\bsrc|<link[^>]*\bhref|<img[^>]*\bsrc|<iframe[^>]*\bsrc)=["'](?:https?:)?//""")


def test_every_document_is_in_the_site() -> None:
    named = set(re.findall(r'"([\w-]+\.md)"', BUILD.read_text("utf-8").partition("_SECTIONS")[0]))
    own = {path.name for path in BUILD.parent.glob("*.md")}
    written = {path.name for path in (ROOT / "docs").glob("*.md")} | own

    assert named == {name for name in written if not name.endswith(".zh.md")}
    assert {name for name in own if name.endswith(".zh.md")} == {
        name.replace(".md", ".zh.md") for name in own if not name.endswith(".zh.md")
    }


@pytest.mark.deeper
def test_it_is_built_in_both_languages_and_loads_nothing_from_elsewhere(tmp_path: Path) -> None:
    done = subprocess.run(
        [sys.executable, str(BUILD), str(tmp_path / "site")],
        cwd=ROOT,
        env={**os.environ, "PYTHONPATH": str(ROOT), "TMPDIR": str(tmp_path)},
        capture_output=True,
        timeout=300,
        check=False,
    )
    assert done.returncode == 0, done.stderr.decode()[-2000:]
    site = tmp_path / "site"
    for code in sorted(set(CODES) - set(own_codes())):
        for folder in (site, site / "zh"):
            assert code in (folder / "findings" / f"{code}.html").read_text("utf-8")
    for path in site.rglob("*.html"):
        assert not LOADED.search(path.read_text("utf-8")), path
    index = json.loads((site / "search" / "search_index.json").read_text("utf-8"))
    parted = [page for page in index["docs"] if "\u200b象限\u200b" in page["text"]]
    assert len(parted) > 10
