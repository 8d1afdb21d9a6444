"""SARIF 2.1.0 (OASIS Standard, errata 01), which code hosts and editors read; § names its sections.

The log names the tool with a rule for each code, made from its page, and a notification for each check; then the
results: findings with their places, fingerprints and mends.
"""

import json
import os
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import PurePath
from typing import Any
from urllib.parse import quote

from parser import __version__
from parser.findings.catalogue import Language, own_codes, page, term
from parser.findings.codes import CODES, Check
from parser.findings.findings import Edit, Finding
from sim.check.result import CheckResult, fingerprints
from sim.show.findings.totals import (
    clean,
    joined,
    spot,
    tidy,
)
from sim.show.findings.wording import Options, reason, silenced, with_hint
from sim.show.texts import Words

_SCHEMA = "https://docs.oasis-open.org/sarif/sarif/v2.1.0/errata01/os/schemas/sarif-schema-2.1.0.json"

_HIDDEN = "findings-not-shown"
"""Notification that findings are silenced; the others have the names of the checks."""

# Names of the IANA registry, which §3.24.9 wants.
_CHARSETS = {
    **{"utf-8": "UTF-8", "utf-8-sig": "UTF-8", "utf-16-le": "UTF-16", "utf-16-be": "UTF-16"},  # these have a BOM
    **{"gb18030": "GB18030", "big5": "Big5", "latin-1": "ISO-8859-1"},
}


def render(results: Iterable[CheckResult], options: Options) -> Iterator[str]:
    """One log of one run; files and what went wrong in the checks themselves stand behind the results."""
    rules = tuple(sorted(CODES))
    run = _Run(options.language, rules)
    head = {
        "tool": {"driver": _driver(options, rules)},
        "language": options.language,
        "columnKind": "unicodeCodePoints",
    }
    yield f'{{"$schema": {_dump(_SCHEMA)}, "version": "2.1.0", "runs": [{{{_dump(head)[1:-1]}, "results": [\n'
    yield from joined(map(_dump, run.results(results)), ",\n")
    yield f'\n], "artifacts": {_lines(run.artifacts)}, "invocations": [{_dump(run.invocation())}]}}]}}\n'


class _Run:
    """What is gathered while the results go by: their files, and notices of what they leave out.

    `rules` are the codes in their order: a result names its rule by the index too.
    """

    def __init__(self, language: Language, rules: Sequence[str]) -> None:
        self._rule_index = {code: index for index, code in enumerate(rules)}
        self._targets: list[dict[str, Any]] = []
        self._settings: dict[str, dict[str, Any]] = {}
        self._language = language
        self._notices: list[dict[str, Any]] = []
        self._successful = True

    def results(self, results: Iterable[CheckResult]) -> Iterator[dict[str, Any]]:
        """The SARIF results of all files."""
        for index, result in enumerate(results):
            self._targets.append(_artifact(result))
            if result.settings_file:
                self._settings[result.settings_file] = _settings(result.settings_file)
            self._notices += _notices(result, index, self._language)
            self._successful &= not result.unreadable
            yield from _results(result, index, self._language, self._rule_index)

    @property
    def artifacts(self) -> list[dict[str, Any]]:
        """The files, which results know by their index, and behind them the settings files."""
        return [*self._targets, *self._settings.values()]

    def invocation(self) -> dict[str, Any]:
        """The run (§3.20): it succeeded where every file was a program that could be read."""
        return {"executionSuccessful": self._successful, "toolExecutionNotifications": self._notices}


def _notices(result: CheckResult, index: int, language: Language) -> Iterator[dict[str, Any]]:
    """Notifications (§3.58) of the checks that did not come to their end, and of findings that are not shown."""
    where = [{"physicalLocation": {"artifactLocation": _location(result.name, index)}}]
    texts = [
        (check.name, "warning", reason(check, language))
        for check in result.coverage.checks
        if check.state == "incomplete"
    ]
    hidden = silenced(result.silenced, (result.settings_file,), language)
    for name, level, text in [*texts, *([(_HIDDEN, "note", hidden)] if hidden else [])]:
        yield {
            "descriptor": {"id": name},
            "level": level,
            "message": {"text": _plain_message(text)},
            "locations": where,
        }


def _artifact(result: CheckResult) -> dict[str, Any]:
    charset = {"encoding": _CHARSETS[result.encoding]} if result.encoding in _CHARSETS else {}
    bag = {"settingsFile": result.settings_file, "silenced": result.silenced._asdict()}
    properties = {"properties": bag} if result.settings_file or any(result.silenced) else {}
    return {"location": _location(result.name), "roles": ["analysisTarget"], **charset, **properties}


def _settings(name: str) -> dict[str, Any]:
    return {"location": _location(name), "roles": ["userSpecifiedConfiguration"]}


