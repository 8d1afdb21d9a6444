"""JUnit XML: a suite for each file, a case for each check.

It keeps to what both common schemas allow: Windy Road's JUnit.xsd of Ant's format, which wants every element and
attribute written here, and junit-10.xsd of the Jenkins xUnit plugin. Both want a time and the first a time stamp and a
host; a result that is the same for the same program has none, so they are 0, the epoch and ``localhost``.
"""

import re
import xml.etree.ElementTree as ET
from collections.abc import Iterable, Iterator
from typing import NamedTuple

from parser import __version__
from parser.findings.catalogue import Language, term
from parser.findings.codes import CODES
from parser.findings.findings import Finding
from parser.text.places import place
from sim.check.result import CheckResult, CheckState
from sim.show.findings.totals import BLOCKS
from sim.show.findings.wording import Options, reason, silenced, with_hint
from sim.show.terminal.finding import message
from sim.show.texts import Words

# What XML 1.0 can hold, section 2.2, but for DEL and C1, which it asks to avoid; a line needs no other controls.
_NO_XML = re.compile("[^\t\n\u0020-\u007e\u00a0-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")
# An error needs a type, and a case that was left out must have none.
_TYPES = {"error": {"type": "incomplete"}, "skipped": {}}
_EPOCH = "1970-01-01T00:00:00"


class _Case(NamedTuple):
    """A check of a file, the findings of it that fail, and whether its not coming to its end does."""

    check: CheckState
    failures: tuple[Finding, ...]
    is_to_end: bool

    @property
    def outcome(self) -> str:
        if self.failures:
            return "failure"
        gap = "error" if self.is_to_end else "skipped"
        return {"complete": "", "incomplete": gap, "known": "skipped", "not asked": "skipped"}[self.check.state]


def render(results: Iterable[CheckResult], options: Options) -> Iterator[str]:
    """One document, in ASCII: other characters are references, whatever the encoding of stdout."""
    yield '<?xml version="1.0" encoding="UTF-8"?>\n<testsuites>\n'
    for index, result in enumerate(results):
        suite = _suite(index, result, options.language)
        ET.indent(suite)
        yield ET.tostring(suite, encoding="us-ascii").decode("ascii") + "\n"
    yield "</testsuites>\n"


def _suite(index: int, result: CheckResult, language: Language) -> ET.Element:
    cases = _cases(result)
    outcomes = [case.outcome for case in cases]
    suite = ET.Element(
        "testsuite",
        package="drycut",
        id=str(index),
        name=_text(result.name),
        timestamp=_EPOCH,
        hostname="localhost",
        tests=str(len(cases)),
        failures=str(outcomes.count("failure")),
        errors=str(outcomes.count("error")),
        skipped=str(outcomes.count("skipped")),
        time="0",
    )
    _add_properties(suite, result)
    for case in cases:
        _add_case(suite, case, result, language)
    ET.SubElement(suite, "system-out").text = _text(_passed_over(result, language))
    ET.SubElement(suite, "system-err")
    return suite


def _cases(result: CheckResult) -> list[_Case]:
    failures: dict[str, list[Finding]] = {check.name: [] for check in result.coverage.checks}
    for finding in result.findings:
        if result.fails(finding.severity):
            failures.setdefault(CODES[finding.code].check or finding.code, []).append(finding)
    states = {check.name: check for check in result.coverage.checks}
    return [
        _Case(states.get(name, CheckState(name)), tuple(found), result.fail_on != "error")
        for name, found in failures.items()
    ]


def _add_properties(suite: ET.Element, result: CheckResult) -> None:
    listed = {
        "drycut": __version__,
        "verdict": result.verdict,
        "encoding": result.encoding,
        "dialect": result.dialect,
        "settings": result.settings_file,
        **{f"silenced.{by}": n for by, n in result.silenced._asdict().items()},
        **{f"blocks.{name}": getattr(result.coverage, name) for name in BLOCKS},
        "steps": result.steps,
        "length_um": round(result.length_um, 6),
    }
    properties = ET.SubElement(suite, "properties")
    for name, value in listed.items():
        ET.SubElement(properties, "property", name=name, value=_text(str(value)))


def _add_case(suite: ET.Element, case: _Case, result: CheckResult, language: Language) -> None:
    name = term(case.check.name, language)
    parent = ET.SubElement(suite, "testcase", classname=_text(result.name), name=_text(name), time="0")
    if case.outcome == "failure":
        codes = " ".join(sorted({finding.code for finding in case.failures}))
        headline = _text(message(case.failures[0], language))
        failure = ET.SubElement(parent, "failure", type=codes, message=headline)
        failure.text = _text(_body(case, result, language))
    elif case.outcome:
        why = _text(reason(case.check, language))
        ET.SubElement(parent, case.outcome, _TYPES[case.outcome], message=why)


def _body(case: _Case, result: CheckResult, language: Language) -> str:
    lines = [_line(finding, result, language) for finding in case.failures]
    # A case has one outcome; that of a failed check which is also not complete is told in its text.
    if case.check.reason:
        lines.append(reason(case.check, language))
    return "\n".join(lines)


def _passed_over(result: CheckResult, language: Language) -> str:
    mild = [_line(finding, result, language) for finding in result.findings if not result.fails(finding.severity)]
    hidden = silenced(result.silenced, (result.settings_file,), language)
    return "\n".join([*mild, *([hidden] if hidden else [])])


def _line(finding: Finding, result: CheckResult, language: Language) -> str:
    where = place(result.name, finding.line, finding.column)
    severity = Words(language)(f"findings.{finding.severity}")
    return f"{where}: {severity}[{finding.code}]: {with_hint(finding, language)}"


def _text(text: str) -> str:
    return _NO_XML.sub("\ufffd", text)
