"""Pages of small runs, with the reports that they show."""

import json
import re
from html.parser import HTMLParser
from typing import Any, NamedTuple

from replayed import recording_of

from sim.base.progress import silent
from sim.run.dryrun import DryRun
from sim.run.report import build_report
from sim.show.pictures.gallery import subject_of
from sim.show.pictures.inline import inline_pictures
from sim.show.report_page import report_page

PART = """\
N1: B0 B500 B500 GYL2;0.000,0.500//lead-in
B500B0B500GXL1
B0B1000B1000GYL4
B1000B0B1000GXL3
B0B1000B1000GYL2
B500B0B500GXL1
B0B500B500GYL4
D
B3000B0B3000GXL1
D
B500B0B500GXL1
B500B0B2000GYNR1
B500B0B500GXL3
DD
"""
"""A square round its start hole, a jump, and a circle round another."""

SMALL = """\
B0B200B200GYL2
B200B0B200GXL1
B0B200B200GYL4
B200B0B200GXL3
DD
"""
"""A square of 0.2 mm."""

HOSTILE = """\
CAXAWEDM -Version 2.0 , Name : <script>window.hacked=1</script>.3B
N1: B0 B500 B500 GYL2;0.000,0.700//<script>window.hacked=1</script> 零件
N2: B500 B0 B500 GXL2;0.500,0.500//"><img src=x onerror="window.hacked=2">
N3: B0 B500 B490 GYL4;0.500,0.000//</script><script>window.hacked=3</script>
DD
"""
HOSTILE_TITLE = '"><img src=x onerror="window.hacked=4"> & <b>bold</b>'


class Made(NamedTuple):
    """A page, and what it was made of."""

    html: str
    run: DryRun
    report: dict[str, Any]

    @property
    def tables(self) -> dict[str, list[dict[str, Any]]]:
        """Columns of the tables by name, as the page's script reads them."""
        data = re.search(r'<script type="application/json" id="tables">(.*?)</script>', self.html, re.DOTALL)
        assert data is not None
        return {table["name"]: table["columns"] for table in json.loads(data[1])}

    def column(self, table: str, head: str) -> list[Any]:
        return next(column["values"] for column in self.tables[table] if column["head"]["en"] == head)


def made(text: str, **changes: object) -> Made:
    recording = recording_of(text, **changes)
    run = recording.run
    report = build_report(run)
    pictures = inline_pictures(subject_of(recording), silent)
    return Made(report_page(run, report, pictures, recording.pieces), run, report)


def hostile() -> Made:
    return made(HOSTILE, title=HOSTILE_TITLE, provenance="<script>window.hacked=5</script>", kerf=True)


def staircase(blocks: int) -> str:
    """A program of so many lines of 5 to 11 µm, up and to the right."""
    lines = (
        f"B{5 + at % 7}B0B{5 + at % 7}GXL1" if at % 2 else f"B0B{5 + at % 7}B{5 + at % 7}GYL2" for at in range(blocks)
    )
    return "\n".join([*lines, "DD", ""])


class Element(NamedTuple):
    tag: str
    attributes: dict[str, str | None]


class Outline(HTMLParser):
    """Every element of a page."""

    def __init__(self, html: str) -> None:
        super().__init__()
        self.elements: list[Element] = []
        self.feed(html)
        self.close()

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.elements.append(Element(tag, dict(attrs)))

    def of(self, tag: str) -> list[Element]:
        return [element for element in self.elements if element.tag == tag]
