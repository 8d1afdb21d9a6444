"""Options that several commands share: lengths with their units, and what an ISO program is read with.

Options that take lengths with their units, and those of settings, made from the rows of their keys.

Options that say what an ISO program is read with: dialect, unit, values of offset registers.
"""

from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import Any, NamedTuple, TypeVar

import click

from parser.findings.errors import Message, SettingsError
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


Command = TypeVar("Command", bound=Callable[..., Any])

_DIALECTS = "fast-wire, classroom, skd2, robofil, sodick, mitsubishi, fanuc, patent-mill, common, strict"


class RegisterSet(NamedTuple):
    """An offset register by its name, such as ``D1``, and what it is set to, µm."""

    name: str
    by_um: float


class Dialect(click.ParamType):  # type: ignore[type-arg]  # generic in newer clicks alone
    """The name of a dialect of ISO."""

    name = "name"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> str:
        """The name; any other than those that there are is bad use."""
        from parser.program import dialects

        if value not in dialects():
            self.fail(Message("not-one-of", found=value, known=", ".join(dialects())), param, ctx)
        return str(value)


class OwnOrNamed(Dialect):
    """The name of a dialect of ISO, or the file of one of a shop's own, which ends in ``.toml``.

    `is_any`: any name is taken, as settings may define it.
    """

    name = "name|FILE.toml"

    def __init__(self, *, is_any: bool = False) -> None:
        self._is_any = is_any

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """The name, or the dialect of the file. FileUnreadableError and SettingsError where that is none."""
        if not isinstance(value, str) or not value.endswith(".toml"):
            is_taken = self._is_any or not isinstance(value, str)
            return value if is_taken else super().convert(value, param, ctx)
        from sim.setup.dialect import own_dialect_of

        return own_dialect_of(Path(value))


class RegisterValue(click.ParamType):  # type: ignore[type-arg]  # generic in newer clicks alone
    """``D0=0.1mm``: an offset register and its value."""

    name = "D0=length"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """The register. A length without a register is bad use: it is an offset for ``drycut run``."""
        if "=" not in value:
            self.fail(Message("names-no-register", found=value), param, ctx)
        return register_set(value)


class OrRegister(click.ParamType):  # type: ignore[type-arg]  # generic in newer clicks alone
    """Values of another type, or ``D0=0.1mm``."""

    def __init__(self, other: click.ParamType) -> None:  # type: ignore[type-arg]  # as above
        self._other = other
        self.name = f"{other.name}|D0=length"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """The register where there is ``=``, else what the other type makes of it."""
        if isinstance(value, str) and "=" in value:
            return register_set(value)
        return self._other.convert(value, param, ctx)


class Offsets(NamedTuple):
    """What ``--offset`` says: values of registers, and the one of another type; None where there is none."""

    registers: tuple[RegisterSet, ...]
    plain: Any


def offsets_of(values: Iterable[Any]) -> Offsets:
    """The values of an option that may be given again for registers. UsageError where two are of the other type."""
    given = tuple(values)
    registers = tuple(each for each in given if isinstance(each, RegisterSet))
    others = [each for each in given if not isinstance(each, RegisterSet)]
    if len(others) > 1:
        raise click.UsageError(Message("two-plain-offsets"))
    return Offsets(registers, others[0] if others else None)


def register_set(text: str) -> RegisterSet:
    """The register that a text such as ``D0=0.1mm`` sets. SettingsError where it is none, or out of its bounds."""
    from parser.dialect.reader import register_name
    from parser.findings.errors import SettingsError
    from parser.units import mm
    from sim.base.units import parse_length
    from sim.setup.dialect import REGISTER_MM
    from sim.setup.toml.reader import number

    before, _, length = text.partition("=")
    name = register_name(before)
    if not name:
        raise SettingsError("option-no-offset-register", found=before.strip())
    by_um = parse_length(length)
    number(mm(by_um), REGISTER_MM, f"--offset {name} in mm")
    return RegisterSet(name, by_um)


UNIT = click.option("--unit", type=click.Choice(["um", "mm", "inch"]))
WRITTEN_IN = (click.option("--dialect", type=Dialect()), UNIT)
"""Of a command that writes programs."""
READ_WITH = (click.option("--dialect", type=OwnOrNamed()), UNIT)
"""Of every command that reads programs."""


def with_dialect(command: Command) -> Command:
    """Give a command the options `READ_WITH`."""
    for option in reversed(READ_WITH):
        command = option(command)
    return command
