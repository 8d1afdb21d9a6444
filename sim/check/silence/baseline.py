"""Baselines: findings that are known, in a file, so that only new ones fail."""

import json
import os
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from pathlib import Path

from parser.files.reading import read_text
from parser.findings.codes import CODES
from parser.findings.errors import SettingsError
from sim.check.result import CheckResult, fingerprints

SCHEMA = "drycut.baseline/1"
_Known = Mapping[str, str]
"""Codes of findings by their fingerprints."""


@dataclass(frozen=True, slots=True)
class Baseline:
    """Known findings of files.

    Attributes
    ----------
    path
        Its own file. Files of programs are named in it from its folder, so that both can move together.
    known
        Codes by fingerprints, by the names of files.
    """

    path: Path
    known: Mapping[str, _Known] = field(default_factory=dict)

    def of(self, file: Path) -> _Known:
        """Known findings of a file, whose path has no link in it but for its last part."""
        return self.known.get(self.key(file), {})

    def key(self, file: Path) -> str:
        """Name of a file in the baseline: from its folder, with slashes; the whole path on another drive."""
        try:
            return Path(os.path.relpath(file, self.path.parent)).as_posix()
        except ValueError:
            return file.as_posix()


def findings_of(result: CheckResult) -> _Known:
    """The findings of a result as a baseline has them; none of a file that is no program."""
    if result.unreadable:
        return {}
    codes = (finding.code for finding in result.findings)
    return dict(zip(fingerprints(result), codes, strict=True))


def baseline_text(known: Mapping[str, _Known]) -> str:
    """A baseline as its file holds it: ASCII, sorted, one finding a line; the same findings give the same text."""
    files = {name: dict(sorted(of.items())) for name, of in sorted(known.items()) if of}
    return json.dumps({"schema": SCHEMA, "files": files}, indent=1) + "\n"


def read_baseline(path: Path) -> Baseline:
    """Baseline of a file, whose path has no link in it.

    Raises FileUnreadableError where it cannot be read, SettingsError where it is no baseline.
    """
    try:
        content = json.loads(read_text(path))
    except (ValueError, RecursionError) as error:  # no JSON, no UTF-8, or nested without end
        raise SettingsError("baseline-damaged", path=path, why=str(error)) from None
    if not isinstance(content, dict) or not isinstance(content.get("files"), dict):
        raise SettingsError("no-baseline", path=path)
    if content.get("schema") != SCHEMA:
        raise SettingsError("baseline-of-another-schema", path=path, found=content.get("schema"), schema=SCHEMA)
    for name, known in content["files"].items():
        if not isinstance(known, dict) or not _are_codes(known.values()):
            raise SettingsError("baseline-without-codes", path=path, name=name)
    return Baseline(path, content["files"])


def _are_codes(values: Iterable[object]) -> bool:
    return all(isinstance(code, str) and code in CODES for code in values)
