"""Tables of the page: columns of values as the report has them, which the page shows, sorts and turns over.

Tables of what a cut leaves: pieces, their sizes, and the worst places beside the drawing.
"""

from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Annotated, Any, Final, Literal, NamedTuple, TypedDict

from parser.documents import SaidEntry
from parser.findings.catalogue import Bilingual
from parser.text.source import BlockNames
from parser.units import UM_PER_MM
from sim.run.report.cut_model import BoxEntry, DistanceEntry, PieceEntry, RadiusEntry, ShiftEntry, SizesEntry
from sim.run.report.drawing import CornerEntry, PlaceEntry
from sim.show.html.packed import PackedEntry, packed
from sim.show.texts import bilingual

_LONG_S: Final = 600.0

Kind = Literal["number", "text", "code", "word", "codes"]
Cell = float | str | list[tuple[str, str]] | None
"""A value of a column; of ``codes`` pairs of a code and its address in the page."""


class ColumnEntry(TypedDict):
    """One column of a table, as `Column` says; a long one has its values packed."""

    head: SaidEntry
    values: Annotated[Sequence[Cell] | PackedEntry, "one a row; null shows as a dash"]
    kind: Kind
    unit: str
    per: Annotated[float, "a number shows divided by it"]
    digits: int
    words: Annotated[dict[str, SaidEntry], "what the keys of a column of words say"]


class TableDataEntry(TypedDict):
    """A table: its name in the page, and what stands in it."""

    name: str
    columns: list[ColumnEntry]


class Column(NamedTuple):
    """One column of a table.

    Attributes
    ----------
    head
        Its name; `unit` stands beside it.
    values
        One a row, as the report has them; None shows as a dash. Of ``codes`` lists of (code, address in the page).
    kind
        ``number``; ``text`` as people write it; ``code`` as a program has it; ``word``, a key of `words`; ``codes``.
    per, digits
        A number shows divided by `per`, with so many digits.
    words
        What the keys of a column of words say.
    """

    head: Bilingual
    values: Sequence[Any]
    kind: Kind = "number"
    unit: str = ""
    per: float = 1.0
    digits: int = 0
    words: Mapping[str, Bilingual] = {}


class ReportTable(NamedTuple):
    """A table: its name in the page, and what stands in it."""

    name: str
    columns: tuple[Column, ...]

    @property
    def title(self) -> Bilingual:
        """Its heading."""
        return bilingual(f"report.table-{self.name}")

    @property
    def rows(self) -> int:
        """How many rows it has."""
        return len(self.columns[0].values)

    def data(self) -> "TableDataEntry":
        """The table for the page's script; long columns are packed."""
        return {"name": self.name, "columns": [_data(column) for column in self.columns]}


def counted(head: str, values: Sequence[Any]) -> Column:
    """Whole numbers."""
    return Column(bilingual(f"report.{head}"), values)


def called(head: str, values: Iterable[int | None], name: Callable[[int], str]) -> Column:
    """Blocks by what `name` calls them; where they have numbers alone, as whole numbers."""
    names = [None if value is None else name(value) for value in values]
    if all(each_name is None or each_name.isdecimal() for each_name in names):
        return counted(head, [each_name and int(each_name) for each_name in names])
    return named(head, names)


def micrometres(head: str, values: Sequence[Any], digits: int = 2) -> Column:
    """Lengths in µm, shown in mm to the µm where any is as long as one."""
    if max((abs(value) for value in values if value is not None), default=0.0) >= UM_PER_MM:
        return millimetres(head, values)
    return Column(bilingual(f"report.{head}"), values, unit="µm", digits=digits)


def millimetres(head: str, values: Sequence[Any]) -> Column:
    """Lengths in µm, shown in mm to the µm."""
    return Column(bilingual(f"report.{head}"), values, unit="mm", per=1000.0, digits=3)


def timed(head: str, values: Sequence[Any]) -> Column:
    """Times in s, shown in min where any is as long as ten of them."""
    long = max((value for value in values if value is not None), default=0.0) >= _LONG_S
    unit, per = ("min", 60.0) if long else ("s", 1.0)
    return Column(bilingual(f"report.{head}"), values, unit=unit, per=per, digits=2)


def worded(head: str, values: Sequence[str], prefix: str = "is") -> Column:
    """Words of the page, by their keys without the prefix."""
    words = {key: bilingual(f"report.{prefix}-{key}") for key in dict.fromkeys(values)}
    return Column(bilingual(f"report.{head}"), values, "word", words=words)


def yes_or_no(head: str, values: Iterable[bool]) -> Column:
    """Whether something is so."""
    answers = ["yes" if value else "no" for value in values]
    return Column(
        bilingual(f"report.{head}"), answers, "word", words={key: bilingual(f"report.{key}") for key in ("yes", "no")}
    )


def named(head: str, values: Sequence[str | None]) -> Column:
    """Texts as people write them."""
    return Column(bilingual(f"report.{head}"), values, "text")


def column_of(entries: Iterable[Mapping[str, Any]], path: str) -> list[Any]:
    """What entries have under keys joined with dots; None where there is nothing on the way."""
    keys = path.split(".")
    return [_under(keys, entry) for entry in entries]


def reached(entry: Any, path: str) -> Any:
    """What lies under keys and list indices joined with dots; None where there is nothing on the way."""
    return _under(path.split("."), entry)


