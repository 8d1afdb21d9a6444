"""Writes the schemas of files that users write, from the rows of keys, and of documents, from models: `make pages`."""

import json
from collections.abc import Iterator
from pathlib import Path

from controller.decode.model import DECODE
from parser.documents import schema_text
from sim.check.settings.read import settings_schema
from sim.make.cam.document_model import PROGRAM
from sim.measure.accept.model import ACCEPT
from sim.measure.fit.model import FIT
from sim.run.ballbar.model import BALLBAR
from sim.run.report.drawing import COMPARE
from sim.run.report.model import REPORT
from sim.run.times.model import TIME
from sim.setup.key_tables import limits_schema, machine_schema, scenario_schema, shop_schema, technology_schema
from sim.show.findings.explained import EXPLAIN
from sim.show.findings.json import CHECK
from sim.show.index_page.model import INDEX
from sim.teach.handins import HAND_IN
from sim.teach.marks_document import MARKS

DOCS = Path(__file__).parents[2] / "docs"
DOCUMENTS = (ACCEPT, BALLBAR, CHECK, COMPARE, DECODE, EXPLAIN, FIT, HAND_IN, INDEX, MARKS, PROGRAM, REPORT, TIME)


def pages() -> Iterator[tuple[Path, str]]:
    """Each file of a schema, and what it is to hold."""
    written = {
        "scenario": scenario_schema(),
        "machine": machine_schema(),
        "settings": settings_schema(),
        "shop": shop_schema(),
        "technology": technology_schema(),
        "limits": limits_schema(),
    }
    for name, schema in written.items():
        yield DOCS / f"{name}.schema.json", json.dumps(schema, indent=2, ensure_ascii=False) + "\n"
    for document in DOCUMENTS:
        name = document.name.removeprefix("drycut.").partition("/")[0]
        yield DOCS / f"{name}.schema.json", schema_text(document)


if __name__ == "__main__":
    for path, text in pages():
        path.write_text(text, "utf-8", newline="\n")
