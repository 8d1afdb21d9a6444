"""Options that take lengths with their units, and those of settings, made from the rows of their keys."""

from collections.abc import Iterable, Mapping
from typing import Any

import click

from parser.findings.errors import SettingsError
from sim.setup.toml.keys import Key


class Length(click.ParamType):  # type: ignore[type-arg]  # generic in newer clicks alone
    """A length with its unit, in µm."""

    name = "length"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> float:
        """The length in µm."""
        from sim.base.units import parse_length

        return value if isinstance(value, float) else parse_length(value)


class Lengths(click.ParamType):  # type: ignore[type-arg]  # generic in newer clicks alone
    """Lengths with their units, with commas between them, in µm."""

    name = "length,…"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> tuple[float, ...]:
        """The lengths in µm. SettingsError for what is none, and where one is missing beside a comma."""
        from sim.base.units import parse_length

        if isinstance(value, tuple):
            return value
        lengths = value.split(",")
        if len(lengths) > 1 and not all(length.strip() for length in lengths):
            raise SettingsError("lacks-a-length", found=value)
        return tuple(parse_length(length) for length in lengths)


def length_options(keys: Iterable[Key]) -> tuple[Any, ...]:
    """An option for each key that has one, in their order."""
    return tuple(click.option(key.option, type=Length()) for key in keys if key.option)


def parameter(key: Key) -> str:
    """The name by which click hands over the option of a key."""
    return key.option.lstrip("-").replace("-", "_")


def taken_lengths(keys: Iterable[Key], options: dict[str, Any]) -> Mapping[str, float]:
    """Lengths in µm that options give for keys, by the names of the keys; they are taken out of the options."""
    lengths = {key.name: options.pop(parameter(key)) for key in keys if key.option}
    return {name: length for name, length in lengths.items() if length is not None}
