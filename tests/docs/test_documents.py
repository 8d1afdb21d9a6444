"""Documents that drycut writes: every key of their models is described, and scripts have the types of today."""

import re

import pytest
from places import ROOT
from schema_pages import DOCUMENTS
from script_types import pages

from parser.documents import Document, document_schema
from sim.run.report.drawing import COMPARE
from sim.run.report.model import REPORT


@pytest.mark.parametrize("document", DOCUMENTS, ids=lambda document: document.name)
def test_every_key_is_described(document: Document) -> None:
    schema = document_schema(document)
    page = (ROOT / document.page).read_text("utf-8")
    if document is REPORT:
        page += (ROOT / COMPARE.page).read_text("utf-8")  # of its ``drawing``
    spans = set(re.findall(r"\w+", " ".join(re.findall(r"`([^`\n]+)`", page))))
    keys = {key for of in (schema, *schema["$defs"].values()) for key in of["properties"]}

    assert keys - spans == set()


def test_scripts_have_the_types_of_the_models() -> None:
    for path, text in pages():
        assert path.read_text("utf-8") == text, "renew them: make pages"
