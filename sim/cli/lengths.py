"""Options that are lengths."""

from typing import Any

import click


class Length(click.ParamType):  # type: ignore[type-arg]  # generic in newer clicks alone
    """A length with its unit, in µm."""

    name = "length"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> float:
        """The length in µm."""
        from sim.units import parse_length

        return value if isinstance(value, float) else parse_length(value)
