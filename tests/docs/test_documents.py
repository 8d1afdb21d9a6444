"""Documents that drycut writes: every key of their models stands in the page that describes them."""

import re

import pytest
from places import ROOT
from schema_pages import DOCUMENTS

from parser.documents.schema import Document, document_schema

PAGES = {"decode": ("iso.md",), "index": ("batch.md",), "report": ("report.md", "compare.md")}


def page_of(name: str) -> str:
    return "\n".join((ROOT / "docs" / page).read_text("utf-8") for page in PAGES.get(name, (f"{name}.md",)))


@pytest.mark.parametrize("document", DOCUMENTS, ids=lambda document: document.name)
def test_every_key_is_described(document: Document) -> None:
    schema = document_schema(document)
    page = page_of(document.name.removeprefix("drycut.").partition("/")[0])
    spans = set(re.findall(r"\w+", " ".join(re.findall(r"`([^`\n]+)`", page))))
    keys = {key for of in (schema, *schema["$defs"].values()) for key in of["properties"]}

    assert keys - spans == set()
