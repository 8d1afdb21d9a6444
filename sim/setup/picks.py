"""What is picked of a drawing: an entity, a part, a window, a layer or a colour, and the words that say so."""

from typing import Any, NamedTuple

from parser.findings.errors import Message, SettingsError
from parser.toolpath import Point
from parser.units import from_mm
from sim.setup.toml.kinds import MOST, ValueKind, in_mm
from sim.setup.toml.reader import PLACE_MM, number

_LAYER, _COLOR = "layer:", "color:"
_COLORS = range(1, 256)  # of the AutoCAD index


class OfEntity(NamedTuple):
    """The contour that an entity is of, by its handle, in letters of either case."""

    handle: str

    def __str__(self) -> str:
        return self.handle


class OfPart(NamedTuple):
    """The part in whose material a place lies, with its holes; or the hole in which it lies."""

    place_um: Point

    def __str__(self) -> str:
        return _in_words(self.place_um)


class OfWindow(NamedTuple):
    """Contours that lie within a rectangle, by its lower left and its upper right corner."""

    low_um: Point
    high_um: Point

    def __str__(self) -> str:
        return f"{_in_words(self.low_um)}..{_in_words(self.high_um)}"


class OfLayer(NamedTuple):
    """Contours with an entity on a layer, in letters of either case."""

    layer: str

    def __str__(self) -> str:
        return f"{_LAYER}{self.layer}"


class OfColor(NamedTuple):
    """Contours with an entity of a colour of the AutoCAD index."""

    color: int

    def __str__(self) -> str:
        return f"{_COLOR}{self.color}"


Pick = OfEntity | OfPart | OfWindow | OfLayer | OfColor


def _in_words(place_um: Point) -> str:
    return f"{in_mm(place_um.x):g},{in_mm(place_um.y):g}"


def pick_of(text: str, where: str | Message) -> Pick:
    """What a text picks: ``2F``, ``12.5,8``, ``0,0..40,30``, ``layer:CUT``, ``color:1``; lengths in mm.

    SettingsError where it picks nothing.
    """
    if text.startswith(_LAYER) and text[len(_LAYER) :]:
        return OfLayer(text[len(_LAYER) :])
    if text.startswith(_COLOR):
        color = text[len(_COLOR) :]
        if color.isascii() and color.isdecimal() and int(color[:4]) in _COLORS:
            return OfColor(int(color))
    elif ".." in text:
        first, _, last = text.partition("..")
        (x, y), (to_x, to_y) = (_place(each, text, where) for each in (first, last))
        return OfWindow(Point(min(x, to_x), min(y, to_y)), Point(max(x, to_x), max(y, to_y)))
    elif "," in text:
        return OfPart(_place(text, text, where))
    elif text and all(each in "0123456789abcdefABCDEF" for each in text):
        return OfEntity(text)
    raise SettingsError("no-pick", where=where, found=text)


def _place(text: str, whole: str, where: str) -> Point:
    x, comma, y = text.partition(",")
    try:
        if comma:
            return Point(*(from_mm(number(float(each), PLACE_MM, where)) for each in (x, y)))
    except ValueError:
        pass
    raise SettingsError("no-pick", where=where, found=whole)


class Picks(ValueKind):
    """A list of what is picked, each as a text."""

    name = "picks"

    def checked(self, table: Any, key: str, where: str) -> tuple[Pick, ...]:
        """What the texts pick. SettingsError where there are too many, or one picks nothing."""
        value = table[key]
        if not isinstance(value, list) or len(value) > MOST:
            raise SettingsError("list-too-long", where=where, key=key, most=MOST)
        return tuple(pick_of(str(each), f"{where}: {key}: entry {at}") for at, each in enumerate(value, start=1))

    def inside(self, value: Any) -> tuple[Pick, ...]:
        """As it is."""
        return tuple(value)

    def written(self, value: Any) -> list[str] | None:
        """Their texts."""
        return [str(pick) for pick in value] or None

    def schema(self) -> dict[str, Any]:
        """Of a list of texts."""
        return {"type": "array", "maxItems": MOST, "items": {"type": "string", "minLength": 1}}
