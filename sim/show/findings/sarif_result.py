"""Results of a SARIF log: a finding with its place, its fingerprint and what mends it."""

import hashlib
import os
from collections import Counter
from collections.abc import Iterator
from pathlib import PurePath
from typing import Any
from urllib.parse import quote

from parser.findings.catalogue import Language
from parser.findings.findings import Edit, Finding
from sim.check.result import CheckResult
from sim.show.findings.sarif_rules import RULES, said
from sim.show.findings.tidy import clean, spot
from sim.show.findings.wording import with_hint

_RULE_INDEX = {code: index for index, code in enumerate(RULES)}


def results_of(result: CheckResult, index: int, language: Language) -> Iterator[dict[str, Any]]:
    """The results (§3.27) of one file, which is the artifact of this index."""
    seen: Counter[str] = Counter()
    where = artifact_location(result.name, index)
    for finding in result.findings:
        message = said(with_hint(finding, language))
        entry = {
            "ruleId": finding.code,
            "ruleIndex": _RULE_INDEX[finding.code],
            "level": finding.severity.value,
            "message": {"text": message},
            "locations": [{"physicalLocation": {"artifactLocation": where, **_region(result, finding)}}],
            "partialFingerprints": {"drycutLine/v1": _fingerprint(result, finding, seen)},
        }
        if finding.edits:
            entry["fixes"] = [{"artifactChanges": [{"artifactLocation": where, "replacements": _mend(finding)}]}]
        yield entry


def artifact_location(name: str, index: int | None = None) -> dict[str, Any]:
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


def _fingerprint(result: CheckResult, finding: Finding, seen: Counter[str]) -> str:
    """Digest of the code and the line's text, and which of several alike: it stays when lines are put in above."""
    line = " ".join(result.excerpts.get(finding.line, "").split())
    key = f"{finding.code}\n{line}"
    seen[key] += 1
    return hashlib.sha256(f"{key}\n{seen[key]}".encode(errors="replace")).hexdigest()[:32]