def _driver(options: Options, rules: Sequence[str]) -> dict[str, Any]:
    """The tool component (§3.19)."""
    language = options.language
    notices = {name: term(name, language) for name in _checks()} | {_HIDDEN: Words(language)("findings.total-silenced")}
    return {
        "name": "drycut",
        "version": __version__,
        "semanticVersion": __version__,
        "language": language,
        "rules": [_rule(code, options) for code in rules],
        "notifications": [
            {"id": id_, "shortDescription": {"text": _plain_message(text)}} for id_, text in notices.items()
        ],
    }


def _checks() -> tuple[str, ...]:
    """Names of all checks, those of a shop's own last."""
    own = (CODES[code].check for code in own_codes())
    return tuple(dict.fromkeys(map(str, filter(None, (*Check, *own)))))


def _plain_message(text: str) -> str:
    """A plain text message: braces doubled (§3.11.5), and nothing in it taken for a link (§3.11.6)."""
    return _literal(text).replace("](", "] (")


def _literal(text: str) -> str:
    return text.replace("{", "{{").replace("}", "}}")


def _rule(code: str, options: Options) -> dict[str, Any]:
    of = page(code, options.language)
    address = {"helpUri": options.help_uri.replace("{code}", code)} if options.help_uri else {}
    markdown = f"{of.why.strip()}\n\n{of.mend.strip()}"
    first, *_ = of.why.strip().split("\n\n")
    return {
        "id": code,
        "name": _identifier(code),
        "shortDescription": {"text": _plain_message(of.title)},
        "fullDescription": {"text": _plain_message(" ".join(first.split()))},
        "help": {"text": _plain_message(markdown), "markdown": _literal(markdown)},
        **address,
        "defaultConfiguration": {"level": CODES[code].severity.value},
    }


def _identifier(code: str) -> str:
    """``WrongCountAxis``, the title of a code, the same in every language; of a code of ISO ``IsoOpenContour``."""
    title = page(code).title
    family = "iso " if code.startswith("ISO") else ""
    return "".join(part[:1].upper() + part[1:] for part in re.split(r"[^A-Za-z0-9]+", family + title))


def _results(
    result: CheckResult, index: int, language: Language, rule_index: Mapping[str, int]
) -> Iterator[dict[str, Any]]:
    """The results (§3.27) of one file, which is the artifact of this index."""
    where = _location(result.name, index)
    for finding, known in zip(result.findings, fingerprints(result), strict=True):
        message = _plain_message(with_hint(finding, language))
        entry = {
            "ruleId": finding.code,
            "ruleIndex": rule_index[finding.code],
            "level": finding.severity.value,
            "message": {"text": message},
            "locations": [{"physicalLocation": {"artifactLocation": where, **_region(result, finding)}}],
            "partialFingerprints": {"drycutBlock/v1": known},
        }
        if finding.edits:
            entry["fixes"] = [{"artifactChanges": [{"artifactLocation": where, "replacements": _mend(finding)}]}]
        yield entry


def _location(name: str, index: int | None = None) -> dict[str, Any]:
    """Place of a file (§3.4): relative to the root of the sources, which the reader of the log knows, or absolute."""
    path = PurePath(_encodable(name))
    by_index = {} if index is None else {"index": index}
    if path.is_absolute():
        return {"uri": path.as_uri(), **by_index}
    return {"uri": quote(os.fsencode(path.as_posix()), safe="/"), "uriBaseId": "%SRCROOT%", **by_index}


def _encodable(name: str) -> str:
    # A name in another encoding than the system's keeps its bytes (PEP 383); half a character of Windows has none.
    try:
        os.fsencode(name)
    except UnicodeEncodeError:
        return clean(name)
    return name


def _region(result: CheckResult, finding: Finding) -> dict[str, Any]:
    at = spot(finding, result.excerpts)
    if not at.line:
        return {}
    region: dict[str, Any] = {"startLine": at.line}
    if at.column:
        region |= {"startColumn": at.column, "endLine": at.line, "endColumn": at.end_column}
    excerpt = result.excerpts.get(at.line)
    if excerpt is not None:
        # §3.30.13: the snippet is the region's own text.
        first, past = (at.column - 1, at.end_column - 1) if at.column else (0, len(excerpt))
        region["snippet"] = {"text": excerpt[first:past]}
    return {"region": region}


def _mend(finding: Finding) -> list[dict[str, Any]]:
    return [_replacement(edit) for edit in finding.edits]


def _replacement(edit: Edit) -> dict[str, Any]:
    deleted = {"charOffset": edit.first, "charLength": edit.past - edit.first}
    return {"deletedRegion": deleted, "insertedContent": {"text": edit.text}}


def _lines(values: list[dict[str, Any]]) -> str:
    return "[\n" + ",\n".join(map(_dump, values)) + "\n]" if values else "[]"


def _dump(value: object) -> str:
    # ASCII alone: UTF-8, as §3.1 wants it, whatever the encoding of stdout.
    return json.dumps(tidy(value), allow_nan=False)
