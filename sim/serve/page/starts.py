"""What a page that holds nothing offers to begin with: a sound program, one with a fault, and a drawing."""

from pathlib import Path
from typing import Final, NamedTuple

from parser.files import read_bytes
from sim.jobs.examples import example

_SOUND: Final = "keyhole"
_DRAWN: Final = "plate"


class Start(NamedTuple):
    """A file to begin with: its name, and its bytes."""

    name: str
    data: bytes


def start(name: str) -> Start:
    """What to begin with: ``sound``, ``broken`` or ``drawing``. KeyError for another name."""
    return _STARTS[name]()


def _sound() -> Start:
    program = example(_SOUND).program
    return Start(f"{_SOUND}{program.suffix}", read_bytes(program))


def _broken() -> Start:
    """The same program with one letter wrong, which is certainly mended."""
    file = Path(__file__).with_name("broken").with_suffix(example(_SOUND).program.suffix)
    return Start(file.name, read_bytes(file))


def _drawing() -> Start:
    drawing = example(_DRAWN).drawing
    assert drawing is not None  # noqa: S101 - the example has one
    return Start(f"{_DRAWN}.dxf", read_bytes(drawing.file))


_STARTS: Final = {"sound": _sound, "broken": _broken, "drawing": _drawing}
STARTS: Final = tuple(_STARTS)
"""Their names, in the order in which they are offered."""
