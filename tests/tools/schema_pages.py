"""Writes the schemas of files that users write, from the rows of keys: `make pages`."""

import json
from collections.abc import Iterator
from pathlib import Path

from sim.check.settings.schema import settings_schema
from sim.setup.file_schemas import machine_schema, scenario_schema

DOCS = Path(__file__).parents[2] / "docs"


def pages() -> Iterator[tuple[Path, str]]:
    """Each file of a schema, and what it is to hold."""
    made = {"scenario": scenario_schema(), "machine": machine_schema(), "settings": settings_schema()}
    for name, schema in made.items():
        yield DOCS / f"{name}.schema.json", json.dumps(schema, indent=2, ensure_ascii=False) + "\n"


if __name__ == "__main__":
    for path, text in pages():
        path.write_text(text, "utf-8", newline="\n")
