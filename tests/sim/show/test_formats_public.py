"""The formats against the public schemas, where a folder holds them: tests/schemas/README.md."""

import json
import os
from dataclasses import replace
from pathlib import Path

import pytest
import xmlschema
from check_results import hostile, kind, parsed, quieted
from jsonschema import Draft4Validator

from parser.findings.catalogue import LANGUAGES, Language
from sim.check.settings.read import FAIL_ON
from sim.show.findings import render
from sim.show.findings.wording import Options

FOLDER = os.environ.get("DRYCUT_PUBLIC_SCHEMAS")
pytestmark = [
    pytest.mark.skipif(FOLDER is None, reason="DRYCUT_PUBLIC_SCHEMAS names no folder of public schemas"),
    pytest.mark.parametrize("language", LANGUAGES),
]


def public(name: str) -> Path:
    return Path(FOLDER or "") / name


def test_sarif(language: Language) -> None:
    validator = Draft4Validator(json.loads(public("sarif-schema-2.1.0.json").read_text(encoding="utf-8")))
    for results in (kind(), hostile(), quieted(), []):
        log = json.loads("".join(render("sarif", results, Options(language))))
        assert [error.message for error in validator.iter_errors(log)] == []


def test_gitlab(language: Language) -> None:
    validator = Draft4Validator(json.loads(public("codeclimate.json").read_text(encoding="utf-8")))
    for results in (kind(), hostile(), quieted(), []):
        issues = json.loads("".join(render("gitlab", results, Options(language))))
        assert [error.message for issue in issues for error in validator.iter_errors(issue)] == []


@pytest.mark.parametrize("name", ["JUnit.xsd", "junit-10.xsd"])
def test_junit(language: Language, name: str) -> None:
    schema = xmlschema.XMLSchema(public(name))
    for fail_on in FAIL_ON:
        for results in (kind(), hostile(), quieted(), []):
            strict = [replace(one, fail_on=fail_on) for one in results]
            schema.validate(parsed("".join(render("junit", strict, Options(language)))))
