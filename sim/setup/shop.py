"""What a shop knows of its time and money beside the cut: the sections ``[time]`` and ``[rates]`` of a shop file."""

from pathlib import Path
from typing import Final, NamedTuple

from sim.setup.toml.keys import Key, Section
from sim.setup.toml.kinds import Name, Number
from sim.setup.toml.reader import Bound, load_toml, refuse_unknown

_MINUTES: Final = Bound(0.0, 1e4)
_SECONDS: Final = Bound(0.0, 1e5)
_MONEY: Final = Bound(0.0, 1e9)
_AMOUNT: Final = Bound(0.0, 1e6)


class ShopTimes(NamedTuple):
    """What a cut takes beside its way at the area rate.

    Attributes
    ----------
    threading_min
        Minutes to thread the wire at each further start hole; the first one is part of the set-up. 3 by hand, as
        assumed.
    pierce_min
        Minutes by which the way from a start hole into the contour takes longer.
    corner_wait_s
        Seconds that the wire stands at each corner.
    reversal_s, reversal_every_s
        Seconds without a cut while the drum turns round, and seconds from one turn to the next.
    breaks_per_h, break_min
        How often the wire breaks in an hour of cutting, and minutes until it cuts again.
    """

    threading_min: float = 3.0
    pierce_min: float = 0.0
    corner_wait_s: float = 0.0
    reversal_s: float = 0.0
    reversal_every_s: float = 30.0
    breaks_per_h: float = 0.0
    break_min: float = 5.0


class Rates(NamedTuple):
    """What time costs, in a currency that is a text.

    Attributes
    ----------
    per_hour
        Of the machine and its operator.
    set_up
        Of each program, once.
    wire_per_m, wire_m_min
        Of wire that is used once: its price, and how fast it runs.
    wire_price, wire_life_h
        Of wire that runs to and fro: the price of a drum full, and hours of cutting that it lasts.
    power_kw, per_kwh
        Power that the machine takes, and its price.
    """

    currency: str = ""
    per_hour: float = 0.0
    set_up: float = 0.0
    wire_per_m: float = 0.0
    wire_m_min: float = 0.0
    wire_price: float = 0.0
    wire_life_h: float = 100.0
    power_kw: float = 0.0
    per_kwh: float = 0.0


class Shop(NamedTuple):
    """A shop file: its times, the names of those that it gives, and its rates, None without any."""

    times: ShopTimes = ShopTimes()
    given: tuple[str, ...] = ()
    rates: Rates | None = None


_USUAL, _FREE = ShopTimes(), Rates()
TIME = Section(
    "time",
    (
        Key("threading_min", Number(_MINUTES, "min"), default=_USUAL.threading_min),
        Key("pierce_min", Number(_MINUTES, "min"), default=_USUAL.pierce_min),
        Key("corner_wait_s", Number(_SECONDS, "s"), default=_USUAL.corner_wait_s),
        Key("reversal_s", Number(_SECONDS, "s"), default=_USUAL.reversal_s),
        Key("reversal_every_s", Number(Bound(0.1, 1e5), "s"), default=_USUAL.reversal_every_s),
        Key("breaks_per_h", Number(Bound(0.0, 1e3), "1/h"), default=_USUAL.breaks_per_h),
        Key("break_min", Number(_MINUTES, "min"), default=_USUAL.break_min),
    ),
    fills="times",
)
RATES = Section(
    "rates",
    (
        Key("currency", Name()),
        Key("per_hour", Number(_MONEY, "1/h"), default=_FREE.per_hour),
        Key("set_up", Number(_MONEY), default=_FREE.set_up),
        Key("wire_per_m", Number(_MONEY, "1/m"), default=_FREE.wire_per_m),
        Key("wire_m_min", Number(_AMOUNT, "m/min"), default=_FREE.wire_m_min),
        Key("wire_price", Number(_MONEY), default=_FREE.wire_price),
        Key("wire_life_h", Number(Bound(0.01, 1e6), "h"), default=_FREE.wire_life_h),
        Key("power_kw", Number(_AMOUNT, "kW"), default=_FREE.power_kw),
        Key("per_kwh", Number(_MONEY, "1/kWh"), default=_FREE.per_kwh),
    ),
    fills="rates",
)
SECTIONS: Final = (TIME, RATES)
"""Sections of a shop file."""


def load_shop(path: Path) -> Shop:
    """A shop file. Raises FileUnreadableError, and SettingsError with file and key."""
    content, where = load_toml(path), str(path)
    refuse_unknown(content, (section.name for section in SECTIONS), where)
    given = tuple(content[TIME.name]) if isinstance(content.get(TIME.name), dict) else ()
    rates = Rates(**RATES.read_in(content, where)) if RATES.name in content else None
    return Shop(ShopTimes(**TIME.read_in(content, where)), given, rates)
