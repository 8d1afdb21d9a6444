"""A made program as data, schema ``drycut.program/1`` (docs/program.md)."""

import json
from typing import Any, Final

from parser import __version__
from sim.cam.maker import Made, NotMade

SCHEMA: Final = "drycut.program/1"


def document(made: Made | NotMade) -> dict[str, Any]:
    """What was made, or why nothing was, as plain lists, dicts, numbers and None; the order of keys is fixed."""
    return {"schema": SCHEMA, "drycut": __version__, "made": isinstance(made, Made)}


def document_text(made: Made | NotMade) -> str:
    """The document as JSON; the same drawing gives the same bytes."""
    return json.dumps(document(made), ensure_ascii=False, allow_nan=False, indent=2) + "\n"
