"""Options of ``drycut program``: what is asked of the maker of a program, in place of a scenario's own values."""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final, NamedTuple, TypeVar, get_args

import click

from parser.findings.errors import Message, SettingsError
from sim.cli.options import (
    TAPER_OPTIONS,
    WRITTEN_IN,
    Length,
    TaperOptions,
    length_um,
    setting_options,
    taken_settings,
    taken_taper,
    with_options,
)
from sim.cli.spoken.values import FilePath, offer_machines
from sim.setup.making import PROGRAM, SIDE_WISHES, Language
from sim.setup.part import GAP, LAYER, MATERIAL, THICKNESS, TOLERANCE, UNIT
from sim.setup.toml.keys import Key
from sim.setup.wire import DIAMETER, SPARK_GAP

if TYPE_CHECKING:
    from sim.setup.making import LayerWish, Making, Writing

Command = TypeVar("Command", bound=Callable[..., Any])


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
        passes_um = tuple(length_um(wish) for name, _, wish in wishes if name.strip() == "pass")
        others = {name.strip(): wish.strip() for name, _, wish in wishes if name.strip() != "pass"}
        side, rank = others.pop("side", None), others.pop("rank", None)
        if others or (side is not None and side not in SIDE_WISHES) or not _is_rank(rank):
            self.fail(Message("no-such-layer-wish", found=value, sides="|".join(SIDE_WISHES)), param, ctx)
        return LayerWish(layer, side, None if rank is None else int(rank), passes_um)  # type: ignore[arg-type]


def _is_rank(text: str | None) -> bool:
    return text is None or (text.removeprefix("-").isdecimal() and text.isascii() and abs(int(text[:6])) <= 1000)


OF_PROOF: Final = (MATERIAL, THICKNESS, DIAMETER, replace(SPARK_GAP, option="--spark-gap"))
"""Settings of the run that proves a program; ``--gap`` is the gap in a drawing here."""
OF_DRAWING: Final = (LAYER, UNIT, replace(TOLERANCE, name="part_tolerance_um", option="--part-tolerance"), GAP)
"""How the drawing is read, and how far the part may be off it; ``--tolerance`` is that of the path."""
_OF_MAKING: Final = tuple(key for key in PROGRAM.keys if key.path.startswith("making."))
_OF_WRITING: Final = tuple(key for key in PROGRAM.keys if key.path.startswith("writing."))
OPTIONS = (
    *setting_options(OF_DRAWING),
    click.option("--on-layer", type=OnLayer(), multiple=True),
    click.option("--offset", type=Length()),
    click.option("--no-offset", is_flag=True),
    click.option("--one-way", is_flag=True),
    *setting_options(_OF_MAKING),
    click.option("--as", "language", type=click.Choice(get_args(Language))),
    *WRITTEN_IN,
    *setting_options(_OF_WRITING),
    click.option("--machine", metavar="NAME|FILE", shell_complete=offer_machines),
    click.option("--technology", type=FilePath(path_type=Path, dir_okay=False), metavar="FILE.toml"),
    *setting_options(OF_PROOF),
    *TAPER_OPTIONS,
)


program_options = with_options(OPTIONS)
"""Gives a command the options that `Options` holds."""


class Options(NamedTuple):
    """The options as given, lengths in µm; None, False and () where they are left out.

    `making`, `writing`, `drawing` and `proof` are those that take the place of settings, by the names of their keys.
    """

    offset: float | None
    no_offset: bool
    one_way: bool
    on_layer: "tuple[LayerWish, ...]"
    language: "Language | None"
    dialect: str | None
    unit: str | None
    machine: str | None
    technology: Path | None
    making: Mapping[str, Any]
    writing: Mapping[str, Any]
    drawing: Mapping[str, Any]
    proof: Mapping[str, Any]
    taper: TaperOptions
    upper: Path | None


def options_of(options: dict[str, Any]) -> Options:
    """The options as click hands them over. SettingsError for a length of the proof out of its bounds."""
    proof = taken_settings(OF_PROOF, options)
    for key in OF_PROOF:
        if key.name in proof:
            key.of_option(proof[key.name])
    taper = taken_taper(options)
    if taper.upper is not None and taper.taper:
        raise SettingsError("taper-angle-and-upper", where="--upper")
    return Options(
        making=taken_settings(_OF_MAKING, options),
        writing=taken_settings(_OF_WRITING, options),
        drawing=taken_settings(OF_DRAWING, options),
        proof=proof,
        taper=taper._replace(upper=None),  # a drawing here
        upper=taper.upper,
        **options,
    )


def making_of(own: "Making", options: Options) -> "Making":
    """What is asked of the maker. UsageError for options that exclude each other; SettingsError for odd numbers."""
    from sim.setup.making import refuse_odd

    given = {
        **_fields(_OF_MAKING, options.making),
        **options.drawing,
        "passes_um": _passes(options),
        "returning": "one-way" if options.one_way else None,
        "layers": options.on_layer or None,
        "upper": options.upper,
    }
    making = own._replace(**{name: value for name, value in given.items() if value is not None})
    refuse_odd(making, "drycut program")
    return making


def _passes(options: Options) -> tuple[float, ...] | None:
    """Offsets of the passes; None where nothing is asked."""
    passes_um = options.making.get("passes_mm")
    wishes = {"--offset": options.offset is not None, "--no-offset": options.no_offset, "--pass": bool(passes_um)}
    named = [name for name, is_there in wishes.items() if is_there]
    if len(named) > 1:
        raise click.UsageError(Message("options-say-one-thing", options=" and ".join(named)))
    if options.no_offset:
        return (0.0,)
    return passes_um or (None if options.offset is None else (options.offset,))


def writing_of(own: "Writing", options: Options) -> "Writing":
    """What is asked of the text."""
    return own._replace(**_fields(_OF_WRITING, options.writing))


def _fields(keys: Iterable[Key], values: Mapping[str, Any]) -> dict[str, Any]:
    """Values by the fields that hold them, in place of the names of their keys."""
    return {key.path.partition(".")[2]: values[key.name] for key in keys if key.name in values}


def refuse_own_files(output: Path, others: "tuple[Path, ...]") -> None:
    """BadParameter where what is written would take the place of what it is made of."""
    for other in others:
        if output.exists() and other.exists() and output.samefile(other):
            raise click.BadParameter(Message("output-is-the-source", output=output), param_hint="-o")
