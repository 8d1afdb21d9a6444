"""Results of checks made by hand, kind ones and hostile ones, for the tests of the formats."""

import xml.etree.ElementTree as ET

from parser.findings.findings import Edit, Finding
from parser.text.encoding import no_program
from sim.check.result import CheckResult, CheckState, Coverage, Silenced

SILENCED = Silenced(options=1, settings=2, remarks=3, baseline=4)
COUNTED = "B0B9900B39600GXNR4"
AXIS = Finding(
    "3B204",
    {"axis": "X", "ruled": "Y", "cost": 140.7, "right": 0.4, "count": 39600},
    span=(22, 24),
    line=2,
    column=15,
    block=2,
    edits=(Edit(22, 24, "GY"),),
)
NO_END = Finding("3B102")
STILL = Finding("3B205", {}, span=(0, 7), line=1, block=1)
CHECKS = (
    CheckState("check-grammar"),
    CheckState("check-blocks"),
    CheckState("check-steps"),
    CheckState("check-crossings", "incomplete", "reason-many"),
    CheckState("check-travel", "not asked", "reason-no-machine"),
)
# Everything that a format may take for its own: controls, ends of sections, commands, braces, links, half characters.
HOSTILE = (
    "\x1b[31m]]>\x00 \n::error::x\r\n##[error]%0A,: <a b='c' d=\"e\">&amp; {0} {evil} [go](http://x) "
    "\ud800\ufffd\u2028 加工 \ufdd0\U0001f600"
)


def parsed(document: str) -> ET.Element:
    return ET.fromstring(document)  # noqa: S314 - written by the code under test


def unknown(text: str, line: int = 3) -> Finding:
    return Finding("3B101", {"text": text}, span=(5, 5 + len(text)), line=line, column=3)


def result(name: str, *findings: Finding, **changes: object) -> CheckResult:
    values: dict[str, object] = {
        "encoding": "utf-8",
        "dialect": "3B",
        "excerpts": {1: "B B B GX L1", 2: COUNTED, 3: "; 穿丝 B9"},
        "coverage": Coverage(7, 6, 6, 5, CHECKS[:3]),
        "length_um": 62204.1234567,
        "steps": 39600,
    }
    return CheckResult(name=name, findings=findings, **(values | changes))  # type: ignore[arg-type]


def kind() -> list[CheckResult]:
    return [
        result("good.3b"),
        result("dir/part 1.3b", STILL, AXIS, NO_END, coverage=Coverage(7, 6, 6, 5, CHECKS), encoding="gb18030"),
        result("halt.3b", coverage=Coverage(7, 7, 7, 7, CHECKS)),
    ]


def quieted() -> list[CheckResult]:
    """Results of which something silenced findings, or of which settings alone counted."""
    return [
        result("quiet.3b", settings_file="shop/drycut.toml", silenced=SILENCED),
        result("told.3b", AXIS, settings_file="shop/drycut.toml"),
        result("baseline.3b", silenced=Silenced(baseline=1)),
    ]


def hostile() -> list[CheckResult]:
    nothing = Coverage(0, 0, 0, 0, (CheckState("check-grammar", "incomplete", "reason-unreadable"),))
    no_file = no_program("unreadable-file", HOSTILE)
    return [
        result(HOSTILE.replace("\0", ""), unknown(HOSTILE), unknown(HOSTILE), excerpts={3: "  " + HOSTILE}),
        result("<stdin>", unknown("x", line=9), unknown("", line=3)),
        result("::error::a,b:c%.3b", no_file, encoding="", dialect="", coverage=nothing, excerpts={}, unreadable=True),
        result("/srv/零件.3b", unknown("字" * 300), excerpts={3: "  " + "字" * 300}, length_um=float("inf")),
        result("quiet.3b", settings_file=HOSTILE.replace("\0", ""), silenced=SILENCED),
    ]
