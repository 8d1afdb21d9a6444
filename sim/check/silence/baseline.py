"""Baselines: what is known of files, findings and checks that do not end, in a file, so that only what is new fails."""

import json
import os
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from pathlib import Path

from parser.files import read_text
from parser.findings.codes import CODES
from parser.findings.errors import SettingsError
from sim.check.own_checks import load_own_checks
from sim.check.result import CheckResult, fingerprints, gap_marks

SCHEMA = "drycut.baseline/2"
_READ = ("drycut.baseline/1", SCHEMA)
"""Schemas that are read; the first has findings alone."""
_CHECK = "check-"
"""Begins the name of a check."""
_Known = Mapping[str, str]
"""Codes of findings, and names of checks that did not come to their end, by fingerprints."""


@dataclass(frozen=True, slots=True)
class Baseline:
    """What is known of files.

    Attributes
    ----------
    path
        Its own file. Files of programs are named in it from its folder, so that both can move together.
    known
        Codes and names of checks by fingerprints, by the names of files.
    """

    path: Path
    known: Mapping[str, _Known] = field(default_factory=dict)

    def of(self, file: Path) -> _Known:
        """What is known of a file, whose path has no link in it but for its last part."""
        return self.known.get(self.key(file), {})

    def key(self, file: Path) -> str:
        """Name of a file in the baseline: from its folder, with slashes; the whole path on another drive."""
        try:
            return Path(os.path.relpath(file, self.path.parent)).as_posix()
        except ValueError:
            return file.as_posix()


def known_of(result: CheckResult) -> _Known:
    """Findings and checks without an end of a result, as a baseline has them; none of a file that is no program."""
    if result.unreadable or result.fault:
        return {}
    codes = (finding.code for finding in result.findings)
    gaps = [check for check in result.coverage.checks if check.state == "incomplete"]
    return {
        **dict(zip(fingerprints(result), codes, strict=True)),
        **{mark: check.name for check in gaps for mark in gap_marks(check)},
    }


def baseline_text(known: Mapping[str, _Known]) -> str:
    """A baseline as its file holds it: ASCII, sorted, one finding or check a line; the same give the same text."""
    files = {name: dict(sorted(of.items())) for name, of in sorted(known.items()) if of}
    return json.dumps({"schema": SCHEMA, "files": files}, indent=1) + "\n"


def read_baseline(path: Path) -> Baseline:
    """Baseline of a file, whose path has no link in it.

    Raises FileUnreadableError where it cannot be read, SettingsError where it is no baseline.
    """
    load_own_checks()  # it may hold codes of theirs
    try:
        content = json.loads(read_text(path))
    except (ValueError, RecursionError) as error:  # no JSON, no UTF-8, or nested without end
        raise SettingsError("baseline-damaged", path=path, why=str(error)) from None
    if not isinstance(content, dict) or not isinstance(content.get("files"), dict):
        raise SettingsError("no-baseline", path=path)
    if content.get("schema") not in _READ:
        raise SettingsError("baseline-of-another-schema", path=path, found=content.get("schema"), schema=SCHEMA)
    for name, known in content["files"].items():
        if not isinstance(known, dict) or not _are_codes(known.values()):
            raise SettingsError("baseline-without-codes", path=path, name=name)
    return Baseline(path, content["files"])


def _are_codes(values: Iterable[object]) -> bool:
    return all(isinstance(code, str) and (code in CODES or code.startswith(_CHECK)) for code in values)