def _under(keys: Iterable[str], entry: Any) -> Any:
    for key in keys:
        if entry is None:
            return None
        entry = entry[int(key)] if isinstance(entry, list) else entry[key]
    return entry


def _data(column: Column) -> ColumnEntry:
    return {
        "head": column.head.entry(),
        "values": packed(column.values),
        "kind": column.kind,
        "unit": column.unit,
        "per": column.per,
        "digits": column.digits,
        "words": {key: text.entry() for key, text in column.words.items()},
    }


def piece_table(entries: list[PieceEntry], names: BlockNames) -> ReportTable:
    """Pieces in the order in which they come free."""
    return ReportTable(
        "pieces",
        (
            counted("number", list(range(1, len(entries) + 1))),
            worded("kind", column_of(entries, "kind")),
            Column(bilingual("report.area"), column_of(entries, "area_mm2"), unit="mm²", digits=3),
            Column(bilingual("report.mass"), column_of(entries, "mass_g"), unit="g", digits=3),
            called("freed-block", column_of(entries, "freed.block"), names.at),
            timed("freed-after", column_of(entries, "freed.t_s")),
            called("held-after", column_of(entries, "held_after_block"), names.at),
            micrometres("cut-after", column_of(entries, "cut_after_um")),
            micrometres("can-shift", [_farthest(entry["play"]["shifts"]) for entry in entries], digits=0),
            yes_or_no("early", column_of(entries, "early")),
        ),
    )


def _farthest(shifts: list[ShiftEntry]) -> float | None:
    """How far a piece shifts in the direction in which it can shift farthest; None where nothing is in the way."""
    ways = [shift["by_um"] for shift in shifts if shift["by_um"] is not None]
    return None if len(ways) < len(shifts) else max(ways)


def size_tables(sizes: SizesEntry, names: BlockNames) -> list[ReportTable]:
    """Widths, radii and distances of what is kept, as cut and nominal."""
    boxes, radii, distances = sizes["boxes"], sizes["radii"], sizes["distances"]
    return [
        ReportTable(
            "boxes",
            (*_of_what(boxes), counted("piece", column_of(boxes, "piece")), *_widths(boxes), _within(boxes, ".0")),
        ),
        ReportTable(
            "radii",
            (
                *_of_what(radii),
                called("block", column_of(radii, "block"), names.at),
                millimetres("as-cut", column_of(radii, "cut_um")),
                millimetres("nominal", column_of(radii, "nominal_um")),
                _apart(radii),
                _within(radii),
                micrometres("form", column_of(radii, "form_um")),
            ),
        ),
        ReportTable(
            "distances",
            (
                *_of_what(distances),
                called("block", column_of(distances, "blocks.0"), names.at),
                called("other-block", column_of(distances, "blocks.1"), names.at),
                millimetres("as-cut", column_of(distances, "cut_um")),
                millimetres("nominal", column_of(distances, "nominal_um")),
                _apart(distances),
                _within(distances),
            ),
        ),
    ]


def worst_table(entries: list[PlaceEntry], names: BlockNames) -> ReportTable:
    """Where edge and drawing are farthest apart."""
    return ReportTable(
        "worst",
        (
            worded("measured-from", column_of(entries, "from")),
            micrometres("distance", column_of(entries, "max_um"), digits=3),
            millimetres("at-x", column_of(entries, "where_um.0")),
            millimetres("at-y", column_of(entries, "where_um.1")),
            called("block", column_of(entries, "block"), names),
            counted("entity", column_of(entries, "entity")),
        ),
    )


def corner_table(entries: list[CornerEntry], names: BlockNames) -> ReportTable:
    """Sharp inside corners of the drawing that the wire cannot reach, and what it must leave in them."""
    return ReportTable(
        "corners",
        (
            micrometres("left-at-least", column_of(entries, "depth_um"), digits=3),
            Column(bilingual("report.angle"), column_of(entries, "angle_deg"), unit="°", digits=1),
            millimetres("at-x", column_of(entries, "where_um.0")),
            millimetres("at-y", column_of(entries, "where_um.1")),
            called("block", column_of(entries, "block"), names),
            counted("entity", column_of(entries, "entity")),
        ),
    )


def _of_what(entries: Sequence[BoxEntry | RadiusEntry | DistanceEntry]) -> tuple[Column, ...]:
    return (worded("what", column_of(entries, "what")),)


def _widths(boxes: list[BoxEntry]) -> list[Column]:
    """As cut and nominal, along X and along Y."""
    return [
        millimetres(f"{head}-{axis}", column_of(boxes, f"{key}.{at}"))
        for at, axis in enumerate("xy")
        for head, key in (("as-cut", "cut_um"), ("nominal", "nominal_um"))
    ]


def _within(entries: Sequence[BoxEntry | RadiusEntry | DistanceEntry], axis: str = "") -> Column:
    """How far sizes as cut may be off, to the farther side."""
    least, cut, most = (column_of(entries, f"{key}_um{axis}") for key in ("least", "cut", "most"))
    return micrometres("within", [max(high - at, at - low) for low, at, high in zip(least, cut, most, strict=True)])


def _apart(entries: Sequence[RadiusEntry | DistanceEntry]) -> Column:
    """As cut less nominal."""
    return micrometres("apart", [entry["cut_um"] - entry["nominal_um"] for entry in entries])
