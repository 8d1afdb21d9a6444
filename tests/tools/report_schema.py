"""The schema of reports, read and looked at once for all tests of a process."""

import json
from functools import cache

from jsonschema import Draft202012Validator
from places import ROOT


@cache
def validator() -> Draft202012Validator:
    schema = json.loads((ROOT / "docs" / "report.schema.json").read_text("utf-8"))
    Draft202012Validator.check_schema(schema)
    return Draft202012Validator(schema)


def complaints(report: object) -> list[str]:
    """What the schema has against a report, with its places."""
    return [f"{error.json_path}: {error.message}" for error in validator().iter_errors(report)]
