"""Options of ``drycut program``: what is asked of the maker of a program, in place of a scenario's own values."""

from collections.abc import Callable, Mapping
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final, NamedTuple, TypeVar

import click

from parser.findings.errors import Message
from sim.cli.options import WRITTEN_IN, Length, length_options, taken_lengths
from sim.cli.spoken.values import WholeNumber, offer_machines
from sim.setup.making import CORNERS, DIRECTION_WISHES, ENCODINGS, FORMS, LEAD_INS, SIDE_WISHES
from sim.setup.part import THICKNESS
from sim.setup.wire import DIAMETER, SPARK_GAP

if TYPE_CHECKING:
    from parser.toolpath import Point
    from sim.setup.making import LayerWish, Making, Writing

Command = TypeVar("Command", bound=Callable[..., Any])


class Place(click.ParamType):  # type: ignore[type-arg]  # generic in newer clicks alone
    """``X,Y`` of the drawing: numbers in mm, or lengths with their units."""

    name = "X,Y"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> "Point":
        """The place in µm. SettingsError for lengths without end, bad use for what is no pair."""
        from parser.toolpath import Point
        from parser.units import mm
        from sim.setup.toml.reader import PLACE_MM, number

        if isinstance(value, Point):
            return value
        parts = value.split(",")
        if len(parts) != 2:
            self.fail(Message("no-place", found=value), param, ctx)
        x, y = (_length_um(part) for part in parts)
        for each in (x, y):
            number(mm(each), PLACE_MM, "--start in mm")
        return Point(x, y)


class Numbers(click.ParamType):  # type: ignore[type-arg]  # generic in newer clicks alone
    """Whole numbers with commas between them."""

    name = "3,1,2"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> tuple[int, ...]:
        """The numbers, each once and from 1."""
        if isinstance(value, tuple):
            return value
        parts = [part.strip() for part in value.split(",")]
        if not all(part.isascii() and part.isdigit() and len(part) < 8 and int(part) for part in parts):
            self.fail(Message("no-figure-numbers", found=value), param, ctx)
        numbers = tuple(map(int, parts))
        if len(set(numbers)) < len(numbers):
            self.fail(Message("figure-named-twice", found=value), param, ctx)
        return numbers


class OnLayer(click.ParamType):  # type: ignore[type-arg]  # generic in newer clicks alone
    """``NAME:side=inside,rank=2,pass=0.12mm``: what is asked for the contours of one layer."""

    name = "NAME:wishes"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> "LayerWish":
        """The wish. Bad use for words that are none; SettingsError for lengths that are none."""
        from sim.setup.making import LayerWish

        if not isinstance(value, str):
            return value  # type: ignore[no-any-return]  # converted before
        layer, colon, rest = value.rpartition(":")
        wishes = [part.partition("=") for part in rest.split(",")]
        if not colon or not layer or not all(equals and wish.strip() for _, equals, wish in wishes):
            self.fail(Message("no-layer-wish", found=value), param, ctx)
        passes_um = tuple(_length_um(wish) for name, _, wish in wishes if name.strip() == "pass")
        others = {name.strip(): wish.strip() for name, _, wish in wishes if name.strip() != "pass"}
        side, rank = others.pop("side", None), others.pop("rank", None)
        if others or (side is not None and side not in SIDE_WISHES) or not _is_rank(rank):
            self.fail(Message("no-such-layer-wish", found=value, sides="|".join(SIDE_WISHES)), param, ctx)
        return LayerWish(layer, side, None if rank is None else int(rank), passes_um)  # type: ignore[arg-type]


def _length_um(text: str) -> float:
    """A length with its unit, or a number in mm, in µm."""
    from sim.base.units import parse_length

    text = text.strip()
    return parse_length(text if not text or text[-1].isalpha() else f"{text}mm")


def _is_rank(text: str | None) -> bool:
    return text is None or (text.removeprefix("-").isdecimal() and text.isascii() and abs(int(text[:6])) <= 1000)


