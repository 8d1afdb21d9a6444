"""axe-core in a page: rules of accessibility that others have written down, held by a script that npm has of them."""

from typing import TYPE_CHECKING

import pytest
from places import ROOT

if TYPE_CHECKING:
    from playwright.sync_api import Page

SCRIPT = ROOT / "node_modules" / "axe-core" / "axe.min.js"
RULES = {
    "runOnly": {"type": "tag", "values": ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa", "wcag22aa", "best-practice"]},
    "rules": {"label-content-name-mismatch": {"enabled": True}},
}
ASK = """async (rules) => (await window.axe.run(document, rules)).violations.flatMap(
    ({ id, nodes }) => nodes.map((node) => `${id}: ${node.html.slice(0, 120)}: ${node.failureSummary}`))"""

EQUIVALENT = 'target-size: <button class="mark'
"""Findings on the time line lie where they happen, side by side; the tab of findings leads to the same (2.5.8)."""

needs_axe = pytest.mark.skipif(not SCRIPT.is_file(), reason="`make scripts` did not install axe-core: there is no npm")


def violations(page: "Page") -> list[str]:
    """What axe finds in a page as it stands, of WCAG 2.2 A and AA, and names that a voice can say."""
    page.evaluate(SCRIPT.read_text("utf-8"))
    return [one for one in page.evaluate(ASK, RULES) if not one.startswith(EQUIVALENT)]
