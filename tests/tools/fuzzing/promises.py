"""Promises of all that is printed: no control characters, and documents that their own readers read."""

import json
import re
from collections.abc import Iterator
from xml.etree import ElementTree as ET

# C0 but for tab and newline, DEL and C1; lone surrogates; marks that turn the direction of text (Unicode, UAX #9).
_UNCLEAN = re.compile(
    r"[\x00-\x08\x0b-\x1f\x7f-\x9f\ud800-\udfff\u061c\u200e\u200f\u2028\u2029\u202a-\u202e\u2066-\u2069]"
)


def unclean(text: str) -> Iterator[str]:
    """What a text for people holds that a terminal would obey."""
    for found in sorted({f"U+{ord(char):04X}" for char in _UNCLEAN.findall(text)}):
        yield f"prints {found}"


def of_document(name: str, text: str) -> Iterator[str]:
    """What is wrong with the form of an output in a format."""
    try:
        if name in ("json", "sarif", "gitlab"):
            json.loads(text, parse_constant=_no_json)
        elif name == "junit":
            ET.fromstring(text)  # noqa: S314 - our own
        elif not text:
            yield "is empty"
    except (ValueError, ET.ParseError) as error:
        yield f"is not well-formed: {error}"


def _no_json(constant: str) -> None:
    raise ValueError(f"{constant} is no JSON")