OF_PROOF: Final = (THICKNESS, DIAMETER, replace(SPARK_GAP, option="--spark-gap"))
"""Settings of the run that proves a program; ``--gap`` is the gap in a drawing here."""
OPTIONS = (
    click.option("--tolerance", type=Length()),
    click.option("--part-tolerance", type=Length()),
    click.option("--offset", type=Length()),
    click.option("--no-offset", is_flag=True),
    click.option("--pass", "passes", type=Length(), multiple=True),
    click.option("--one-way", is_flag=True),
    click.option("--start", type=Place(), multiple=True),
    click.option("--thread-layer", metavar="NAME"),
    click.option("--layer", metavar="NAME"),
    click.option("--on-layer", type=OnLayer(), multiple=True),
    click.option("--gap", type=Length()),
    click.option("--side", type=click.Choice(SIDE_WISHES)),
    click.option("--direction", type=click.Choice(DIRECTION_WISHES)),
    click.option("--order", type=Numbers()),
    click.option("--lead", type=click.Choice(LEAD_INS)),
    click.option("--lead-length", type=Length()),
    click.option("--overcut", type=Length()),
    click.option("--tab", type=Length()),
    click.option("--corners", type=click.Choice(CORNERS)),
    click.option("--as", "language", type=click.Choice(["3b", "4b", "iso"])),
    *WRITTEN_IN,
    click.option("--decimals", type=WholeNumber(1, 6)),
    click.option(
        "--compensation",
        type=click.Choice(["worked-in", "kept"]),
    ),
    click.option("--form", type=click.Choice(FORMS)),
    click.option("--end-code", metavar="WORD"),
    click.option("--pause-code", metavar="WORD"),
    click.option("--crlf", is_flag=True),
    click.option("--encoding", type=click.Choice(ENCODINGS)),
    click.option("--machine", metavar="NAME|FILE", shell_complete=offer_machines),
    *length_options(OF_PROOF),
)


def program_options(command: Command) -> Command:
    """Give a command the options that `Options` holds."""
    for option in reversed(OPTIONS):
        command = option(command)
    return command


class Options(NamedTuple):
    """The options as given, lengths in µm; None, False and () where they are left out."""

    tolerance: float | None
    part_tolerance: float | None
    offset: float | None
    no_offset: bool
    passes: tuple[float, ...]
    one_way: bool
    start: "tuple[Point, ...]"
    thread_layer: str | None
    layer: str | None
    on_layer: "tuple[LayerWish, ...]"
    gap: float | None
    side: Any
    direction: Any
    order: tuple[int, ...] | None
    lead: Any
    lead_length: float | None
    overcut: float | None
    tab: float | None
    corners: Any
    language: Any
    dialect: str | None
    unit: str | None
    decimals: int | None
    compensation: Any
    form: Any
    end_code: str | None
    pause_code: str | None
    crlf: bool
    encoding: Any
    machine: str | None
    lengths: Mapping[str, float]


def options_of(options: dict[str, Any]) -> Options:
    """The options as click hands them over. SettingsError for a length out of its bounds."""
    lengths = taken_lengths(OF_PROOF, options)
    for key in OF_PROOF:
        if key.name in lengths:
            key.of_option(lengths[key.name])
    return Options(lengths=lengths, **options)


def making_of(own: "Making", options: Options) -> "Making":
    """What is asked of the maker. UsageError for options that exclude each other; SettingsError for odd numbers."""
    from sim.setup.making import refuse_odd

    given = {
        "tolerance_um": options.tolerance,
        "part_tolerance_um": options.part_tolerance,
        "layer": options.layer,
        "gap_um": options.gap,
        "passes_um": _passes(options),
        "returning": "one-way" if options.one_way else None,
        "side": options.side,
        "direction": options.direction,
        "order": options.order,
        "starts_um": options.start or None,
        "thread_layer": options.thread_layer,
        "lead": options.lead,
        "lead_um": options.lead_length,
        "overcut_um": options.overcut,
        "tab_um": options.tab,
        "corners": options.corners,
        "layers": options.on_layer or None,
    }
    making = own._replace(**{name: value for name, value in given.items() if value is not None})
    refuse_odd(making, "drycut program")
    return making


def _passes(options: Options) -> tuple[float, ...] | None:
    """Offsets of the passes; None where nothing is asked."""
    wishes = {"--offset": options.offset is not None, "--no-offset": options.no_offset, "--pass": bool(options.passes)}
    named = [name for name, is_there in wishes.items() if is_there]
    if len(named) > 1:
        raise click.UsageError(Message("options-say-one-thing", options=" and ".join(named)))
    if options.no_offset:
        return (0.0,)
    return options.passes or (None if options.offset is None else (options.offset,))


def writing_of(own: "Writing", options: Options) -> "Writing":
    """What is asked of the text."""
    given = {
        "form": options.form,
        "end_code": options.end_code,
        "pause_code": options.pause_code,
        "crlf": options.crlf or None,
        "encoding": options.encoding,
        "compensation": options.compensation,
        "decimals": options.decimals,
    }
    return own._replace(**{name: value for name, value in given.items() if value is not None})


def refuse_own_files(output: Path, others: "tuple[Path, ...]") -> None:
    """BadParameter where what is written would take the place of what it is made of."""
    for other in others:
        if output.exists() and other.exists() and output.samefile(other):
            raise click.BadParameter(Message("output-is-the-source", output=output), param_hint="-o")
