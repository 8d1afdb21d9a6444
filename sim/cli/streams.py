"""Output streams that never fail on a character: what an encoding lacks is written in ASCII."""

import codecs
import sys
from io import TextIOWrapper

_PLAIN = {"µ": "u", "×": "x", "–": "-", "−": "-", "·": "-", "…": "...", "≤": "<=", "≥": ">=", "²": "2"}


def prepare_streams() -> None:
    """Let stdout and stderr spell out what their encoding lacks, such as µ in GBK."""
    codecs.register_error("drycut.plain", _plain)
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, TextIOWrapper):
            stream.reconfigure(errors="drycut.plain")


def _plain(error: UnicodeError) -> tuple[str, int]:
    if not isinstance(error, UnicodeEncodeError):
        raise error
    lost = error.object[error.start : error.end]
    return "".join(_PLAIN.get(char, "?") for char in lost), error.end
