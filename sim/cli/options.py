"""Options that several commands share: lengths with their units, and what an ISO program is read with.

Options that take lengths with their units, and those of settings, made from the rows of their keys.

Options that say what an ISO program is read with: dialect, unit, values of offset registers.
"""

from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final, NamedTuple, TypeVar

import click

from parser.findings.errors import Message, SettingsError
from sim.cli.spoken.values import FilePath, WholeNumber
from sim.setup.picks import Picks, pick_of
from sim.setup.toml.keys import Key
from sim.setup.toml.kinds import Lengths as OfLengths
from sim.setup.toml.kinds import Name, Number, OneOf, Places, Text, Truth, ValueKind, Whole, Wholes

if TYPE_CHECKING:
    from controller.taper.shifted_contour import Corner
    from parser.toolpath import Point
    from sim.setup.taper import TaperSettings


Command = TypeVar("Command", bound=Callable[..., Any])


class Length(click.ParamType):  # type: ignore[type-arg]  # generic in newer clicks alone
    """A length with its unit, in µm."""

    name = "length"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> float:
        """The length in µm."""
        from sim.base.units import parse_length

        return value if isinstance(value, float) else parse_length(value)


class Angle(click.ParamType):  # type: ignore[type-arg]  # generic in newer clicks alone
    """An angle in degrees, in rad."""

    name = "angle"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> float:
        """The angle in rad. SettingsError for what is none, or too large."""
        from sim.setup.taper import angle_of

        return value if isinstance(value, float) else angle_of(value, param.opts[0] if param else self.name)


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
        x, y = map(length_um, parts)
        for each in (x, y):
            number(mm(each), PLACE_MM, f"{param.opts[0] if param else self.name} in mm")
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


class Picked(click.ParamType):  # type: ignore[type-arg]  # generic in newer clicks alone
    """What is picked of a drawing."""

    name = "WHAT"

    def convert(self, value: Any, param: click.Parameter | None, _ctx: click.Context | None) -> Any:
        """The pick. SettingsError for what picks nothing."""
        return pick_of(value, param.opts[0] if param else self.name) if isinstance(value, str) else value


def length_um(text: str) -> float:
    """A length with its unit, or a number in mm, in µm."""
    from sim.base.units import parse_length

    text = text.strip()
    return parse_length(text if not text or text[-1].isalpha() else f"{text}mm")


def setting_options(keys: Iterable[Key]) -> tuple[Any, ...]:
    """An option for each key that has one, in their order; what it takes is of the kind of the key's values."""
    return tuple(
        click.option(*filter(None, (key.option, key.older)), parameter(key), **_taking(key.kind))
        for key in keys
        if key.option
    )


def _taking(kind: ValueKind) -> dict[str, Any]:
    """What click is to know of an option whose values are of a kind; of lists each entry is given one by one."""
    if isinstance(kind, OneOf):
        return {"type": click.Choice(kind.words)}
    if isinstance(kind, Whole):
        return {"type": WholeNumber(int(kind.bound.low), int(kind.bound.high))}
    return _TAKING[type(kind)]


_TAKING: Final[Mapping[type[ValueKind], dict[str, Any]]] = {
    Truth: {"is_flag": True},
    Number: {"type": Length()},
    OfLengths: {"type": Length(), "multiple": True},
    Places: {"type": Place(), "multiple": True},
    Wholes: {"type": Numbers()},
    Picks: {"type": Picked(), "multiple": True},
    Name: {"metavar": "WORD"},
    Text: {"metavar": "NAME"},
}


def with_options(options: Sequence[Any]) -> Callable[[Command], Command]:
    """What gives a command some options, which its help lists in their order."""

    def offering(command: Command) -> Command:
        for option in reversed(options):
            command = option(command)
        return command

    return offering


def parameter(key: Key) -> str:
    """The name by which click hands over the option of a key."""
    return key.option.lstrip("-").replace("-", "_")


def taken_settings(keys: Iterable[Key], options: dict[str, Any]) -> Mapping[str, Any]:
    """What options give for keys, by the names of the keys, lengths in µm; they are taken out of the options.

    Options that are left out give nothing. A flag gives the other truth than the usual one.
    """
    values = {key: options.pop(parameter(key)) for key in keys if key.option}
    given = {key: value for key, value in values.items() if value is not None and value is not False and value != ()}
    return {key.name: not key.default if isinstance(key.kind, Truth) else value for key, value in given.items()}


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


with_dialect = with_options(READ_WITH)


TAPER_OPTIONS: Final = (
    click.option("--taper", type=Angle()),
    click.option("--taper-side", type=click.Choice(["left", "right"])),
    click.option("--taper-corner", type=click.Choice(["sharp", "cone"])),
    click.option("--program-plane", type=Length()),
    click.option("--upper", type=FilePath(path_type=Path, dir_okay=False), metavar="PROGRAM"),
)
"""Options of a wire that leans: what they give is `TaperOptions`."""


class TaperOptions(NamedTuple):
    """Options of a wire that leans as given, rad and µm; None where one was left out."""

    taper: float | None = None
    taper_side: str | None = None
    taper_corner: "Corner | None" = None
    program_plane: float | None = None
    upper: Path | None = None


def taken_taper(options: dict[str, Any]) -> TaperOptions:
    """The options of a wire that leans, which are taken out of all."""
    return TaperOptions(*(options.pop(name, None) for name in TaperOptions._fields))


def taper_of(options: TaperOptions, own: "TaperSettings | None") -> "TaperSettings | None":
    """What is told of the lean, with options in place of a scenario's own values; None where nothing is.

    SettingsError where an angle and an upper contour are given, and for a plane out of bounds; FileUnreadableError
    where the upper program is not there.
    """
    if options == TaperOptions() or (own is None and options == TaperOptions(taper=0.0)):
        return own
    from parser.units import mm
    from sim.setup.part import SIDES
    from sim.setup.taper import PLANE_MM, TaperSettings, read_upper
    from sim.setup.toml.reader import number

    if options.program_plane is not None:
        number(mm(options.program_plane), PLANE_MM, "--program-plane in mm")
    given = {
        "angle_rad": options.taper,
        "side": None if options.taper_side is None else SIDES[options.taper_side],
        "corner": options.taper_corner,
        "program_plane_um": options.program_plane,
        "upper": options.upper and read_upper(options.upper),
    }
    values: dict[str, Any] = {name: value for name, value in given.items() if value is not None}
    taper = (own or TaperSettings())._replace(**values)
    if taper.upper is not None and taper.angle_rad is not None:
        raise SettingsError("taper-angle-and-upper", where="--upper")
    return taper
